//! Every variant gives the answers of accel where no rounding can turn them.

use accel::{BruteForce, BruteForceConfig, Bvh, BvhConfig, Occluder, Segment};
use glam::DVec3;

use super::compare::shooting;
use super::layout::{Inner, order};
use super::specimens;
use super::switches::{Layout, TECHNIQUES, VARIANTS};
use crate::{Limits, Triangle, Workload, soup, terrain};

/// How much triangles are grown or shrunk about their centroid, and segments about their middle,
/// to see whether an answer hangs on it: about a thousand times the rounding of f32.
const MARGIN: f64 = 1e-4;

/// Segments with answers that stay the same within the margin.
fn sure(triangles: &[Triangle], count: usize) -> Vec<(Segment, bool)> {
    let workload = Workload::new(triangles.to_vec(), triangles, count);
    let scaled = |factor: f64| -> Vec<Triangle> {
        let scale = |t: &Triangle| {
            let centroid = (t[0] + t[1] + t[2]) / 3.0;
            t.map(|corner| centroid + factor * (corner - centroid))
        };
        triangles.iter().map(scale).collect()
    };
    let bvh = Bvh::build(triangles, &BvhConfig::default());
    let brute = [1.0, 1.0 + MARGIN, 1.0 - MARGIN]
        .map(|factor| BruteForce::build(&scaled(factor), &BruteForceConfig::default()));
    let segments = shooting(&workload).into_iter().chain(workload.random);
    segments
        .filter_map(|segment| {
            let answer = bvh.occluded(&segment);
            let by = MARGIN * (segment.to - segment.from);
            let same = |from, to| {
                brute.iter().all(|brute| brute.occluded(&Segment::new(from, to)) == answer)
            };
            (same(segment.from - by, segment.to + by) && same(segment.from + by, segment.to - by))
                .then_some((segment, answer))
        })
        .collect()
}

#[test]
fn variants_agree_with_accel() {
    let far = |scene: Vec<Triangle>| -> Vec<Triangle> {
        scene.iter().map(|t| t.map(|corner| corner + DVec3::splat(1000.0))).collect()
    };
    for scene in [far(soup(400)), far(terrain(800))] {
        let sure = sure(&scene, 1500);
        let blocked = sure.iter().filter(|(_, answer)| *answer).count();
        // The case can tell a structure that never or always says yes.
        assert!(sure.len() > 1500 && blocked > 150 && sure.len() - blocked > 150, "{blocked}");
        for (number, variant) in VARIANTS.iter().enumerate() {
            let occluder = specimens::build(number, &scene);
            for (segment, answer) in &sure {
                assert_eq!(occluder.occluded(segment), *answer, "{}: {segment:?}", variant.name);
            }
            // Ends outside the root.
            let (lo, hi) = crate::bounds(&scene).unwrap();
            let through = Segment::new(2.0 * lo - hi, 2.0 * hi - lo);
            occluder.occluded(&through);
            assert!(!occluder.occluded(&Segment::new(hi + (hi - lo), hi + 2.0 * (hi - lo))));
        }
    }
}

#[test]
fn nothing_blocks_where_nothing_is() {
    for number in 0..VARIANTS.len() {
        let occluder = specimens::build(number, &[]);
        assert!(!occluder.occluded(&Segment::new(DVec3::ZERO, DVec3::ONE)));
    }
}

#[test]
fn techniques_name_variants_and_each_variant_is_named() {
    for technique in TECHNIQUES {
        for name in [technique.on, technique.off] {
            assert!(specimens::number(name).is_some(), "{name}");
        }
    }
    for variant in VARIANTS {
        let named = |t: &super::Technique| [t.on, t.off].contains(&variant.name);
        assert!(TECHNIQUES.iter().any(named), "{}", variant.name);
    }
}

#[test]
fn all_are_measured() {
    let scene = soup(100);
    let workload = Workload::new(scene.clone(), &scene, 100);
    let comparison = super::compare("soup", &workload, &Limits { runs: 1, seconds: 0.0 });
    assert_eq!((comparison.rounds, comparison.segments), (1, 100));
    assert_eq!(comparison.measured.len(), VARIANTS.len());
    assert!(TECHNIQUES.iter().all(|technique| comparison.gain(technique) > 0.0));
}

/// Every layout holds every family once.
#[test]
fn layouts_are_permutations() {
    // A lopsided tree: cell i has children as far as there are numbers for them.
    let inner: Inner =
        (0..200).map(|i| (3 * i + 1..3 * i + 4).filter(|c| *c < 200).collect()).collect();
    let layouts = [Layout::BreadthFirst, Layout::DepthFirst, Layout::InOrder, Layout::VanEmdeBoas];
    let orders = layouts.map(|layout| order(&inner, layout));
    for found in &orders {
        let mut sorted = found.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..200));
    }
    assert!(orders[1..].iter().all(|other| *other != orders[0]));
}
