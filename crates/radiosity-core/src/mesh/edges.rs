//! The edges of a growing mesh: which leaves lie at each, and how long it is.
//!
//! Leaves know their edges by number, so that growing looks nothing up by vertices.

use std::cmp::Reverse;

use glam::DVec3;
use rustc_hash::FxHashMap;
use scene::VertexId;
use smallvec::SmallVec;

use super::Node;
use super::cut::{Edge, edge};

/// The number of an edge.
pub(super) type EdgeId = u32;

/// All edges there are and were: 48 bytes each, and 12 for each node.
#[derive(Default)]
pub(super) struct Edges {
    all: Vec<Record>,
    /// Of each node, from each corner to the next.
    of_nodes: Vec<[EdgeId; 3]>,
}

struct Record {
    ends: Edge,
    squared: Length,
    /// At most two unless surfaces meet there; none once it is halved.
    leaves: SmallVec<[u32; 2]>,
}

/// A squared length, ordered: never NaN, since vertices are finite.
#[derive(Clone, Copy, PartialEq)]
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

impl Edges {
    /// Those of the leaves among these nodes; no leaf is entered at them yet.
    pub(super) fn of_leaves(nodes: &[Node], vertices: &[DVec3]) -> Self {
        let mut edges = Self { all: Vec::new(), of_nodes: vec![[0; 3]; nodes.len()] };
        let mut known: FxHashMap<Edge, EdgeId> = FxHashMap::default();
        for (id, node) in nodes.iter().enumerate().filter(|(_, node)| node.is_leaf()) {
            let [a, b, c] = node.vertices;
            edges.of_nodes[id] = [edge(a, b), edge(b, c), edge(c, a)]
                .map(|ends| *known.entry(ends).or_insert_with(|| edges.add(ends, vertices)));
        }
        edges
    }

    /// A new edge without leaves.
    pub(super) fn add(&mut self, ends: Edge, vertices: &[DVec3]) -> EdgeId {
        let [p, q] = [ends.0, ends.1].map(|v: VertexId| vertices[v.index()]);
        let squared = Length::of((q - p).length_squared());
        self.all.push(Record { ends, squared, leaves: SmallVec::new() });
        self.all.len() as EdgeId - 1
    }

    /// The edges of a leaf, from each corner to the next.
    pub(super) fn of(&self, leaf: u32) -> [EdgeId; 3] {
        self.of_nodes[leaf as usize]
    }

    pub(super) fn ends(&self, edge: EdgeId) -> Edge {
        self.all[edge as usize].ends
    }

    pub(super) fn leaves(&self, edge: EdgeId) -> &[u32] {
        &self.all[edge as usize].leaves
    }

    /// Orders edges by their true length; ties go to the smallest vertices.
    pub(super) fn rank(&self, edge: EdgeId) -> (Length, Reverse<Edge>) {
        let Record { ends, squared, .. } = self.all[edge as usize];
        (squared, Reverse(ends))
    }

    /// Enters the last node at its edges.
    pub(super) fn enter(&mut self, leaf: u32, own: [EdgeId; 3]) {
        if self.of_nodes.len() <= leaf as usize {
            self.of_nodes.resize(leaf as usize + 1, [0; 3]);
        }
        self.of_nodes[leaf as usize] = own;
        for edge in own {
            self.all[edge as usize].leaves.push(leaf);
        }
    }

    /// A leaf is no longer at an edge.
    pub(super) fn leave(&mut self, edge: EdgeId, leaf: u32) {
        self.all[edge as usize].leaves.retain(|l| *l != leaf);
    }

    /// The leaves at an edge that is about to be halved.
    pub(super) fn take_leaves(&mut self, edge: EdgeId) -> SmallVec<[u32; 2]> {
        std::mem::take(&mut self.all[edge as usize].leaves)
    }
}
