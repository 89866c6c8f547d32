//! Checks that a BVH is what its build promises.

use super::build::MAX_DEPTH;
use super::node::LEAF;
use super::{BOX_PADDING, Bvh};
use crate::aabb::Aabb;

impl Bvh {
    /// Checks that every node and leaf has one parent, that every triangle lies in one leaf and
    /// well inside all boxes above it, and that the depth is bounded.
    ///
    /// For tests and debugging: it visits everything.
    ///
    /// # Errors
    /// Says which node, leaf or triangle breaks which promise.
    pub fn validate(&self) -> Result<(), String> {
        let mut parents = (vec![0_u32; self.nodes.len()], vec![0_u32; self.blocks.len()]);
        if !self.nodes.is_empty() {
            parents.0[0] = 1;
            self.validate_node(0, 1, &mut parents)?;
        }
        if let Some(node) = parents.0.iter().position(|&count| count != 1) {
            return Err(format!("node {node} has {} parents, expected 1", parents.0[node]));
        }
        if let Some(leaf) = parents.1.iter().position(|&count| count != 1) {
            return Err(format!("leaf {leaf} has {} parents, expected 1", parents.1[leaf]));
        }
        let mut indices: Vec<u32> =
            self.blocks.iter().flat_map(|b| b.triangles().map(|t| t.index)).collect();
        indices.sort_unstable();
        match indices.windows(2).find(|pair| pair[0] == pair[1]) {
            Some(pair) => Err(format!("triangle {} is in two leaves, expected one", pair[0])),
            None => Ok(()),
        }
    }

    /// Returns the bounds of the triangles below a node.
    fn validate_node(
        &self,
        index: usize,
        depth: usize,
        parents: &mut (Vec<u32>, Vec<u32>),
    ) -> Result<Aabb, String> {
        if depth > MAX_DEPTH {
            return Err(format!("node {index} is at depth {depth}, expected at most {MAX_DEPTH}"));
        }
        let node = &self.nodes[index];
        let mut all = Aabb::EMPTY;
        for lane in node.lanes() {
            let child = node.child(lane);
            let target = (child & !LEAF) as usize;
            let below = if child & LEAF != 0 {
                parents.1[target] += 1;
                let mut bounds = Aabb::EMPTY;
                for triangle in self.blocks[target].triangles() {
                    bounds.join(&Aabb::of_triangle(&triangle.vertices));
                }
                bounds
            } else {
                parents.0[target] += 1;
                if target <= index {
                    return Err(format!("node {index} has child {target}, expected a later one"));
                }
                self.validate_node(target, depth + 1, parents)?
            };
            let bounds = node.boxes.of_lane(lane);
            // Half the padding, because the padded corner was rounded.
            if !bounds.contains(&below.padded(0.5 * BOX_PADDING)) {
                return Err(format!("child {lane} of node {index} does not hold its triangles"));
            }
            all.join(&below);
        }
        Ok(all)
    }
}
