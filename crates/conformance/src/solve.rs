//! One scene through one combination of occluder and executor.

use std::fmt;

use accel::{BruteForce, BruteForceConfig, Bvh, BvhConfig, Occluder, Octree, OctreeConfig};
use glam::DVec3;
use radiosity_core::{
    Census, Executor, Ledger, Mesh, MeshConfig, Sequential, Shooting, ShootingConfig, StopReason,
};
use radiosity_par::Pool;
use scene::{Scene, Solution};

use crate::Error;

/// The structure that answers what is in between.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OccluderKind {
    /// `accel::Bvh`.
    Bvh,
    /// `accel::Octree`.
    Octree,
    /// `accel::BruteForce`.
    BruteForce,
}

/// Who runs the loops.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ExecutorKind {
    /// `radiosity_core::Sequential`.
    Sequential,
    /// `radiosity_par::Pool` of so many threads.
    Pool(usize),
}

/// A combination of parts that must give the same light as every other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Engine {
    /// The structure that answers what is in between.
    pub occluder: OccluderKind,
    /// Who runs the loops.
    pub executor: ExecutorKind,
}

impl Engine {
    /// What the others are held to: a BVH, one item after the other.
    pub const FIRST: Self =
        Self { occluder: OccluderKind::Bvh, executor: ExecutorKind::Sequential };

    /// Every occluder with every executor, [`Engine::FIRST`] first. Two threads share the
    /// items evenly, three do not.
    pub fn all() -> impl Iterator<Item = Self> {
        let occluders = [OccluderKind::Bvh, OccluderKind::Octree, OccluderKind::BruteForce];
        let executors = [ExecutorKind::Sequential, ExecutorKind::Pool(2), ExecutorKind::Pool(3)];
        occluders
            .into_iter()
            .flat_map(move |occluder| executors.map(|executor| Self { occluder, executor }))
    }
}

impl fmt::Display for Engine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let occluder = match self.occluder {
            OccluderKind::Bvh => "bvh",
            OccluderKind::Octree => "octree",
            OccluderKind::BruteForce => "brute force",
        };
        match self.executor {
            ExecutorKind::Sequential => write!(f, "{occluder}, sequential"),
            ExecutorKind::Pool(threads) => write!(f, "{occluder}, {threads} threads"),
        }
    }
}

/// What an engine made of a scene.
#[derive(Clone, Debug)]
pub struct Solved {
    /// The light.
    pub solution: Solution,
    /// Where the emitted power went.
    pub ledger: Ledger,
    /// Why the solver stopped.
    pub reason: StopReason,
    /// How many shots it took.
    pub shots: u64,
}

impl Solved {
    /// All light in all elements and corners, bit by bit.
    #[must_use]
    pub fn bits(&self) -> Vec<u64> {
        let elements = self.solution.elements.iter();
        let light = elements.flat_map(|e| {
            let [a, b, c] = e.corner_exitance;
            [e.exitance, a, b, c].into_iter().flat_map(|rgb| rgb.0)
        });
        light.map(f64::to_bits).collect()
    }
}

/// Solves a scene with about `elements` elements.
///
/// # Errors
/// If the operating system refuses the threads.
pub fn solve(
    scene: &Scene,
    elements: usize,
    config: ShootingConfig,
    engine: Engine,
) -> Result<Solved, Error> {
    match engine.executor {
        ExecutorKind::Sequential => Ok(run(scene, elements, config, engine.occluder, &Sequential)),
        ExecutorKind::Pool(threads) => {
            let pool = Pool::new(threads).map_err(|e| Error::caused(engine.to_string(), e))?;
            Ok(run(scene, elements, config, engine.occluder, &pool))
        }
    }
}

fn run<E: Executor>(
    scene: &Scene,
    elements: usize,
    config: ShootingConfig,
    kind: OccluderKind,
    executor: &E,
) -> Solved {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let mesh = Mesh::from_scene(scene, &MeshConfig::with_elements(elements));
    let census = Census::take(scene, &mesh, &bvh, config.exchange, executor);
    let other = occluder(kind, &triangles);
    let occluder = other.as_deref().unwrap_or(&bvh);
    let mut shooting = Shooting::new(&mesh, occluder, &census, executor, config);
    let reason = shooting.run(&mut ());
    Solved {
        solution: shooting.solution(),
        ledger: shooting.ledger(),
        reason,
        shots: shooting.report().shots,
    }
}

/// The occluder asked for; `None` for the BVH, which the census needs in any case.
fn occluder(kind: OccluderKind, triangles: &[[DVec3; 3]]) -> Option<Box<dyn Occluder>> {
    match kind {
        OccluderKind::Bvh => None,
        OccluderKind::Octree => Some(Box::new(Octree::build(triangles, &OctreeConfig::DEFAULT))),
        OccluderKind::BruteForce => {
            Some(Box::new(BruteForce::build(triangles, &BruteForceConfig::default())))
        }
    }
}
