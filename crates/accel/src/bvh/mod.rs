//! Bounding volume hierarchy: four boxes to a node, four triangles to a leaf.
//!
//! Built by binned SAH (Wald 2007) straight into four-wide nodes; memory is bounded by the number
//! of triangles alone. The default choice for any scene that is not convex.

mod build;
mod config;
mod nearest;
mod split;
mod stats;
mod traverse;
mod validate;

pub use config::BvhConfig;
pub use stats::BvhStats;

use glam::{DVec3, Vec4};

use crate::block::Block;
use crate::frame::Frame;
use crate::triangle::HIT_ERROR;

/// How far each box is grown beyond its triangles, in local units.
///
/// A box must be met by every segment that the triangle test accepts: such a segment passes within
/// [`HIT_ERROR`] of the triangle, and the slab test errs by less than half of that
/// (see `Slabs::span`), as does rounding the grown corner. Four times [`HIT_ERROR`] is ample and
/// still far below any visible size.
pub(crate) const BOX_PADDING: f32 = 4.0 * HIT_ERROR;

/// Children per node.
const WIDTH: usize = 4;

/// Set in [`Node::children`] when the rest is an index into `blocks` rather than `nodes`.
const LEAF: u32 = 1 << 31;

/// Marks an unused child slot.
const NO_CHILD: u32 = u32::MAX;

/// Up to four children with their boxes, one per lane. 128 bytes with its alignment.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Node {
    /// Least and greatest corners, by axis. Unused lanes hold an inside-out box.
    bounds: [[Vec4; 3]; 2],
    children: [u32; WIDTH],
}

/// A bounding volume hierarchy over triangles.
///
/// # Examples
/// ```
/// use accel::{Bvh, BvhConfig, NO_TRIANGLE, Occluder, Segment};
/// use glam::dvec3;
///
/// let triangle = [dvec3(0.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0)];
/// let bvh = Bvh::build(&[triangle], &BvhConfig::default());
/// let through = Segment::new(dvec3(0.2, 0.2, 1.0), dvec3(0.2, 0.2, -1.0));
/// assert!(bvh.occluded(&through));
/// assert!(!bvh.occluded(&Segment { ignore: [0, NO_TRIANGLE], ..through }));
/// ```
#[derive(Clone, Debug)]
pub struct Bvh {
    frame: Frame,
    nodes: Vec<Node>,
    blocks: Vec<Block>,
    depth: usize,
}

impl Bvh {
    /// Builds the hierarchy; indices in answers are positions in `triangles`.
    ///
    /// Triangles with zero area or a coordinate that is not finite never block. The same input
    /// gives the same hierarchy.
    ///
    /// # Panics
    /// Panics if there are 2³¹ − 1 triangles or more.
    pub fn build(triangles: &[[DVec3; 3]], config: &BvhConfig) -> Self {
        assert!(triangles.len() < LEAF as usize - 1, "one bit of each index marks leaves");
        let (frame, kept) = Frame::of(triangles);
        let (nodes, blocks, depth) = build::build(&kept, config);
        Self { frame, nodes, blocks, depth }
    }

    /// Returns the longest side of the bounds of the triangles, in scene units: the argument for
    /// [`crate::rounding_band`].
    pub fn extent(&self) -> f64 {
        self.frame.extent()
    }
}
