//! The way of the light: scene → mesh → occluder → shooting → solution, each step timed.

use std::num::NonZeroUsize;
use std::sync::Arc;
use std::time::{Duration, Instant};

use accel::{Bvh, BvhConfig, Nothing, Occluder, Octree, OctreeConfig, Proven};
use radiosity_core::plan::Structure;
use radiosity_core::{
    Asked, Census, Control, Correction, Executor, Kept, LevelReport, Mesh, MeshConfig, Observer,
    Plan, PlanConfig, Probe, Reached, RefineConfig, Refined, ShootingConfig, Stage, Statement,
    StepReport, StopReason, Stopper, refine, resume,
};
use radiosity_par::{Loop, Pool};
use scene::{Scene, Solution};

use crate::args::AccelArg;
use crate::checkpoint::{self, Identity, Keeper};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::memory::{self, Budget};
use crate::screen;
use crate::settings::{DEFAULT_ERROR, Goal, MOST_ELEMENTS, Read, Solve, Work};
use crate::snapshot::{Snapshot, Snapshots};
use crate::stages::{StageSeconds, Stages};

/// The unshot share must fall by this factor before the curve gets another point: 23 points
/// per decade, whatever the number of shots.
const CURVE_STEP: f64 = 0.9;

/// How Ctrl-C is called where limits have the names of their flags.
pub(crate) const INTERRUPT: &str = "interrupt";

/// What finds the occluders, and who does the work.
pub(crate) struct Prepared {
    pub(crate) plan: Plan,
    /// Over all triangles, for directions; empty where none is followed.
    pub(crate) bvh: Bvh,
    /// What answers segments, if not that.
    other: Option<Box<dyn Occluder>>,
    pub(crate) occluder_name: &'static str,
    pub(crate) occluder_bytes: usize,
    pub(crate) pool: Pool,
    pub(crate) plan_seconds: f64,
    pub(crate) occluder_seconds: f64,
}

/// A solved scene with what it took.
pub(crate) struct Solved {
    pub(crate) refined: Refined,
    pub(crate) seconds: f64,
    /// What the seconds were for; the rest is what is done before the first.
    pub(crate) stages: StageSeconds,
    pub(crate) curve: Vec<CurvePoint>,
    pub(crate) snapshots: Vec<Snapshot>,
    /// The limit that ended the work before its goal.
    pub(crate) limit: Option<&'static str>,
}

/// The state of a solve at one time.
pub(crate) struct CurvePoint {
    pub(crate) seconds: f64,
    pub(crate) work: StepReport,
    /// Elements and statement, after a level of refinement.
    pub(crate) level: Option<(usize, Option<Statement>)>,
}

/// Plans the work, and builds what finds the occluders.
pub(crate) fn prepare(
    scene: &Scene,
    work: &Work,
    read: &Read,
    (goal, correction, timed): (Goal, Correction, bool),
    sharing: Loop,
) -> Result<Prepared, Failure> {
    let clock = Instant::now();
    let plan = Plan::of(scene, &plan_config(work, read, goal, correction, timed, scene));
    let plan_seconds = clock.elapsed().as_secs_f64();
    let pool = Pool::with_loop(plan.threads, sharing)?;
    let clock = Instant::now();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let config = BvhConfig::default();
    let run = |may_block: &dyn Fn(usize) -> bool| {
        Bvh::build_of(&triangles, may_block, &config, |parts, work| pool.for_each(parts, work))
    };
    let all = plan.everything_blocks() || plan.blockers() == triangles.len();
    let blocks = |t: usize| all || plan.facts.blocking[t];
    let by_bvh = plan.structure == Structure::Bvh;
    // Directions end at all triangles, segments at those that may block.
    let bvh = match plan.needs.census || by_bvh && all {
        true => run(&|_| true),
        false => run(&|_| false),
    };
    let (other, bytes): (Option<Box<dyn Occluder>>, _) = match plan.structure {
        Structure::Octree => {
            let octree = Octree::build_of(&triangles, blocks, &OctreeConfig::default());
            let bytes = octree.bytes();
            (Some(Box::new(octree)), bytes)
        }
        Structure::None => (Some(Box::new(Nothing)), 0),
        Structure::Bvh if all => (None, bvh.bytes()),
        Structure::Bvh => {
            let some = run(&blocks);
            let bytes = some.bytes();
            (Some(Box::new(some)), bytes)
        }
    };
    let occluder_seconds = clock.elapsed().as_secs_f64();
    let occluder_name = plan.structure.name();
    Ok(Prepared {
        plan,
        bvh,
        other,
        occluder_name,
        occluder_bytes: bytes,
        pool,
        plan_seconds,
        occluder_seconds,
    })
}

