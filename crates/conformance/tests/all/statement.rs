//! Stated errors against an independent path tracer, where its data is present.

use std::fs::File;
use std::path::Path;

use accel::{Bvh, BvhConfig};
use conformance::shared;
use output::csv;
use radiosity_core::{Asked, Exchange, Probe, RefineConfig, Refined, ShootingConfig, refine};
use radiosity_par::Pool;
use scene::{Scene, TriangleId};
use scene_import::Options;

/// How many times the true error a statement may be.
const LOOSEST: f64 = 5.0;

/// The scene and the rows of its reference; `None`, with a line that says so, without them.
fn subject(scene: &str, reference: &str) -> Option<(Scene, Vec<csv::Row>)> {
    let find = |folder: &str, name: &str| shared::find(&format!("{folder}/{name}"));
    let (Some(path), Some(rows)) = (find("scenes", scene), find("reference", reference)) else {
        println!("{scene}: skipped: no shared/reference beside the checkout");
        return None;
    };
    let scene = scene_import::open(Path::new(&path), &Options::default()).unwrap().scene;
    Some((scene, csv::read(File::open(rows).unwrap()).unwrap()))
}

fn run(scene: &Scene, exchange: Exchange, target: f64, probes: &[Probe]) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let config = ShootingConfig { exchange, ..ShootingConfig::until(1e-3) };
    let pool = Pool::new(0).unwrap();
    let refining = RefineConfig::until(Asked::Error(target));
    refine(scene, &bvh, &bvh, &pool, config, refining, probes, &mut ())
}

/// The true error lies below the stated one, which is no more than five times as large.
fn holds(scene: &str, reference: &str, exchange: Exchange, target: f64) {
    let Some((geometry, rows)) = subject(scene, reference) else { return };
    let refined = run(&geometry, exchange, target, &[]);
    let stated = refined.statement.unwrap().triangles.e1;
    let ours = csv::rows(&geometry, &refined.solution).unwrap();
    let error = output::compare(&ours, &rows).unwrap();
    let (truth, total) = (error.worst_e1(), stated.total());
    println!(
        "{scene} {exchange:?} to {target}: {} elements, stated {total:.5} = {:.5} + {:.5} + {:.5}, true \
         {truth:.5}: {:.2} times",
        refined.mesh.elements().len(),
        stated.iteration,
        stated.form_factor,
        stated.mesh,
        total / truth
    );
    assert!(total <= target, "{scene}: the asked error is reached");
    assert!(truth <= total, "{scene}: {truth} is above the stated {total}");
    assert!(total <= LOOSEST * truth, "{scene}: {total} is more than five times {truth}");
}

#[test]
fn room() {
    holds("room.tri", "room_onesided.csv", Exchange::OneSided, 0.04);
    holds("room.tri", "room_onesided.csv", Exchange::OneSided, 0.01);
}

#[test]
fn room_by_the_paired_rule() {
    holds("room.tri", "room_paired.csv", Exchange::Paired, 0.03);
}

#[test]
fn blocks() {
    holds("blocks.tri", "blocks_onesided.csv", Exchange::OneSided, 0.02);
}

#[test]
fn cornell_box() {
    holds("cornell.obj", "cornell.csv", Exchange::OneSided, 0.03);
}

/// Means over 8,000 parts of the room's triangles, at the default error: E1 at most 2 %, of which
/// half a per cent is the reference's own noise.
#[test]
fn eight_thousand_parts_of_the_room() {
    let Some((scene, rows)) = subject("room.tri", "room_fine.csv") else { return };
    let probe = |row: &csv::Row| Probe::Surface {
        triangle: TriangleId(row.triangle),
        uv: row.uv.unwrap(),
        area: Some(row.area),
    };
    let probes: Vec<Probe> = rows.iter().map(probe).collect();
    let refined = run(&scene, Exchange::OneSided, 0.01, &probes);
    let lit = rows.iter().zip(&refined.probes);
    let ours: Vec<csv::Row> =
        lit.map(|(row, light)| csv::Row { exitance: *light, se: None, ..row.clone() }).collect();
    let error = output::compare(&ours, &rows).unwrap();
    let stated = refined.statement.unwrap().probes.unwrap().e1.total();
    println!(
        "room_fine: {} elements, {} segments, E1 {:.4}, stated {stated:.4}, noise of the reference {:.4}",
        refined.mesh.elements().len(),
        refined.total_work.rays,
        error.worst_e1(),
        error.reference_se.unwrap()[0]
    );
    assert!(error.worst_e1() <= 0.02, "{:?}", error.e1);
    assert!(error.worst_e1() <= stated, "{stated}");
}
