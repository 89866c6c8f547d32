//! Segments that end close in front of a triangle: which of them surely do not reach its plane.
//!
//! Receivers lie on triangles, so segments end near those beside them, closer than f32 products of
//! edges tell (see `planes.rs`). f64 products tell, and spare most of these segments the exact test.
//!
//! # Bound
//!
//! With e = 2⁻²⁴; A, B, C the corners less the origin, rounded as the exact test rounds them; M the
//! greatest coordinate among them; d a segment's direction, H its greatest component; N the normal
//! (B − A) × (C − A) and f = N · A. If the exact test accepts, the crossing at its parameter t is a
//! mean of the corners but for the shear's roundings, of at most 3 e M in two components of each
//! corner, and for those of the slopes, 2 e in two components of t d. N · A = N · B = N · C = f, so
//! |f − t N · d| is at most (3 e M + 2 e H) |N|₁ with the sum of components |N|₁. If f and f − N · d
//! are both beyond that on the same side, so is f − t N · d for any t in (0, 1), and the exact test
//! does not accept. Rounding in f64 adds less than 2⁻⁴⁸ times the products of edges and M + H.

use glam::{DVec3, Vec3A};

/// e times 4 and times 3, above 3 and 2 derived above.
const CORNER_ERROR: f64 = 4.0 / (1 << 24) as f64;
const SLOPE_ERROR: f64 = 3.0 / (1 << 24) as f64;

/// For f64 rounding, above 2⁻⁴⁸.
const ROUNDING: f64 = 1.0 / (1_u64 << 46) as f64;

/// The plane of a triangle, seen from an origin.
pub(super) struct Level {
    normal: DVec3,
    /// How far in front of the plane the origin is, in units of the normal.
    front: f64,
    /// The error for a direction is the first plus the second times its greatest component.
    error: [f64; 2],
}

impl Level {
    /// The plane of a triangle whose corners are given less the origin.
    #[inline]
    pub(super) fn of(corners: [Vec3A; 3]) -> Self {
        let [a, b, c] = corners.map(Vec3A::as_dvec3);
        let (ab, ac) = (b - a, c - a);
        let normal = ab.cross(ac);
        let size = |v: DVec3| v.abs().max_element();
        let far = size(a).max(size(b)).max(size(c));
        let sum = normal.abs().element_sum();
        let rounding = ROUNDING * size(ab) * size(ac);
        let error = [(CORNER_ERROR * sum + rounding) * far, SLOPE_ERROR * sum + rounding];
        Self { normal, front: normal.dot(a), error }
    }

    /// Whether the segment in a direction surely stays on the origin's side.
    #[inline]
    pub(super) fn clears(&self, direction: Vec3A) -> bool {
        let direction = direction.as_dvec3();
        let beyond = self.front - self.normal.dot(direction);
        let error = self.error[0] + self.error[1] * direction.abs().max_element();
        self.front.min(beyond) > error || self.front.max(beyond) < -error
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::near_miss::NearMisses;

    #[test]
    fn what_is_cleared_does_not_cross() {
        let (mut cleared, mut crossed) = (0, 0);
        for miss in NearMisses::new().take(200_000) {
            let corners = miss.corners.map(|corner| corner - miss.origin);
            let clears = Level::of(corners).clears(miss.direction);
            let crosses = miss.segment().is_some_and(|s| miss.block().crosses(0, &s));
            assert!(!(clears && crosses), "{miss:?}");
            // Coordinates are below 3 here, so the error is at most 21 e times |N|₁ / |N| ≤ √3.
            assert!(clears || miss.in_front < 3e-6, "{miss:?}");
            cleared += usize::from(clears);
            crossed += usize::from(crosses);
        }
        assert!(crossed > 50_000 && cleared > 50_000, "{crossed} {cleared}");
    }
}
