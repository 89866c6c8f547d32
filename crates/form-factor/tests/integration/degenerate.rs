//! Slivers, coplanar pairs, a point beside a plain: where careless formulas fail.

use form_factor::{Polygon, REFERENCE, between, lambert};
use glam::DVec3;

use crate::{Random, moved, polygon};

/// Largest error where two polygons are so nearly coplanar that the contour cancels, absolute.
const NEARLY_COPLANAR: f64 = 1e-9;

#[test]
fn the_same_polygon_and_its_back_see_nothing() {
    let mut random = Random(1_234_567);
    for _ in 0..100 {
        let at = random.vector() * 10.0;
        let one = random.triangle(at);
        let [p, q, r] = [0, 1, 2].map(|i| one.corners()[i]);
        for other in [[p, q, r], [q, r, p], [p, r, q]] {
            let other = Polygon::triangle(other).expect("it has an area");
            assert_eq!(between(&one, &other, 1e-3).value, 0.0);
            assert_eq!(between(&one, &other, REFERENCE).error, 0.0);
        }
    }
}

#[test]
fn what_faces_away_sees_nothing() {
    let one = polygon([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let below = moved(&one, |c| c - DVec3::Z);
    let beside = moved(&one, |c| c + DVec3::X * 3.0);
    for other in [&below, &beside] {
        assert_eq!(between(&one, other, 1e-3).value, 0.0);
        assert_eq!(between(other, &one, 1e-3).value, 0.0);
    }
}

#[test]
fn nearly_coplanar_pairs_are_small_and_not_negative() {
    let one = polygon([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.8, 0.0]]);
    for exponent in 1..45 {
        let tilt = 2f64.powi(-exponent);
        let two = polygon([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.4, -0.7, 0.7 * tilt]]);
        for tolerance in [1e-2, REFERENCE] {
            let f = between(&one, &two, tolerance);
            assert!(f.value >= 0.0);
            // F = (1 − cos θ)/2 at most: what a point on the edge sees of a half plane.
            assert!(f.value <= tilt * tilt / 4.0 + NEARLY_COPLANAR, "{exponent}: {f:?}");
        }
    }
}

#[test]
fn slivers_agree_with_their_integral() {
    // Length over width up to 1e5, beside a triangle of like length: the mean of Lambert's form
    // along the sliver, whose width changes little. 4000 strips.
    let large = polygon([[0.0, 0.5, 0.0], [1.0, 0.1, 0.7], [0.3, -0.2, 1.0]]);
    for aspect in [1e2, 1e3, 1e5] {
        let sliver = polygon([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0 / aspect, 0.0]]);
        let [p, q, r] = [0, 1, 2].map(|i| large.corners()[i]);
        let strip = |i: u32| {
            let x = (f64::from(i) + 0.5) / 4000.0;
            let middle = DVec3::new(x, x / aspect / 2.0, 0.0);
            2.0 * x * lambert(middle, DVec3::Z, [p, q, r]).form_factor / 4000.0
        };
        let expected: f64 = (0..4000).map(strip).sum();
        for tolerance in [1e-2, 1e-4, REFERENCE] {
            let f = between(&sliver, &large, tolerance);
            let at_most = tolerance.max(1.0 / aspect / aspect).max(1e-6);
            assert!((f.value / expected - 1.0).abs() <= at_most, "{aspect} {f:?} {expected}");
            assert!(f.error <= tolerance * f.value * 1.001, "{f:?}");
        }
    }
}

#[test]
fn a_small_triangle_beside_a_large_one() {
    // A wall of edge d stands before the rim of a triangle of edge 1, a tenth of d away. The
    // mean of Lambert's form over 4⁷ pieces of the wall.
    let large = polygon([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.4, 0.9, 0.0]]);
    for d in [0.2, 0.01, 1e-4, 1e-6] {
        let y = -0.1 * d;
        let wall = [[0.5 - d / 2.0, y, 0.0], [0.5 - d / 2.0, y, d], [0.5 + d / 2.0, y, 0.0]];
        let small = polygon(wall);
        assert_eq!(small.normal(), DVec3::Y);
        let [p, q, r] = [0, 1, 2].map(|i| large.corners()[i]);
        let expected =
            mean(wall.map(DVec3::from), 7, &|at| lambert(at, DVec3::Y, [p, q, r]).form_factor);
        for tolerance in [1e-2, 1e-3, 1e-4, REFERENCE] {
            let f = between(&small, &large, tolerance);
            let at_most = tolerance.max(MEAN);
            assert!((f.value / expected - 1.0).abs() <= at_most, "{d} {f:?} {expected}");
            assert!(f.error <= tolerance * f.value * 1.001, "{f:?}");
        }
    }
}

/// What the mean below is off by, relative: a hundredth of a part where the wall is nearest.
const MEAN: f64 = 1e-4;

/// The mean over a triangle, by the middles of four parts of four parts of ...
fn mean([a, b, c]: [DVec3; 3], depth: u32, f: &impl Fn(DVec3) -> f64) -> f64 {
    if depth == 0 {
        return f((a + b + c) / 3.0);
    }
    let [d, e, g] = [(a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0];
    let parts = [[a, d, g], [d, b, e], [g, e, c], [d, e, g]];
    parts.into_iter().map(|part| mean(part, depth - 1, f)).sum::<f64>() / 4.0
}
