//! Whole solutions that are known: the case files, and light through exact form factors.

use form_factor::{Polygon, REFERENCE};
use glam::DVec3;
use radiosity_core::Sequential;
use radiosity_core::ShootingConfig;
use radiosity_core::matrix::{
    ComputeConfig, Matrix, MatrixConfig, MatrixShooting, Surfaces, compute,
};
use scene::Rgb;

use super::{Check, Outcome};
use crate::howell::{opposed_rectangles, perpendicular_rectangles};
use crate::{Case, Engine, solve};

/// Error of a solution through form factors that are exact to [`REFERENCE`], at ρ = .5.
const EXACT: f64 = 1e-8;

/// Unshot share at which those solutions stop.
const UNSHOT: f64 = 1e-12;

pub(super) fn checks() -> Vec<Check> {
    let mut checks: Vec<Check> = Case::ids().map(case).collect();
    for reflectance in [0.5, 0.99, 0.999_999] {
        checks.push(Check::new(
            format!("cube of six faces, one shines, reflectance {reflectance}"),
            move || cube(reflectance),
        ));
    }
    checks
}

/// A case file through the first engine; the number furthest off.
fn case(id: &'static str) -> Check {
    Check::new(id.replace('_', " "), move || {
        let failed = Outcome { exact: f64::NAN, ours: f64::NAN, error: f64::NAN, bound: 0.0 };
        let Ok(case) = Case::load(id) else { return failed };
        let Ok(scene) = case.scene() else { return failed };
        let config = ShootingConfig::until(case.unshot);
        let Ok(solved) = solve(&scene, case.elements, config, Engine::FIRST) else { return failed };
        let worst = case.worst(&scene, &solved.solution);
        Outcome { exact: worst.exact, ours: worst.ours, error: worst.error, bound: case.tolerance }
    })
}

/// The face opposite the one that shines, from our form factors and from the closed forms of
/// a cube by its symmetry: B = (emitter, opposite, side) with
/// s = ρ(4·(e + o)·p/4 + 2p·s + q·s), o = ρ(q·e + 4p·s), e = 1 + ρ(q·o + 4p·s).
fn cube(reflectance: f64) -> Outcome {
    let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64);
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let polygons = faces.map(|f| Polygon::new(&f.map(corner)).expect("a face is a square"));
    let surfaces = Surfaces::each(polygons);
    let config = ComputeConfig { tolerance: REFERENCE, occluders: None };
    let matrix: Matrix = compute(&surfaces, &config, &Sequential).matrix;
    let mut emittance = [Rgb::ZERO; 6];
    emittance[0] = Rgb::splat(1.0);
    let until = MatrixConfig::until(UNSHOT * (1.0 - reflectance));
    let Ok(mut shooting) =
        MatrixShooting::new(&matrix, &[Rgb::splat(reflectance); 6], &emittance, until)
    else {
        return Outcome { exact: f64::NAN, ours: f64::NAN, error: f64::NAN, bound: 0.0 };
    };
    shooting.run();
    let exact = opposite_face(reflectance);
    // An error δ of a row sum is worth δ/(1 − ρ).
    let bound = EXACT * 0.5 / (1.0 - reflectance);
    Outcome::relative(exact, shooting.exitance()[1][0], bound)
}

/// The exact exitance opposite the shining face, of three unknowns by elimination.
fn opposite_face(rho: f64) -> f64 {
    let q = opposed_rectangles(1.0, 1.0, 1.0);
    let p = perpendicular_rectangles(1.0, 1.0, 1.0);
    // s = k(e + o); e + o = t and e − o = d: t = 1 + ρ(q t + 8 p s), d = 1 − ρ q d.
    let k = rho * p / (1.0 - rho * (q + 2.0 * p));
    let t = 1.0 / (1.0 - rho * q - 8.0 * rho * p * k);
    let d = 1.0 / (1.0 + rho * q);
    (t - d) / 2.0
}

#[cfg(test)]
mod tests {
    use super::opposite_face;

    #[test]
    fn the_elimination_solves_the_cube() {
        // Repeated substitution over all six faces is the second witness.
        let (q, p, rho) = (0.199_824_895_698_387_4, 0.200_043_776_075_403_15, 0.9);
        let mut b = [0.0f64; 6];
        for _ in 0..2000 {
            let mut next = [0.0; 6];
            for (i, slot) in next.iter_mut().enumerate() {
                let light: f64 = (0..6)
                    .filter(|j| *j != i)
                    .map(|j| if j / 2 == i / 2 { q * b[j] } else { p * b[j] })
                    .sum();
                *slot = rho * light + if i == 0 { 1.0 } else { 0.0 };
            }
            b = next;
        }
        assert!((opposite_face(rho) / b[1] - 1.0).abs() < 1e-12, "{} {}", opposite_face(rho), b[1]);
    }
}