/// What the plan is made for.
fn plan_config(
    work: &Work,
    read: &Read,
    goal: Goal,
    correction: Correction,
    timed: bool,
    scene: &Scene,
) -> PlanConfig {
    let available = std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let (elements, error) = match goal.asked(scene.triangles().len()) {
        Asked::Error(error) => (None, error),
        Asked::Elements(n) | Asked::Unstated(n) => (Some(n), DEFAULT_ERROR),
    };
    PlanConfig {
        elements,
        error,
        unshot: goal.converge(),
        exchange: read.exchange,
        correction,
        structure: match work.accel {
            AccelArg::Auto => None,
            AccelArg::Octree => Some(Structure::Octree),
            AccelArg::Bvh => Some(Structure::Bvh),
            AccelArg::None => Some(Structure::None),
        },
        threads: work.threads.map(|n| if n == 0 { available } else { n }),
        available,
        timed,
        everything: work.everything,
    }
}

/// Splits the scene as one mesh, and samples where its light ends up.
pub(crate) fn mesh(
    scene: &Scene,
    prepared: &Prepared,
    config: &MeshConfig,
    read: &Read,
) -> (Mesh, Census, Duration) {
    let clock = Instant::now();
    let mesh = Mesh::from_scene(scene, config);
    let census = Census::take(scene, &mesh, &prepared.bvh, read.exchange, &prepared.pool);
    (mesh, census, clock.elapsed())
}

/// Solves the scene until the goal or a limit is reached.
pub(crate) fn solve(
    scene: &Scene,
    prepared: &Prepared,
    settings: &Solve,
    probes: &[Probe],
    snapshots: Option<Snapshots<'_>>,
) -> Result<Solved, Failure> {
    let interrupt = Interrupt::listen();
    let exchange = settings.read.exchange;
    let how = &settings.shooting;
    let config = ShootingConfig {
        exchange,
        schedule: how.schedule,
        overshoot: how.overshoot,
        ambient: how.ambient,
        correction: prepared.plan.correction,
        needs: prepared.plan.needs,
        ..ShootingConfig::until(settings.goal.converge())
    };
    let asked = settings.goal.asked(scene.triangles().len());
    let clock = Instant::now();
    let budget = Budget::of(settings, scene).map(|budget| budget.with_pieces(pieces(scene)));
    let schedule = budget.as_ref().map_or(how.schedule, Budget::schedule);
    let config = ShootingConfig { schedule, ..config };
    let fitting = match &budget {
        Some(budget) => fitting(budget, asked)?,
        None => usize::MAX,
    };
    let most = settings.limits.elements.unwrap_or(MOST_ELEMENTS).min(MOST_ELEMENTS);
    let mut watch = Watch {
        clock,
        stages: Stages::default(),
        most: settings.limits.time,
        interrupt: interrupt.clone(),
        budget,
        kept: 0,
        coarsened: fitting < most,
        keeper: None,
        snapshots,
        curve: Vec::new(),
        step: 0,
        refining: matches!(asked, Asked::Error(_)),
    };
    let proven = prepared.proven();
    let (bvh, occluder) = (&prepared.bvh, prepared.occluder(&proven));
    let pool = &prepared.pool;
    let refining = RefineConfig {
        asked,
        most_elements: most.min(fitting),
        split: how.split,
        least_area: how.least_area,
        most_depth: how.most_depth.unwrap_or(u32::MAX),
    };
    let identity = Identity::of(scene, prepared.occluder_name, &config, &refining, probes);
    watch.keeper = Keeper::of(&settings.keeping, &identity);
    let refined = match &settings.keeping.resume {
        None => {
            pool.run(|| refine(scene, bvh, occluder, pool, config, refining, probes, &mut watch))
        }
        Some(path) => {
            let kept = checkpoint::read(path, &identity)?;
            watch.kept = kept.finished_elements();
            screen::say(&format!("{}: going on from there", path.display()));
            pool.run(|| {
                resume(kept, scene, bvh, occluder, pool, config, refining, probes, &mut watch)
            })
            .map_err(|e| checkpoint::inconsistent(path, e))?
        }
    };
    watch.stages.stop();
    refuse_endless(refined.reason)?;
    let limit = match refined.reached {
        Reached::Stopped if interrupt.heard() => Some(INTERRUPT),
        Reached::Stopped => Some("--max-time"),
        Reached::ElementLimit if watch.coarsened => Some("--max-memory"),
        Reached::ElementLimit if settings.limits.elements.is_some() => Some("--max-elements"),
        Reached::ElementLimit => Some("the widest mesh there is"),
        Reached::SizeLimit => Some("--min-area or --max-depth"),
        _ => None,
    };
    if let Some(keeper) = watch.keeper.filter(|_| refined.reached == Reached::Stopped) {
        keeper.say_how_to_go_on();
    }
    let seconds = watch.clock.elapsed().as_secs_f64();
    let stages = watch.stages.seconds();
    let snapshots = watch.snapshots.map_or_else(Vec::new, |snapshots| {
        snapshots.say_failed();
        snapshots.written
    });
    Ok(Solved { refined, seconds, stages, curve: watch.curve, snapshots, limit })
}

/// What the scene's triangles are cut into, which is known only by cutting them.
fn pieces(scene: &Scene) -> usize {
    Mesh::from_scene(scene, &MeshConfig::with_elements(1)).elements().len()
}

