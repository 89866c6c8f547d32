//! Bounding volume hierarchy: eight boxes to a node, four triangles to a leaf.
//!
//! Built by binned SAH (Wald 2007) straight into eight-wide nodes; memory is bounded by the number
//! of triangles alone. The default choice for any scene that is not convex.

mod batch;
mod beam;
mod box_test;
mod build;
mod chunk;
mod config;
mod group;
mod level;
mod nearest;
mod node;
mod packet;
mod planes;
mod segment;
mod slabs;
mod split;
mod stats;
mod validate;

pub use build::Part;
pub use config::BvhConfig;
pub use stats::BvhStats;

use glam::DVec3;

use crate::block::Block;
use crate::frame::Frame;
use crate::simd::{Found, Width};
use crate::triangle::HIT_ERROR;
use crate::{Occluder, Segment, Target};
use batch::Batch;
use build::Tree;
use node::{LEAF, Node};
use segment::Blocked;

/// How far each box is grown beyond its triangles, in local units.
///
/// A box must be met by every segment that the triangle test accepts: such a segment passes within
/// [`HIT_ERROR`] of the triangle, and the slab test errs by less than half of that
/// (see `Slabs::span`), as does rounding the grown corner. Four times [`HIT_ERROR`] is ample and
/// still far below any visible size.
pub(crate) const BOX_PADDING: f32 = 4.0 * HIT_ERROR;

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
    width: Found,
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
        Self::build_with(triangles, config, |parts, work| parts.iter_mut().for_each(work))
    }

    /// Builds the hierarchy on several threads: `run` calls the function it is given once for each
    /// of some independent parts, in any order and on any thread.
    ///
    /// The hierarchy is the one that [`Self::build`] builds, on however many threads.
    ///
    /// # Panics
    /// Panics if there are 2³¹ − 1 triangles or more, or if `run` leaves a part out.
    ///
    /// # Examples
    /// ```
    /// use accel::{Bvh, BvhConfig};
    /// use glam::{DVec3, dvec3};
    ///
    /// let row: Vec<[DVec3; 3]> = (0..10_000)
    ///     .map(|i| [DVec3::ZERO, DVec3::X, DVec3::Y].map(|v| v + dvec3(0.0, 0.0, f64::from(i))))
    ///     .collect();
    /// let config = BvhConfig::default();
    /// let bvh = Bvh::build_with(&row, &config, |parts, work| {
    ///     std::thread::scope(|scope| {
    ///         for some in parts.chunks_mut(4) {
    ///             scope.spawn(move || some.iter_mut().for_each(work));
    ///         }
    ///     });
    /// });
    /// assert_eq!(bvh.stats(), Bvh::build(&row, &config).stats());
    /// ```
    pub fn build_with(
        triangles: &[[DVec3; 3]],
        config: &BvhConfig,
        run: impl Fn(&mut [Part<'_>], &(dyn Fn(&mut Part<'_>) + Sync)),
    ) -> Self {
        Self::build_of(triangles, |_| true, config, run)
    }

    /// Builds the hierarchy over those triangles that `may_block`; the others never do, and keep their
    /// index. What blocks answers to the bit as it would among all.
    ///
    /// # Panics
    /// Panics if there are 2³¹ − 1 triangles or more, or if `run` leaves a part out.
    pub fn build_of(
        triangles: &[[DVec3; 3]],
        may_block: impl Fn(usize) -> bool,
        config: &BvhConfig,
        run: impl Fn(&mut [Part<'_>], &(dyn Fn(&mut Part<'_>) + Sync)),
    ) -> Self {
        assert!(triangles.len() < LEAF as usize - 1, "one bit of each index marks leaves");
        // The frame is that of all: it is what positions are rounded to.
        let (frame, mut kept) = Frame::of(triangles);
        kept.retain(|triangle| may_block(triangle.index as usize));
        let Tree { nodes, blocks, depth } = build::build(&kept, config, run);
        Self { frame, nodes, blocks, depth, width: Found::of(Width::fastest()) }
    }

    /// Answers in a width instead of the widest that the machine has, or in the widest if that is
    /// less. No width changes an answer.
    #[must_use]
    pub fn with_width(self, width: Width) -> Self {
        Self { width: Found::of(width), ..self }
    }

    /// Returns the width in which questions are answered.
    pub fn width(&self) -> Width {
        self.width.width()
    }

    /// Returns the longest side of the bounds of the triangles, in scene units: the argument for
    /// [`crate::rounding_band`].
    pub fn extent(&self) -> f64 {
        self.frame.extent()
    }
}

impl Occluder for Bvh {
    fn occluded(&self, segment: &Segment) -> bool {
        self.width.run(Blocked { bvh: self, segment })
    }

    fn occluded_batch(&self, from: DVec3, ignore: u32, targets: &[Target], blocked: &mut [bool]) {
        assert_eq!(targets.len(), blocked.len(), "one answer per target");
        self.width.run(Batch { bvh: self, from, ignore, targets, blocked });
    }
}
