//! A convex planar polygon, checked once.

use glam::DVec3;

use crate::corners::Corners;

/// How far a corner may lie from the polygon's plane, and how far a polygon may be dented, in
/// longest edges: corners that were rounded to f32 pass, real dents do not.
pub const FLAT: f64 = 1e-6;

/// A convex planar polygon whose front is the side from which its corners run
/// counter-clockwise.
///
/// # Units
/// Any length; between 1e-150 and 1e150 of them across.
///
/// # Examples
/// ```
/// use form_factor::Polygon;
/// use glam::DVec3;
///
/// let square = Polygon::new(&[DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y]).unwrap();
/// assert_eq!((square.normal(), square.area()), (DVec3::Z, 1.0));
/// assert!(Polygon::triangle([DVec3::ZERO, DVec3::X, DVec3::X * 2.0]).is_none());
/// ```
#[derive(Clone, Debug)]
pub struct Polygon {
    corners: Corners,
    normal: DVec3,
    /// A power of two near the longest edge.
    unit: f64,
    /// In units squared: never out of the range of numbers.
    unit_area: f64,
    /// The centre of area, from the first corner.
    centre: DVec3,
    /// From the centre to the farthest corner.
    radius: f64,
}

impl Polygon {
    /// Makes a polygon of `corners`, or `None` where there is no convex planar polygon: fewer
    /// than three distinct corners, no area, a coordinate that is not finite, or a corner that
    /// is out of plane or dents the rim by more than [`FLAT`] longest edges.
    #[must_use]
    pub fn new(corners: &[DVec3]) -> Option<Self> {
        let mut distinct = Corners::new();
        for &corner in corners {
            if distinct.last() != Some(&corner) {
                distinct.push(corner);
            }
        }
        if distinct.len() > 1 && distinct.first() == distinct.last() {
            distinct = distinct[..distinct.len() - 1].iter().copied().collect();
        }
        let polygon = Self::measured(distinct)?;
        (polygon.corners.len() == 3 || polygon.is_convex_and_flat()).then_some(polygon)
    }

    /// Makes a triangle; `None` if it has no area or a corner is not finite. Allocates nothing.
    #[must_use]
    pub fn triangle(corners: [DVec3; 3]) -> Option<Self> {
        Self::measured(corners.into_iter().collect())
    }

    /// The corners, counter-clockwise seen from the front.
    #[must_use]
    pub fn corners(&self) -> &[DVec3] {
        &self.corners
    }

    /// The direction of length 1 to which the front faces.
    #[must_use]
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// The area.
    #[must_use]
    pub fn area(&self) -> f64 {
        self.unit_area * self.unit * self.unit
    }

    /// A part of a polygon with this normal, which is surer than that of the part.
    pub(crate) fn part(corners: Corners, normal: DVec3) -> Option<Self> {
        Self::measured(corners).map(|part| Self { normal, ..part })
    }

    pub(crate) fn unit(&self) -> f64 {
        self.unit
    }

    /// The area over the square of `unit`.
    pub(crate) fn area_in(&self, unit: f64) -> f64 {
        let ratio = self.unit / unit;
        self.unit_area * ratio * ratio
    }

    /// The centre of area, from the first corner.
    pub(crate) fn centre(&self) -> DVec3 {
        self.centre
    }

    pub(crate) fn radius(&self) -> f64 {
        self.radius
    }

    fn measured(corners: Corners) -> Option<Self> {
        let [first, second, ..] = corners[..] else { return None };
        let mut longest = (second - first).abs().max_element();
        for i in 1..corners.len() {
            let edge = corners[(i + 1) % corners.len()] - corners[i];
            longest = longest.max(edge.abs().max_element());
        }
        if !corners.iter().all(|corner| corner.is_finite()) || !longest.is_normal() {
            return None;
        }
        let unit = binade(longest);
        let scale = 1.0 / unit;
        let (mut twice, mut moment) = (DVec3::ZERO, DVec3::ZERO);
        for i in 2..corners.len() {
            let [p, q] = [corners[i - 1], corners[i]].map(|corner| (corner - first) * scale);
            let cross = p.cross(q);
            twice += cross;
            // Fans of a convex polygon turn one way, so lengths weigh as areas do.
            moment += (p + q) * cross.length();
        }
        let length = twice.length();
        let (unit_area, normal) = (length / 2.0, twice / length);
        if !(unit_area * unit * unit).is_normal() || !normal.is_finite() {
            return None;
        }
        let centre = moment / (3.0 * length) * unit;
        let radius2 = corners
            .iter()
            .map(|&corner| ((corner - first - centre) * scale).length_squared())
            .fold(0.0, f64::max);
        let radius = radius2.sqrt() * unit;
        Some(Self { corners, normal, unit, unit_area, centre, radius })
    }

