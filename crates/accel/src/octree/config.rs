//! How an octree is built.

/// What the build of an [`crate::Octree`] may choose; no choice changes an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OctreeConfig {
    /// Halvings of the root cell, at most; clamped to 16 so that cell faces stay exact in f32.
    pub max_depth: u32,
    /// Cells with this many triangles or fewer are not split.
    pub leaf_size: usize,
    /// Bound on the length of all leaf lists together, per triangle. A cell that would exceed it
    /// stays a leaf, however long its list.
    pub max_references: usize,
}

impl OctreeConfig {
    /// Found with the binary `occlusion-bench` on room, hall and church (2026-11-23): since blocks
    /// have boxes, long lists are cheap. Lists of 12 are a third slower and take twice the memory;
    /// 32 and 64 are within a twentieth.
    pub const DEFAULT: Self = Self { max_depth: 10, leaf_size: 48, max_references: 24 };
}

impl Default for OctreeConfig {
    fn default() -> Self {
        Self::DEFAULT
    }
}
