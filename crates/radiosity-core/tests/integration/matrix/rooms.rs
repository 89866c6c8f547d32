//! Boxes and meshes as matrices, and their solutions.

use std::sync::OnceLock;

use form_factor::{Polygon, REFERENCE};
use glam::DVec3;
use radiosity_core::matrix::{
    ComputeConfig, Entry, Matrix, MatrixConfig, MatrixShooting, Method, Surfaces, compute,
};
use radiosity_core::{Sequential, StopReason};
use scene::Rgb;

/// The faces of a box seen from inside, x0, x1, y0, y1, z0, z1, each of n × n rectangles.
pub(super) fn rectangles(size: DVec3, n: usize) -> Vec<Polygon> {
    let mut polygons = Vec::new();
    for axis in 0..3 {
        let (u, v) = ([DVec3::Y, DVec3::Z, DVec3::X][axis], [DVec3::Z, DVec3::X, DVec3::Y][axis]);
        for far in [false, true] {
            let origin = if far { [DVec3::X, DVec3::Y, DVec3::Z][axis] } else { DVec3::ZERO };
            let at = |i: usize, j: usize| {
                let share = |k: usize| k as f64 / n as f64;
                (origin + u * share(i) + v * share(j)) * size
            };
            for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
                let mut corners = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                if far {
                    corners.reverse();
                }
                polygons.push(Polygon::new(&corners).unwrap());
            }
        }
    }
    polygons
}

/// The same, each rectangle cut into two triangles.
pub(super) fn triangles(size: DVec3, n: usize) -> Vec<Polygon> {
    let halves = |p: &Polygon| {
        let c = p.corners();
        [[c[0], c[1], c[2]], [c[0], c[2], c[3]]].map(|t| Polygon::triangle(t).unwrap())
    };
    rectangles(size, n).iter().flat_map(halves).collect()
}

/// The form factors of a convex room to the last digits that can be had.
pub(super) fn reference(polygons: Vec<Polygon>) -> Matrix {
    let config = ComputeConfig { tolerance: REFERENCE, occluders: None };
    compute(&Surfaces::each(polygons), &config, &Sequential).matrix
}

/// The unit cube of 384 squares, its rows closed.
pub(super) fn cube_384() -> &'static Matrix {
    static CUBE: OnceLock<Matrix> = OnceLock::new();
    CUBE.get_or_init(|| {
        let mut cube = reference(rectangles(DVec3::ONE, 8));
        cube.close().unwrap();
        cube
    })
}

/// The unit cube of six squares, its rows closed.
pub(super) fn cube_6() -> Matrix {
    let mut cube = reference(rectangles(DVec3::ONE, 1));
    cube.close().unwrap();
    cube
}

/// A matrix from full rows, with this error in each of its form factors.
pub(super) fn dense(areas: Vec<f64>, rows: &[Vec<f64>], error: f64) -> Matrix {
    let names = (0..rows.len()).map(|i| i.to_string()).collect();
    let entry = |(column, value): (usize, &f64)| {
        let error = if *value > 0.0 { error } else { 0.0 };
        Entry { column: column as u32, value: *value, error }
    };
    let rows = rows.iter().map(|row| row.iter().enumerate().map(entry).collect()).collect();
    Matrix::from_rows(names, areas, rows).unwrap()
}

/// Grey lists from numbers.
pub(super) fn grey(values: impl IntoIterator<Item = f64>) -> Vec<Rgb> {
    values.into_iter().map(Rgb::splat).collect()
}

/// Emittance 1 of some surfaces, 0 of the others.
pub(super) fn lit(n: usize, shines: impl Fn(usize) -> bool) -> Vec<Rgb> {
    grey((0..n).map(|i| f64::from(u8::from(shines(i)))))
}

/// Shoots until `unshot` is reached, and checks what every solution must have: the power that
/// was emitted, and no light below zero.
pub(super) fn solve<'a>(
    matrix: &'a Matrix,
    reflectance: &[Rgb],
    emittance: &[Rgb],
    unshot: f64,
    method: Method,
) -> MatrixShooting<'a> {
    let config = MatrixConfig { method, ..MatrixConfig::until(unshot) };
    let mut shooting = MatrixShooting::new(matrix, reflectance, emittance, config).unwrap();
    assert_eq!(shooting.run(), StopReason::Converged, "{} sweeps", shooting.sweeps());
    assert!(shooting.unshot() <= unshot);
    let ledger = shooting.ledger();
    for c in 0..3 {
        // f64 keeps that much of all the power that went round, bounce after bounce.
        let moved = matrix.areas().iter().zip(shooting.irradiance()).map(|(a, h)| a * h[c]);
        let rounds = moved.sum::<f64>() / ledger.emitted[c].max(f64::MIN_POSITIVE);
        let imbalance = ledger.imbalance();
        assert!(imbalance <= 1e-12 + 4.0 * f64::EPSILON * rounds, "{imbalance}, {rounds} bounces");
    }
    for c in 0..3 {
        let exitance = shooting.exitance();
        let most = exitance.iter().map(|b| b[c]).fold(0.0, f64::max);
        let least = exitance.iter().map(|b| b[c]).fold(f64::INFINITY, f64::min);
        assert!(least >= -1e-14 * most, "channel {c}: {least} beside {most}");
    }
    shooting
}

/// The largest |a − b| over the largest |b|, red alone.
pub(super) fn furthest(found: &[Rgb], expected: &[f64]) -> f64 {
    assert_eq!(found.len(), expected.len());
    let most = expected.iter().copied().fold(0.0, f64::max);
    let far = found.iter().zip(expected).map(|(a, b)| (a[0] - b).abs()).fold(0.0, f64::max);
    far / most
}
