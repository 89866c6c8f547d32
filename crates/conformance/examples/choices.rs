//! What each choice of the solver is worth: the tables of docs/design.md.
//!
//! `cargo run --release -p radiosity-conformance --example choices`, with the reference data beside the
//! checkout. Rows: error E1 of the worst channel against the path-traced reference.

#![expect(clippy::print_stdout, reason = "its output is its purpose")]

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use accel::{Bvh, BvhConfig};
use conformance::shared;
use output::csv;
use radiosity_core::{Census, Exchange, Mesh, MeshConfig, Shooting, ShootingConfig};
use radiosity_par::Pool;
use scene::Scene;

const ELEMENTS: usize = 15_000;
const UNSHOT: f64 = 1e-3;

struct Subject {
    name: &'static str,
    scene: Scene,
    reference: Vec<csv::Row>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut subjects = Vec::new();
    for (name, file, reference) in [
        ("room", "scenes/room.tri", "reference/room_onesided.csv"),
        ("Cornell box", "scenes/cornell.obj", "reference/cornell.csv"),
    ] {
        let (Some(file), Some(reference)) = (shared::find(file), shared::find(reference)) else {
            println!("skipped: no reference data for {name} beside the checkout");
            continue;
        };
        subjects.push(open(name, &file, &reference)?);
    }
    let pool = Pool::new(0)?;
    println!("{ELEMENTS} elements, unshot {UNSHOT}\n");
    let default = MeshConfig::with_elements(ELEMENTS);
    let config = ShootingConfig::until(UNSHOT);
    println!(
        "| elements per patch | scene | shots | segments | E1 | seconds |\n|---|---|---|---|---|---|"
    );
    for patch_elements in [4, 8, 15, default.patch_elements, 32, 64] {
        for subject in &subjects {
            let mesh = MeshConfig { patch_elements, ..default };
            row(&patch_elements.to_string(), subject, mesh, config, &pool)?;
        }
    }
    println!(
        "\n| points inside when brighter than | scene | shots | segments | E1 | seconds |\n|---|---|---|---|---|---|"
    );
    for bright in [f64::INFINITY, 8.0, 4.0, config.bright, 1.0, 0.25] {
        for subject in &subjects {
            let config = ShootingConfig { bright, ..config };
            row(&bright.to_string(), subject, default, config, &pool)?;
        }
    }
    println!(
        "\n| cell share | scene | shots | segments | E1 | seconds |\n|---|---|---|---|---|---|"
    );
    for cell_share in [f64::INFINITY, 0.2, config.cell_share, 0.01] {
        for subject in &subjects {
            let config = ShootingConfig { cell_share, ..config };
            row(&cell_share.to_string(), subject, default, config, &pool)?;
        }
    }
    println!(
        "\n| points inside when brighter than | elements | white furnace at ρ = .9: B/B* |\n|---|---|---|"
    );
    for bright in [config.bright, 0.1] {
        for elements in [192, 768, 3000] {
            let (low, high) = furnace(elements, ShootingConfig { bright, ..config }, &pool)?;
            println!("| {bright} | {elements} | {low:.4} to {high:.4} |");
        }
    }
    Ok(())
}

fn open(name: &'static str, file: &Path, reference: &Path) -> Result<Subject, Box<dyn Error>> {
    let scene = scene_import::open(file, &scene_import::Options::default())?.scene;
    let reference = csv::read(std::fs::File::open(reference)?)?;
    Ok(Subject { name, scene, reference })
}

fn row(
    choice: &str,
    subject: &Subject,
    mesh: MeshConfig,
    config: ShootingConfig,
    pool: &Pool,
) -> Result<(), Box<dyn Error>> {
    let clock = Instant::now();
    let scene = &subject.scene;
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let mesh = Mesh::from_scene(scene, &mesh);
    let census = Census::take(scene, &mesh, &bvh, Exchange::OneSided, pool);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, pool, config);
    shooting.run(&mut ());
    let ours = csv::rows(scene, &shooting.solution())?;
    let error = output::compare(&ours, &subject.reference)?.worst_e1();
    let work = shooting.report();
    println!(
        "| {choice} | {} | {} | {:.1} M | {:.2} % | {:.1} |",
        subject.name,
        work.shots,
        work.rays as f64 / 1e6,
        error * 100.0,
        clock.elapsed().as_secs_f64()
    );
    Ok(())
}

/// The smallest and the largest exitance of a cube furnace over the exact one.
fn furnace(
    elements: usize,
    config: ShootingConfig,
    pool: &Pool,
) -> Result<(f64, f64), Box<dyn Error>> {
    const REFLECTANCE: f64 = 0.9;
    let mut builder = scene::SceneBuilder::new();
    let walls = builder.group("walls");
    let white = builder.material(scene::Material {
        name: "white".into(),
        reflectance: scene::Rgb::splat(REFLECTANCE),
        emittance: scene::Rgb::splat(1.0 - REFLECTANCE),
        sides: scene::Sides::Front,
    })?;
    let corner = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
        builder.vertex([f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)].into())
    });
    for [a, b, c, d] in
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    {
        builder.triangle([corner[a], corner[b], corner[c]], white, walls)?;
        builder.triangle([corner[a], corner[c], corner[d]], white, walls)?;
    }
    let scene = builder.finish();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(elements));
    let census = Census::default();
    let mut shooting = Shooting::new(&mesh, &bvh, &census, pool, config);
    shooting.run(&mut ());
    let solution = shooting.solution();
    let values = solution.elements.iter().map(|e| e.exitance[0]);
    Ok(values.fold((f64::INFINITY, 0.0), |(low, high), b| (low.min(b), high.max(b))))
}
