//! A node: eight boxes side by side, and what is in them.

use super::BOX_PADDING;
use crate::aabb::Aabb;

/// Children per node.
pub(super) const WIDTH: usize = 8;

/// Set in [`Node::children`] when the rest is an index into the blocks rather than the nodes.
pub(super) const LEAF: u32 = 1 << 31;

/// Marks an unused child slot.
pub(super) const NO_CHILD: u32 = u32::MAX;

/// Up to eight children with their boxes, one per lane. Four cache lines.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// By axis, the least and the greatest coordinates. Unused lanes hold an inside-out box.
    pub(super) bounds: [[[f32; WIDTH]; 2]; 3],
    pub(super) children: [u32; WIDTH],
}

/// The least coordinate of an unused lane's box, and the negative of its greatest: farther out
/// than any segment goes, and finite, so that no product with it is NaN.
const NOWHERE: f32 = 4.0;

impl Node {
    pub(super) const EMPTY: Self =
        Self { bounds: [[[NOWHERE; WIDTH], [-NOWHERE; WIDTH]]; 3], children: [NO_CHILD; WIDTH] };

    /// Puts a child in a lane; its box is padded here.
    pub(super) fn set_child(&mut self, lane: usize, child: u32, bounds: &Aabb) {
        let padded = bounds.padded(BOX_PADDING);
        for axis in 0..3 {
            self.bounds[axis][0][lane] = padded.lo[axis];
            self.bounds[axis][1][lane] = padded.hi[axis];
        }
        self.children[lane] = child;
    }

    /// Takes over a child of another node, its box as it is there.
    #[inline]
    pub(super) fn copy_child(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for axis in 0..3 {
            for side in 0..2 {
                self.bounds[axis][side][lane] = from.bounds[axis][side][from_lane];
            }
        }
        self.children[lane] = from.children[from_lane];
    }

    /// The lanes with a child, one bit each.
    #[inline(always)]
    pub(super) fn used(&self) -> u32 {
        let mut used = 0;
        for lane in 0..WIDTH {
            used |= u32::from(self.children[lane] != NO_CHILD) << lane;
        }
        used
    }

    /// The padded box of a lane.
    pub(super) fn child_bounds(&self, lane: usize) -> Aabb {
        let corner = |side: usize| self.bounds.map(|axis| axis[side][lane]).into();
        Aabb { lo: corner(0), hi: corner(1) }
    }
}
