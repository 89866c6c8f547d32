//! How many sweeps it takes: the spectral radius counts, not the largest reflectance.

use radiosity_core::StopReason;
use radiosity_core::matrix::{MatrixConfig, MatrixShooting, Method};

use super::rooms::{cube_6, cube_384, dense, grey, lit, solve};

/// The same numbers in every run, spread over [0, 1): the fractional parts of i φ², shuffled
/// by a multiplicative hash (Knuth 1973, §6.4).
fn spread(i: usize) -> f64 {
    const HASH: u64 = 0x9e37_79b9_7f4a_7c15;
    let bits = (i as u64 + 1).wrapping_mul(HASH).rotate_left(31).wrapping_mul(HASH);
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

#[test]
fn mixed_reflectance() {
    let cube = cube_384();
    let n = cube.len();
    let half = grey((0..n).map(|i| if spread(i) < 0.5 { 0.999 } else { 0.1 }));
    let spotted = grey((0..n).map(|i| if i == 200 { 0.0 } else { 0.999 }));
    let uniform = grey((0..n).map(|i| 0.2 + 0.79 * spread(i)));
    let sweeps =
        |rho: &[scene::Rgb], method| solve(cube, rho, &lit(n, |i| i == 0), 1e-6, method).sweeps();
    // An independent program needed 12.5, 1915 and 13 plain, 3.9, 6.1 and 4.2 deflated, with
    // other random numbers and another lamp.
    for (name, rho, plain, deflated) in [
        ("half .999, half .1", &half, 9.0..16.0, 0.0..8.0),
        ("one black patch in .999", &spotted, 1500.0..2300.0, 0.0..12.0),
        ("U(.2, .99)", &uniform, 9.0..17.0, 0.0..8.0),
    ] {
        let found = [Method::Plain, Method::Deflated, Method::Auto].map(|m| sweeps(rho, m));
        println!("{name}: {:.1} plain, {:.1} deflated, {:.1} auto", found[0], found[1], found[2]);
        assert!(plain.contains(&found[0]), "{name}: {} plain", found[0]);
        assert!(deflated.contains(&found[1]), "{name}: {} deflated", found[1]);
        assert!(found[2] <= found[0].min(found[1] + 10.0), "{name}: {} auto", found[2]);
    }
}

/// Auto leaves deflation out where most light is lost at each bounce.
#[test]
fn auto_deflates_only_where_little_is_absorbed() {
    let cube = cube_384();
    let deflations = |rho: f64| {
        let shining = lit(cube.len(), |i| i == 0);
        solve(cube, &grey(vec![rho; cube.len()]), &shining, 1e-6, Method::Auto).deflations()
    };
    assert_eq!(deflations(0.5), 0);
    assert!(deflations(0.7) > 0);
}

/// Two rooms that no light joins, one of them dark: it stays dark, and the other takes no
/// longer for it.
#[test]
fn each_room_is_deflated_by_itself() {
    let room = cube_6();
    let row = |i: usize| -> Vec<f64> { (0..6).map(|j| room.value(i, j)).collect() };
    let rows: Vec<Vec<f64>> = (0..12)
        .map(|i| if i < 6 { [row(i), vec![0.0; 6]] } else { [vec![0.0; 6], row(i - 6)] }.concat())
        .collect();
    let rooms = dense(vec![1.0; 12], &rows, 0.0);
    let shining = lit(12, |i| i == 2);
    let solved = solve(&rooms, &grey([0.9999; 12]), &shining, 1e-9, Method::Deflated);
    assert!(solved.sweeps() <= 10.0, "{}", solved.sweeps());
    assert!(solved.exitance()[6..].iter().all(|b| *b == scene::Rgb::ZERO));
}

#[test]
fn the_number_of_shots_can_be_limited() {
    let cube = cube_384();
    let (rho, shining) = (grey(vec![0.9; cube.len()]), lit(cube.len(), |i| i < 64));
    let mut config = MatrixConfig::until(1e-6);
    config.stop.max_shots = Some(100);
    let mut shooting = MatrixShooting::new(cube, &rho, &shining, config).unwrap();
    assert_eq!((shooting.run(), shooting.shots()), (StopReason::ShotLimit, 100));
    assert!(shooting.ledger().imbalance() <= 1e-14);
}
