//! Closed forms from Howell, Mengüç, Daun & Siegel, A Catalog of Radiation Heat Transfer
//! Configuration Factors.

use std::f64::consts::{PI, TAU};

use form_factor::{Estimate, Polygon, REFERENCE, between};
use glam::DVec3;

use crate::{ceiling, floor, polygon};

/// All tolerances that are promised, and what each may err by, relative.
const SETTINGS: [(f64, f64); 4] = [(1e-2, 1e-2), (1e-3, 1e-3), (1e-4, 1e-4), (REFERENCE, 1e-9)];

/// Rounding of the closed forms, absolute: their terms are up to 50 and cancel.
const ROUNDING: f64 = 1e-13;

fn check(name: &str, exact: f64, f: impl Fn(f64) -> Estimate) {
    for (tolerance, at_most) in SETTINGS {
        let estimate = f(tolerance);
        let error = (estimate.value - exact).abs();
        assert!(error <= at_most * exact, "{name} {tolerance:e}: {estimate:?} {exact}");
        assert!(error <= estimate.error + ROUNDING, "{name} {tolerance:e}: {estimate:?} {exact}");
    }
}

/// C-11: two equal rectangles a × b face to face at distance c.
fn opposed(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (x2, y2) = (1.0 + x * x, 1.0 + y * y);
    let terms = (x2 * y2 / (x2 + y * y)).sqrt().ln()
        + x * y2.sqrt() * (x / y2.sqrt()).atan()
        + y * x2.sqrt() * (y / x2.sqrt()).atan()
        - x * x.atan()
        - y * y.atan();
    2.0 / (PI * x * y) * terms
}

/// C-14: from a rectangle w × l to one h × l that stands on their common edge l.
fn upright(h: f64, w: f64, l: f64) -> f64 {
    let (h, w) = (h / l, w / l);
    let (h2, w2) = (h * h, w * w);
    let both = h2 + w2;
    let logs = ((1.0 + w2) * (1.0 + h2) / (1.0 + both)).ln()
        + w2 * (w2 * (1.0 + both) / ((1.0 + w2) * both)).ln()
        + h2 * (h2 * (1.0 + both) / ((1.0 + h2) * both)).ln();
    let angles =
        w * (1.0 / w).atan() + h * (1.0 / h).atan() - both.sqrt() * (1.0 / both.sqrt()).atan();
    (angles + logs / 4.0) / (PI * w)
}

/// C-13: from the rectangle x × y to the rectangle u × v in a parallel plane at distance z.
fn parallel(x: [f64; 2], y: [f64; 2], u: [f64; 2], v: [f64; 2], z: f64) -> f64 {
    let part = |dx: f64, dy: f64| {
        let (rx, ry) = (dx.hypot(z), dy.hypot(z));
        (dy * rx * (dy / rx).atan() + dx * ry * (dx / ry).atan()
            - z * z / 2.0 * (dx * dx + dy * dy + z * z).ln())
            / TAU
    };
    let mut sum = 0.0;
    for i in 0..16 {
        let [a, b, c, d] = [i & 1, i >> 1 & 1, i >> 2 & 1, i >> 3];
        let sign = if (a + b + c + d) % 2 == 0 { 1.0 } else { -1.0 };
        sum += sign * part(x[a] - u[b], y[c] - v[d]);
    }
    sum / ((x[1] - x[0]) * (y[1] - y[0]))
}

#[test]
fn rectangles_face_to_face() {
    for (a, b, c) in [(1.0, 1.0, 1.0), (2.0, 3.0, 0.5), (1.0, 10.0, 1.0), (1.0, 1.0, 0.01)] {
        let (lower, upper) = (floor([0.0, a], [0.0, b], 0.0), ceiling([0.0, a], [0.0, b], c));
        check(&format!("{a} {b} {c}"), opposed(a, b, c), |t| between(&lower, &upper, t));
    }
}

