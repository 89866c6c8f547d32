//! Triangles without area.

use glam::DVec3;

/// Smallest ratio of altitude to longest edge that counts as area. Decimal coordinates
/// carry a relative error near 1e-16, so three points written on one line, a million
/// edge lengths from the origin, come out with a ratio near 1e-10; real slivers are
/// orders of magnitude above.
const MIN_ALTITUDE_RATIO: f64 = 1e-10;

/// Whether the triangle is a line or a point.
pub(super) fn is_degenerate([a, b, c]: [DVec3; 3]) -> bool {
    let longest_squared =
        a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    let double_area = (b - a).cross(c - a).length();
    // Where the products overflow, the area is no number to work with either.
    !double_area.is_finite() || double_area <= MIN_ALTITUDE_RATIO * longest_squared
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_is_judged_against_the_longest_edge_alone() {
        let triangle = |height: f64, scale: f64, offset: f64| {
            let at = |x: f64, y: f64| DVec3::new(x, y, 0.0) * scale + DVec3::splat(offset);
            [at(0.0, 0.0), at(1.0, 0.0), at(0.3, height)]
        };
        for scale in [1e-9, 1.0, 1e9] {
            assert!(is_degenerate(triangle(0.0, scale, 0.0)));
            assert!(!is_degenerate(triangle(1e-6, scale, 0.0)));
        }
        // In the same place three times, and on one line far away.
        assert!(is_degenerate([DVec3::splat(0.1); 3]));
        assert!(is_degenerate(triangle(0.0, 1.0, 123_456.7)));
        // A thin sliver far away is still a triangle.
        assert!(!is_degenerate(triangle(1e-6, 1.0, 123_456.7)));
    }
}
