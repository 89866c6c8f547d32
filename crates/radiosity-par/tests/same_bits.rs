//! The same bits on any number of threads.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use radiosity_core::{
    Census, Exchange, Executor, Ledger, Mesh, MeshConfig, Sequential, Shooting, ShootingConfig,
};
use radiosity_par::Pool;
use scene::{Material, Rgb, Scene, SceneBuilder, Sides, Solution};

/// A box with one bright face, and a board inside that throws a shadow.
fn scene() -> Scene {
    let mut builder = SceneBuilder::new();
    let group = builder.group("box");
    let mut surface = |reflectance: [f64; 3], emittance: f64| {
        let (reflectance, emittance) = (Rgb(reflectance), Rgb::splat(emittance));
        let material = Material { name: "s".into(), reflectance, emittance, sides: Sides::Both };
        builder.material(material).unwrap()
    };
    let wall = surface([0.6, 0.4, 0.2], 0.0);
    let lamp = surface([0.2; 3], 7.0);
    let corner =
        |i: u32| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)) * 3.0;
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let board = [[1.0, 1.0, 1.5], [2.0, 1.0, 1.5], [2.0, 2.0, 1.4], [1.0, 2.0, 1.4]];
    let quads = faces.map(|f| f.map(corner)).into_iter().chain([board.map(DVec3::from)]);
    for (i, [a, b, c, d]) in quads.enumerate() {
        let material = if i == 1 { lamp } else { wall };
        for t in [[a, b, c], [a, c, d]] {
            let v = t.map(|p| builder.vertex(p));
            builder.triangle(v, material, group).unwrap();
        }
    }
    builder.finish()
}

fn solve<E: Executor>(scene: &Scene, executor: &E) -> (Solution, Ledger, u64) {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let mesh = Mesh::from_scene(scene, &MeshConfig::with_elements(4000));
    let census = Census::take(scene, &mesh, &bvh, Exchange::OneSided, executor);
    let config = ShootingConfig::until(0.02);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, executor, config);
    shooting.run(&mut ());
    (shooting.solution(), shooting.ledger(), shooting.report().rays)
}

#[test]
fn on_1_2_3_8_and_24_threads() {
    let scene = scene();
    let expected = solve(&scene, &Sequential);
    assert!(expected.2 > 100_000, "the test must have work to share out");
    for threads in [1, 2, 3, 8, 24] {
        let pool = Pool::new(threads).unwrap();
        assert_eq!(pool.threads(), threads);
        assert!(solve(&scene, &pool) == expected, "{threads} threads");
    }
}

#[test]
fn zero_asks_for_all_the_machine_has() {
    let available = std::thread::available_parallelism().unwrap().get();
    assert_eq!(Pool::new(0).unwrap().threads(), available);
}

#[test]
fn the_callers_own_pool_stays_untouched() {
    // Items run on threads that bear our name.
    let names = std::sync::Mutex::new(Vec::new());
    let mut items = [(); 64];
    Pool::new(2).unwrap().for_each(&mut items, |()| {
        let name = std::thread::current().name().unwrap_or("").to_owned();
        names.lock().unwrap().push(name);
    });
    assert!(names.lock().unwrap().iter().all(|n| n.starts_with("radiosity-")));
}
