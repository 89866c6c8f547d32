//! Light that is reflected hundreds to millions of times, or for ever.

use glam::DVec3;
use radiosity_core::StopReason;
use radiosity_core::matrix::{Error, Matrix, MatrixConfig, MatrixShooting, Method};
use scene::Rgb;

use super::rooms::{cube_6, cube_384, furthest, grey, lit, reference, solve, triangles};
use super::shared::{numbers, solution};

const REFLECTANCES: [f64; 6] = [0.5, 0.9, 0.99, 0.999, 0.9999, 0.999999];

/// Every surface emits 1 and reflects ρ: B = 1 / (1 − ρ), in any closed scene.
fn furnace(matrix: &Matrix, rho: f64) {
    let all = |value| grey(vec![value; matrix.len()]);
    let solved = solve(matrix, &all(rho), &all(1.0), 1e-10, Method::Auto);
    let expected = vec![1.0 / (1.0 - rho); matrix.len()];
    let far = furthest(&solved.exitance(), &expected);
    println!("furnace {}, ρ {rho}: off by {far:.1e}, {:.1} sweeps", matrix.len(), solved.sweeps());
    assert!(far <= 1e-9, "{} elements, ρ {rho}: {far:e}", matrix.len());
    assert!(solved.sweeps() <= 20.0);
}

#[test]
fn rho_to_1_furnace() {
    let mut twelve = reference(triangles(DVec3::ONE, 1));
    twelve.close().unwrap();
    for rho in REFLECTANCES {
        furnace(&cube_6(), rho);
        furnace(&twelve, rho);
        furnace(cube_384(), rho);
    }
}

/// One face shines, against solutions of the 6 × 6 system in 40 digits.
#[test]
fn rho_to_1_one_face() {
    let cube = cube_6();
    for rho in REFLECTANCES {
        let Some(case) = solution(&format!("cube_one_emitter_rho{rho}")) else { return };
        let (reflectance, emittance) = (grey(numbers(&case["rho"])), grey(numbers(&case["E"])));
        let solved = solve(&cube, &reflectance, &emittance, 1e-12, Method::Auto);
        let far = furthest(&solved.exitance(), &numbers(&case["B"]));
        println!("one face, ρ {rho}: off by {far:.1e}, {:.1} sweeps", solved.sweeps());
        // F is known to 1e-15, which 1 / (1 − ρ) bounces make 1e-9.
        assert!(far <= 1e-9, "ρ {rho}: {far:e}");
        assert!(solved.sweeps() <= 25.0);
    }
}

/// One patch shines. Plain shooting needs about 6.9 / (1 − ρ) sweeps to one millionth:
/// 688 at .99; deflation 10 at any ρ.
#[test]
fn rho_to_1_one_patch() {
    let cube = cube_384();
    for rho in [0.9, 0.99, 0.999, 0.9999, 0.999999] {
        let shining = lit(cube.len(), |i| i == 0);
        let solved = solve(cube, &grey(vec![rho; cube.len()]), &shining, 1e-6, Method::Auto);
        println!("one patch, ρ {rho}: {:.1} sweeps", solved.sweeps());
        assert!(solved.sweeps() <= 20.0, "ρ {rho}: {}", solved.sweeps());
        // The mean follows from the balance alone, up to the lamp: ΣA (1 − ρ) H = ΣA E.
        let mean = cube.areas().iter().zip(solved.irradiance()).map(|(a, h)| a * h[0]);
        let expected = cube.areas()[0] / (1.0 - rho);
        assert!((mean.sum::<f64>() / expected - 1.0).abs() <= 1e-6);
    }
}

#[test]
fn rho_exactly_1() {
    let mut cube = reference(triangles(DVec3::ONE, 1));
    cube.close().unwrap();
    let shining = lit(12, |i| i == 3);
    let start = |matrix, rho: &[Rgb], emittance: &[Rgb]| {
        MatrixShooting::new(matrix, rho, emittance, MatrixConfig::until(1e-9)).map(|_| ())
    };
    let white = grey([1.0; 12]);
    assert_eq!(start(&cube, &white, &shining), Err(Error::Singular { name: "0".into() }));
    // Without closure, rounding leaves the rows at 1 all the same.
    let raw = reference(triangles(DVec3::ONE, 1));
    assert!(start(&raw, &white, &shining).is_err());
    // Without light there is nothing to absorb.
    assert_eq!(start(&cube, &white, &lit(12, |_| false)), Ok(()));

    // One black triangle takes all that is emitted.
    let mut rho = white;
    rho[7] = Rgb::ZERO;
    let solved = solve(&cube, &rho, &shining, 1e-10, Method::Auto);
    let ledger = solved.ledger();
    println!("one black triangle: {:.1} sweeps", solved.sweeps());
    assert!((ledger.absorbed[0] / ledger.emitted[0] - 1.0).abs() <= 1e-9);
    let taken = solved.irradiance()[7][0] * cube.areas()[7];
    assert!((taken / ledger.emitted[0] - 1.0).abs() <= 1e-9);
    assert!(solved.exitance().iter().all(|b| b.is_finite()));
}

#[test]
fn what_no_surface_can_have_is_refused() {
    let cube = cube_6();
    let refused = |rho: f64, e: f64| {
        let (mut reflectance, mut emittance) = (grey([0.5; 6]), lit(6, |i| i == 0));
        reflectance[4].0[1] = rho;
        emittance[5].0[2] = e;
        MatrixShooting::new(&cube, &reflectance, &emittance, MatrixConfig::until(1e-3)).err()
    };
    assert_eq!(refused(0.5, 1.0), None);
    for rho in [1.2, -0.1, f64::NAN] {
        assert_eq!(refused(rho, 1.0), Some(Error::Reflectance { surface: 4 }));
    }
    for e in [-1.0, f64::INFINITY, f64::NAN] {
        assert_eq!(refused(0.5, e), Some(Error::Emittance { surface: 5 }));
    }
    let short = MatrixShooting::new(&cube, &grey([0.5]), &grey([1.0; 6]), MatrixConfig::until(0.1));
    let expected = Error::Length { what: "reflectances", expected: 6, found: 1 };
    assert_eq!(short.err(), Some(expected));
}

/// Plain shooting says so when it gets nowhere.
#[test]
fn rho_to_1_plain_stalls() {
    let cube = cube_6();
    let config = MatrixConfig { method: Method::Plain, ..MatrixConfig::until(1e-9) };
    let shining = lit(6, |i| i == 0);
    let mut shooting = MatrixShooting::new(&cube, &grey([0.999999; 6]), &shining, config).unwrap();
    assert_eq!(shooting.run(), StopReason::Stalled);
    assert!(shooting.sweeps() <= 50.0);
}
