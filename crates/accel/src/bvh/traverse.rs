//! Whether a segment meets any triangle: depth-first, in no particular order.

use glam::DVec3;

use super::build::MAX_DEPTH;
use super::{Bvh, LEAF, WIDTH};
use crate::batch::with_last_blocker;
use crate::local::{LocalSegment, Slabs};
use crate::{Occluder, Segment, Target};

/// Nodes waiting at any time: each level leaves at most three behind.
pub(super) const STACK: usize = (WIDTH - 1) * MAX_DEPTH + WIDTH;

impl Bvh {
    /// The block in which a triangle blocks the segment.
    #[inline]
    fn blocking_block(&self, segment: &LocalSegment) -> Option<usize> {
        if self.nodes.is_empty() {
            return None;
        }
        let slabs = Slabs::of(segment);
        let mut stack = [0_u32; STACK];
        let mut waiting = 1; // the root
        while waiting > 0 {
            waiting -= 1;
            let child = stack[waiting];
            if child & LEAF != 0 {
                let block = (child & !LEAF) as usize;
                if self.blocks[block].blocks(segment) {
                    return Some(block);
                }
                continue;
            }
            let node = &self.nodes[child as usize];
            let (enter, leave) = slabs.span(&node.bounds, 1.0);
            let mut met = enter.cmple(leave).bitmask();
            while met != 0 {
                let lane = met.trailing_zeros() as usize;
                met &= met - 1;
                stack[waiting] = node.children[lane];
                waiting += 1;
            }
        }
        None
    }
}

impl Occluder for Bvh {
    fn occluded(&self, segment: &Segment) -> bool {
        LocalSegment::between(&self.frame, segment.from, segment.to, segment.ignore)
            .is_some_and(|local| self.blocking_block(&local).is_some())
    }

    fn occluded_batch(&self, from: DVec3, ignore: u32, targets: &[Target], blocked: &mut [bool]) {
        with_last_blocker(
            &self.frame,
            (from, ignore),
            targets,
            blocked,
            |local, block: usize| self.blocks[block].blocks(local),
            |local| self.blocking_block(local),
        );
    }
}