    fn is_convex_and_flat(&self) -> bool {
        let n = self.corners.len();
        let edge = |i: usize| (self.corners[(i + 1) % n] - self.corners[i % n]) / self.unit;
        let mut turned = 0.0;
        for i in 0..n {
            let (before, after) = (edge(i), edge(i + 1));
            let height = (self.corners[i] - self.corners[0]).dot(self.normal) / self.unit;
            let cross = before.cross(after).dot(self.normal);
            let shorter = before.length_squared().min(after.length_squared()).sqrt();
            if height.abs() > FLAT || cross < -FLAT * shorter {
                return false;
            }
            turned += cross.atan2(before.dot(after));
        }
        // A star turns left at each corner, too, but more than once around.
        turned < 3.0 * std::f64::consts::PI
    }
}

/// The largest power of two that is not above `x`, for positive normal `x`.
pub(crate) fn binade(x: f64) -> f64 {
    f64::from_bits(x.to_bits() & (0x7ff << 52))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn polygon(points: &[[f64; 3]]) -> Option<Polygon> {
        Polygon::new(&points.iter().copied().map(DVec3::from).collect::<Vec<_>>())
    }

    #[test]
    fn what_is_no_convex_polygon_is_refused() {
        let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
        assert!(polygon(&square).is_some());
        assert!(polygon(&square[..2]).is_none());
        assert!(polygon(&[square[0], square[1], square[0], square[1]]).is_none());
        assert!(polygon(&[square[0], square[1], [2.0, 0.0, 0.0]]).is_none(), "no area");
        assert!(polygon(&[square[0], square[1], [f64::NAN, 1.0, 0.0]]).is_none());
        assert!(polygon(&[square[0], square[1], [f64::INFINITY, 1.0, 0.0]]).is_none());
        assert!(polygon(&[square[0], square[1], [1.0, 1.0, 0.1], square[3]]).is_none(), "bent");
        assert!(polygon(&[square[0], square[1], [0.2, 0.2, 0.0], square[3]]).is_none(), "dented");
        assert!(polygon(&[square[0], square[2], square[1], square[3]]).is_none(), "crossed");
        let star: Vec<[f64; 3]> = (0..5)
            .map(|i| (f64::from(i) * 0.8 * std::f64::consts::PI).sin_cos())
            .map(|(y, x)| [x, y, 0.0])
            .collect();
        assert!(polygon(&star).is_none(), "a star");
        assert!(polygon(&[[0.0; 3], [1e-320, 0.0, 0.0], [0.0, 1e-320, 0.0]]).is_none());
    }

    #[test]
    fn what_repeats_or_lies_straight_is_kept() {
        let repeated = polygon(&[[0.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0; 3]]);
        assert_eq!(repeated.unwrap().corners().len(), 3);
        let straight = polygon(&[[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]]);
        assert_eq!(straight.unwrap().area(), 2.0);
    }

    #[test]
    fn measures_hold_at_any_size() {
        for size in [1e-110, 1e-80, 1.0, 1e80, 1e110] {
            let corners =
                [[0.0; 3], [3.0, 0.0, 0.0], [0.0, 0.0, 4.0]].map(|c| DVec3::from(c) * size);
            let triangle = Polygon::triangle(corners).unwrap();
            assert_eq!(triangle.normal(), DVec3::NEG_Y);
            assert!((triangle.area() / (6.0 * size) / size - 1.0).abs() < 1e-15);
            let centre = (corners[1] + corners[2]) / 3.0;
            assert!((triangle.centre() - centre).length() <= 1e-15 * size);
            assert!((triangle.radius() / (corners[2] - centre).abs().max_element() - 1.0) < 1.0);
        }
    }
}
