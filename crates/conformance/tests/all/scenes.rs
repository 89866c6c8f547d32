//! The bundled scenes: clean files, balanced light, and nothing inside out.

use std::path::{Path, PathBuf};

use conformance::{Engine, Solved, solve};
use radiosity_core::{ShootingConfig, StopRule};
use scene::Scene;
use scene_import::{DiagnosticKind, Options};

use crate::BALANCED;

/// Enough to reach beyond the lamps in every scene, few enough to be quick.
const SHOTS: u64 = 100;

/// Share of the light that may meet backs in a closed scene: what leaves the hidden parts of
/// surfaces that stretch below other things, which have no undersides.
const WRONG_SIDE: f64 = 1e-3;

/// The same where rugs lie on the floor, cushions on the sofa, and shelves stand at the wall.
const FURNISHED_WRONG_SIDE: f64 = 5e-3;

fn path(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes").join(name)
}

/// Opens a scene and refuses what a clean file has not.
fn open(name: &str) -> Scene {
    let imported = scene_import::open(&path(name), &Options::default()).unwrap();
    println!("{name}: {}", imported.summary);
    let odd = |kind: &DiagnosticKind| {
        matches!(
            kind,
            DiagnosticKind::Degenerate
                | DiagnosticKind::NonFinite
                | DiagnosticKind::Duplicate { .. }
                | DiagnosticKind::ReversedWinding
                | DiagnosticKind::NormalDisagrees
        )
    };
    let odd: Vec<_> = imported.diagnostics.iter().filter(|d| odd(&d.kind)).collect();
    odd.iter().take(10).for_each(|d| println!("{d}"));
    assert!(odd.is_empty(), "{name}: {} warnings", odd.len());
    imported.scene
}

fn a_few_shots(name: &str, scene: &Scene, elements: usize) -> Solved {
    let stop = StopRule { unshot: 0.0, max_shots: Some(SHOTS) };
    let config = ShootingConfig { stop, ..ShootingConfig::until(0.0) };
    let solved = solve(scene, elements, config, Engine::FIRST).unwrap();
    let ledger = solved.ledger;
    println!(
        "{name}: {} elements, {} shots, wrong side {:.1e}, escaped {:.1e}, unshot {:.2}",
        solved.solution.elements.len(),
        solved.shots,
        ledger.share(ledger.wrong_side),
        ledger.share(ledger.escaped),
        ledger.share(ledger.unshot)
    );
    assert!(ledger.imbalance() < BALANCED, "{name}: {:e}", ledger.imbalance());
    assert!(solved.solution.elements.iter().all(|e| e.exitance.is_finite()), "{name}");
    solved
}

fn closed(name: &str, most: f64) {
    let scene = open(name);
    let ledger = a_few_shots(name, &scene, 0).ledger;
    let share = ledger.share(ledger.wrong_side);
    assert!(share < most, "{name}: {share} of the light meets backs");
}

#[test]
fn room() {
    closed("room.tri", FURNISHED_WRONG_SIDE);
}

#[test]
fn hall() {
    closed("hall.tri", WRONG_SIDE);
}

#[test]
fn church() {
    closed("church.tri", WRONG_SIDE);
}

#[test]
fn blocks() {
    closed("blocks.tri", WRONG_SIDE);
}

#[test]
fn gallery() {
    closed("gallery.glb", WRONG_SIDE);
}

#[test]
fn cornell_box_is_one_scene_in_two_formats() {
    // GLB holds f32 numbers: positions and materials are off by up to 6e-8 of themselves.
    const ROUNDING: f64 = 1e-4;
    // A segment that grazes an edge may fall to the other side of it: rare, but all of one
    // cell's light to one point.
    const GRAZING: f64 = 1e-3;
    let [obj, glb] = ["cornell.obj", "cornell.glb"].map(|name| {
        let scene = open(name);
        let light = a_few_shots(name, &scene, 500).solution.triangle_exitance(&scene);
        let row = |id| (scene.area(id), light[id.index()]);
        scene.ids().map(row).collect::<Vec<_>>()
    });
    assert_eq!(obj.len(), glb.len());
    for c in 0..3 {
        let (mut difference, mut total) = (0.0, 0.0);
        for (triangle, ((area, a), (_, b))) in obj.iter().zip(&glb).enumerate() {
            let apart = (a[c] - b[c]).abs();
            assert!(apart <= GRAZING * a[c], "triangle {triangle}: {a:?} {b:?}");
            difference += area * apart;
            total += area * a[c];
        }
        let e1 = difference / total;
        println!("cornell.obj and .glb, channel {c}: E1 {e1:.1e}");
        assert!(e1 <= ROUNDING, "channel {c}: {e1}");
    }
}
