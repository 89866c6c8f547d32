//! Triangles over numbered places: which share a corner, and which an edge.

use glam::DVec3;

/// Places, each once, and the triangles' corners among them.
pub(super) struct Welded {
    pub(super) places: Vec<DVec3>,
    pub(super) corners: Vec<[u32; 3]>,
}

/// An edge of a triangle: its ends, the lesser first; the triangle; and which corner faces it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Edge {
    pub(super) ends: [u32; 2],
    pub(super) triangle: u32,
    pub(super) opposite: u8,
}

impl Welded {
    /// Gives bitwise equal places one number, in the order of their coordinates' bits.
    pub(super) fn of(triangles: &[[DVec3; 3]]) -> Self {
        // Adding 0 turns −0 into 0.
        let key = |p: &DVec3| (*p + DVec3::ZERO).to_array().map(f64::to_bits);
        let mut keys: Vec<([u64; 3], u32)> = triangles.iter().flatten().map(key).zip(0..).collect();
        keys.sort_unstable();
        let mut welded = Self { places: Vec::new(), corners: vec![[0; 3]; triangles.len()] };
        let mut last = None;
        for (key, slot) in keys {
            if last != Some(key) {
                last = Some(key);
                welded.places.push(DVec3::from_array(key.map(f64::from_bits)));
            }
            let slot = slot as usize;
            welded.corners[slot / 3][slot % 3] = welded.places.len() as u32 - 1;
        }
        welded
    }

    /// The edges of the triangles that `takes_part`, those of the same ends side by side.
    pub(super) fn edges(&self, takes_part: impl Fn(usize) -> bool) -> Vec<Edge> {
        let mut edges = Vec::with_capacity(3 * self.corners.len());
        for (triangle, c) in self.corners.iter().enumerate().filter(|(t, _)| takes_part(*t)) {
            for opposite in 0..3u8 {
                let (a, b) = (c[(opposite as usize + 1) % 3], c[(opposite as usize + 2) % 3]);
                let triangle = triangle as u32;
                edges.push(Edge { ends: [a.min(b), a.max(b)], triangle, opposite });
            }
        }
        edges.sort_unstable();
        edges
    }
}

/// Union–find: the smallest member stands for its set.
pub(super) struct Sets(Vec<u32>);

impl Sets {
    pub(super) fn new(members: usize) -> Self {
        Self((0..members as u32).collect())
    }

    pub(super) fn leader(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            // Halving the way keeps later ways short.
            let next = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = next;
            i = next;
        }
        i
    }

    pub(super) fn join(&mut self, a: u32, b: u32) -> u32 {
        let (a, b) = (self.leader(a), self.leader(b));
        self.0[a.max(b) as usize] = a.min(b);
        a.min(b)
    }
}
