//! One segment against the eight boxes of a node: the slab test (Kay & Kajiya 1986).

use super::node::Boxes;
use crate::lanes::{Lanes, Simd};
use crate::local::LocalSegment;

/// The parts of a [`LocalSegment`] that the test reads, one copy per lane.
#[derive(Clone, Copy)]
pub(super) struct Slabs<S: Simd> {
    inverse: [S::F8; 3],
    /// The parameter at which the segment's line has coordinate 0.
    offset: [S::F8; 3],
    start: S::F8,
    /// Per axis, which of the bounds (0 least, 1 greatest) the segment meets first.
    near: [usize; 3],
}

impl<S: Simd> Slabs<S> {
    #[inline(always)]
    pub(super) fn of(simd: S, segment: &LocalSegment) -> Self {
        let [ix, iy, iz] = segment.inverse;
        let [ox, oy, oz] = segment.origin;
        let splat = S::F8::splat;
        Self {
            inverse: [splat(simd, ix), splat(simd, iy), splat(simd, iz)],
            offset: [splat(simd, -ox * ix), splat(simd, -oy * iy), splat(simd, -oz * iz)],
            start: splat(simd, 0.0),
            near: [usize::from(ix < 0.0), usize::from(iy < 0.0), usize::from(iz < 0.0)],
        }
    }

    /// Per lane, the parameter at which the segment enters the box, and which boxes it meets up to
    /// `limit`, one bit each: those that it does not leave before it enters them.
    ///
    /// A parameter is b · i − o · i for a face at b, an origin o and a reciprocal direction i. With
    /// e = 2⁻²⁴, the roundings of i, of the two products and of the difference shift the face by
    /// e · (|b − o| + |b| + |o| + |b − o|) < 6.2 e < 2⁻²¹ at most; boxes are padded by more than
    /// that (see `BOX_PADDING`), so the test never misses a box that the segment meets.
    #[inline(always)]
    pub(super) fn span(&self, simd: S, boxes: &Boxes, limit: S::F8) -> (S::F8, u32) {
        let [x, y, z] = self.near;
        let enter_x = self.at(simd, boxes, 0, x);
        let enter_y = self.at(simd, boxes, 1, y);
        let enter_z = self.at(simd, boxes, 2, z);
        let leave_x = self.at(simd, boxes, 0, x ^ 1);
        let leave_y = self.at(simd, boxes, 1, y ^ 1);
        let leave_z = self.at(simd, boxes, 2, z ^ 1);
        // Neither a start below 0 nor an end below 0 need be the right one.
        let enter = enter_x.max_above_0(enter_y).max_above_0(enter_z.max_above_0(self.start));
        let leave = leave_x.min_above_0(leave_y).min_above_0(leave_z.min_above_0(limit));
        (enter, enter.le_above_0(leave))
    }

    #[inline(always)]
    fn at(&self, simd: S, boxes: &Boxes, axis: usize, side: usize) -> S::F8 {
        let face = S::F8::load(simd, &boxes.bounds[axis][side & 1]);
        face.mul_add(self.inverse[axis], self.offset[axis])
    }
}
