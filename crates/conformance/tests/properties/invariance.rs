//! Form factors know no unit, no place and no direction.

use form_factor::{Estimate, Occluders, between, between_occluded};
use glam::DVec3;
use proptest::prelude::*;

use crate::draw::{moved, occluders, pair, place, turn};
use crate::runner;

/// Rounding of turned coordinates, in a form factor: some hundred roundings of 1e-16 over the
/// smallest gaps and angles that are drawn.
const ROUNDING: f64 = 1e-9;

fn agree(a: Estimate, b: Estimate) -> Result<(), TestCaseError> {
    let off = (a.value - b.value).abs();
    prop_assert!(off <= a.error + b.error + ROUNDING, "{a:?} {b:?}");
    Ok(())
}

#[test]
fn turned_moved_and_scaled_polygons_exchange_the_same() {
    let any = (pair(), turn(), place(), -6.0..6.0f64);
    runner(100)
        .run(&any, |((a, b), turn, shift, power)| {
            let to = |p: DVec3| (turn * p + shift * 10.0) * 10f64.powf(power);
            agree(between(&a, &b, 1e-6), between(&moved(&a, to), &moved(&b, to), 1e-6))
        })
        .unwrap();
}

#[test]
fn powers_of_two_change_no_bit() {
    runner(60)
        .run(&(pair(), occluders(), -60..60i32), |((a, b), screens, power)| {
            let unit = 2f64.powi(power);
            let to = |p: DVec3| p * unit;
            let (c, d) = (moved(&a, to), moved(&b, to));
            for tolerance in [1e-2, 1e-6] {
                let (one, other) = (between(&a, &b, tolerance), between(&c, &d, tolerance));
                prop_assert_eq!(one.value.to_bits(), other.value.to_bits());
            }
            let scaled: Vec<_> = screens.iter().map(|t| t.map(to)).collect();
            let one = between_occluded(&a, &b, &Occluders::build(&screens), 1e-2);
            let other = between_occluded(&c, &d, &Occluders::build(&scaled), 1e-2);
            prop_assert_eq!(one.value.to_bits(), other.value.to_bits());
            Ok(())
        })
        .unwrap();
}

#[test]
fn turned_and_moved_screens_hide_the_same() {
    let any = (pair(), occluders(), turn(), place());
    runner(30)
        .run(&any, |((a, b), screens, turn, shift)| {
            let to = |p: DVec3| turn * p + shift;
            let turned: Vec<_> = screens.iter().map(|t| t.map(to)).collect();
            let one = between_occluded(&a, &b, &Occluders::build(&screens), 1e-3);
            let (c, d) = (moved(&a, to), moved(&b, to));
            agree(one, between_occluded(&c, &d, &Occluders::build(&turned), 1e-3))
        })
        .unwrap();
}
