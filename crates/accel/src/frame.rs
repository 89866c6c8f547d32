//! The local frame: scene positions recentred and scaled in f64, then narrowed to f32.
//!
//! The centre of the bounds moves to the origin and lengths are multiplied by a power of two, so
//! that every coordinate of every triangle lies in [-1, 1] and the largest lies in [0.5, 1] (less in
//! a scene below the normal range of f64). All tolerances of this crate are therefore plain numbers
//! in this frame, a scene far from the origin or in odd units loses nothing, and f32 products cannot
//! overflow. A power of two keeps the scaling free of rounding.

use glam::DVec3;

use crate::Target;
use crate::lanes::Simd;

/// The width of the rounding band in f32 units in the last place of the scene's extent.
///
/// In the local frame (extent in [1, 2]) with u = 2⁻²³: narrowing moves a vertex or an end by at
/// most u/4 and the direction by u; the triangle test moves a vertex by at most 6 u (see
/// `triangle.rs`). 8 u covers the sum.
pub const ROUNDING_BAND_ULPS: f64 = 8.0;

/// Returns the distance below which this crate does not promise the exact answer.
///
/// `extent` is the longest side of the bounds of all triangles. Positions are held as f32 relative
/// to the centre of the bounds, to half a unit in the last place of the extent. An answer equals
/// that of exact arithmetic on the f64 input unless moving the triangles' vertices and the
/// segment's ends by no more than this distance could change it. Within the band the answer is
/// still the same from every structure of this crate, and shared edges still do not leak.
///
/// # Units
/// The result has the unit of `extent`.
///
/// # Examples
/// ```
/// // A hall 100 m long is answered for to a tenth of a millimetre.
/// assert!(accel::rounding_band(100.0) < 1e-4);
/// ```
pub fn rounding_band(extent: f64) -> f64 {
    ROUNDING_BAND_ULPS * f64::from(f32::EPSILON) * extent
}

/// How far beyond the bounds segments are kept, in local units. Segments are cut off there so that
/// no coordinate, and so no rounding error, grows with the distance of an end from the scene. Any
/// value well above the rounding band serves; 1/64 is exact and leaves the octree's root cell
/// tight.
pub(crate) const CLIP_MARGIN: f64 = 1.0 / 64.0;

/// The map from the scene to the local frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    centre: DVec3,
    scale: f64,
    /// Half the sides of the bounds, in local units.
    half: DVec3,
}

impl Frame {
    /// Narrows the triangles that can block; returns them with their indices in the input.
    ///
    /// A triangle is left out when a coordinate is not finite or when its area is exactly zero,
    /// before or after narrowing.
    pub(crate) fn of(triangles: &[[DVec3; 3]]) -> (Self, Vec<LocalTriangle>) {
        assert!(triangles.len() < u32::MAX as usize, "triangle indices are 32 bits wide");
        let blocks = |t: &[DVec3; 3]| t.iter().all(|v| v.is_finite()) && has_area(t);
        let (mut lo, mut hi) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
        for vertex in triangles.iter().filter(|t| blocks(t)).flatten() {
            lo = lo.min(*vertex);
            hi = hi.max(*vertex);
        }
        if lo.x > hi.x {
            return (Self { centre: DVec3::ZERO, scale: 1.0, half: DVec3::ZERO }, Vec::new());
        }
        // Halved before they are combined, because the sum of two huge values overflows.
        let centre = lo * 0.5 + hi * 0.5;
        // From the centre as it is rounded, so that no vertex is farther out.
        let half = (hi - centre).max(centre - lo);
        let scale = 0.5 / power_of_two_below(half.max_element());
        let frame = Self { centre, scale, half: half * scale };
        let mut kept = Vec::with_capacity(triangles.len());
        for (index, triangle) in triangles.iter().enumerate().filter(|(_, t)| blocks(t)) {
            let vertices = triangle.map(|v| frame.local(v).as_vec3().to_array());
            if has_area(&vertices.map(|v| DVec3::from_array(v.map(f64::from)))) {
                kept.push(LocalTriangle { vertices, index: index as u32 });
            }
        }
        (frame, kept)
    }

    #[inline]
    pub(crate) fn local(&self, point: DVec3) -> DVec3 {
        (point - self.centre) * self.scale
    }

    #[inline]
    pub(crate) fn local_direction(&self, direction: DVec3) -> DVec3 {
        direction * self.scale
    }

    /// Half the longest side of the bounds, in local units: in [0.5, 1], or 0 for an empty scene.
    pub(crate) fn half_extent(&self) -> f64 {
        self.half.max_element()
    }

    /// The longest side of the bounds, in scene units.
    pub(crate) fn extent(&self) -> f64 {
        2.0 * self.half_extent() / self.scale
    }

    /// Whether a local point is within the margin around the bounds; false for NaN.
    #[inline]
    pub(crate) fn holds(&self, local: DVec3) -> bool {
        local.abs().cmple(self.half + CLIP_MARGIN).all()
    }

    /// Narrows the local positions of sixteen targets, by axis, and says which of them the frame
    /// holds, one bit each: [`Self::local`] and [`Self::holds`] side by side.
    #[inline(always)]
    pub(crate) fn narrow<S: Simd>(&self, simd: S, targets: &[Target; 16]) -> ([S::F16; 3], u32) {
        simd.narrow(targets, self.centre, self.scale, self.half + CLIP_MARGIN)
    }

    /// The part of [t0, t1] in which `from + t * direction` is within the margin around the bounds
    /// (Cyrus & Beck 1978; Kay & Kajiya 1986); `None` if there is none or a value is not finite.
    pub(crate) fn clip(
        &self,
        from: DVec3,
        direction: DVec3,
        mut t0: f64,
        mut t1: f64,
    ) -> Option<(f64, f64)> {
        if !(from.is_finite() && direction.is_finite()) {
            return None;
        }
        let half = self.half + CLIP_MARGIN;
        for axis in 0..3 {
            if direction[axis] == 0.0 {
                if from[axis].abs() > half[axis] {
                    return None;
                }
                continue;
            }
            let a = (-half[axis] - from[axis]) / direction[axis];
            let b = (half[axis] - from[axis]) / direction[axis];
            t0 = t0.max(a.min(b));
            t1 = t1.min(a.max(b));
        }
        (t0 < t1).then_some((t0, t1))
    }
}

/// A triangle that can block: its narrowed vertices and its index in the input.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalTriangle {
    pub(crate) vertices: [[f32; 3]; 3],
    pub(crate) index: u32,
}

/// Whether the area, as far as f64 can tell, differs from zero.
fn has_area(t: &[DVec3; 3]) -> bool {
    let (e, f) = (t[1] - t[0], t[2] - t[0]);
    // Scaled to about 1, so that a tiny triangle's products do not vanish, and by a power of two,
    // so that products that cancel exactly still do.
    let size = power_of_two_below(e.abs().max(f.abs()).max_element());
    (e / size).cross(f / size) != DVec3::ZERO
}

/// The greatest power of two that does not exceed a positive number; of numbers below the normal
/// range, its least. Half its reciprocal is finite and exact, if not always normal.
fn power_of_two_below(x: f64) -> f64 {
    f64::from_bits(x.max(f64::MIN_POSITIVE).to_bits() & 0x7ff0_0000_0000_0000) // the exponent alone
}
