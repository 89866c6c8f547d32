//! How many sweeps the shooting takes, by reflectance, with and without ambient corrections, as
//! CSV: `cargo run --release -p radiosity-conformance --example sweeps`. `cargo xtask numerics` draws it.
//!
//! A closed cube of one reflectance, one face of which emits, shot until a millionth of the
//! light is unshot. A sweep is one shot per patch.

#![expect(clippy::print_stdout, reason = "its output is its purpose")]

use std::error::Error;

use accel::{Bvh, BvhConfig};
use conformance::Geometry;
use radiosity_core::{
    Census, Correction, Exchange, Mesh, MeshConfig, Sequential, Shooting, ShootingConfig,
    StopReason, StopRule,
};
use scene::{Material, Rgb, Sides};

const REFLECTANCES: [f64; 10] = [0.5, 0.7, 0.8, 0.9, 0.95, 0.99, 0.999, 0.9999, 0.99999, 0.999_999];

const ELEMENTS: usize = 384;

const UNSHOT: f64 = 1e-6;

/// Sweeps after which plain shooting is given up.
const MOST_SWEEPS: u64 = 1000;

fn main() -> Result<(), Box<dyn Error>> {
    println!("reflectance,correction,sweeps,stopped");
    for reflectance in REFLECTANCES {
        for (name, correction) in [("auto", Correction::Auto), ("never", Correction::Never)] {
            let (sweeps, reason) = sweeps(reflectance, correction)?;
            let stopped = match reason {
                StopReason::Converged => "converged",
                StopReason::ShotLimit => "limit",
                StopReason::Stalled => "stalled",
                other => return Err(format!("{name} at {reflectance}: {other:?}").into()),
            };
            println!("{reflectance},{name},{sweeps:.3},{stopped}");
        }
    }
    Ok(())
}

/// Shots per patch, and why the shooting stopped.
fn sweeps(reflectance: f64, correction: Correction) -> Result<(f64, StopReason), Box<dyn Error>> {
    let cube = Geometry::Box { size: [1.0; 3] };
    let scene = cube.scene(|face| {
        Ok(Material {
            name: face.into(),
            reflectance: Rgb::splat(reflectance),
            emittance: Rgb::splat(if face == "z1" { 1.0 } else { 0.0 }),
            sides: Sides::Front,
        })
    })?;
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(ELEMENTS));
    let patches = mesh.patches().len() as u64;
    let stop = StopRule { unshot: UNSHOT, max_shots: Some(MOST_SWEEPS * patches) };
    let config = ShootingConfig { stop, correction, ..ShootingConfig::until(UNSHOT) };
    // Which says that the scene is closed, and so that its rows may be.
    let census = Census::take(&scene, &mesh, &bvh, Exchange::OneSided, &Sequential);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, &Sequential, config);
    let reason = shooting.run(&mut ());
    Ok((shooting.report().shots as f64 / patches as f64, reason))
}
