//! Longest-edge bisection: halve the longest edge of the mesh until there are enough elements.
//!
//! Where the mesh is graded, the edge that counts for the longest may not be the longest of its
//! leaves. Then the longest edges that lead to it are halved first, from the far end of the chain
//! (Rivara 1997, "New longest-edge algorithms for the refinement and/or improvement of
//! unstructured triangulations"): every edge is the longest of all its leaves when it is halved.
//!
//! A forest may grow again: where light asks for more elements, edges count for longer.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use glam::DVec3;
use rustc_hash::FxHashSet;
use scene::VertexId;

use super::Node;
use super::cut::Edge;
use super::edges::{EdgeId, Edges, Length};
use super::grade::Grade;
use super::triangle_area;

/// The nodes of a mesh, with what growing them needs.
pub(super) struct Forest {
    pub(super) vertices: Vec<DVec3>,
    pub(super) nodes: Vec<Node>,
    /// Edges along contacts; halves of barriers are barriers.
    pub(super) barriers: FxHashSet<Edge>,
}

/// Where a forest grows, and where it does not.
pub(super) struct Plan<'a> {
    pub(super) grade: &'a Grade,
    /// How many elements each leaf's place deserves beside others, by element; all alike if
    /// absent.
    pub(super) density: Option<&'a [f64]>,
    /// A leaf of this area or less is halved only for its neighbours' sake.
    pub(super) least_area: f64,
    /// So is one this many halvings below its root.
    pub(super) most_depth: u32,
    /// Roots whose leaves are halved only for their neighbours' sake.
    pub(super) whole: &'a [bool],
}

impl Forest {
    /// A forest of roots alone.
    pub(super) fn of_roots(
        vertices: Vec<DVec3>,
        roots: Vec<[VertexId; 3]>,
        barriers: FxHashSet<Edge>,
    ) -> Self {
        let node = |(vertices, root)| Node::leaf(vertices, root);
        let nodes = roots.into_iter().zip(0..).map(node).collect();
        Self { vertices, nodes, barriers }
    }

    /// Grows to about `elements` leaves: stops when the next edge would leave more than that.
    pub(super) fn grow(self, plan: &Plan, elements: usize) -> Self {
        let mut grower = Grower::new(self, plan);
        while grower.leaves < elements && grower.halve_longest(elements) {}
        Self { vertices: grower.vertices, nodes: grower.nodes, barriers: grower.barriers }
    }
}

struct Grower<'a> {
    plan: &'a Plan<'a>,
    vertices: Vec<DVec3>,
    nodes: Vec<Node>,
    /// Of each node.
    state: Vec<Growth>,
    leaves: usize,
    edges: Edges,
    /// Edges by what they count for, the longest first; ties go to the smallest vertices. An edge
    /// between leaves of two densities is here twice. Halved ones stay until their turn comes.
    queue: BinaryHeap<(Length, Reverse<Edge>, EdgeId)>,
    barriers: FxHashSet<Edge>,
}

/// What a node hands down to its halves.
#[derive(Clone, Copy)]
struct Growth {
    density: f64,
    depth: u32,
}

impl<'a> Grower<'a> {
    fn new(forest: Forest, plan: &'a Plan) -> Self {
        let Forest { vertices, nodes, barriers } = forest;
        let mut state = vec![Growth { density: 1.0, depth: 0 }; nodes.len()];
        for (state, _) in state.iter_mut().zip(plan.whole).filter(|(_, whole)| **whole) {
            state.depth = u32::MAX;
        }
        for (id, node) in nodes.iter().enumerate() {
            // Halves come after what was halved.
            let depth = state[id].depth.saturating_add(1);
            node.children.clone().for_each(|part| state[part as usize].depth = depth);
            if let (true, Some(density)) = (node.is_leaf(), plan.density) {
                state[id].density = density[node.elements.start as usize];
            }
        }
        let edges = Edges::of_leaves(&nodes, &vertices);
        let leaves = nodes.iter().filter(|node| node.is_leaf()).count();
        let queue = BinaryHeap::new();
        let mut grower = Self { plan, vertices, nodes, state, leaves, edges, queue, barriers };
        for leaf in 0..grower.nodes.len() as u32 {
            if grower.nodes[leaf as usize].is_leaf() {
                grower.enter(leaf, grower.edges.of(leaf), [true; 3]);
            }
        }
        grower
    }

