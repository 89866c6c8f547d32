//! What splitting where the light changes is worth: a table of docs/performance/splitting.md.
//!
//! `cargo run --release -p radiosity-conformance --example splits`, with the reference data beside the
//! checkout. For each way to split: angles, segments, the stated error, and the true one against
//! the path-traced reference.

#![expect(clippy::print_stdout, reason = "its output is its purpose")]

use std::error::Error;
use std::path::Path;
use std::time::Instant;

use accel::{Bvh, BvhConfig};
use conformance::shared;
use output::csv;
use radiosity_core::{Asked, Mesh, RefineConfig, ShootingConfig, Split, refine};
use radiosity_par::Pool;

fn main() -> Result<(), Box<dyn Error>> {
    let pool = Pool::new(0)?;
    println!(
        "| scene | split | elements | least angle, 1 in 100 below | segments | seconds | stated E1 | true E1 | true Einf |\n|---|---|---|---|---|---|---|---|---|"
    );
    for (name, file, reference) in [
        ("room", "scenes/room.tri", "reference/room_onesided.csv"),
        ("blocks", "scenes/blocks.tri", "reference/blocks_onesided.csv"),
        ("Cornell box", "scenes/cornell.obj", "reference/cornell.csv"),
    ] {
        let (Some(file), Some(reference)) = (shared::find(file), shared::find(reference)) else {
            println!("skipped: no reference data for {name} beside the checkout");
            continue;
        };
        for most in [6_000, 24_000] {
            for (split, called) in [
                (Split::LongestEdge, "longest edge"),
                (Split::Centroid, "centroid"),
                (Split::None, "none"),
            ] {
                row(name, &file, &reference, most, split, called, &pool)?;
            }
        }
    }
    Ok(())
}

fn row(
    name: &str,
    file: &Path,
    reference: &Path,
    most_elements: usize,
    split: Split,
    called: &str,
    pool: &Pool,
) -> Result<(), Box<dyn Error>> {
    let scene = scene_import::open(file, &scene_import::Options::default())?.scene;
    let reference = csv::read(std::fs::File::open(reference)?)?;
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    // An error that is never reached: the limit on the elements ends the work.
    let refining = RefineConfig { most_elements, split, ..RefineConfig::until(Asked::Error(1e-9)) };
    let config = ShootingConfig::until(1e-3);
    let clock = Instant::now();
    let refined = refine(&scene, &bvh, &bvh, pool, config, refining, &[], &mut ());
    let seconds = clock.elapsed().as_secs_f64();
    let compared = output::compare(&csv::rows(&scene, &refined.solution)?, &reference)?;
    let stated = refined.statement.map_or(f64::INFINITY, |s| s.triangles.e1.total());
    let [least, hundredth] = angles(&refined.mesh);
    println!(
        "| {name} | {called} | {} | {least:.1}°, {hundredth:.1}° | {:.1} M | {seconds:.1} | {:.2} % | {:.2} % | {:.1} % |",
        refined.mesh.elements().len(),
        refined.total_work.rays as f64 / 1e6,
        stated * 100.0,
        compared.worst_e1() * 100.0,
        compared.worst_einf() * 100.0,
    );
    Ok(())
}

/// The least angle of all elements, and that which a hundredth of the elements falls below.
fn angles(mesh: &Mesh) -> [f64; 2] {
    let mut angles: Vec<f64> = mesh
        .elements()
        .iter()
        .map(|element| {
            let p = element.vertices.map(|v| mesh.vertices()[v.index()]);
            let angle = |k: usize| (p[(k + 1) % 3] - p[k]).angle_between(p[(k + 2) % 3] - p[k]);
            (0..3).map(angle).fold(f64::INFINITY, f64::min).to_degrees()
        })
        .collect();
    angles.sort_by(f64::total_cmp);
    [angles[0], angles[angles.len() / 100]]
}
