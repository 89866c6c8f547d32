//! One pair of polygons, with and without something in between.

use std::cell::RefCell;

use form_factor::{Estimate, FLOOR, Occluders, REFERENCE, between, between_occluded};
use proptest::prelude::*;

use crate::draw::{occluders, pair};
use crate::runner;

/// What f64 makes of 1.
const ROUNDING: f64 = 1e-12;

/// A tolerance between the loosest and the tightest that a user asks for.
fn tolerance() -> impl Strategy<Value = f64> {
    (-8.0..-1.0f64).prop_map(|power| 10f64.powf(power))
}

fn is_sound(f: Estimate) -> bool {
    (0.0..=1.0).contains(&f.value) && f.error >= 0.0 && f.error.is_finite()
}

#[test]
fn form_factors_lie_between_0_and_1() {
    runner(200)
        .run(&(pair(), tolerance()), |((a, b), tolerance)| {
            prop_assert!(is_sound(between(&a, &b, tolerance)));
            Ok(())
        })
        .unwrap();
}

#[test]
fn exchange_is_mutual() {
    runner(100)
        .run(&(pair(), tolerance()), |((a, b), tolerance)| {
            let (there, back) = (between(&a, &b, tolerance), between(&b, &a, tolerance));
            let off = (a.area() * there.value - b.area() * back.value).abs();
            let stated = a.area() * there.error + b.area() * back.error;
            prop_assert!(off <= stated + ROUNDING * a.area(), "{there:?} {back:?}");
            Ok(())
        })
        .unwrap();
}

#[test]
fn exchange_behind_something_is_mutual() {
    runner(40)
        .run(&(pair(), occluders()), |((a, b), screens)| {
            let screens = Occluders::build(&screens);
            let there = between_occluded(&a, &b, &screens, 1e-3);
            let back = between_occluded(&b, &a, &screens, 1e-3);
            let off = (a.area() * there.value - b.area() * back.value).abs();
            let stated = a.area() * there.error + b.area() * back.error;
            prop_assert!(off <= stated + ROUNDING * a.area(), "{there:?} {back:?}");
            Ok(())
        })
        .unwrap();
}

#[test]
fn a_stated_error_covers_the_true_one() {
    runner(200)
        .run(&(pair(), tolerance()), |((a, b), tolerance)| {
            let (found, truth) = (between(&a, &b, tolerance), between(&a, &b, REFERENCE));
            let off = (found.value - truth.value).abs();
            prop_assert!(off <= found.error + truth.error + ROUNDING, "{found:?} {truth:?}");
            Ok(())
        })
        .unwrap();
}

/// How many estimates behind something may be off by more than they state, of 1000; the error is
/// one that was estimated. Of 6,000 (2,000 pairs) 11 were, the worst by a factor of 4.
const UNLUCKY: usize = 5;

/// How far off any may be, in tolerances. The worst of those was off by 1.2.
const FARTHEST: f64 = 2.0;

#[test]
fn a_stated_error_covers_the_true_one_behind_something() {
    let (mut estimates, mut unlucky, mut hidden) = (0, 0, 0);
    let counts = RefCell::new((&mut estimates, &mut unlucky, &mut hidden));
    runner(100)
        .run(&(pair(), occluders()), |((a, b), screens)| {
            let screens = Occluders::build(&screens);
            let truth = between_occluded(&a, &b, &screens, 1e-6);
            let mut counts = counts.borrow_mut();
            *counts.2 += usize::from(truth.value < 0.99 * between(&a, &b, 1e-3).value);
            for tolerance in [1e-1, 1e-2, 1e-3] {
                let found = between_occluded(&a, &b, &screens, tolerance);
                let off = (found.value - truth.value).abs() - truth.error;
                *counts.0 += 1;
                *counts.1 += usize::from(off > found.error + ROUNDING);
                let most = FARTHEST * (tolerance * truth.value).max(FLOOR);
                prop_assert!(off <= most, "{found:?} {truth:?}");
            }
            Ok(())
        })
        .unwrap();
    println!("{unlucky} of {estimates} are off by more than they state; {hidden} pairs are hidden");
    assert!(hidden >= 25, "the screens must hide something: {hidden}");
    assert!(unlucky * 1000 <= UNLUCKY * estimates, "{unlucky} of {estimates}");
}

#[test]
fn what_stands_between_only_takes() {
    runner(60)
        .run(&(pair(), occluders()), |((a, b), screens)| {
            let open = between(&a, &b, 1e-6);
            let mut last = open;
            // One more screen each time.
            for n in 1..=screens.len() {
                let with = between_occluded(&a, &b, &Occluders::build(&screens[..n]), 1e-3);
                prop_assert!(is_sound(with));
                let most = last.value + last.error + with.error + ROUNDING;
                prop_assert!(with.value <= most, "{with:?} {last:?}");
                last = with;
            }
            Ok(())
        })
        .unwrap();
}
