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
use rustc_hash::{FxHashMap, FxHashSet};
use scene::VertexId;
use smallvec::SmallVec;

use super::Node;
use super::cut::{Edge, edge};
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
        let mut grower = Grower::new(self, plan, elements);
        while grower.leaves < elements && grower.halve_longest(elements) {}
        Self { vertices: grower.vertices, nodes: grower.nodes, barriers: grower.barriers }
    }
}

/// No room is reserved for more edges than these: elements may be asked for that never come.
const MOST_RESERVED: usize = 1 << 20;

struct Grower<'a> {
    plan: &'a Plan<'a>,
    vertices: Vec<DVec3>,
    nodes: Vec<Node>,
    /// Of each node.
    state: Vec<Growth>,
    leaves: usize,
    /// The leaves at each edge of the present mesh; at most two unless surfaces meet there.
    at_edge: FxHashMap<Edge, SmallVec<[u32; 2]>>,
    /// Edges by what they count for, the longest first; ties go to the smallest vertices. An edge
    /// between leaves of two densities is here twice. Halved ones stay until their turn comes.
    queue: BinaryHeap<(Length, Reverse<Edge>)>,
    barriers: FxHashSet<Edge>,
}

/// What a node hands down to its halves.
#[derive(Clone, Copy)]
struct Growth {
    density: f64,
    depth: u32,
}

/// A squared length, ordered: never NaN, since vertices are finite.
#[derive(PartialEq)]
pub(super) struct Length(pub(super) f64);

impl Length {
    /// The length, rounded to 24 binary digits: edges that are alike but for rounding stay alike,
    /// and their vertices decide, in whatever unit and wherever the scene is.
    pub(super) fn of(squared: f64) -> Self {
        const LOST: u32 = f64::MANTISSA_DIGITS - f32::MANTISSA_DIGITS;
        let half = 1 << (LOST - 1);
        // Carries into the exponent as rounding up should; infinity stays above all.
        Self(f64::from_bits((squared.to_bits() + half) >> LOST << LOST))
    }
}

impl Eq for Length {}

impl PartialOrd for Length {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Length {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

fn edges([a, b, c]: [VertexId; 3]) -> [Edge; 3] {
    [edge(a, b), edge(b, c), edge(c, a)]
}

impl<'a> Grower<'a> {
    fn new(forest: Forest, plan: &'a Plan, elements: usize) -> Self {
        let Forest { vertices, nodes, barriers } = forest;
        let mut state = vec![Growth { density: 1.0, depth: 0 }; nodes.len()];
        for (id, node) in nodes.iter().enumerate() {
            // Halves come after what was halved.
            let depth = state[id].depth + 1;
            node.children.clone().for_each(|part| state[part as usize].depth = depth);
            if let (true, Some(density)) = (node.is_leaf(), plan.density) {
                state[id].density = density[node.elements.start as usize];
            }
        }
        let leaves: Vec<u32> =
            (0u32..).zip(&nodes).filter_map(|(id, node)| node.is_leaf().then_some(id)).collect();
        let mut grower = Self {
            plan,
            vertices,
            nodes,
            state,
            leaves: leaves.len(),
            // Three edges for two elements, and room for those that are one-sided.
            at_edge: FxHashMap::with_capacity_and_hasher(
                (2 * elements).min(MOST_RESERVED),
                Default::default(),
            ),
            queue: BinaryHeap::new(),
            barriers,
        };
        for leaf in leaves {
            grower.enter(leaf, |_| true);
        }
        grower
    }

    /// Halves the edge that counts for the longest, or one on the way to it, unless that would
    /// leave more than `most` leaves.
    fn halve_longest(&mut self, most: usize) -> bool {
        while let Some((_, Reverse(edge))) = self.queue.peek()
            && !self.at_edge.contains_key(edge)
        {
            self.queue.pop();
        }
        let Some(&(_, Reverse(edge))) = self.queue.peek() else { return false };
        let edge = self.end_of_chain(edge);
        if self.leaves + self.at_edge[&edge].len() > most {
            return false;
        }
        self.halve(edge);
        true
    }

