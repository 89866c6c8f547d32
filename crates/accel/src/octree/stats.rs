//! What an octree consists of.

use super::boxes::Boxes;
use super::leaf::Group;
use super::{Cell, INNER, Octree};
use crate::block::Block;
use crate::frame::LocalTriangle;

/// The size and shape of an [`Octree`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct OctreeStats {
    /// Triangles that can block; those with zero area are left out.
    pub triangles: usize,
    /// Cells with children.
    pub inner: usize,
    /// Cells without children.
    pub leaves: usize,
    /// Leaves without triangles.
    pub empty_leaves: usize,
    /// Length of all leaf lists together.
    pub references: usize,
    /// Length of the longest leaf list.
    pub longest_list: usize,
    /// Halvings of the root cell in the deepest leaf.
    pub depth: u32,
    /// Heap memory, in bytes.
    pub bytes: usize,
}

impl Octree {
    /// Counts cells, list entries and triangles.
    pub fn stats(&self) -> OctreeStats {
        let inner = self.cells.iter().filter(|cell| cell.count == INNER).count();
        let leaves = || self.cells.iter().map(|cell| cell.count).filter(|&count| count != INNER);
        OctreeStats {
            triangles: self.triangles.len(),
            inner,
            leaves: leaves().count(),
            empty_leaves: leaves().filter(|&count| count == 0).count(),
            references: leaves().map(|count| count as usize).sum(),
            longest_list: leaves().max().unwrap_or(0) as usize,
            depth: self.depth,
            bytes: self.bytes(),
        }
    }

    /// Returns the heap memory held, in bytes.
    pub fn bytes(&self) -> usize {
        self.cells.capacity() * size_of::<Cell>()
            + self.boxes.capacity() * size_of::<[Boxes; 2]>()
            + self.groups.capacity() * size_of::<Group>()
            + self.blocks.capacity() * size_of::<Block>()
            + self.triangles.capacity() * size_of::<LocalTriangle>()
    }
}
