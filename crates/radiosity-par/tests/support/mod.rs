//! A room to solve, for the tests and the benches.

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use radiosity_core::{
    Census, Exchange, Executor, Ledger, Mesh, MeshConfig, Shooting, ShootingConfig,
};
use scene::{Material, Rgb, Scene, SceneBuilder, Sides, Solution};

/// All that a solve needs and no executor touches.
pub(crate) struct Room {
    scene: Scene,
    mesh: Mesh,
    bvh: Bvh,
}

/// All that a solve gives, to compare bit by bit.
#[derive(PartialEq)]
pub(crate) struct Outcome {
    pub(crate) solution: Solution,
    pub(crate) ledger: Ledger,
    pub(crate) rays: u64,
}

impl Room {
    pub(crate) fn with_elements(elements: usize) -> Self {
        let scene = scene();
        let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
        let bvh = Bvh::build(&triangles, &BvhConfig::default());
        let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(elements));
        Self { scene, mesh, bvh }
    }

    pub(crate) fn solve<E: Executor>(&self, executor: &E) -> Outcome {
        let Self { scene, mesh, bvh } = self;
        let census = Census::take(scene, mesh, bvh, Exchange::OneSided, executor);
        let config = ShootingConfig::until(0.02);
        let mut shooting = Shooting::new(mesh, bvh, &census, executor, config);
        shooting.run(&mut ());
        let rays = shooting.report().rays;
        Outcome { solution: shooting.solution(), ledger: shooting.ledger(), rays }
    }
}

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
