//! Where in its input triangle a vertex of the refined mesh lies.

use glam::DVec3;

/// Barycentric shares smaller than this are those of a vertex on an edge, whose third share is
/// only rounding: f64 geometry is good to some 1e-13 of a triangle after a few splits.
const ON_EDGE: f64 = 1e-10;

/// The shares of the three corners in a point of their plane: at least 0, and 1 together. A point
/// on a corner has exactly that corner's.
pub(super) fn shares([a, b, c]: [DVec3; 3], point: DVec3) -> [f64; 3] {
    if let Some(corner) = [a, b, c].iter().position(|corner| *corner == point) {
        return std::array::from_fn(|i| f64::from(u8::from(i == corner)));
    }
    let normal = (b - a).cross(c - a);
    let area = normal.length_squared();
    let share = |from: DVec3, to: DVec3| {
        let share = (to - from).cross(point - from).dot(normal) / area;
        // Not a number where the triangle has no area, and then any corner will do.
        if share > ON_EDGE { share } else { 0.0 }
    };
    let shares = [share(b, c), share(c, a), share(a, b)];
    let sum: f64 = shares.iter().sum();
    if sum > 0.0 && sum.is_finite() { shares.map(|share| share / sum) } else { [1.0, 0.0, 0.0] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_rebuild_the_point() {
        let corners = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(4.0, 2.5, 3.0), DVec3::Y];
        assert_eq!(shares(corners, corners[1]), [0.0, 1.0, 0.0]);
        let middle = 0.5 * (corners[0] + corners[2]);
        assert_eq!(shares(corners, middle), [0.5, 0.0, 0.5]);
        let inside = 0.2 * corners[0] + 0.3 * corners[1] + 0.5 * corners[2];
        let found = shares(corners, inside);
        assert!(found.iter().zip([0.2, 0.3, 0.5]).all(|(a, b)| (a - b).abs() < 1e-15), "{found:?}");
        assert_eq!(shares([DVec3::X; 3], DVec3::Y), [1.0, 0.0, 0.0]);
    }
}
