//! A small piece of work, so that there is something to go on with.

use accel::{Bvh, BvhConfig};
use glam::{DVec3, dvec3};
use radiosity_core::{
    Asked, Checkpoint, Inconsistent, Observer, RefineConfig, Refined, Sequential, ShootingConfig,
    refine, resume,
};
use scene::{Material, Rgb, Scene, SceneBuilder, Sides};

/// Elements that the work may take.
const MOST_ELEMENTS: usize = 60;

/// A lamp over a floor, with a board between them.
#[derive(Debug)]
pub struct Work {
    scene: Scene,
    bvh: Bvh,
}

impl Work {
    /// The same work each time.
    #[must_use]
    pub fn new() -> Self {
        let scene = scene();
        let triangles: Vec<[DVec3; 3]> = scene.ids().map(|id| scene.corners(id)).collect();
        let bvh = Bvh::build(&triangles, &BvhConfig::default());
        Self { scene, bvh }
    }

    /// Does it.
    pub fn solve(&self, observer: &mut impl Observer) -> Refined {
        let Self { scene, bvh } = self;
        let (config, refining) = asked();
        refine(scene, bvh, bvh, &Sequential, config, refining, &[], observer)
    }

    /// Goes on with it.
    ///
    /// # Errors
    /// If the checkpoint is of other work.
    pub fn resume(
        &self,
        checkpoint: Checkpoint,
        observer: &mut impl Observer,
    ) -> Result<Refined, Inconsistent> {
        let Self { scene, bvh } = self;
        let (config, refining) = asked();
        resume(checkpoint, scene, bvh, bvh, &Sequential, config, refining, &[], observer)
    }
}

impl Default for Work {
    fn default() -> Self {
        Self::new()
    }
}

fn asked() -> (ShootingConfig, RefineConfig) {
    let refining = RefineConfig::until(Asked::Error(0.05));
    (ShootingConfig::until(1e-4), RefineConfig { most_elements: MOST_ELEMENTS, ..refining })
}

fn scene() -> Scene {
    let mut builder = SceneBuilder::new();
    let group = builder.group("all");
    let mut square = |height: f64, side: f64, up: bool, reflectance: f64, emittance: f64| {
        let material = builder
            .material(Material {
                name: "surface".to_owned(),
                reflectance: Rgb::splat(reflectance),
                emittance: Rgb::splat(emittance),
                sides: Sides::Front,
            })
            .expect("the numbers are those of a surface");
        let [a, b, c, d] = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)]
            .map(|(x, y)| builder.vertex(dvec3(x, y, height)));
        let corners = if up { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] };
        for corners in corners {
            builder.triangle(corners, material, group).expect("the numbers are in range");
        }
    };
    square(0.0, 1.0, true, 0.9, 0.0);
    square(0.5, 0.3, true, 0.5, 0.0);
    square(1.0, 1.0, false, 0.9, 1.0);
    builder.finish()
}
