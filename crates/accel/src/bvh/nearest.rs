//! The first triangle along a ray: depth-first, near children first.

use glam::DVec3;

use super::traverse::STACK;
use super::{Bvh, LEAF, WIDTH};
use crate::Hit;
use crate::local::{LocalSegment, Slabs};

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
        let slabs = Slabs::of(&segment);
        let mut best = Hit::NONE;
        let mut limit = 1.0;
        let mut stack = [(0_u32, 0.0_f32); STACK];
        let mut waiting = 1; // the root
        while waiting > 0 {
            waiting -= 1;
            let (child, enter) = stack[waiting];
            if enter > limit {
                continue;
            }
            if child & LEAF != 0 {
                for (triangle, crossing) in
                    self.blocks[(child & !LEAF) as usize].crossings(&segment)
                {
                    best.improve(triangle, &crossing);
                }
                limit = (best.t as f32 + LIMIT_SLACK).min(1.0);
                continue;
            }
            let node = &self.nodes[child as usize];
            let (enter, leave) = slabs.span(&node.bounds, limit);
            let first = waiting;
            for lane in 0..WIDTH {
                if enter[lane] <= leave[lane] {
                    // Insertion keeps the nearest on top.
                    let mut place = waiting;
                    while place > first && stack[place - 1].1 < enter[lane] {
                        stack[place] = stack[place - 1];
                        place -= 1;
                    }
                    stack[place] = (node.children[lane], enter[lane]);
                    waiting += 1;
                }
            }
        }
        best.finish(span)
    }
}
