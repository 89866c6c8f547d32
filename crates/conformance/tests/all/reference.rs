//! Whole scenes against an independent path tracer, where its results are present.
//!
//! Few elements, so that the test is quick: the bounds are those of a coarse mesh, not of the
//! method.

use std::fs::File;
use std::path::Path;

use conformance::{Engine, shared, solve};
use output::csv;
use radiosity_core::{Exchange, ShootingConfig};
use scene_import::Options;

use crate::BALANCED;

/// Unshot share: a twentieth of the tightest bound.
const UNSHOT: f64 = 1e-3;

/// A scene, its reference, the elements to solve it with, and the largest E1 of a channel.
struct Check {
    scene: &'static str,
    reference: &'static str,
    exchange: Exchange,
    elements: usize,
    at_most: f64,
}

fn compare(check: &Check) {
    let &Check { scene: scene_file, reference, exchange, elements, at_most } = check;
    let find = |folder: &str, name: &str| shared::find(&format!("{folder}/{name}"));
    let (Some(scene_path), Some(reference)) =
        (find("scenes", scene_file), find("reference", reference))
    else {
        println!("{scene_file}: skipped: no shared/reference beside the checkout");
        return;
    };
    let scene = scene_import::open(Path::new(&scene_path), &Options::default()).unwrap().scene;
    let config = ShootingConfig { exchange, ..ShootingConfig::until(UNSHOT) };
    let solved = solve(&scene, elements, config, Engine::FIRST).unwrap();
    let imbalance = solved.ledger.imbalance();
    assert!(imbalance < BALANCED, "{scene_file}: {imbalance:e}");
    let reference = csv::read(File::open(reference).unwrap()).unwrap();
    let ours = csv::rows(&scene, &solved.solution).unwrap();
    let error = output::compare(&ours, &reference).unwrap();
    let percent = |c: [f64; 3]| c.map(|x| (x * 1e4).round() / 1e2);
    println!(
        "{scene_file} {exchange:?}, {elements} elements: E1 {:?} % (at most {} %), standard error of the reference \
         {:?} %, {} rows",
        percent(error.e1),
        at_most * 100.0,
        percent(error.reference_se.unwrap()),
        error.rows_used
    );
    assert!(error.worst_e1() <= at_most, "{scene_file}: {:?}", error.e1);
}

#[test]
fn room() {
    compare(&Check {
        scene: "room.tri",
        reference: "room_onesided.csv",
        exchange: Exchange::OneSided,
        elements: 4000,
        at_most: 0.03,
    });
}

#[test]
fn room_by_the_paired_rule() {
    compare(&Check {
        scene: "room.tri",
        reference: "room_paired.csv",
        exchange: Exchange::Paired,
        elements: 4000,
        at_most: 0.04,
    });
}

#[test]
fn blocks() {
    compare(&Check {
        scene: "blocks.tri",
        reference: "blocks_onesided.csv",
        exchange: Exchange::OneSided,
        elements: 4000,
        at_most: 0.03,
    });
}

#[test]
fn cornell_box() {
    compare(&Check {
        scene: "cornell.obj",
        reference: "cornell.csv",
        exchange: Exchange::OneSided,
        elements: 6000,
        at_most: 0.02,
    });
}