    /// Halves the edge that counts for the longest, or one on the way to it, unless that would
    /// leave more than `most` leaves.
    fn halve_longest(&mut self, most: usize) -> bool {
        while let Some((_, _, edge)) = self.queue.peek()
            && !self.may_halve(*edge)
        {
            self.queue.pop();
        }
        let Some(&(_, _, edge)) = self.queue.peek() else { return false };
        let edge = self.end_of_chain(edge);
        if self.leaves + self.edges.leaves(edge).len() > most {
            return false;
        }
        self.halve(edge);
        true
    }

    /// Follows longer and longer edges of leaves from `edge`, to one that is the longest of all
    /// its leaves. Each is longer than the one before, so the way ends.
    fn end_of_chain(&self, mut edge: EdgeId) -> EdgeId {
        loop {
            let leaves = self.edges.leaves(edge).iter();
            let edges = leaves.flat_map(|&leaf| self.edges.of(leaf));
            let longest = edges.max_by_key(|&e| self.edges.rank(e)).unwrap_or(edge);
            if self.edges.rank(longest) <= self.edges.rank(edge) {
                return edge;
            }
            edge = longest;
        }
    }

    fn halve(&mut self, edge: EdgeId) {
        let leaves = self.edges.take_leaves(edge);
        let ends = self.edges.ends(edge);
        let (p, q) = (self.vertices[ends.0.index()], self.vertices[ends.1.index()]);
        let middle = VertexId::from(self.vertices.len());
        self.vertices.push(p.midpoint(q));
        // A new vertex is greater than all before.
        let halves = [(ends.0, middle), (ends.1, middle)];
        if self.barriers.remove(&ends) {
            self.barriers.extend(halves);
        }
        let halves = halves.map(|half| self.edges.add(half, &self.vertices));
        for leaf in leaves {
            self.bisect(leaf, edge, halves, middle);
        }
    }

    /// Splits a leaf at the middle of one of its edges, whose halves are those of its smaller and
    /// its greater end.
    fn bisect(&mut self, leaf: u32, edge: EdgeId, halves: [EdgeId; 2], middle: VertexId) {
        let Node { vertices, root, .. } = self.nodes[leaf as usize];
        let own = self.edges.of(leaf);
        // Turn the triangle so that the halved edge is a–b; the winding stays.
        let turn = own.iter().position(|e| *e == edge);
        let turn = turn.expect("a leaf is entered only at its own edges");
        let [a, b, c] = [0, 1, 2].map(|i| vertices[(i + turn) % 3]);
        let [_, bc, ca] = [0, 1, 2].map(|i| own[(i + turn) % 3]);
        let [am, mb] = if a < b { halves } else { [halves[1], halves[0]] };
        let mc = self.edges.add((c, middle), &self.vertices);
        self.edges.leave(bc, leaf);
        self.edges.leave(ca, leaf);
        let first = self.nodes.len() as u32;
        self.nodes[leaf as usize].children = first..first + 2;
        self.leaves += 1;
        let Growth { density, depth } = self.state[leaf as usize];
        for (vertices, own, new) in [
            ([a, middle, c], [am, mc, ca], [true, true, false]),
            ([middle, b, c], [mb, bc, mc], [true, false, true]),
        ] {
            self.nodes.push(Node::leaf(vertices, root));
            self.state.push(Growth { density, depth: depth.saturating_add(1) });
            // The other edge is in the queue already, for the leaf that this was.
            self.enter(self.nodes.len() as u32 - 1, own, new);
        }
    }

    /// Enters a leaf at its edges, and the new ones among them in the queue.
    fn enter(&mut self, leaf: u32, own: [EdgeId; 3], new: [bool; 3]) {
        let density = self.state[leaf as usize].density;
        for (edge, new) in own.into_iter().zip(new) {
            let mut others = self.edges.leaves(edge).iter();
            let known =
                others.any(|&other| self.state[other as usize].density.total_cmp(&density).is_eq());
            if new && !known {
                let ends = self.edges.ends(edge);
                let (p, q) = (self.vertices[ends.0.index()], self.vertices[ends.1.index()]);
                let squared = self.plan.grade.squared_length(p, q) * density;
                self.queue.push((Length::of(squared), Reverse(ends), edge));
            }
        }
        self.edges.enter(leaf, own);
    }

    /// Whether some leaf at an edge may be halved for its own sake; none at an edge that was.
    /// Once there is none, there will be none: leaves only become smaller.
    fn may_halve(&self, edge: EdgeId) -> bool {
        let Plan { least_area, most_depth, .. } = *self.plan;
        let large = |leaf: u32| {
            let corners = self.nodes[leaf as usize].vertices.map(|v| self.vertices[v.index()]);
            triangle_area(corners) > least_area
        };
        let mut leaves = self.edges.leaves(edge).iter();
        leaves.any(|&leaf| self.state[leaf as usize].depth < most_depth && large(leaf))
    }
}
