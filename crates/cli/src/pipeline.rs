//! The way of the light: scene → mesh → occluder → shooting → solution, each step timed.

use std::time::{Duration, Instant};

use accel::{Bvh, BvhConfig, Nothing, Occluder, Octree, OctreeConfig};
use radiosity_core::{
    Asked, Census, Control, Executor, LevelReport, Mesh, MeshConfig, Observer, Probe, RefineConfig,
    Refined, ShootingConfig, Statement, StepReport, StopReason, refine,
};
use radiosity_par::{Loop, Pool};
use scene::Scene;

use crate::args::AccelArg;
use crate::failure::Failure;
use crate::screen;
use crate::settings::{Read, Solve, Work};

/// The unshot share must fall by this factor before the curve gets another point: 23 points
/// per decade, whatever the number of shots.
const CURVE_STEP: f64 = 0.9;

/// What finds the occluders, and who does the work.
pub(crate) struct Prepared {
    pub(crate) bvh: Bvh,
    /// What answers in the place of the hierarchy, if asked for.
    other: Option<Box<dyn Occluder>>,
    pub(crate) occluder_name: &'static str,
    pub(crate) occluder_bytes: usize,
    pub(crate) pool: Pool,
    pub(crate) occluder_seconds: f64,
}

/// A solved scene with what it took.
pub(crate) struct Solved {
    pub(crate) refined: Refined,
    pub(crate) seconds: f64,
    pub(crate) curve: Vec<CurvePoint>,
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

/// Builds what finds the occluders.
pub(crate) fn prepare(scene: &Scene, work: &Work, sharing: Loop) -> Result<Prepared, Failure> {
    let pool = Pool::with_loop(work.threads, sharing)?;
    let clock = Instant::now();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let config = BvhConfig::default();
    let bvh = Bvh::build_with(&triangles, &config, |parts, work| pool.for_each(parts, work));
    let (other, occluder_name, occluder_bytes): (Option<Box<dyn Occluder>>, _, _) = match work.accel
    {
        AccelArg::Octree => {
            let octree = Octree::build(&triangles, &OctreeConfig::default());
            let bytes = octree.bytes();
            (Some(Box::new(octree)), "octree", bytes)
        }
        AccelArg::None => (Some(Box::new(Nothing)), "none", 0),
        AccelArg::Auto | AccelArg::Bvh => (None, "bvh", bvh.bytes()),
    };
    let occluder_seconds = clock.elapsed().as_secs_f64();
    Ok(Prepared { bvh, other, occluder_name, occluder_bytes, pool, occluder_seconds })
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
) -> Result<Solved, Failure> {
    let exchange = settings.read.exchange;
    let how = &settings.shooting;
    let config = ShootingConfig {
        exchange,
        schedule: how.schedule,
        ..ShootingConfig::until(settings.goal.converge())
    };
    let asked = settings.goal.asked(scene.triangles().len());
    let (most, which) = settings.limits.most_elements();
    let mut watch = Watch {
        clock: Instant::now(),
        most: settings.limits.time,
        curve: Vec::new(),
        step: 0,
        refining: matches!(asked, Asked::Error(_)),
    };
    let (bvh, occluder) = (&prepared.bvh, prepared.occluder());
    let pool = &prepared.pool;
    let refining = RefineConfig {
        asked,
        most_elements: most,
        split: how.split,
        least_area: how.least_area,
        most_depth: how.most_depth.unwrap_or(u32::MAX),
    };
    let refined = refine(scene, bvh, occluder, pool, config, refining, probes, &mut watch);
    refuse_endless(refined.reason)?;
    let limit = match refined.reached {
        radiosity_core::Reached::Stopped => Some("--max-time"),
        radiosity_core::Reached::ElementLimit => Some(which),
        radiosity_core::Reached::SizeLimit => Some("--min-area or --max-depth"),
        _ => None,
    };
    let seconds = watch.clock.elapsed().as_secs_f64();
    Ok(Solved { refined, seconds, curve: watch.curve, limit })
}

impl Prepared {
    /// How many threads take part.
    pub(crate) fn threads(&self) -> usize {
        self.pool.threads()
    }

    fn occluder(&self) -> &dyn Occluder {
        self.other.as_deref().unwrap_or(&self.bvh)
    }
}

/// Looks at the clock, and keeps the curve.
struct Watch {
    clock: Instant,
    most: Option<Duration>,
    curve: Vec<CurvePoint>,
    /// Points of the curve on earlier levels.
    step: usize,
    refining: bool,
}

impl Observer for Watch {
    fn step(&mut self, report: &StepReport) -> Control {
        let last = self.curve[self.step..].last().map(|point| point.work.unshot);
        if last.is_none_or(|unshot| report.unshot <= unshot * CURVE_STEP) {
            let seconds = self.clock.elapsed().as_secs_f64();
            self.curve.push(CurvePoint { seconds, work: *report, level: None });
        }
        match self.most {
            Some(most) if self.clock.elapsed() >= most => Control::Stop,
            _ => Control::Continue,
        }
    }

    fn level(&mut self, report: &LevelReport) {
        let seconds = self.clock.elapsed().as_secs_f64();
        let level = Some((report.elements, report.statement));
        self.curve.push(CurvePoint { seconds, work: report.work, level });
        self.step = self.curve.len();
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