#[test]
fn rectangles_with_a_common_edge() {
    for (h, w, l) in [(1.0, 1.0, 1.0), (2.0, 1.0, 1.0), (0.5, 1.0, 3.0), (1.0, 1.0, 1000.0)] {
        let lying = floor([0.0, w], [0.0, l], 0.0);
        let wall = polygon([[0.0, 0.0, 0.0], [0.0, l, 0.0], [0.0, l, h], [0.0, 0.0, h]]);
        check(&format!("{h} {w} {l}"), upright(h, w, l), |t| between(&lying, &wall, t));
        let back = upright(h, w, l) * w / h;
        check(&format!("{h} {w} {l} back"), back, |t| between(&wall, &lying, t));
    }
}

#[test]
fn rectangles_in_parallel_planes() {
    let cases = [
        ([0.0, 1.0], [0.0, 1.0], [1.0, 2.0], [0.0, 1.0], 1.0),
        ([0.0, 1.0], [0.0, 2.0], [3.0, 5.0], [-1.0, 0.5], 0.5),
        ([-0.5, 0.5], [-0.5, 0.5], [-0.25, 0.25], [-0.25, 0.25], 0.75),
        ([0.0, 1.0], [0.0, 1.0], [2.0, 3.0], [5.0, 6.0], 7.0),
    ];
    for (x, y, u, v, z) in cases {
        let exact = parallel(x, y, u, v, z);
        let (lower, upper) = (floor(x, y, 0.0), ceiling(u, v, z));
        check(&format!("{x:?} {y:?} {u:?} {v:?} {z}"), exact, |t| between(&lower, &upper, t));
    }
}

#[test]
fn a_tiny_rectangle_sees_like_a_point() {
    // B-3, four times: a point below the middle of a rectangle. The rectangle around the point
    // is 1e-6 across, which changes the mean by the square of that.
    let half = 1e-6 / 2.0;
    let tiny = floor([-half, half], [-half, half], 0.0);
    for (a, b, c) in [(1.0, 1.0, 1.0), (3.0, 0.5, 2.0), (100.0, 100.0, 1.0)] {
        let (x, y) = (a / c, b / c);
        let (sx, sy) = (1.0f64.hypot(x), 1.0f64.hypot(y));
        let exact = 4.0 / TAU * (x / sx * (y / sx).atan() + y / sy * (x / sy).atan());
        let above = ceiling([-a, a], [-b, b], c);
        check(&format!("{a} {b} {c}"), exact, |t| between(&tiny, &above, t));
    }
}

#[test]
fn polygons_bracket_coaxial_discs() {
    // C-41: with R = r/h and X = 1 + (1 + R₂²)/R₁², F = (X − √(X² − 4 R₂²/R₁²))/2.
    for (r1, r2, h) in [(1.0f64, 1.0f64, 1.0f64), (1.0, 2.0, 1.0), (2.0, 1.0, 0.25)] {
        let x = 1.0 + (h * h + r2 * r2) / (r1 * r1);
        let exact = PI * r1 * r1 * (x - (x * x - 4.0 * (r2 / r1).powi(2)).sqrt()) / 2.0;
        let disc = |r: f64, z: f64, n: i32, turn: f64| {
            let corner = |i: i32| {
                let (sin, cos) = (turn * TAU * f64::from(i) / f64::from(n)).sin_cos();
                DVec3::new(r * cos, r * sin, z)
            };
            Polygon::new(&(0..n).map(corner).collect::<Vec<_>>()).expect("a regular polygon")
        };
        let width = |n: i32| {
            let exchange = |scale: f64| {
                let lower = disc(r1 * scale, 0.0, n, 1.0);
                lower.area() * between(&lower, &disc(r2 * scale, h, n, -1.0), REFERENCE).value
            };
            let (inside, outside) = (exchange(1.0), exchange(1.0 / (PI / f64::from(n)).cos()));
            assert!(inside < exact && exact < outside, "{inside} {exact} {outside}");
            outside - inside
        };
        let ratio = width(12) / width(24);
        assert!((3.5..4.5).contains(&ratio), "of second order: {ratio}");
    }
}
