//! Kernel quadrature: cosθ cosθ' / (π r²), at one or three points of the shooter.

use std::f64::consts::PI;

use glam::DVec3;

/// The three-point rule on a triangle, exact for quadratics (Strang & Fix 1973).
const THREE_POINTS: [[f64; 3]; 3] = [
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// Form factor from a point to a small triangle: the kernel at its centroid times its area.
///
/// Cosines below 0 count as 0. Error about (longest edge / distance)².
#[inline]
#[must_use]
pub fn centroid_kernel(
    point: DVec3,
    normal: DVec3,
    centroid: DVec3,
    shooter_normal: DVec3,
    area: f64,
) -> f64 {
    kernel(point, normal, centroid, shooter_normal) * area
}

/// Form factor from a point to a triangle: the mean of three kernel values times its area.
#[inline]
#[must_use]
pub fn three_point_kernel(
    point: DVec3,
    normal: DVec3,
    corners: [DVec3; 3],
    shooter_normal: DVec3,
    area: f64,
) -> f64 {
    let [a, b, c] = corners;
    let sum: f64 = THREE_POINTS
        .iter()
        .map(|w| kernel(point, normal, a * w[0] + b * w[1] + c * w[2], shooter_normal))
        .sum();
    sum * area / 3.0
}

#[inline]
fn kernel(point: DVec3, normal: DVec3, at: DVec3, at_normal: DVec3) -> f64 {
    let d = at - point;
    let r2 = d.length_squared();
    let cos_cos_r2 = normal.dot(d).max(0.0) * (-at_normal.dot(d)).max(0.0);
    if r2 > 0.0 { cos_cos_r2 / (PI * r2 * r2) } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_far_triangle_matches_the_inverse_square_law() {
        // Two facing pieces at distance 10: F = A / (π·100).
        let area = 1e-4;
        let f = centroid_kernel(DVec3::ZERO, DVec3::Z, DVec3::Z * 10.0, DVec3::NEG_Z, area);
        assert!((f - area / (PI * 100.0)).abs() < 1e-18);
        assert_eq!(centroid_kernel(DVec3::ZERO, DVec3::NEG_Z, DVec3::Z, DVec3::NEG_Z, 1.0), 0.0);
        assert_eq!(centroid_kernel(DVec3::ZERO, DVec3::Z, DVec3::Z, DVec3::Z, 1.0), 0.0);
    }
}
