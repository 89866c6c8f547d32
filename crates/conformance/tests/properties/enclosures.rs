//! Closed polyhedra, whose rows sum to 1, and open ones, whose rows do not.

use form_factor::{Polygon, between, lambert};
use glam::{DQuat, DVec3};
use proptest::prelude::*;

use crate::draw::{place, turn};
use crate::runner;

/// The relative tolerance asked of each form factor.
const TOLERANCE: f64 = 1e-6;

/// Rounding of a sum of a few form factors.
const ROUNDING: f64 = 1e-12;

/// The inside of a tetrahedron whose height over each face is at least a tenth of its size.
fn tetrahedron() -> impl Strategy<Value = Vec<Vec<DVec3>>> {
    [place(), place(), place(), place()].prop_filter_map("a tetrahedron with room in it", |p| {
        let volume = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]);
        let longest =
            (0..4).flat_map(|i| (0..i).map(move |j| p[i].distance(p[j]))).fold(0.0, f64::max);
        let [a, b, c, d] = if volume > 0.0 { p } else { [p[1], p[0], p[2], p[3]] };
        let faces = [[a, b, c], [a, d, b], [b, d, c], [c, d, a]];
        (volume.abs() > 0.05 * longest.powi(3)).then(|| faces.map(|f| f.to_vec()).to_vec())
    })
}

/// The inside of a box of any measures, turned.
fn any_box() -> impl Strategy<Value = Vec<Vec<DVec3>>> {
    ([0.2..3.0, 0.2..3.0, 0.2..3.0f64], turn()).prop_map(|(size, turn): ([f64; 3], DQuat)| {
        let corner =
            |i: usize| turn * (DVec3::from([0, 1, 2].map(|k| (i >> k & 1) as f64 * size[k])));
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
            .map(|face| face.map(corner).to_vec())
            .to_vec()
    })
}

/// The sum of each row, and how far its entries may be off together.
fn rows(faces: &[Vec<DVec3>]) -> Vec<(f64, f64)> {
    let polygons: Vec<_> = faces.iter().map(|face| Polygon::new(face).unwrap()).collect();
    let row = |a: &Polygon| {
        let all = polygons.iter().map(|b| between(a, b, TOLERANCE));
        all.fold((0.0, 0.0), |(sum, error), f| (sum + f.value, error + f.error))
    };
    polygons.iter().map(row).collect()
}

fn check(faces: &[Vec<DVec3>]) -> Result<(), TestCaseError> {
    for (sum, error) in rows(faces) {
        prop_assert!((sum - 1.0).abs() <= error + ROUNDING, "{sum} with an error of {error:e}");
        prop_assert!(error <= TOLERANCE * faces.len() as f64, "{error:e}");
    }
    // Without its last face it is open, and what that one got is missing.
    for (sum, error) in rows(&faces[..faces.len() - 1]) {
        prop_assert!(sum < 1.0 + error + ROUNDING && sum > 0.0, "{sum}");
    }
    Ok(())
}

#[test]
fn rows_of_a_tetrahedron_sum_to_1() {
    runner(60).run(&tetrahedron(), |faces| check(&faces)).unwrap();
}

#[test]
fn rows_of_a_box_sum_to_1() {
    runner(40).run(&any_box(), |faces| check(&faces)).unwrap();
}

#[test]
fn a_point_in_a_closed_room_sees_all_of_it() {
    let rooms = prop_oneof![tetrahedron(), any_box()];
    runner(200)
        .run(&(rooms, [0.05..1.0, 0.05..1.0, 0.05..1.0f64], turn()), |(faces, w, turn)| {
            // Anywhere inside: a mean of its corners.
            let corners: Vec<_> = faces.iter().flatten().copied().collect();
            let weight = |i: usize| (w[i % 3] * (i as f64 + 1.0)).fract() + 0.05;
            let total: f64 = (0..corners.len()).map(weight).sum();
            let sum: DVec3 = corners.iter().enumerate().map(|(i, c)| *c * weight(i)).sum();
            let (inside, normal) = (sum / total, turn * DVec3::Z);
            let fan = |face: &Vec<DVec3>| -> f64 {
                (2..face.len())
                    .map(|i| lambert(inside, normal, [face[0], face[i - 1], face[i]]).form_factor)
                    .sum()
            };
            let row: f64 = faces.iter().map(fan).sum();
            prop_assert!((row - 1.0).abs() <= ROUNDING, "{row}");
            Ok(())
        })
        .unwrap();
}
