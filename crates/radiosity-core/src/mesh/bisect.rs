//! Longest-edge bisection: halve the longest edge of the mesh until there are enough elements.
//!
//! Where the mesh is graded, the edge that counts for the longest may not be the longest of its
//! leaves. Then the longest edges that lead to it are halved first, from the far end of the chain
//! (Rivara 1997, "New longest-edge algorithms for the refinement and/or improvement of
//! unstructured triangulations"): every edge is the longest of all its leaves when it is halved.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

use glam::DVec3;
use scene::VertexId;

use super::Node;
use super::cut::{Edge, edge};
use super::grade::Grade;

/// Grows the forest over the given roots to about `elements` leaves: stops when the next
/// edge would leave more than that. Halves of barriers are barriers.
pub(super) fn forest(
    vertices: Vec<DVec3>,
    roots: Vec<[VertexId; 3]>,
    barriers: HashSet<Edge>,
    grade: &Grade,
    elements: usize,
) -> (Vec<DVec3>, Vec<Node>, HashSet<Edge>) {
    let mut grower = Grower::new(vertices, roots, barriers, grade);
    while grower.leaves < elements && grower.halve_longest(elements) {}
    (grower.vertices, grower.nodes, grower.barriers)
}

struct Grower<'a> {
    grade: &'a Grade,
    vertices: Vec<DVec3>,
    nodes: Vec<Node>,
    leaves: usize,
    /// The leaves at each edge of the present mesh; at most two unless surfaces meet there.
    at_edge: HashMap<Edge, Vec<u32>>,
    /// Edges by what they count for, the longest first; ties go to the smallest vertices.
    /// Halved ones stay until their turn comes.
    queue: BinaryHeap<(Length, Reverse<Edge>)>,
    /// Edges along contacts.
    barriers: HashSet<Edge>,
}

/// A squared length, ordered: never NaN, since vertices are finite.
#[derive(PartialEq)]
struct Length(f64);

impl Length {
    /// The length, rounded to 24 binary digits: edges that are alike but for rounding stay alike,
    /// and their vertices decide, in whatever unit and wherever the scene is.
    fn of(squared: f64) -> Self {
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
    fn new(
        vertices: Vec<DVec3>,
        roots: Vec<[VertexId; 3]>,
        barriers: HashSet<Edge>,
        grade: &'a Grade,
    ) -> Self {
        let mut grower = Self {
            grade,
            vertices,
            nodes: Vec::with_capacity(2 * roots.len()),
            leaves: roots.len(),
            at_edge: HashMap::new(),
            queue: BinaryHeap::new(),
            barriers,
        };
        for (root, corners) in roots.into_iter().enumerate() {
            grower.add(corners, root as u32);
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
                leaves.retain(|&l| l != leaf);
            }
        }
        self.nodes[leaf as usize].children = Some(self.nodes.len() as u32);
        self.leaves += 1;
        self.add([a, middle, c], root);
        self.add([middle, b, c], root);
    }

    /// Adds a leaf and enters it at its edges; an edge has one place in the queue.
    fn add(&mut self, vertices: [VertexId; 3], root: u32) {
        let id = self.nodes.len() as u32;
        self.nodes.push(Node { vertices, children: None, root, elements: 0..0 });
        for edge in edges(vertices) {
            let (p, q) = (self.vertices[edge.0.index()], self.vertices[edge.1.index()]);
            self.at_edge
                .entry(edge)
                .or_insert_with(|| {
                    self.queue.push((Length::of(self.grade.squared_length(p, q)), Reverse(edge)));
                    Vec::with_capacity(2)
                })
                .push(id);
        }
    }
}
