//! Sixteen segments from one origin against the boxes of a node.
//!
//! The packet's beam is tested against the eight boxes at once, and each box that it meets against
//! the sixteen segments at once.

use super::beam::{Beam, Extremes};
use super::node::Boxes;
use super::planes::Rays;
use crate::lanes::{Lanes, Simd};
use crate::local::LEAST_SLOPE;

/// What the tests of one packet need.
pub(super) struct BoxTest<S: Simd> {
    /// Made when it is first asked for; `None` in it if the segments are too far apart.
    beam: Option<Option<Beam<S>>>,
    /// Reciprocal directions, and the parameters at which coordinates are 0: see `slabs.rs`.
    inverse: [S::F16; 3],
    offset: [S::F16; 3],
}

impl<S: Simd> BoxTest<S> {
    #[inline(always)]
    pub(super) fn of(simd: S, origin: [f32; 3], rays: &Rays<S>) -> Self {
        let (mut inverse, mut offset) = (rays.direction, rays.direction);
        let (one, least) = (S::F16::splat(simd, 1.0), S::F16::splat(simd, LEAST_SLOPE));
        let mut axis = 0;
        while axis < 3 {
            let direction = rays.direction[axis];
            let slope = direction.abs().max(least).copysign(direction);
            inverse[axis] = one.div(slope);
            offset[axis] = inverse[axis].mul(S::F16::splat(simd, -origin[axis]));
            axis += 1;
        }
        Self { beam: None, inverse, offset }
    }

    /// Of the boxes in use, one bit each, those that some segment may meet.
    #[inline(always)]
    pub(super) fn near(
        &mut self,
        simd: S,
        origin: [f32; 3],
        rays: &Rays<S>,
        (boxes, used): (&Boxes, u32),
    ) -> u32 {
        if self.beam.is_none() {
            self.beam = Some(beam(simd, origin, rays));
        }
        match &self.beam {
            Some(Some(beam)) => beam.meets(simd, boxes),
            _ => used,
        }
    }

    /// The segments that meet the box in a lane, one bit each; the slab test of `slabs.rs`.
    #[inline(always)]
    pub(super) fn meeting(&self, simd: S, boxes: &Boxes, lane: usize) -> u32 {
        let mut enter = S::F16::splat(simd, 0.0);
        let mut leave = S::F16::splat(simd, 1.0);
        let mut axis = 0;
        while axis < 3 {
            let (inverse, offset) = (self.inverse[axis], self.offset[axis]);
            let [lo, hi] = &boxes.bounds[axis];
            let a = S::F16::splat(simd, lo[lane]).mul_add(inverse, offset);
            let b = S::F16::splat(simd, hi[lane]).mul_add(inverse, offset);
            enter = enter.max_above_0(a.min_above_0(b));
            leave = leave.min_above_0(a.max_above_0(b));
            axis += 1;
        }
        enter.le_above_0(leave)
    }
}

#[inline(always)]
fn beam<S: Simd>(simd: S, origin: [f32; 3], rays: &Rays<S>) -> Option<Beam<S>> {
    let [x, y, z] = rays.direction;
    let ends = Extremes {
        lo: [x.least(), y.least(), z.least()],
        hi: [x.greatest(), y.greatest(), z.greatest()],
    };
    let axis = ends.axis()?;
    let along = rays.direction[axis];
    let u = rays.direction[(axis + 1) % 3].div(along);
    let v = rays.direction[(axis + 2) % 3].div(along);
    let slopes = ([u.least(), v.least()], [u.greatest(), v.greatest()]);
    Beam::new(simd, origin, axis, slopes, &ends)
}
