//! A segment in the local frame, with everything that is computed once per segment.

use glam::{DVec3, Vec3A};

use crate::NO_TRIANGLE;
use crate::frame::Frame;

/// Direction components below this are taken as this in the slab tests, so that no reciprocal is
/// infinite and no test meets 0 · ∞. Over a whole segment the change moves a point by at most
/// 1e-20, far below the padding of every box (about 4e-6).
pub(crate) const LEAST_SLOPE: f32 = 1e-20;

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
    #[inline(always)]
    pub(crate) fn between(frame: &Frame, from: DVec3, to: DVec3, ignore: [u32; 2]) -> Option<Self> {
        Self::from_local(frame, frame.local(from), frame.local(to), ignore)
    }

    /// [`Self::between`] for ends already in the local frame, still in f64.
    #[inline(always)]
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
    #[inline(always)]
    pub(crate) fn narrowed(from: DVec3, to: DVec3, ignore: [u32; 2]) -> Option<Self> {
        let origin = Vec3A::from(from.as_vec3());
        Self::of(origin, Vec3A::from(to.as_vec3()) - origin, ignore)
    }

    /// Prepares a segment from its narrowed start and the difference of its narrowed ends.
    #[inline(always)]
    pub(crate) fn of(origin: Vec3A, direction: Vec3A, ignore: [u32; 2]) -> Option<Self> {
        let d = direction.to_array();
        let size = direction.abs().to_array();
        // The longest axis, of equals the last; sums, because branches would be guesses.
        let y_or_x = usize::from(size[1] >= size[0]);
        let z = y_or_x + (2 - y_or_x) * usize::from(size[2] >= size[0].max(size[1]));
        if size[z] == 0.0 {
            return None;
        }
        // The other two in cyclic order; looking the other way along z mirrors the plane, and
        // taking them the other way round mirrors it back.
        const OTHERS: [[[usize; 2]; 2]; 3] = [[[1, 2], [2, 1]], [[2, 0], [0, 2]], [[0, 1], [1, 0]]];
        let [x, y] = OTHERS[z][usize::from(d[z] < 0.0)];
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
