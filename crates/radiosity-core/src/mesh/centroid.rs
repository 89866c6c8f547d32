//! Cuts at centroids: the split of an older program, kept for comparison.
//!
//! An element becomes three that meet at its centroid. Edges are never cut, so neighbours need not
//! know, and no vertex lies inside an edge; but every cut divides the angles at the corners, and
//! after some of them elements are needles along edges that are as long as ever.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use scene::VertexId;

use super::bisect::{Forest, Plan};
use super::edges::Length;
use super::{Node, triangle_area};

impl Forest {
    /// Cuts the leaf with the most area times density, over and over, until another cut would leave
    /// more than `elements` leaves.
    pub(super) fn cut_at_centroids(mut self, plan: &Plan, elements: usize) -> Self {
        let mut leaves = 0;
        let mut queue = BinaryHeap::new();
        let mut depths = vec![0u32; self.nodes.len()];
        for (depth, _) in depths.iter_mut().zip(plan.whole).filter(|(_, whole)| **whole) {
            *depth = u32::MAX;
        }
        for id in 0..self.nodes.len() {
            let node = &self.nodes[id];
            for part in node.children.clone() {
                depths[part as usize] = depths[id].saturating_add(1);
            }
            if node.is_leaf() {
                let density = plan.density.map_or(1.0, |d| d[node.elements.start as usize]);
                leaves += 1;
                self.enter(plan, &mut queue, id as u32, density, depths[id]);
            }
        }
        while leaves + 2 <= elements
            && let Some((_, Reverse(id), density, depth)) = queue.pop()
        {
            let Node { vertices: [a, b, c], root, .. } = self.nodes[id as usize];
            let [p, q, r] = [a, b, c].map(|v| self.vertices[v.index()]);
            let middle = VertexId::from(self.vertices.len());
            self.vertices.push((p + q + r) / 3.0);
            let first = self.nodes.len() as u32;
            self.nodes[id as usize].children = first..first + 3;
            for vertices in [[a, b, middle], [b, c, middle], [c, a, middle]] {
                self.nodes.push(Node::leaf(vertices, root));
                let part = self.nodes.len() as u32 - 1;
                self.enter(plan, &mut queue, part, density.0, depth.saturating_add(1));
            }
            leaves += 2;
        }
        self
    }

    /// Enters a leaf in the queue, if it may be cut.
    fn enter(
        &self,
        plan: &Plan,
        queue: &mut BinaryHeap<(Length, Reverse<u32>, Length, u32)>,
        id: u32,
        density: f64,
        depth: u32,
    ) {
        let corners = self.nodes[id as usize].vertices.map(|v| self.vertices[v.index()]);
        let area = triangle_area(corners);
        if area > plan.least_area && depth < plan.most_depth {
            queue.push((Length::of(area * density), Reverse(id), Length(density), depth));
        }
    }
}
