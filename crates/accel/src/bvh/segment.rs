//! Whether a segment meets any triangle: depth-first, in no particular order.

use super::Bvh;
use super::build::MAX_DEPTH;
use super::slabs::Slabs;
use crate::Segment;
use crate::lanes::{Kernel, Lanes, Simd};
use crate::local::LocalSegment;

/// Asks whether a segment meets any triangle.
pub(super) struct Blocked<'a> {
    pub(super) bvh: &'a Bvh,
    pub(super) segment: &'a Segment,
}

impl Kernel for Blocked<'_> {
    type Output = bool;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> bool {
        let Segment { from, to, ignore } = *self.segment;
        match LocalSegment::between(&self.bvh.frame, from, to, ignore) {
            Some(segment) => blocked(simd, self.bvh, &segment),
            None => false,
        }
    }
}

/// The kernel itself, for other kernels to call.
#[inline(always)]
pub(super) fn blocked<S: Simd>(simd: S, bvh: &Bvh, segment: &LocalSegment) -> bool {
    !bvh.nodes.is_empty() && blocking(simd, bvh, segment, 0).is_some()
}

/// A triangle below a node that blocks the segment, by block and lane.
#[inline(always)]
pub(super) fn blocking<S: Simd>(
    simd: S,
    bvh: &Bvh,
    segment: &LocalSegment,
    below: u32,
) -> Option<(u32, usize)> {
    let slabs = Slabs::of(simd, segment);
    let end = S::F8::splat(simd, 1.0);
    // Nodes with children still to visit, and which.
    let mut stack = [(0_u32, 0_u32); MAX_DEPTH];
    let mut depth = 0;
    let mut current = below;
    loop {
        let mut node = &bvh.nodes[current as usize];
        let (_, mut met) = slabs.span(simd, &node.boxes, end);
        loop {
            while met == 0 {
                if depth == 0 {
                    return None;
                }
                depth -= 1;
                (current, met) = stack[depth];
                node = &bvh.nodes[current as usize];
            }
            let lane = met.trailing_zeros();
            met &= met - 1;
            if lane < node.inner {
                if met != 0 {
                    stack[depth] = (current, met);
                    depth += 1;
                }
                current = node.first_node + lane;
                break;
            }
            let block = node.block(lane as usize);
            if let Some(lane) = bvh.blocks[block as usize].blocking(segment) {
                return Some((block, lane));
            }
        }
    }
}
