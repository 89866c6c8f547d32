//! The way of the light: scene → mesh → occluder → shooting → solution, each step timed.

use std::sync::Arc;
use std::time::{Duration, Instant};

use radiosity_core::{
    Asked, Census, Control, Kept, LevelReport, Mesh, MeshConfig, Observer, Probe, Reached,
    RefineConfig, Refined, ShootingConfig, Stage, Statement, StepReport, StopReason, Stopper,
    refine, resume,
};
use scene::{Scene, Solution};

use crate::checkpoint::{self, Identity, Keeper};
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::live::Live;
use crate::memory::{self, Budget};
use crate::prepared::Prepared;
use crate::progress::{Foreseen, Progress};
use crate::screen::{self, Event};
use crate::settings::{MOST_ELEMENTS, Read, Solve};
use crate::snapshot::{Snapshot, Snapshots};
use crate::stages::{StageSeconds, Stages};

/// The unshot share must fall by this factor before the curve gets another point: 23 points
/// per decade, whatever the number of shots.
const CURVE_STEP: f64 = 0.9;

/// How Ctrl-C is called where limits have the names of their flags.
pub(crate) const INTERRUPT: &str = "interrupt";

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
    (progress, live): (&mut Progress, Option<&mut Live<'_>>),
) -> Result<Solved, Failure> {
    let interrupt = Interrupt::listen();
    if let Some(live) = &live {
        live.heed(&interrupt);
    }
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
    progress.solve(Foreseen {
        asked,
        converge: settings.goal.converge(),
        planned: prepared.plan.planned,
        threads: prepared.threads(),
        triangles: scene.triangles().len(),
        most_elements: most.min(fitting),
        most_seconds: settings.limits.time.map(|most| most.as_secs_f64()),
    });
    let mut watch = Watch {
        clock,
        progress,
        stages: Stages::default(),
        most: settings.limits.time,
        interrupt: interrupt.clone(),
        budget,
        kept: 0,
        coarsened: fitting < most,
        keeper: None,
        snapshots,
        snapshot_due: false,
        live,
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

/// Looks at the clock and at memory, hears of interrupts, keeps the curve, and writes snapshots and
/// checkpoints.
struct Watch<'a, 'b> {
    clock: Instant,
    progress: &'a mut Progress,
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
    snapshot_due: bool,
    live: Option<&'a mut Live<'b>>,
    curve: Vec<CurvePoint>,
    /// Points of the curve on earlier levels.
    step: usize,
    refining: bool,
}

impl Watch<'_, '_> {
    /// Whether time is up, or someone said stop.
    fn stopped(&self) -> bool {
        self.interrupt.heard() || self.most.is_some_and(|most| self.clock.elapsed() >= most)
    }
}

impl Observer for Watch<'_, '_> {
    fn stage(&mut self, stage: Stage) {
        self.stages.begin(stage);
        self.progress.stage(stage);
    }

    fn step(&mut self, report: &StepReport) -> Control {
        self.progress.step(report);
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
        let allowed = self.budget.as_ref().map_or(planned, |budget| budget.next_level(self.kept));
        self.coarsened |= allowed < planned;
        self.progress.planned(planned.min(allowed));
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
        let snapshots = self.snapshots.as_ref();
        self.snapshot_due = snapshots.is_some_and(|snapshots| snapshots.due(report, elapsed));
        let watched = self.live.as_ref().is_some_and(|live| live.wants());
        self.snapshot_due || watched
    }

    fn solution(&mut self, report: &StepReport, _: &Mesh, solution: &Solution) {
        if let Some(live) = &mut self.live {
            live.show(report, solution);
        }
        if let Some(snapshots) = self.snapshots.as_mut().filter(|_| self.snapshot_due) {
            snapshots.take(report, solution, || self.clock.elapsed());
        }
    }

    fn level(&mut self, report: &LevelReport) {
        let seconds = self.clock.elapsed().as_secs_f64();
        let level = Some((report.elements, report.statement));
        self.curve.push(CurvePoint { seconds, work: report.work, level });
        self.step = self.curve.len();
        self.kept = report.elements;
        let number = self.progress.level(report);
        match self.refining {
            true => screen::level(number, report, seconds),
            false => screen::log(|| Event::level(number, report)),
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
