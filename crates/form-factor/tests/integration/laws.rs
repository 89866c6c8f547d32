//! What holds whatever the polygons: closed rooms, reciprocity, additivity, scale and place.

use form_factor::{Polygon, REFERENCE, between};
use glam::DVec3;

use crate::{Random, ceiling, floor, moved, polygon};

/// Two triangles for each face of the unit cube, fronts inwards.
fn cube() -> Vec<Polygon> {
    let c = |i: usize| [(i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64];
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let halves = |[p, q, r, s]: [usize; 4]| [[p, q, r], [p, r, s]];
    faces.into_iter().flat_map(halves).map(|t| polygon(t.map(c))).collect()
}

fn row_sums(room: &[Polygon], tolerance: f64) -> Vec<f64> {
    let row = |a: &Polygon| room.iter().map(|b| between(a, b, tolerance).value).sum();
    room.iter().map(row).collect()
}

#[test]
fn in_a_closed_room_all_light_arrives() {
    let corners = [[0.0, 0.0, 0.0], [1.0, 0.1, 0.0], [0.3, 0.9, 0.1], [0.2, 0.4, 1.3]];
    let [p, q, r, s] = corners;
    let tetrahedron: Vec<_> =
        [[p, q, r], [p, s, q], [q, s, r], [r, s, p]].into_iter().map(polygon).collect();
    assert!((tetrahedron[0].centre_to(s)) > 0.0, "fronts inwards");
    for room in [cube(), tetrahedron] {
        for (tolerance, at_most) in [(1e-2, 1e-2), (1e-4, 1e-4), (REFERENCE, 1e-11)] {
            for sum in row_sums(&room, tolerance) {
                assert!((sum - 1.0).abs() < at_most, "{tolerance:e}: {sum}");
            }
        }
    }
}

trait Front {
    fn centre_to(&self, point: [f64; 3]) -> f64;
}

impl Front for Polygon {
    fn centre_to(&self, point: [f64; 3]) -> f64 {
        self.normal().dot(DVec3::from(point) - self.corners()[0])
    }
}

#[test]
fn both_directions_exchange_the_same() {
    let mut random = Random(88_172_645_463_325_252);
    let mut seen = 0;
    for i in 0..3000 {
        let distance = 0.3 + f64::from(i % 100) * 0.2;
        let a = random.triangle(DVec3::ZERO);
        let at = random.vector().normalize() * distance;
        let b = random.triangle(at);
        for tolerance in [1e-2, 1e-4, REFERENCE] {
            let (there, back) = (between(&a, &b, tolerance), between(&b, &a, tolerance));
            let (one, two) = (a.area() * there.value, b.area() * back.value);
            assert!((one - two).abs() <= 4.0 * f64::EPSILON * one, "{one} {two}");
            assert!((0.0..=1.0).contains(&there.value) && there.error >= 0.0);
            seen += usize::from(there.value > 0.0);
        }
    }
    assert!(seen > 1000, "{seen}");
}

#[test]
fn every_tolerance_is_met_and_every_error_stated() {
    let mut random = Random(362_436_069_521_288_629);
    let mut checked = 0;
    for i in 0..4000 {
        let a = random.triangle(DVec3::ZERO);
        let at = random.vector().normalize() * (0.2 + f64::from(i % 50) * 0.3);
        // Every fourth pair touches.
        let b = match i % 8 {
            0 => Polygon::triangle([a.corners()[0], random.vector(), random.vector()]),
            4 => Polygon::triangle([a.corners()[1], a.corners()[0], random.vector()]),
            _ => Some(random.triangle(at)),
        };
        let Some(b) = b else { continue };
        let exact = between(&a, &b, REFERENCE);
        if exact.value < 1e-6 {
            continue;
        }
        checked += 1;
        for tolerance in [1e-2, 1e-3, 1e-4] {
            let estimate = between(&a, &b, tolerance);
            let error = (estimate.value - exact.value).abs();
            assert!(error <= estimate.error + exact.error, "{estimate:?} {exact:?}");
            assert!(error <= tolerance * exact.value + exact.error, "{estimate:?} {exact:?}");
        }
    }
    assert!(checked > 800, "{checked}");
}

#[test]
fn parts_add_up_to_the_whole() {
    // One plane cuts the other polygon, so that only a part of it is seen: the part alone has
    // the same form factor.
    let lying = floor([0.0, 1.0], [0.0, 1.0], 0.0);
    let through = polygon([[1.5, 0.0, -1.0], [1.5, 0.0, 1.0], [1.5, 1.0, 1.0], [1.5, 1.0, -1.0]]);
    let above = polygon([[1.5, 0.0, 0.0], [1.5, 0.0, 1.0], [1.5, 1.0, 1.0], [1.5, 1.0, 0.0]]);
    let (whole, part) =
        (between(&lying, &through, REFERENCE).value, between(&lying, &above, REFERENCE).value);
    assert!(whole > 0.01 && (whole - part).abs() < 1e-12, "{whole} {part}");
    // Four quarters of a ceiling, and the floor seen by them.
    let half = [[0.0, 0.5], [0.5, 1.0]];
    let quarters = half.iter().flat_map(|&x| half.map(|y| ceiling(x, y, 0.3)));
    let sum: f64 = quarters.map(|quarter| between(&lying, &quarter, REFERENCE).value).sum();
    let all = between(&lying, &ceiling([0.0, 1.0], [0.0, 1.0], 0.3), REFERENCE).value;
    assert!((sum - all).abs() < 1e-11, "{sum} {all}");
}

#[test]
fn scale_and_place_change_nothing() {
    let a = polygon([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.25, 0.875, 0.0]]);
    let b = polygon([[0.25, 0.125, 1.25], [0.125, 1.125, 0.75], [1.25, 0.375, 0.875]]);
    for distance in [0.0, 5.0, 500.0] {
        let b = moved(&b, |c| c + DVec3::Z * distance);
        for tolerance in [1e-2, REFERENCE] {
            let one = between(&a, &b, tolerance).value;
            for scale in [1e-110, 1e-80, 1e-6, 3.0, 1e6, 1e80, 1e110] {
                let [a, b] = [&a, &b].map(|polygon| moved(polygon, |c| c * scale));
                let other = between(&a, &b, tolerance).value;
                assert!((other / one - 1.0).abs() < 1e-13, "{scale:e}: {one} {other}");
            }
            // Exact in f64, so the same to the last bit.
            let offset = DVec3::splat(2f64.powi(20));
            let [a, b] = [&a, &b].map(|polygon| moved(polygon, |c| c + offset));
            assert_eq!(between(&a, &b, tolerance).value, one);
        }
    }
}
