//! A segment in the local frame, with everything that is computed once per segment.

use glam::{DVec3, Vec3A, Vec4};

use crate::NO_TRIANGLE;
use crate::frame::Frame;

/// Direction components below this are taken as this in the slab tests, so that no reciprocal is
/// infinite and no test meets 0 · ∞. Over a whole segment the change moves a point by at most
/// 1e-20, far below the padding of every box (about 4e-6).
const LEAST_SLOPE: f32 = 1e-20;

/// A segment prepared for the slab tests and the triangle test.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LocalSegment {
    pub(crate) origin: [f32; 3],
    pub(crate) direction: [f32; 3],
    /// Reciprocal direction; finite and not zero.
    pub(crate) inverse: [f32; 3],
    /// The axis along which the direction is longest, and the other two in the cyclic order that
    /// keeps the winding of projected triangles.
    pub(crate) axes: Axes,
    /// The slopes that shear the direction onto the longest axis; within [-1, 1].
    pub(crate) shear: [f32; 2],
    pub(crate) ignore: [u32; 2],
}

#[derive(Clone, Copy, Debug)]
pub(crate) struct Axes {
    pub(crate) x: usize,
    pub(crate) y: usize,
    pub(crate) z: usize,
}

impl LocalSegment {
    /// Prepares the segment between two scene points; `None` if nothing can block it.
    #[inline]
    pub(crate) fn between(frame: &Frame, from: DVec3, to: DVec3, ignore: [u32; 2]) -> Option<Self> {
        Self::from_local(frame, frame.local(from), frame.local(to), ignore)
    }

    /// [`Self::between`] for ends already in the local frame, still in f64.
    #[inline]
    pub(crate) fn from_local(
        frame: &Frame,
        from: DVec3,
        to: DVec3,
        ignore: [u32; 2],
    ) -> Option<Self> {
        if frame.holds(from) && frame.holds(to) {
            return Self::narrowed(from, to, ignore);
        }
        let direction = to - from;
        let (t0, t1) = frame.clip(from, direction, 0.0, 1.0)?;
        let a = if t0 > 0.0 { from + t0 * direction } else { from };
        let b = if t1 < 1.0 { from + t1 * direction } else { to };
        Self::narrowed(a, b, ignore)
    }

    /// Prepares a ray as the segment of it that crosses the scene, with the ray's parameters at
    /// that segment's ends; `None` if the ray meets nothing.
    pub(crate) fn along(
        frame: &Frame,
        origin: DVec3,
        direction: DVec3,
    ) -> Option<(Self, (f64, f64))> {
        let from = frame.local(origin);
        let step = frame.local_direction(direction);
        let (t0, t1) = frame.clip(from, step, 0.0, f64::INFINITY)?;
        if !t1.is_finite() {
            return None; // no direction
        }
        let start = if t0 > 0.0 { from + t0 * step } else { from };
        let segment = Self::narrowed(start, from + t1 * step, [NO_TRIANGLE; 2])?;
        Some((segment, (t0, t1)))
    }

    /// Narrows two points that the frame holds; `None` if they become one.
    #[inline]
    pub(crate) fn narrowed(from: DVec3, to: DVec3, ignore: [u32; 2]) -> Option<Self> {
        let origin = Vec3A::from(from.as_vec3());
        let direction = Vec3A::from(to.as_vec3()) - origin;
        let d = direction.to_array();
        let size = direction.abs().to_array();
        let z = if size[0] > size[1] {
            if size[0] > size[2] { 0 } else { 2 }
        } else if size[1] > size[2] {
            1
        } else {
            2
        };
        if size[z] == 0.0 {
            return None;
        }
        const NEXT: [usize; 3] = [1, 2, 0];
        let (mut x, mut y) = (NEXT[z], NEXT[NEXT[z]]);
        if d[z] < 0.0 {
            (x, y) = (y, x); // looking the other way along z mirrors the plane: mirror it back
        }
        let least = Vec3A::splat(LEAST_SLOPE).copysign(direction);
        let slope =
            Vec3A::select(direction.abs().cmplt(Vec3A::splat(LEAST_SLOPE)), least, direction);
        let inverse = slope.recip().to_array();
        let reciprocal = 1.0 / d[z];
        Some(Self {
            origin: origin.to_array(),
            direction: d,
            inverse,
            axes: Axes { x, y, z },
            shear: [d[x] * reciprocal, d[y] * reciprocal],
            ignore,
        })
    }

    #[inline]
    pub(crate) fn ignores(&self, triangle: u32) -> bool {
        self.ignore[0] == triangle || self.ignore[1] == triangle
    }
}

/// The parts of a [`LocalSegment`] that four-wide box tests read, one copy per lane.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slabs {
    pub(crate) origin: [Vec4; 3],
    pub(crate) inverse: [Vec4; 3],
    /// Per axis, which of the bounds (0 least, 1 greatest) the segment meets first.
    pub(crate) near: [usize; 3],
}

impl Slabs {
    #[inline]
    pub(crate) fn of(segment: &LocalSegment) -> Self {
        Self {
            origin: segment.origin.map(Vec4::splat),
            inverse: segment.inverse.map(Vec4::splat),
            near: segment.inverse.map(|slope| usize::from(slope < 0.0)),
        }
    }

    /// Per lane, the parameters between which the segment's line is in the box, cut to [0, limit]:
    /// the lane's box is met if the first does not exceed the second.
    ///
    /// Each product has a relative error below 3 · 2⁻²⁴, which is a shift of the box face of at
    /// most 2.1 · 3 · 2⁻²⁴ < 2⁻²¹; boxes are padded by more than that (see `BOX_PADDING`), so the
    /// test never misses a box that the segment meets.
    #[inline(always)]
    pub(crate) fn span(&self, bounds: &[[Vec4; 3]; 2], limit: f32) -> (Vec4, Vec4) {
        let at = |side: usize, axis: usize| {
            (bounds[side & 1][axis] - self.origin[axis]) * self.inverse[axis]
        };
        let [x, y, z] = self.near;
        let enter = at(x, 0).max(at(y, 1)).max(at(z, 2).max(Vec4::ZERO));
        let leave = at(x ^ 1, 0).min(at(y ^ 1, 1)).min(at(z ^ 1, 2).min(Vec4::splat(limit)));
        (enter, leave)
    }
}
