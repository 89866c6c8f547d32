//! The structures against each other, bit for bit, and against the f64 reference.
//!
//! With `ACCEL_FULL=1` every scene gets 10⁶ random and 10⁶ shooting segments against the reference;
//! run that with `--release`.

use accel::{Occluder, Segment, rounding_band};

use crate::support::all::All;
use crate::support::reference::{self, Verdict};
use crate::support::rng::Rng;
use crate::support::{Triangle, scenes, segments, shared};

/// How many segments of each kind a scene gets: for the BVH against the octree, and of those the
/// first so many also against brute force and the reference.
struct Counts {
    structures: usize,
    reference: usize,
}

/// Makes a segment of some kind.
type Make<'a> = &'a dyn Fn(&mut Rng) -> Segment;

fn check(name: &str, scene: &[Triangle], counts: Counts) {
    let full = std::env::var_os("ACCEL_FULL").is_some();
    let counts = if full { Counts { structures: 1_000_000, reference: 1_000_000 } } else { counts };
    let all = All::build(scene);
    let extent = all.bvh.extent();
    let band = rounding_band(extent);
    let mut rng = Rng(7);
    let (lo, hi) = scenes::bounds(scene);
    let margin = 0.1 * (hi - lo);
    let random = |rng: &mut Rng| segments::random(lo - margin, hi + margin, rng);
    let shooting = |rng: &mut Rng| segments::shooting(scene, 1e-3 * extent, rng);
    let kinds: [(&str, Make); 2] = [("random", &random), ("shooting", &shooting)];
    for (kind, make) in kinds {
        let (mut blocked, mut unsure) = (0, 0);
        for i in 0..counts.structures {
            let segment = make(&mut rng);
            if i >= counts.reference {
                let answer = all.bvh.occluded(&segment);
                assert_eq!(all.octree.occluded(&segment), answer, "{name} {kind}: {segment:?}");
                continue;
            }
            let answer = all.occluded(&segment);
            blocked += usize::from(answer);
            match reference::occluded(scene, &segment, band) {
                Verdict::Unsure => unsure += 1,
                sure => {
                    assert_eq!(answer, sure == Verdict::Blocked, "{name} {kind}: {segment:?}");
                }
            }
        }
        println!(
            "{name}, {kind}: {} segments, 0 disagreements between structures; {} against f64, \
             {blocked} blocked, 0 disagreements outside the band, {unsure} inside",
            counts.structures, counts.reference
        );
        let share = unsure as f64 / counts.reference as f64;
        assert!(share < 0.01, "{name} {kind}: the band decides {share}: the test is empty");
        assert!(blocked > 0 && blocked < counts.reference, "{name} {kind}: {blocked} blocked");
    }
}

#[test]
fn shared_room() {
    if let Some(scene) = shared::scene("room") {
        check("room", &scene, Counts { structures: 500_000, reference: 500_000 });
    }
}

#[test]
fn shared_blocks() {
    if let Some(scene) = shared::scene("blocks") {
        check("blocks", &scene, Counts { structures: 500_000, reference: 500_000 });
    }
}

#[test]
fn shared_church() {
    if let Some(scene) = shared::scene("church") {
        check("church", &scene, Counts { structures: 500_000, reference: 2_500 });
    }
}

#[test]
fn made_room() {
    check("made room", &scenes::room(), Counts { structures: 200_000, reference: 200_000 });
}

#[test]
fn made_columns() {
    let scene = scenes::columns(8, 12);
    check("columns", &scene, Counts { structures: 200_000, reference: 10_000 });
}

#[test]
fn made_soup() {
    check("soup", &scenes::soup(3000, 1), Counts { structures: 200_000, reference: 10_000 });
}

#[test]
fn far_from_the_origin_nothing_is_lost() {
    // The same room, 10⁶ m out: f64 keeps 1e-10 m there, so answers stay those of the reference.
    let offset = glam::dvec3(1e6, -1e6, 1e6);
    let scene: Vec<Triangle> = scenes::room().iter().map(|t| t.map(|v| v + offset)).collect();
    check("far room", &scene, Counts { structures: 100_000, reference: 100_000 });
}
