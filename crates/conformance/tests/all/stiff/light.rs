//! Light of any strength, in any channel, from lamps of any size, and none at all.

use radiosity_core::{Correction, ShootingConfig, StopReason, StopRule};
use scene::{Rgb, Sides};

use super::model::{Lit, Model, light};
use crate::BALANCED;

#[test]
fn no_emitters() {
    let mut model = Model::new();
    let wall = model.grey(0.9, 0.0);
    model.cube([wall; 6]);
    let solved = light(&model.scene(), 384, ShootingConfig::until(1e-3));
    assert_eq!((solved.reason, solved.shots, solved.form_factors), (StopReason::NoLight, 0, 0));
    assert!(solved.values().all(|b| b == Rgb::ZERO));
    assert_eq!((solved.unshot, solved.ledger.imbalance()), (0.0, 0.0));
}

#[test]
fn all_emitters_no_receivers() {
    let low = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    // Below the first, and facing down as it faces up.
    let under = [[0., 0., -1.], [0., 1., -1.], [1., 0., -1.]];
    for triangles in [vec![], vec![low], vec![low, under]] {
        for elements in [0, 1, 100] {
            let mut model = Model::new();
            let lamp = model.grey(0.7, 3.0);
            triangles.iter().for_each(|t| model.triangle(*t, lamp));
            let solved = light(&model.scene(), elements, ShootingConfig::until(1e-3));
            let reason =
                if triangles.is_empty() { StopReason::NoLight } else { StopReason::Converged };
            assert_eq!((solved.reason, solved.form_factors), (reason, 0));
            assert_eq!(solved.solution.elements.is_empty(), triangles.is_empty());
            assert!(solved.values().all(|b| b.0.map(f64::to_bits) == [3f64.to_bits(); 3]));
        }
    }
}

/// A cube that two of its faces light, the second `ratio` times as bright as the first.
fn two_lamps(first: f64, second: f64, elements: usize, config: ShootingConfig) -> Lit {
    let mut model = Model::new();
    let wall = model.grey(0.9, 0.0);
    let one = model.grey(0.9, first);
    let two = model.grey(0.9, second);
    model.cube([one, two, wall, wall, wall, wall]);
    light(&model.scene(), elements, config)
}

#[test]
fn emission_1e30_1e_30() {
    for correction in [Correction::Auto, Correction::Never] {
        let config = ShootingConfig { correction, ..ShootingConfig::until(1e-6) };
        for elements in [12, 96] {
            let scaled = |scale: f64| two_lamps(1e-30 * scale, 1e30 * scale, elements, config);
            let once = scaled(1.0);
            println!("REASON {:?} {correction:?} {elements}", once.reason);
            assert!(once.reason == StopReason::Converged && once.values().all(Rgb::is_finite));
            let exact = |solved: &Lit, once: &Lit, k: f64| {
                solved.values().zip(once.values()).all(|(a, b)| a == b * k)
            };
            for power in [100, -100] {
                let k = 2f64.powi(power);
                assert!(exact(&scaled(k), &once, k), "2^{power}, {elements} elements");
            }
            // 1e30 · 2^1000 is beyond f64; one lamp alone is not.
            let one = |k: f64| two_lamps(k, 0.0, elements, config);
            for power in [1000, -1000] {
                let k = 2f64.powi(power);
                assert!(exact(&one(k), &one(1.0), k), "2^{power}, {elements} elements");
            }
            for k in [1e30, 1e-30] {
                let far = scaled(k)
                    .values()
                    .zip(once.values())
                    .map(|(a, b)| (a[0] / (b[0] * k) - 1.0).abs())
                    .fold(0.0, f64::max);
                println!("{correction:?}, {elements} elements, times {k:e}: off by {far:.1e}");
                assert!(far <= 1e-13, "{far:e}");
            }
        }
    }
}

