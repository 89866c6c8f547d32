//! Very bright, very dark, very long, and three channels at once.

use glam::DVec3;
use radiosity_core::StopReason;
use radiosity_core::matrix::{Matrix, MatrixConfig, MatrixShooting, Method};
use scene::Rgb;

use super::rooms::{cube_6, cube_384, grey, lit, rectangles, reference, solve};

#[test]
fn zero_rho() {
    let cube = cube_384();
    let black = grey(vec![0.0; cube.len()]);
    let shining = lit(cube.len(), |i| i % 100 == 7);
    for method in [Method::Auto, Method::Plain, Method::Deflated] {
        let solved = solve(cube, &black, &shining, 0.0, method);
        assert_eq!(solved.shots(), 4, "one shot for each of the lamps");
        assert_eq!(solved.exitance(), shining);
        let from_lamps: f64 = [7, 107, 207, 307].iter().map(|&lamp| cube.value(0, lamp)).sum();
        assert!((solved.irradiance()[0][0] - from_lamps).abs() <= 1e-15);
    }
}

#[test]
fn no_emitters() {
    let cube = cube_384();
    let dark = lit(cube.len(), |_| false);
    for method in [Method::Auto, Method::Deflated] {
        let config = MatrixConfig { method, ..MatrixConfig::until(1e-3) };
        let mut shooting =
            MatrixShooting::new(cube, &grey(vec![0.9; cube.len()]), &dark, config).unwrap();
        assert_eq!((shooting.run(), shooting.shots()), (StopReason::NoLight, 0));
        assert_eq!((shooting.exitance(), shooting.unshot()), (dark.clone(), 0.0));
        assert_eq!(shooting.ledger().imbalance(), 0.0);
    }
    let nothing = Matrix::default();
    let mut shooting = MatrixShooting::new(&nothing, &[], &[], MatrixConfig::until(1e-3)).unwrap();
    assert_eq!((shooting.run(), shooting.sweeps()), (StopReason::NoLight, 0.0));
}

#[test]
fn emission_1e30_1e_30() {
    let cube = cube_6();
    let rho = grey([0.9; 6]);
    let emittance = |scale: f64| grey([1e-30 * scale, 1e30 * scale, 0.0, 0.0, 0.0, 0.0]);
    for method in [Method::Plain, Method::Deflated] {
        let light = |e: &[Rgb]| solve(&cube, &rho, e, 1e-10, method).exitance();
        let once = light(&emittance(1.0));
        for power in [100, -100] {
            let scale = 2f64.powi(power);
            let scaled: Vec<Rgb> = once.iter().map(|b| *b * scale).collect();
            assert_eq!(light(&emittance(scale)), scaled, "2^{power}");
        }
        let ten = light(&emittance(1e30));
        for (b, once) in ten.iter().zip(&once) {
            assert!((b[0] / (once[0] * 1e30) - 1.0).abs() <= 1e-13);
        }
        // As far as f64 goes: the light of one face alone, times 2^1000 and 2^-1000.
        let one =
            |scale: f64| light(&lit(6, |i| i == 2).iter().map(|e| *e * scale).collect::<Vec<_>>());
        for power in [1000, -1000] {
            let scale = 2f64.powi(power);
            let scaled: Vec<Rgb> = one(1.0).iter().map(|b| *b * scale).collect();
            assert_eq!(one(scale), scaled, "2^{power}");
        }
    }
}

/// Hundreds of thousands of shots, and the power is still all there.
#[test]
fn f32_drift() {
    let mut cube_96 = reference(rectangles(DVec3::ONE, 4));
    cube_96.close().unwrap();
    for (cube, rho, at_least) in [(cube_384(), 0.99, 250_000), (&cube_96, 0.999, 600_000)] {
        let shining = lit(cube.len(), |i| i == 0);
        let solved = solve(cube, &grey(vec![rho; cube.len()]), &shining, 1e-6, Method::Plain);
        let imbalance = solved.ledger().imbalance();
        println!("ρ {rho}: {} shots, balance off by {imbalance:.1e}", solved.shots());
        assert!(imbalance <= 1e-12, "ρ {rho}: {imbalance:e}");
        assert!(solved.shots() > at_least, "{}", solved.shots());
    }
}

/// A shaft of 40 rings, grey, lit at one end: the far end has a ten-thousandth of the lamp's
/// exitance, and deflation first gives it as much as the near one. The overshoot must be taken
/// back, by shooting negative light: `solve` asserts that none is left below zero.
#[test]
fn cancel_after_overshoot() {
    let rings = 40;
    let mut polygons = Vec::new();
    for (face, polygon) in rectangles(DVec3::new(1.0, 1.0, 40.0), 1).into_iter().enumerate() {
        if face >= 4 {
            polygons.push(polygon);
            continue;
        }
        for ring in 0..rings {
            let step = |c: &DVec3| c.with_z(c.z / 40.0 + f64::from(ring));
            let corners: Vec<DVec3> = polygon.corners().iter().map(step).collect();
            polygons.push(form_factor::Polygon::new(&corners).unwrap());
        }
    }
    let mut shaft = reference(polygons);
    shaft.close().unwrap();
    let (lamp, end) = (shaft.len() - 2, shaft.len() - 1);
    let shining = lit(shaft.len(), |i| i == lamp);
    let rho = grey(vec![0.5; shaft.len()]);
    let deflated = solve(&shaft, &rho, &shining, 1e-12, Method::Deflated);
    let plain = solve(&shaft, &rho, &shining, 1e-15, Method::Plain);
    let far = |s: &MatrixShooting| s.exitance()[end][0];
    println!(
        "far end {:.3e} deflated ({:.1} sweeps), {:.3e} plain ({:.1} sweeps)",
        far(&deflated),
        deflated.sweeps(),
        far(&plain),
        plain.sweeps()
    );
    assert!((far(&deflated) - far(&plain)).abs() <= 1e-12);
    // Loosely stopped, too: light that is not there yet may be missing, but none is negative.
    for unshot in [1e-1, 1e-2, 1e-3, 1e-6] {
        solve(&shaft, &rho, &shining, unshot, Method::Deflated);
    }
}

/// Three channels of very different reflectance: each must meet the stop rule, and each gets
/// what it gets alone.
#[test]
fn rgb() {
    let cube = cube_384();
    let rho = [0.1, 0.5, 0.99];
    let shining = lit(cube.len(), |i| i < 64);
    let all = vec![Rgb(rho); cube.len()];
    let together = solve(cube, &all, &shining, 1e-9, Method::Auto);
    let (ledger, exitance) = (together.ledger(), together.exitance());
    for c in 0..3 {
        // All that is not unshot is absorbed: Σ A (1 − ρ) H / Σ A E misses 1 by the unshot.
        let missing = (ledger.absorbed[c] / ledger.emitted[c] - 1.0).abs();
        assert!(missing <= 1e-9, "channel {c}: {missing:e}");
        let grey_rho = grey(vec![rho[c]; cube.len()]);
        let alone = solve(cube, &grey_rho, &shining, 1e-9, Method::Auto);
        let most = alone.exitance().iter().map(|b| b[0]).fold(0.0, f64::max);
        for (b, alone) in exitance.iter().zip(alone.exitance()) {
            // Twice the L1 bound of the iteration, of a lamp of 64 in 384 surfaces.
            let far = (b[c] - alone[0]).abs() / most;
            assert!(far <= 1e-7, "channel {c}: {far:e}");
        }
    }
    println!("three channels: {:.1} sweeps", together.sweeps());
}
