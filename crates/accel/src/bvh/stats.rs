//! What a BVH consists of.

use super::Bvh;
use super::node::Node;
use crate::block::Block;

/// The size and shape of a [`Bvh`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct BvhStats {
    /// Triangles that can block; those with zero area are left out.
    pub triangles: usize,
    /// Inner nodes, of eight children each at most.
    pub nodes: usize,
    /// Leaves, of four triangles each at most.
    pub leaves: usize,
    /// Nodes on the longest way from the root, the root included.
    pub depth: usize,
    /// Heap memory, in bytes.
    pub bytes: usize,
}

impl Bvh {
    /// Counts nodes, leaves and triangles.
    pub fn stats(&self) -> BvhStats {
        BvhStats {
            triangles: self.blocks.iter().map(|block| block.triangles().count()).sum(),
            nodes: self.nodes.len(),
            leaves: self.blocks.len(),
            depth: self.depth,
            bytes: self.bytes(),
        }
    }

    /// Returns the heap memory held, in bytes.
    pub fn bytes(&self) -> usize {
        self.nodes.capacity() * size_of::<Node>() + self.blocks.capacity() * size_of::<Block>()
    }
}
