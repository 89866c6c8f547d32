//! Binned SAH build (Wald 2007, "On fast construction of SAH-based bounding volume hierarchies").

use std::ops::Range;

use glam::Vec4;

use super::split;
use super::{BOX_PADDING, BvhConfig, LEAF, NO_CHILD, Node, WIDTH};
use crate::aabb::Aabb;
use crate::block::{Block, LANES};
use crate::frame::LocalTriangle;

/// A bound on the depth of any hierarchy, and so on the stack of a traversal.
///
/// Halving alone needs 29 levels for 2³¹ triangles; what a smaller scene leaves unused is room for
/// SAH to be uneven. Sensible scenes stay below 16.
pub(super) const MAX_DEPTH: usize = 36;

/// Whether a range that is halved from here on stays within [`MAX_DEPTH`] with a level to spare.
fn may_be_uneven(len: usize, depth: usize) -> bool {
    depth + 1 + (len.ilog2() as usize) < MAX_DEPTH
}

impl Node {
    const EMPTY: Self = Self {
        bounds: [[Vec4::INFINITY; 3], [Vec4::NEG_INFINITY; 3]],
        children: [NO_CHILD; WIDTH],
    };

    fn set_child(&mut self, lane: usize, child: u32, bounds: &Aabb) {
        let padded = bounds.padded(BOX_PADDING);
        for axis in 0..3 {
            self.bounds[0][axis][lane] = padded.lo[axis];
            self.bounds[1][axis][lane] = padded.hi[axis];
        }
        self.children[lane] = child;
    }
}

/// Returns nodes (root first), leaf blocks and the depth.
pub(super) fn build(
    triangles: &[LocalTriangle],
    config: &BvhConfig,
) -> (Vec<Node>, Vec<Block>, usize) {
    let mut builder = Builder {
        triangles,
        boxes: triangles.iter().map(|t| Aabb::of_triangle(&t.vertices)).collect(),
        order: (0..triangles.len() as u32).collect(),
        bins: config.bins.clamp(2, split::MAX_BINS),
        nodes: Vec::new(),
        blocks: Vec::new(),
        depth: 0,
    };
    if !triangles.is_empty() {
        builder.node(0..triangles.len(), 1);
    }
    builder.nodes.shrink_to_fit();
    builder.blocks.shrink_to_fit();
    (builder.nodes, builder.blocks, builder.depth)
}

struct Builder<'a> {
    triangles: &'a [LocalTriangle],
    boxes: Vec<Aabb>,
    /// Triangles in the order of the leaves; each node owns a range.
    order: Vec<u32>,
    bins: usize,
    nodes: Vec<Node>,
    blocks: Vec<Block>,
    depth: usize,
}

impl Builder<'_> {
    /// Builds the node over a range of `order`; returns its index.
    ///
    /// Recursion is as deep as the hierarchy, at most [`MAX_DEPTH`].
    fn node(&mut self, range: Range<usize>, depth: usize) -> u32 {
        self.depth = self.depth.max(depth);
        let mut parts = [(); WIDTH].map(|()| (0..0, Aabb::EMPTY));
        parts[0] = (range.clone(), self.bounds(range));
        let mut count = 1;
        while count < WIDTH {
            // Split the part that most rays meet.
            let area = |part: &(Range<usize>, Aabb)| part.1.half_area();
            let widest = (0..count)
                .filter(|&i| parts[i].0.len() > LANES)
                .reduce(|a, b| if area(&parts[b]) > area(&parts[a]) { b } else { a });
            let Some(i) = widest else { break };
            let range = parts[i].0.clone();
            let middle = self.split(range.clone(), depth);
            parts[i] = (range.start..middle, self.bounds(range.start..middle));
            parts[count] = (middle..range.end, self.bounds(middle..range.end));
            count += 1;
        }

        let index = self.nodes.len();
        self.nodes.push(Node::EMPTY);
        for (lane, (range, bounds)) in parts.into_iter().take(count).enumerate() {
            let child =
                if range.len() <= LANES { self.leaf(range) } else { self.node(range, depth + 1) };
            self.nodes[index].set_child(lane, child, &bounds);
        }
        index as u32
    }

    fn leaf(&mut self, range: Range<usize>) -> u32 {
        let triangles = self.order[range].iter().map(|&i| &self.triangles[i as usize]);
        self.blocks.push(Block::of(triangles));
        LEAF | (self.blocks.len() - 1) as u32
    }

    fn bounds(&self, range: Range<usize>) -> Aabb {
        let mut bounds = Aabb::EMPTY;
        for &i in &self.order[range] {
            bounds.join(&self.boxes[i as usize]);
        }
        bounds
    }

    /// Reorders the range into two parts, neither empty; returns where the second starts.
    fn split(&mut self, range: Range<usize>, depth: usize) -> usize {
        let part = &mut self.order[range.clone()];
        let first = may_be_uneven(part.len(), depth)
            .then(|| split::by_area(part, &self.boxes, self.bins))
            .flatten();
        range.start + first.unwrap_or_else(|| split::at_median(part, &self.boxes))
    }
}
