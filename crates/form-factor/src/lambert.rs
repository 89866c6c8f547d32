//! Lambert's exact form factor from a point to a polygon, clipped at the point's horizon.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

/// What a point sees of a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clipped {
    /// The form factor from the point to the part above its horizon.
    pub form_factor: f64,
    /// The mean of that part's corners: a place on it that the point can see.
    pub middle: DVec3,
    /// Whether the horizon cut anything off.
    pub cut: bool,
}

/// Form factor from a point with a normal to a triangle:
/// F = 1/2π · |Σ over edges of angle(rᵢ, rᵢ₊₁) · n·(rᵢ × rᵢ₊₁)/|rᵢ × rᵢ₊₁||.
///
/// Exact where nothing is in between, at any distance and for slivers. A point on the
/// triangle's rim counts as lying just in front of it. Which side of the triangle the point
/// sees is otherwise the caller's concern.
///
/// # References
/// Lambert 1760; Baum, Rushmeier & Winget 1989, "Improving radiosity solutions through the
/// use of analytically determined form-factors", eq. 7.
#[must_use]
pub fn lambert(point: DVec3, normal: DVec3, corners: [DVec3; 3]) -> Clipped {
    let r = corners.map(|c| c - point);
    let h = r.map(|v| normal.dot(v));
    if h.iter().all(|&height| height >= 0.0) {
        let sum: f64 = (0..3).map(|i| edge(normal, r[i], r[(i + 1) % 3], &r)).sum();
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        return Clipped { form_factor: sum.abs() / TAU, middle, cut: false };
    }
    let (polygon, n) = above_horizon(r, h);
    let mut sum = 0.0;
    let mut middle = DVec3::ZERO;
    for i in 0..n {
        sum += edge(normal, polygon[i], polygon[(i + 1) % n], &r);
        middle += polygon[i];
    }
    let middle = if n > 0 { point + middle / n as f64 } else { point };
    Clipped { form_factor: sum.abs() / TAU, middle, cut: true }
}

/// The angle between two directions times the height of their common normal.
#[inline]
fn edge(normal: DVec3, a: DVec3, b: DVec3, triangle: &[DVec3; 3]) -> f64 {
    let cross = a.cross(b);
    let sine = cross.length();
    if sine > 0.0 {
        sine.atan2(a.dot(b)) * normal.dot(cross) / sine
    } else {
        edge_through_point(normal, a, b, triangle)
    }
}

/// The limit for a point on the edge's line, approached from the triangle's front: nothing
/// if the edge lies to one side, half a turn if the point lies on the edge.
#[cold]
fn edge_through_point(normal: DVec3, a: DVec3, b: DVec3, triangle: &[DVec3; 3]) -> f64 {
    if a.dot(b) >= 0.0 {
        return 0.0;
    }
    let [p, q, r] = *triangle;
    let up = (q - p).cross(r - p).cross(a - b).normalize_or_zero();
    PI * normal.dot(up)
}

/// Sutherland–Hodgman against one plane: a triangle leaves at most four corners.
fn above_horizon(r: [DVec3; 3], h: [f64; 3]) -> ([DVec3; 4], usize) {
    let mut out = [DVec3::ZERO; 4];
    let mut n = 0;
    for i in 0..3 {
        let j = (i + 1) % 3;
        if h[i] >= 0.0 {
            out[n] = r[i];
            n += 1;
        }
        if (h[i] >= 0.0) != (h[j] >= 0.0) {
            out[n] = r[i] + (r[j] - r[i]) * (h[i] / (h[i] - h[j]));
            n += 1;
        }
    }
    (out, n)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn triangle(points: [[f64; 3]; 3]) -> [DVec3; 3] {
        points.map(DVec3::from)
    }

    #[test]
    fn right_triangle_above_a_corner_matches_the_closed_form() {
        // Differential element to a parallel rectangle a×b at height c, its corner above the
        // element (Howell, catalogue of configuration factors, B-3).
        let (a, b, c) = (2.0f64, 3.0f64, 1.5f64);
        let (x, y) = (a / c, b / c);
        let (sx, sy) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
        let expected = (x / sx * (y / sx).atan() + y / sy * (x / sy).atan()) / TAU;
        let lower = triangle([[0.0, 0.0, c], [a, 0.0, c], [a, b, c]]);
        let upper = triangle([[0.0, 0.0, c], [a, b, c], [0.0, b, c]]);
        let f = lambert(DVec3::ZERO, DVec3::Z, lower).form_factor
            + lambert(DVec3::ZERO, DVec3::Z, upper).form_factor;
        assert!((f - expected).abs() < 1e-15, "{f} {expected}");
    }

    #[test]
    fn a_closed_box_around_the_point_sums_to_one() {
        // Whatever the point and its normal, half of it below the horizon.
        let box_corner =
            |i: usize| DVec3::new((i & 1) as f64, ((i >> 1) & 1) as f64, ((i >> 2) & 1) as f64);
        let faces =
            [[0, 1, 3, 2], [4, 5, 7, 6], [0, 1, 5, 4], [2, 3, 7, 6], [0, 2, 6, 4], [1, 3, 7, 5]];
        let normal = DVec3::new(0.3, -0.5, 0.8).normalize();
        for point in [DVec3::splat(0.5), DVec3::new(0.01, 0.9, 0.2), DVec3::new(1e-9, 0.5, 0.5)] {
            let mut sum = 0.0;
            for f in faces {
                let p = f.map(box_corner);
                sum += lambert(point, normal, [p[0], p[1], p[2]]).form_factor;
                sum += lambert(point, normal, [p[0], p[2], p[3]]).form_factor;
            }
            assert!((sum - 1.0).abs() < 1e-12, "{point} {sum}");
        }
    }

    #[test]
    fn below_the_horizon_is_nothing_and_the_rim_is_finite() {
        let below = triangle([[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -2.0]]);
        assert_eq!(lambert(DVec3::ZERO, DVec3::Z, below).form_factor, 0.0);
        // A wall that rises at right angles from an edge through the point: the value on the
        // rim is the limit of values just in front of it (independent: the same formula away
        // from its singular case).
        let wall = triangle([[0.0, -1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
        let rim = lambert(DVec3::ZERO, DVec3::Z, wall).form_factor;
        let near = lambert(DVec3::X * 1e-7, DVec3::Z, wall).form_factor;
        assert!(near > 0.2 && (rim - near).abs() < 1e-6, "{rim} {near}");
    }
}
