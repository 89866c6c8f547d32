//! Closed forms for form factors, from Howell, A Catalog of Radiation Heat Transfer
//! Configuration Factors, by their numbers there.

use std::f64::consts::{PI, TAU};

/// C-11: between opposed rectangles a × b at distance c.
#[must_use]
pub fn opposed_rectangles(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (x2, y2) = (1.0 + x * x, 1.0 + y * y);
    let log = (x2 * y2 / (x2 + y * y)).ln() / 2.0;
    let across = |x: f64, y2: f64| x * y2.sqrt() * (x / y2.sqrt()).atan();
    2.0 / (PI * x * y) * (log + across(x, y2) + across(y, x2) - x * x.atan() - y * y.atan())
}

/// C-13: from a rectangle to another in a parallel plane at distance z, sides along the same
/// axes; each rectangle is its two x and its two y.
#[must_use]
pub fn parallel_rectangles(from: [[f64; 2]; 2], to: [[f64; 2]; 2], z: f64) -> f64 {
    let along = |d: f64, e: f64| d * (e * e + z * z).sqrt() * (d / (e * e + z * z).sqrt()).atan();
    let corner = |x: f64, y: f64, p: f64, q: f64| {
        let (d, e) = (x - p, y - q);
        (along(e, d) + along(d, e) - z * z / 2.0 * (d * d + e * e + z * z).ln()) / TAU
    };
    let mut sum = 0.0;
    for (i, x) in from[0].into_iter().enumerate() {
        for (j, y) in from[1].into_iter().enumerate() {
            for (k, p) in to[0].into_iter().enumerate() {
                for (l, q) in to[1].into_iter().enumerate() {
                    let sign = if (i + j + k + l) % 2 == 0 { 1.0 } else { -1.0 };
                    sum += sign * corner(x, y, p, q);
                }
            }
        }
    }
    sum / ((from[0][1] - from[0][0]) * (from[1][1] - from[1][0]))
}

/// C-14: from a rectangle of width w to one of height h at right angles, along a common edge
/// of length l.
#[must_use]
pub fn perpendicular_rectangles(h: f64, w: f64, l: f64) -> f64 {
    let (h, w) = (h / l, w / l);
    let (h2, w2) = (h * h, w * w);
    let logs = ((1.0 + w2) * (1.0 + h2) / (1.0 + w2 + h2)).ln()
        + w2 * (w2 * (1.0 + w2 + h2) / ((1.0 + w2) * (w2 + h2))).ln()
        + h2 * (h2 * (1.0 + h2 + w2) / ((1.0 + h2) * (h2 + w2))).ln();
    let root = (h2 + w2).sqrt();
    let angles = w * (1.0 / w).atan() + h * (1.0 / h).atan() - root * (1.0 / root).atan();
    (angles + logs / 4.0) / (PI * w)
}

/// C-41: from a disc of radius a to a coaxial one of radius b at distance h.
#[must_use]
pub fn coaxial_discs(a: f64, b: f64, h: f64) -> f64 {
    let (r1, r2) = (a / h, b / h);
    let s = 1.0 + (1.0 + r2 * r2) / (r1 * r1);
    // ½(s − √(s² − 4(b/a)²)) without the difference of near numbers.
    let ratio = (b / a).powi(2);
    2.0 * ratio / (s + (s * s - 4.0 * ratio).sqrt())
}

/// B-3: from a point to a parallel rectangle a × b at distance c, a corner above the point. Odd in a
/// and in b, so that differences give rectangles elsewhere.
#[must_use]
pub fn point_to_parallel_rectangle(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (x2, y2) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / x2 * (y / x2).atan() + y / y2 * (x / y2).atan()) / TAU
}

/// B-4: from a point that looks along a to a rectangle a × b at distance c from it, a corner where
/// the plane's normal through the point meets it. Odd in b; differences give rectangles elsewhere.
#[must_use]
pub fn point_to_perpendicular_rectangle(a: f64, b: f64, c: f64) -> f64 {
    let slant = a.hypot(c);
    ((b / c).atan() - c / slant * (b / slant).atan()) / TAU
}

/// B-3 for the rectangle of these two x and two y, seen from the origin.
#[must_use]
pub fn point_to_parallel([x0, x1]: [f64; 2], [y0, y1]: [f64; 2], c: f64) -> f64 {
    let corner = |x, y| point_to_parallel_rectangle(x, y, c);
    corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
}

/// B-4 for the rectangle of these two distances along the look, each at least 0, and two aside.
#[must_use]
pub fn point_to_perpendicular([a0, a1]: [f64; 2], [b0, b1]: [f64; 2], c: f64) -> f64 {
    let corner = |a, b| point_to_perpendicular_rectangle(a, b, c);
    corner(a1, b1) - corner(a0, b1) - corner(a1, b0) + corner(a0, b0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn printed_values_come_out() {
        // Walton, NISTIR 6925 (2002), table 1 and its examples, to their digits.
        assert!((opposed_rectangles(1.0, 1.0, 1.0) - 0.199_824_90).abs() < 5e-9);
        assert!((perpendicular_rectangles(1.0, 1.0, 1.0) - 0.200_043_78).abs() < 5e-9);
        let (unit, hole) = ([[0.0, 1.0]; 2], [[0.25, 0.75]; 2]);
        assert!((parallel_rectangles(unit, hole, 0.75) - 0.084_204_294).abs() < 5e-10);
    }

    #[test]
    fn formulas_agree_with_each_other() {
        let unit = [[0.0, 2.0], [0.0, 3.0]];
        let same = parallel_rectangles(unit, unit, 0.5) - opposed_rectangles(2.0, 3.0, 0.5);
        assert!(same.abs() < 1e-13, "{same:e}");
        // A cube's six faces see each other entirely.
        let cube =
            opposed_rectangles(1.0, 1.0, 1.0) + 4.0 * perpendicular_rectangles(1.0, 1.0, 1.0);
        assert!((cube - 1.0).abs() < 1e-14, "{cube}");
        // A small disc sees a large one like a point: sin² of the half angle.
        let small = coaxial_discs(1e-4, 2.0, 1.0);
        assert!((small - 4.0 / 5.0).abs() < 1e-8, "{small}");
        // A quarter of the plane above is a quarter of the half-space that a look along it sees.
        let quarter = point_to_perpendicular_rectangle(1e9, 1e9, 1.0);
        assert!((quarter - 0.25).abs() < 1e-8, "{quarter}");
        // The mean of the point's over a rectangle is that of the rectangle (C-14): midpoints.
        let n = 400;
        let at = |i: i32| (f64::from(i) + 0.5) / f64::from(n);
        let point =
            |i: i32, j: i32| point_to_perpendicular([0.0, 1.0], [-at(i), 1.0 - at(i)], at(j));
        let sum: f64 = (0..n).flat_map(|i| (0..n).map(move |j| point(i, j))).sum();
        let mean = sum / f64::from(n * n);
        assert!((mean - perpendicular_rectangles(1.0, 1.0, 1.0)).abs() < 1e-5, "{mean}");
        // Four corners of a far square look like one small patch: A / (π c²).
        let far = 4.0 * point_to_parallel_rectangle(0.5, 0.5, 1000.0) * PI * 1e6;
        assert!((far - 1.0).abs() < 1e-6, "{far}");
    }
}
