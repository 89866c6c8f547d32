//! The triangles of a leaf: groups of four blocks of four, each block with the box that a segment
//! must meet.
//!
//! Blocks hold copies of the vertices, because gathering them through a list at every question is
//! slow (`docs/performance/techniques.md`).

use glam::Vec3A;

use super::boxes::{Boxes, FOUR};
use super::{CELL_PADDING, Cell, Octree};
use crate::aabb::Aabb;
use crate::block::{Block, LANES};
use crate::local::LocalSegment;

/// Up to four blocks of a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Group {
    /// Bounds of what each block's triangles have inside the leaf, grown by [`CELL_PADDING`].
    ///
    /// A crossing that is to be found in this leaf lies within that distance of the leaf and of its
    /// triangle (see `dda.rs`), hence in the box. Its slab test errs by less than e of `dda.rs`,
    /// since it computes the same expressions, and the padding is four times that.
    pub(super) boxes: Boxes,
    /// Where the blocks start.
    pub(super) first: u32,
}

impl Group {
    /// The block in which a triangle that the segment does not ignore crosses it, among those
    /// marked.
    #[inline(always)]
    pub(super) fn blocking(
        &self,
        octree: &Octree,
        path: &Path,
        segment: &LocalSegment,
        marked: u32,
    ) -> Option<u32> {
        let mut met = self.boxes.met_by(path) & marked;
        while met != 0 {
            let block = self.first + met.trailing_zeros();
            met &= met - 1;
            if octree.crosses(block, segment) {
                return Some(block);
            }
        }
        None
    }
}

impl Octree {
    /// Adds a leaf's triangles.
    pub(super) fn pack(&mut self, list: &[u32], cell: &Aabb) -> Cell {
        let first = self.groups.len() as u32;
        let padding = CELL_PADDING as f32;
        let cell = cell.padded(padding);
        for sixteen in list.chunks(FOUR * LANES) {
            let first = self.blocks.len() as u32;
            let mut boxes = Vec::with_capacity(FOUR);
            for four in sixteen.chunks(LANES) {
                // The first fills the gaps.
                let at = |lane: usize| *four.get(lane).unwrap_or(&four[0]);
                self.blocks.push(Block::gather(&self.triangles, [at(0), at(1), at(2), at(3)]));
                let mut bounds = Aabb::EMPTY;
                for &position in four {
                    bounds.join(&Aabb::of_triangle(&self.triangles[position as usize].vertices));
                }
                let bounds = bounds.padded(padding);
                boxes.push(Aabb { lo: bounds.lo.max(cell.lo), hi: bounds.hi.min(cell.hi) });
            }
            self.groups.push(Group { boxes: Boxes::of(&boxes), first });
        }
        Cell { first, count: list.len() as u32 }
    }

    /// The blocks of a leaf.
    #[inline(always)]
    pub(super) fn groups(&self, leaf: Cell) -> &[Group] {
        let count = (leaf.count as usize).div_ceil(FOUR * LANES);
        &self.groups[leaf.first as usize..][..count]
    }

    /// Whether a triangle of a block that the segment does not ignore crosses it.
    #[inline(always)]
    pub(super) fn crosses(&self, block: u32, segment: &LocalSegment) -> bool {
        self.blocks[block as usize].crossings(segment).next().is_some()
    }

    /// The indices in the input of a leaf's triangles.
    pub(super) fn list(&self, leaf: Cell) -> impl Iterator<Item = u32> {
        let groups = self.groups(leaf).iter();
        let blocks = groups.flat_map(|group| self.blocks[group.first as usize..].iter().take(FOUR));
        blocks.flat_map(|block| block.indices).take(leaf.count as usize)
    }
}

/// A segment as walk and boxes see it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    pub(super) origin: Vec3A,
    pub(super) direction: Vec3A,
    pub(super) inverse: Vec3A,
}

impl Path {
    pub(super) const NONE: Self =
        Self { origin: Vec3A::ZERO, direction: Vec3A::ZERO, inverse: Vec3A::ZERO };

    #[inline(always)]
    pub(super) fn of(segment: &LocalSegment) -> Self {
        Self {
            origin: segment.origin.into(),
            direction: segment.direction.into(),
            inverse: segment.inverse.into(),
        }
    }
}