#[test]
fn f32_drift() {
    for (elements, rho, shots) in [(12, 0.999, 60_000), (384, 0.999, 5_000)] {
        let mut model = Model::new();
        let wall = model.grey(rho, 0.0);
        let lamp = model.grey(rho, 1.0);
        model.cube([lamp, wall, wall, wall, wall, wall]);
        let stop = StopRule { unshot: 1e-6, max_shots: Some(shots) };
        let config =
            ShootingConfig { stop, correction: Correction::Never, ..ShootingConfig::until(0.0) };
        let solved = light(&model.scene(), elements, config);
        let imbalance = solved.ledger.imbalance();
        println!(
            "{elements} elements, {} shots, {:?}: balance off by {imbalance:.1e}",
            solved.shots, solved.reason
        );
        assert!(imbalance <= BALANCED, "{imbalance:e}");
    }
}

#[test]
fn rgb() {
    const ASKED: f64 = 1e-6;
    let rho = Rgb::new(0.1, 0.5, 0.99);
    // As the catalogue has it, and with blue a millionth of the light.
    for emittance in [Rgb::splat(1.0), Rgb::new(1.0, 1.0, 1e-6)] {
        let mut model = Model::new();
        let wall = model.surface(rho, Rgb::ZERO, Sides::Front);
        let lamp = model.surface(rho, emittance, Sides::Front);
        model.cube([lamp, wall, wall, wall, wall, wall]);
        let scene = model.scene();
        let solved = light(&scene, 384, ShootingConfig::until(ASKED));
        assert_eq!(solved.reason, StopReason::Converged);
        let longer = light(&scene, 384, ShootingConfig::until(1e-12));
        for c in 0..3 {
            let unshot = solved.ledger.unshot[c].abs() / solved.ledger.emitted[c];
            let bound = solved.remaining.power[c];
            let missing: f64 = solved
                .solution
                .elements
                .iter()
                .zip(&longer.solution.elements)
                .map(|(a, b)| solved.solution.area(a) * (b.exitance[c] - a.exitance[c]).abs())
                .sum();
            assert!(missing <= bound, "channel {c}: {missing:e} of {bound:e}");
            println!(
                "{emittance:?}, channel {c}: unshot {unshot:.1e}, missing {missing:.1e} of at most {bound:.1e}, {:.1} sweeps",
                solved.sweeps()
            );
            assert!(unshot <= ASKED, "channel {c}");
        }
    }
}

#[test]
fn large_closed_room_one_tiny_lamp() {
    // A lamp of a square millimetre, hung a metre below the ceiling of a room of ten.
    let (rho, size, lamp_side) = (0.8, 10.0, 1e-3);
    let mut model = Model::new();
    let wall = model.grey(rho, 0.0);
    let lamp = model.grey(0.0, 1e6);
    model.room([0.0; 3], [size; 3], [Some(wall); 6]);
    let at = |x: f64| [x, x + lamp_side];
    model.level(at(4.3), at(5.1), 9.0, false, lamp);
    // Its back, so that nothing falls on a side that is not there.
    model.level(at(4.3), at(5.1), 9.0, true, lamp);
    let scene = model.scene();
    for elements in [2400, 9600] {
        let solved = light(&scene, elements, ShootingConfig::until(1e-6));
        let ledger = solved.ledger;
        let (balance, absorbed) = (ledger.imbalance(), ledger.absorbed[0] / ledger.emitted[0]);
        // Walls absorb (1 − ρ) of what reaches them, and all that is emitted: but for what
        // falls back on the lamp, 1e-8 of it, ΣA·(1 − ρ)·H = ΣA·E.
        let mean = 2.0 * lamp_side * lamp_side * 1e6 / (600.0 * (1.0 - rho)) * rho;
        let found = solved.triangles[..12].iter().map(|b| b[0] * 50.0).sum::<f64>() / 600.0;
        println!(
            "{elements} elements: balance {balance:.1e}, absorbed {absorbed:.6}, walls off by \
             {:.1e}, {:.1} sweeps",
            found / mean - 1.0,
            solved.sweeps()
        );
        assert!(balance <= 1e-9 && solved.reason == StopReason::Converged, "{balance:e}");
        assert!((absorbed - 1.0).abs() <= 1e-2, "{absorbed}");
        assert!((found / mean - 1.0).abs() <= 1e-2, "{found} {mean}");
    }
}
