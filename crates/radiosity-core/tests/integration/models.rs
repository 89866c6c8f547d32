//! Small scenes built in code, and a short way to solve them.

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use radiosity_core::{
    Census, Exchange, Ledger, Mesh, MeshConfig, Sequential, Shooting, ShootingConfig, StopReason,
};
use scene::{Material, MaterialId, Rgb, Scene, SceneBuilder, Sides, Solution};

pub(crate) struct Model {
    builder: SceneBuilder,
}

impl Model {
    pub(crate) fn new() -> Self {
        let mut builder = SceneBuilder::new();
        builder.group("all");
        Self { builder }
    }

    pub(crate) fn surface(&mut self, reflectance: f64, emittance: f64) -> MaterialId {
        self.sided(reflectance, emittance, Sides::Front)
    }

    pub(crate) fn sided(&mut self, reflectance: f64, emittance: f64, sides: Sides) -> MaterialId {
        let material = Material {
            name: "surface".into(),
            reflectance: Rgb::splat(reflectance),
            emittance: Rgb::new(emittance, emittance / 2.0, 0.0),
            sides,
        };
        self.builder.material(material).unwrap()
    }

    pub(crate) fn triangle(&mut self, corners: [[f64; 3]; 3], material: MaterialId) {
        let v = corners.map(|c| self.builder.vertex(DVec3::from(c)));
        self.builder.triangle(v, material, scene::GroupId(0)).unwrap();
    }

    /// A quadrilateral a b c d, counter-clockwise seen from its front.
    pub(crate) fn quad(&mut self, [a, b, c, d]: [[f64; 3]; 4], material: MaterialId) {
        self.triangle([a, b, c], material);
        self.triangle([a, c, d], material);
    }

    /// A unit cube seen from inside: floor, ceiling, and four walls, each with a material.
    pub(crate) fn cube(&mut self, materials: [MaterialId; 6]) {
        self.cube_at(0.0, materials);
    }

    /// The same, moved along x.
    pub(crate) fn cube_at(&mut self, x: f64, materials: [MaterialId; 6]) {
        let p = |i: usize| [x + (i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64];
        let faces =
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        for (face, material) in faces.into_iter().zip(materials) {
            self.quad(face.map(p), material);
        }
    }

    pub(crate) fn scene(self) -> Scene {
        self.builder.finish()
    }
}

pub(crate) struct Solved {
    pub(crate) solution: Solution,
    pub(crate) ledger: Ledger,
    pub(crate) reason: StopReason,
    pub(crate) shots: u64,
    pub(crate) rays: u64,
    pub(crate) patches: usize,
    pub(crate) corrected: bool,
    pub(crate) closed_rows: Option<[f64; 2]>,
}

pub(crate) fn solve(scene: &Scene, elements: usize, config: ShootingConfig) -> Solved {
    solve_mesh(scene, &Mesh::from_scene(scene, &MeshConfig::with_elements(elements)), config)
}

pub(crate) fn solve_mesh(scene: &Scene, mesh: &Mesh, config: ShootingConfig) -> Solved {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let census = Census::take(scene, mesh, &bvh, config.exchange, &Sequential);
    let mut shooting = Shooting::new(mesh, &bvh, &census, &Sequential, config);
    let reason = shooting.run(&mut ());
    Solved {
        solution: shooting.solution(),
        ledger: shooting.ledger(),
        reason,
        shots: shooting.report().shots,
        rays: shooting.report().rays,
        patches: mesh.patches().len(),
        corrected: shooting.corrected(),
        closed_rows: shooting.closed_rows(),
    }
}

pub(crate) fn until(unshot: f64) -> ShootingConfig {
    ShootingConfig::until(unshot)
}

pub(crate) fn paired(unshot: f64) -> ShootingConfig {
    ShootingConfig { exchange: Exchange::Paired, ..until(unshot) }
}
