//! The way of the light: scene → mesh → occluder → shooting → solution, each step timed.

use std::time::Instant;

use accel::{Bvh, BvhConfig, Nothing, Occluder, Octree, OctreeConfig};
use radiosity_core::{
    Census, Control, Executor, Ledger, Mesh, Shooting, ShootingConfig, StepReport, StopReason,
};
use radiosity_par::Pool;
use scene::{Scene, Solution};

use crate::args::AccelArg;
use crate::failure::Failure;
use crate::settings::{Read, Work};

/// The unshot share must fall by this factor before the curve gets another point: 23 points
/// per decade, whatever the number of shots.
const CURVE_STEP: f64 = 0.9;

/// What was built before the first shot.
pub(crate) struct Prepared {
    pub(crate) mesh: Mesh,
    pub(crate) census: Census,
    pub(crate) occluder: Box<dyn Occluder>,
    pub(crate) occluder_name: &'static str,
    pub(crate) occluder_bytes: usize,
    pub(crate) pool: Pool,
    pub(crate) mesh_seconds: f64,
    pub(crate) occluder_seconds: f64,
    pub(crate) census_seconds: f64,
}

/// A solved scene with what it took.
pub(crate) struct Solved {
    pub(crate) solution: Solution,
    pub(crate) reason: StopReason,
    pub(crate) work: StepReport,
    pub(crate) ledger: Ledger,
    pub(crate) seconds: f64,
    pub(crate) curve: Vec<(f64, StepReport)>,
}

/// Splits the scene and builds what finds the occluders.
pub(crate) fn prepare(scene: &Scene, work: &Work, read: &Read) -> Result<Prepared, Failure> {
    let pool = Pool::new(work.threads)?;
    let clock = Instant::now();
    let mesh = Mesh::from_scene(scene, &work.mesh(scene.triangles().len()));
    let mesh_seconds = clock.elapsed().as_secs_f64();

    let clock = Instant::now();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let octree = (work.accel == AccelArg::Octree)
        .then(|| Octree::build(&triangles, &OctreeConfig::default()));
    let occluder_seconds = clock.elapsed().as_secs_f64();

    let clock = Instant::now();
    let census = Census::take(scene, &mesh, &bvh, read.exchange, &pool);
    let census_seconds = clock.elapsed().as_secs_f64();

    let (occluder, occluder_name, occluder_bytes): (Box<dyn Occluder>, _, _) =
        match (work.accel, octree) {
            (_, Some(octree)) => {
                let bytes = octree.bytes();
                (Box::new(octree), "octree", bytes)
            }
            (AccelArg::None, None) => (Box::new(Nothing), "none", 0),
            _ => {
                let bytes = bvh.bytes();
                (Box::new(bvh), "bvh", bytes)
            }
        };
    Ok(Prepared {
        mesh,
        census,
        occluder,
        occluder_name,
        occluder_bytes,
        pool,
        mesh_seconds,
        occluder_seconds,
        census_seconds,
    })
}

/// Shoots until at most `converge` of the emitted power is unshot.
pub(crate) fn shoot(prepared: &Prepared, read: &Read, converge: f64) -> Result<Solved, Failure> {
    let config = ShootingConfig { exchange: read.exchange, ..ShootingConfig::until(converge) };
    let Prepared { mesh, census, occluder, pool, .. } = prepared;
    let clock = Instant::now();
    let mut shooting = Shooting::new(mesh, occluder.as_ref(), census, pool, config);
    let mut curve: Vec<(f64, StepReport)> = Vec::new();
    let reason = shooting.run(&mut |step: &StepReport| {
        if curve.last().is_none_or(|(_, last)| step.unshot <= last.unshot * CURVE_STEP) {
            curve.push((clock.elapsed().as_secs_f64(), *step));
        }
        Control::Continue
    });
    refuse_endless(reason)?;
    let seconds = clock.elapsed().as_secs_f64();
    let work = shooting.report();
    if curve.last().is_some_and(|(_, last)| last.shots < work.shots) {
        curve.push((seconds, work));
    }
    let (solution, ledger) = (shooting.solution(), shooting.ledger());
    Ok(Solved { solution, reason, work, ledger, seconds, curve })
}

impl Prepared {
    /// How many threads take part.
    pub(crate) fn threads(&self) -> usize {
        self.pool.threads()
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