/// How many elements fit into memory; warns if more are asked for.
fn fitting(budget: &Budget, asked: Asked) -> Result<usize, Failure> {
    budget.check()?;
    let fitting = budget.last_level(!matches!(asked, Asked::Unstated(_))).max(1);
    if let Asked::Elements(n) | Asked::Unstated(n) = asked
        && n > fitting
    {
        screen::warning(&format!(
            "--max-memory: {} elements instead of {}, which may take {}",
            screen::count(fitting as u64),
            screen::count(n as u64),
            memory::size(budget.bytes(n))
        ));
    }
    Ok(fitting)
}

impl Prepared {
    /// How many threads take part.
    pub(crate) fn threads(&self) -> usize {
        self.pool.threads()
    }

    /// What answers segments, with what is known beside them.
    fn proven(&self) -> Proven<'_> {
        Proven::new(self.other.as_deref().unwrap_or(&self.bvh), &self.plan.proofs)
    }

    fn occluder<'a>(&'a self, proven: &'a Proven<'a>) -> &'a dyn Occluder {
        let proofs = &self.plan.proofs;
        let known = !proofs.walls.is_empty() || proofs.objects.is_some();
        match known || proofs.spaces.shells() > 0 {
            true => proven,
            false => self.other.as_deref().unwrap_or(&self.bvh),
        }
    }
}

/// Looks at the clock and at memory, hears of interrupts, keeps the curve, and writes snapshots and
/// checkpoints.
struct Watch<'a> {
    clock: Instant,
    stages: Stages,
    most: Option<Duration>,
    interrupt: Interrupt,
    budget: Option<Budget>,
    /// Elements of the last finished level.
    kept: usize,
    /// Memory allows fewer elements than all other limits.
    coarsened: bool,
    keeper: Option<Keeper>,
    snapshots: Option<Snapshots<'a>>,
    curve: Vec<CurvePoint>,
    /// Points of the curve on earlier levels.
    step: usize,
    refining: bool,
}

impl Watch<'_> {
    /// Whether time is up, or someone said stop.
    fn stopped(&self) -> bool {
        self.interrupt.heard() || self.most.is_some_and(|most| self.clock.elapsed() >= most)
    }
}

impl Observer for Watch<'_> {
    fn stage(&mut self, stage: Stage) {
        self.stages.begin(stage);
    }

    fn step(&mut self, report: &StepReport) -> Control {
        let last = self.curve[self.step..].last().map(|point| point.work.unshot);
        if last.is_none_or(|unshot| report.unshot <= unshot * CURVE_STEP) {
            let seconds = self.clock.elapsed().as_secs_f64();
            self.curve.push(CurvePoint { seconds, work: *report, level: None });
        }
        if self.stopped() { Control::Stop } else { Control::Continue }
    }

    fn stopper(&self) -> Option<Stopper> {
        let (clock, most, interrupt) = (self.clock, self.most, self.interrupt.clone());
        Some(Arc::new(move || {
            interrupt.heard() || most.is_some_and(|most| clock.elapsed() >= most)
        }))
    }

    fn elements(&mut self, planned: usize) -> usize {
        let Some(budget) = &self.budget else { return planned };
        let allowed = budget.next_level(self.kept);
        self.coarsened |= allowed < planned;
        allowed
    }

    fn keeps(&mut self) -> bool {
        let stopped = self.stopped();
        self.keeper.as_ref().is_some_and(|keeper| stopped || keeper.due())
    }

    fn keep(&mut self, kept: &Kept<'_>) {
        if let Some(keeper) = &mut self.keeper {
            keeper.keep(kept);
        }
    }

    fn wants_solution(&mut self, report: &StepReport) -> bool {
        let elapsed = self.clock.elapsed();
        self.snapshots.as_ref().is_some_and(|snapshots| snapshots.due(report, elapsed))
    }

    fn solution(&mut self, report: &StepReport, _: &Mesh, solution: &Solution) {
        if let Some(snapshots) = &mut self.snapshots {
            snapshots.take(report, solution, || self.clock.elapsed());
        }
    }

    fn level(&mut self, report: &LevelReport) {
        let seconds = self.clock.elapsed().as_secs_f64();
        let level = Some((report.elements, report.statement));
        self.curve.push(CurvePoint { seconds, work: report.work, level });
        self.step = self.curve.len();
        self.kept = report.elements;
        if self.refining {
            screen::level(report, seconds);
        }
    }
}

/// A scene whose light has no end has no solution to write.
fn refuse_endless(reason: StopReason) -> Result<(), Failure> {
    match reason {
        StopReason::Singular => Err(Failure::Failed(
            "the scene is closed and lit and every reflectance is 1: nothing absorbs the light, \
             so there is no solution; lower a reflectance or open the scene"
                .into(),
        )),
        StopReason::Stalled => Err(Failure::Failed(
            "the unshot power no longer falls: the scene absorbs less than about 0.005 % of the \
             light per bounce; lower a reflectance or open the scene"
                .into(),
        )),
        StopReason::Diverged => Err(Failure::Failed(
            "the light grows from bounce to bounce: surfaces that face the same way lie in one \
             another, and each takes the light of all; take the copies out"
                .into(),
        )),
        _ => Ok(()),
    }
}
