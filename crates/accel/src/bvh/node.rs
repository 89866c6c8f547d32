//! A node: eight boxes side by side, and what is in them.

use super::BOX_PADDING;
use crate::aabb::Aabb;

/// Children per node.
pub(super) const WIDTH: usize = 8;

/// Set in the number of a child that is a block rather than a node.
pub(super) const LEAF: u32 = 1 << 31;

/// Up to eight boxes, one per lane. Unused lanes hold an inside-out box.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Boxes {
    /// By axis, the least and the greatest coordinates.
    pub(super) bounds: [[[f32; WIDTH]; 2]; 3],
}

/// The least coordinate of an unused lane's box, and the negative of its greatest: farther out
/// than any segment goes, and finite, so that no product with it is NaN.
const NOWHERE: f32 = 4.0;

impl Boxes {
    pub(super) const EMPTY: Self = Self { bounds: [[[NOWHERE; WIDTH], [-NOWHERE; WIDTH]]; 3] };

    /// Takes over a box, as it is there.
    #[inline]
    pub(super) fn copy(&mut self, lane: usize, from: &Self, from_lane: usize) {
        for axis in 0..3 {
            for side in 0..2 {
                self.bounds[axis][side][lane] = from.bounds[axis][side][from_lane];
            }
        }
    }

    /// The padded box of a lane.
    pub(super) fn of_lane(&self, lane: usize) -> Aabb {
        let corner = |side: usize| self.bounds.map(|axis| axis[side][lane]).into();
        Aabb { lo: corner(0), hi: corner(1) }
    }
}

/// Up to eight children with their boxes. Four cache lines.
///
/// Nodes come first, then blocks; each kind lies side by side in memory, so that a child's place
/// follows from its lane without another look at memory (example `mrays`: singles 1.02 to 1.07,
/// random segments among a million triangles 1.14).
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    pub(super) boxes: Boxes,
    /// How many of the children are nodes.
    pub(super) inner: u32,
    /// How many children there are.
    count: u32,
    /// The number of the first lane's node.
    pub(super) first_node: u32,
    /// The number of the block that the first lane would have, modulo 2³², if it had one.
    first_block: u32,
}

impl Node {
    pub(super) const EMPTY: Self =
        Self { boxes: Boxes::EMPTY, inner: 0, count: 0, first_node: 0, first_block: 0 };

    /// A node whose first children are `inner` nodes from `first_node` on, and whose others are
    /// blocks from `first_block` on.
    pub(super) fn new(inner: usize, first_node: usize, first_block: usize) -> Self {
        let inner = inner as u32;
        let first_block = (first_block as u32).wrapping_sub(inner);
        Self { inner, first_node: first_node as u32, first_block, ..Self::EMPTY }
    }

    /// Adds the box of the next child; it is padded here.
    pub(super) fn push(&mut self, bounds: &Aabb) {
        let padded = bounds.padded(BOX_PADDING);
        let lane = self.count as usize;
        for axis in 0..3 {
            self.boxes.bounds[axis][0][lane] = padded.lo[axis];
            self.boxes.bounds[axis][1][lane] = padded.hi[axis];
        }
        self.count += 1;
    }

    /// Adds to the numbers of all children.
    pub(super) fn shift(&mut self, nodes: u32, blocks: u32) {
        self.first_node = self.first_node.wrapping_add(nodes);
        self.first_block = self.first_block.wrapping_add(blocks);
    }

    /// The lanes in use.
    pub(super) fn lanes(&self) -> std::ops::Range<usize> {
        0..self.count as usize
    }

    /// The lanes in use, one bit each.
    #[inline(always)]
    pub(super) fn used(&self) -> u32 {
        (1 << self.count) - 1
    }

    /// The block in a lane that has one.
    #[inline(always)]
    pub(super) fn block(&self, lane: usize) -> u32 {
        self.first_block.wrapping_add(lane as u32)
    }

    /// The child in a lane: a node, or with [`LEAF`] a block.
    #[inline(always)]
    pub(super) fn child(&self, lane: usize) -> u32 {
        if (lane as u32) < self.inner {
            self.first_node + lane as u32
        } else {
            self.block(lane) | LEAF
        }
    }
}
