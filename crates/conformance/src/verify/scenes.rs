//! What must hold in any scene.

use std::sync::Arc;

use accel::{Bvh, BvhConfig, Octree, OctreeConfig};
use radiosity_core::{Asked, Executor, RefineConfig, Refined, Sequential, ShootingConfig, refine};
use radiosity_par::Pool;
use scene::Scene;

use super::{Check, Outcome};

/// Violation of the energy ledger, relative to the emitted power: rounding of f64 sums.
const BALANCED: f64 = 1e-12;

/// Threads that the bits must not depend on.
const THREADS: usize = 3;

/// Elements of the mesh that is judged, or twice the scene's triangles.
const ELEMENTS: usize = 2000;

/// How many times more the finer mesh has that judges.
const FINER: usize = 4;

/// Scenes of more triangles than this are only shot at for a while.
const SMALL: usize = 1500;

/// Unshot share of the solutions.
const UNSHOT: f64 = 1e-3;

pub(super) fn checks(name: &str, scene: Scene) -> Vec<Check> {
    let scene = Arc::new(scene);
    let with = |what: &str, run: fn(&Scene) -> Outcome| {
        let scene = Arc::clone(&scene);
        Check::new(format!("{name}: {what}"), move || run(&scene))
    };
    let mut checks = vec![
        with("power that is neither absorbed, lost nor unshot", balance),
        with("elements that differ on 3 threads or with an octree", same_bits),
    ];
    if scene.triangles().len() <= SMALL {
        checks.push(with("E1 against a finer mesh, at most as stated", statement));
    }
    checks
}

fn elements(scene: &Scene) -> usize {
    let triangles = scene.triangles().len();
    if triangles <= SMALL { ELEMENTS.max(2 * triangles) } else { triangles }
}

fn run<E: Executor>(scene: &Scene, asked: Asked, executor: &E, octree: bool) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let config = ShootingConfig::until(if scene.triangles().len() <= SMALL { UNSHOT } else { 0.5 });
    let refining = RefineConfig::until(asked);
    if octree {
        let octree = Octree::build(&triangles, &OctreeConfig::DEFAULT);
        refine(scene, &bvh, &octree, executor, config, refining, &[], &mut ())
    } else {
        refine(scene, &bvh, &bvh, executor, config, refining, &[], &mut ())
    }
}

fn balance(scene: &Scene) -> Outcome {
    let asked = Asked::Unstated(elements(scene));
    let imbalance = run(scene, asked, &Sequential, false).ledger.imbalance();
    Outcome { exact: 0.0, ours: imbalance, error: imbalance, bound: BALANCED }
}

fn same_bits(scene: &Scene) -> Outcome {
    let asked = Asked::Unstated(elements(scene));
    let one = run(scene, asked, &Sequential, false);
    let other = match Pool::new(THREADS) {
        Ok(pool) => run(scene, asked, &pool, true),
        Err(_) => run(scene, asked, &Sequential, true),
    };
    let pairs = one.solution.elements.iter().zip(&other.solution.elements);
    let differ = pairs.filter(|(a, b)| a != b).count() as f64;
    Outcome { exact: 0.0, ours: differ, error: differ, bound: 0.0 }
}

fn statement(scene: &Scene) -> Outcome {
    let pool = Pool::new(0);
    let [ours, finer] =
        [Asked::Elements(elements(scene)), Asked::Unstated(FINER * elements(scene))].map(|asked| {
            match &pool {
                Ok(pool) => run(scene, asked, pool, false),
                Err(_) => run(scene, asked, &Sequential, false),
            }
        });
    let stated = ours.statement.map_or(f64::NAN, |s| s.triangles.e1.total());
    let [a, b] = [&ours, &finer].map(|r| r.solution.triangle_exitance(scene));
    let mut worst = 0.0f64;
    for c in 0..3 {
        let (mut apart, mut power) = (0.0, 0.0);
        for id in scene.ids().filter(|id| !scene.material_of(*id).emits()) {
            let (a, b) = (a[id.index()][c], b[id.index()][c]);
            apart += scene.area(id) * (a - b).abs();
            power += scene.area(id) * b;
        }
        if power > 0.0 {
            worst = worst.max(apart / power);
        }
    }
    Outcome { exact: 0.0, ours: worst, error: worst, bound: stated }
}
