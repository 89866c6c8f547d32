//! Longest-edge bisection: halve the longest edge of the mesh until there are enough elements.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap, HashSet};

use glam::DVec3;
use scene::VertexId;

use super::Node;
use super::cut::{Edge, edge};

/// Grows the forest over the given roots to about `elements` leaves: stops when the next
/// edge would leave more than that. Halves of barriers are barriers.
pub(super) fn forest(
    vertices: Vec<DVec3>,
    roots: Vec<[VertexId; 3]>,
    barriers: HashSet<Edge>,
    elements: usize,
) -> (Vec<DVec3>, Vec<Node>, HashSet<Edge>) {
    let mut grower = Grower::new(vertices, roots, barriers);
    while grower.leaves < elements && grower.halve_longest(elements) {}
    (grower.vertices, grower.nodes, grower.barriers)
}

struct Grower {
    vertices: Vec<DVec3>,
    nodes: Vec<Node>,
    leaves: usize,
    /// The leaves at each edge of the present mesh; at most two unless surfaces meet there.
    at_edge: HashMap<Edge, Vec<u32>>,
    /// Edges by length, the longest first; ties go to the smallest vertices.
    queue: BinaryHeap<(Length, Reverse<Edge>)>,
    /// Edges along contacts.
    barriers: HashSet<Edge>,
}

/// A squared length, ordered: never NaN, since vertices are finite.
#[derive(PartialEq)]
struct Length(f64);

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

impl Grower {
    fn new(vertices: Vec<DVec3>, roots: Vec<[VertexId; 3]>, barriers: HashSet<Edge>) -> Self {
        let mut grower = Self {
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

    /// Halves the longest edge, unless that would leave more than `most` leaves.
    fn halve_longest(&mut self, most: usize) -> bool {
        let Some((_, Reverse(edge))) = self.queue.pop() else { return false };
        let leaves = self.at_edge.remove(&edge).unwrap_or_default();
        if self.leaves + leaves.len() > most {
            return false;
        }
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
        true
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
                    self.queue.push((Length((q - p).length_squared()), Reverse(edge)));
                    Vec::with_capacity(2)
                })
                .push(id);
        }
    }
}
