//! Every triangle against every segment, by the exact test alone: the reference that structures are
//! held to.

use glam::DVec3;

use crate::block::{Block, LANES};
use crate::frame::Frame;
use crate::local::LocalSegment;
use crate::{Hit, Occluder, Segment};

/// How to build [`BruteForce`]: there is nothing to choose.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct BruteForceConfig {}

/// Tests every triangle.
///
/// It has no traversal that could go wrong and takes no answer from f32, so it says what
/// [`crate::Bvh`] and [`crate::Octree`] must say.
#[derive(Clone, Debug)]
pub struct BruteForce {
    frame: Frame,
    blocks: Vec<Block>,
}

impl BruteForce {
    /// Stores `triangles`; indices in answers are positions in this slice.
    ///
    /// Triangles with zero area or a coordinate that is not finite never block.
    ///
    /// # Panics
    /// Panics if there are 2³² − 1 triangles or more.
    pub fn build(triangles: &[[DVec3; 3]], _config: &BruteForceConfig) -> Self {
        let (frame, kept) = Frame::of(triangles);
        Self { frame, blocks: kept.chunks(LANES).map(Block::of).collect() }
    }

    /// Returns the first triangle that the ray meets at a parameter above 0, of several at the
    /// same parameter the one with the least index.
    ///
    /// The parameter is in lengths of `direction`, which need not be 1. A ray that is not finite
    /// or has no direction meets nothing.
    pub fn nearest(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let (segment, span) = LocalSegment::along(&self.frame, origin, direction)?;
        let mut best = Hit::NONE;
        for block in &self.blocks {
            for (triangle, crossing) in block.crossings(&segment) {
                best.improve(triangle, &crossing);
            }
        }
        best.finish(span)
    }

    /// Returns the heap memory held, in bytes.
    pub fn bytes(&self) -> usize {
        self.blocks.capacity() * size_of::<Block>()
    }

    /// Returns the longest side of the bounds of the triangles, in scene units: the argument for
    /// [`crate::rounding_band`].
    pub fn extent(&self) -> f64 {
        self.frame.extent()
    }
}

impl Occluder for BruteForce {
    fn occluded(&self, segment: &Segment) -> bool {
        LocalSegment::between(&self.frame, segment.from, segment.to, segment.ignore)
            .is_some_and(|local| self.blocks.iter().any(|block| block.crosses_any(&local)))
    }
}
