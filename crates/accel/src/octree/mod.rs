//! Octree: triangles in the leaves alone, in blocks of four with a box each.
//!
//! Single segments are walked by 3D-DDA: the walk visits the leaves along a segment in order
//! (Amanatides & Woo 1987, on leaves of unequal size) and needs no stack. Batches go down from the
//! root in packets. Large triangles are copied to many leaves; where triangles vary much in size,
//! the BVH is smaller and faster. What each technique is worth: `docs/performance/techniques.md`.

mod batch;
mod boxes;
mod build;
mod config;
mod dda;
mod leaf;
mod overlap;
mod packet;
mod stats;
mod validate;

pub use config::OctreeConfig;
pub use stats::OctreeStats;

use glam::DVec3;

use crate::block::Block;
use crate::frame::{Frame, LocalTriangle};
use crate::triangle::HIT_ERROR;
use boxes::Boxes;
use leaf::Group;

/// How far each cell is grown when triangles are sorted into it, in local units.
///
/// The walk must find a triangle in some leaf it visits whenever the triangle test would accept
/// it: the crossing is within [`HIT_ERROR`] of the triangle, and the walk drifts from the true
/// segment by less than [`HIT_ERROR`] (see `dda.rs`). The sum is doubled for good measure.
const CELL_PADDING: f64 = 4.0 * HIT_ERROR as f64;

/// The deepest octree: with root cells of at most 7 significant bits (see `build.rs`) every cell
/// face is an f32 number without rounding.
const DEPTH_LIMIT: u32 = 16;

/// A cell: eight children in a row, or a run of groups of blocks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Cell {
    /// The first child, or the first group.
    first: u32,
    /// How many triangles the groups hold; [`INNER`] for a cell with children.
    count: u32,
}

/// The count that marks a cell with children.
const INNER: u32 = u32::MAX;

/// An octree over triangles.
///
/// # Examples
/// ```
/// use accel::{Occluder, Octree, OctreeConfig, Segment};
/// use glam::dvec3;
///
/// let triangle = [dvec3(0.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0)];
/// let octree = Octree::build(&[triangle], &OctreeConfig::default());
/// assert!(octree.occluded(&Segment::new(dvec3(0.2, 0.2, 1.0), dvec3(0.2, 0.2, -1.0))));
/// assert!(!octree.occluded(&Segment::new(dvec3(0.8, 0.8, 1.0), dvec3(0.8, 0.8, -1.0))));
/// ```
#[derive(Clone, Debug)]
pub struct Octree {
    frame: Frame,
    /// Half the side of the root cell, which is centred on the local origin.
    half: f32,
    /// Halvings of the root cell in the deepest leaf; the walk counts in cells of that size.
    depth: u32,
    /// The root first.
    cells: Vec<Cell>,
    /// The boxes of each family of eight cells, in their order behind the root.
    boxes: Vec<[Boxes; 2]>,
    groups: Vec<Group>,
    /// The triangles of the leaves, ascending within a leaf.
    blocks: Vec<Block>,
    /// Every triangle once, ascending.
    triangles: Vec<LocalTriangle>,
}

impl Octree {
    /// Builds the octree; indices in answers are positions in `triangles`.
    ///
    /// Triangles with zero area or a coordinate that is not finite never block. The same input
    /// gives the same octree.
    ///
    /// # Panics
    /// Panics if there are 2³² − 1 triangles or more, or as many list entries.
    pub fn build(triangles: &[[DVec3; 3]], config: &OctreeConfig) -> Self {
        Self::build_of(triangles, |_| true, config)
    }

    /// Builds the octree over those triangles that `may_block`; the others never do, and keep their
    /// index. What blocks answers to the bit as it would among all.
    ///
    /// # Panics
    /// Panics if there are 2³² − 1 triangles or more.
    pub fn build_of(
        triangles: &[[DVec3; 3]],
        may_block: impl Fn(usize) -> bool,
        config: &OctreeConfig,
    ) -> Self {
        // The frame is that of all: it is what positions are rounded to.
        let (frame, mut kept) = Frame::of(triangles);
        kept.retain(|triangle| may_block(triangle.index as usize));
        build::build(frame, kept, config)
    }

    /// Returns the longest side of the bounds of the triangles, in scene units: the argument for
    /// [`crate::rounding_band`].
    pub fn extent(&self) -> f64 {
        self.frame.extent()
    }
}
