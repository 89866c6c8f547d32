//! The first triangle along a ray: depth-first, near children first.

use glam::DVec3;

use super::Bvh;
use super::build::MAX_DEPTH;
use super::node::{LEAF, WIDTH};
use super::slabs::Slabs;
use crate::Hit;
use crate::lanes::{Kernel, Lanes, Simd};
use crate::local::LocalSegment;

/// Nodes waiting at any time: each level leaves at most seven behind.
const STACK: usize = (WIDTH - 1) * MAX_DEPTH + WIDTH;

/// Added to the best parameter so far before it limits the search: narrowing it to f32 must not cut
/// off a triangle met at the same parameter. Parameters are at most 1, so one f32 epsilon is two
/// rounding errors.
const LIMIT_SLACK: f32 = f32::EPSILON;

impl Bvh {
    /// Returns the first triangle that the ray meets at a parameter above 0, of several at the
    /// same parameter the one with the least index.
    ///
    /// The parameter is in lengths of `direction`, which need not be 1. A ray that is not finite
    /// or has no direction meets nothing.
    ///
    /// # Examples
    /// ```
    /// use accel::{Bvh, BvhConfig};
    /// use glam::dvec3;
    ///
    /// let floor = [dvec3(0.0, 0.0, 0.0), dvec3(1.0, 0.0, 0.0), dvec3(0.0, 1.0, 0.0)];
    /// let bvh = Bvh::build(&[floor], &BvhConfig::default());
    /// let hit = bvh.nearest(dvec3(0.2, 0.2, 3.0), dvec3(0.0, 0.0, -2.0)).expect("it is below");
    /// assert!((hit.t - 1.5).abs() < 1e-6 && hit.front);
    /// ```
    pub fn nearest(&self, origin: DVec3, direction: DVec3) -> Option<Hit> {
        let (segment, span) = LocalSegment::along(&self.frame, origin, direction)?;
        if self.nodes.is_empty() {
            return None;
        }
        self.width.run(Nearest { bvh: self, segment: &segment }).finish(span)
    }
}

struct Nearest<'a> {
    bvh: &'a Bvh,
    segment: &'a LocalSegment,
}

impl Kernel for Nearest<'_> {
    type Output = Hit;

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) -> Hit {
        let Self { bvh, segment } = self;
        let slabs = Slabs::of(simd, segment);
        let mut best = Hit::NONE;
        let mut limit = 1.0;
        let mut stack = [(0_u32, 0.0_f32); STACK];
        let mut waiting = 1; // the root
        let mut enters = [0.0; WIDTH];
        while waiting > 0 {
            waiting -= 1;
            let (child, enter) = stack[waiting];
            if enter > limit {
                continue;
            }
            if child & LEAF != 0 {
                for (triangle, crossing) in bvh.blocks[(child & !LEAF) as usize].crossings(segment)
                {
                    best.improve(triangle, &crossing);
                }
                limit = (best.t as f32 + LIMIT_SLACK).min(1.0);
                continue;
            }
            let node = &bvh.nodes[child as usize];
            let (enter, mut met) = slabs.span(simd, &node.boxes, S::F8::splat(simd, limit));
            enter.store(&mut enters);
            let first = waiting;
            while met != 0 {
                let lane = met.trailing_zeros() as usize & (WIDTH - 1);
                met &= met - 1;
                // Insertion keeps the nearest on top.
                let mut place = waiting;
                while place > first && stack[place - 1].1 < enters[lane] {
                    stack[place] = stack[place - 1];
                    place -= 1;
                }
                stack[place] = (node.child(lane), enters[lane]);
                waiting += 1;
            }
        }
        best
    }
}