    /// Follows longer and longer edges of leaves from `edge`, to one that is the longest of all
    /// its leaves. Each is longer than the one before, so the way ends.
    fn end_of_chain(&self, mut edge: Edge) -> Edge {
        loop {
            let leaves = self.at_edge[&edge].iter();
            let edges = leaves.flat_map(|&leaf| edges(self.nodes[leaf as usize].vertices));
            let longest = edges.max_by_key(|&e| self.rank(e)).unwrap_or(edge);
            if self.rank(longest) <= self.rank(edge) {
                return edge;
            }
            edge = longest;
        }
    }

    /// Orders edges by their true length; ties go to the smallest vertices.
    fn rank(&self, edge: Edge) -> (Length, Reverse<Edge>) {
        let (p, q) = (self.vertices[edge.0.index()], self.vertices[edge.1.index()]);
        (Length::of((q - p).length_squared()), Reverse(edge))
    }

    fn halve(&mut self, edge: Edge) {
        let leaves = self.at_edge.remove(&edge).unwrap_or_default();
        let (p, q) = (self.vertices[edge.0.index()], self.vertices[edge.1.index()]);
        let middle = VertexId::from(self.vertices.len());
        self.vertices.push(p.midpoint(q));
        if self.barriers.remove(&edge) {
            // A new vertex is greater than all before.
            self.barriers.extend([(edge.0, middle), (edge.1, middle)]);
        }
        for leaf in leaves {
            self.bisect(leaf, edge, middle);
        }
    }

    fn bisect(&mut self, leaf: u32, edge: Edge, middle: VertexId) {
        let Node { vertices, root, .. } = self.nodes[leaf as usize];
        // Turn the triangle so that the halved edge is a–b; the winding stays.
        let turn = edges(vertices).iter().position(|e| *e == edge);
        let turn = turn.expect("a leaf is entered only at its own edges");
        let [a, b, c] = [0, 1, 2].map(|i| vertices[(i + turn) % 3]);
        for other in edges(vertices) {
            if other != edge
                && let Some(leaves) = self.at_edge.get_mut(&other)
            {
                leaves.retain(|l| *l != leaf);
            }
        }
        let first = self.nodes.len() as u32;
        self.nodes[leaf as usize].children = first..first + 2;
        self.leaves += 1;
        let Growth { density, depth } = self.state[leaf as usize];
        for vertices in [[a, middle, c], [middle, b, c]] {
            self.nodes.push(Node::leaf(vertices, root));
            self.state.push(Growth { density, depth: depth + 1 });
            // The other edges are in the queue already, for the leaf that this was.
            self.enter(self.nodes.len() as u32 - 1, |edge| edge.1 == middle);
        }
    }

    /// Enters a leaf at its edges, and the new ones among them in the queue if it may be halved.
    fn enter(&mut self, leaf: u32, new: impl Fn(Edge) -> bool) {
        let vertices = self.nodes[leaf as usize].vertices;
        let Growth { density, depth } = self.state[leaf as usize];
        let place = vertices.map(|v| self.vertices[v.index()]);
        let may = depth < self.plan.most_depth && triangle_area(place) > self.plan.least_area;
        // Where some leaves may not be halved, an edge that they know may not be in the queue.
        let limited = self.plan.least_area > 0.0 || self.plan.most_depth < u32::MAX;
        for edge in edges(vertices) {
            let leaves = self.at_edge.entry(edge).or_default();
            let known = leaves
                .iter()
                .any(|&other| self.state[other as usize].density.total_cmp(&density).is_eq());
            leaves.push(leaf);
            if may && new(edge) && (!known || limited) {
                let (p, q) = (self.vertices[edge.0.index()], self.vertices[edge.1.index()]);
                let squared = self.plan.grade.squared_length(p, q) * density;
                self.queue.push((Length::of(squared), Reverse(edge)));
            }
        }
    }
}
