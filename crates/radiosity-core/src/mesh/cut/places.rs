//! Vertices by their place, so that what lies in one place is one vertex.

use std::collections::HashMap;

use glam::DVec3;
use scene::VertexId;

/// The vertices, and the way to those near a place.
pub(super) struct Places<'a> {
    vertices: &'a mut Vec<DVec3>,
    near: f64,
    /// Vertices by the cell of a grid that they lie in; looked up, never walked.
    cells: HashMap<[i64; 3], Vec<VertexId>>,
}

impl<'a> Places<'a> {
    /// The vertices so far; places up to `near` apart count as one.
    pub(super) fn new(vertices: &'a mut Vec<DVec3>, near: f64) -> Self {
        let mut places = Self { vertices, near, cells: HashMap::new() };
        for i in 0..places.vertices.len() {
            places.enter(VertexId::from(i));
        }
        places
    }

    /// How far apart places may be that count as one.
    pub(super) fn near(&self) -> f64 {
        self.near
    }

    /// Where a vertex is.
    pub(super) fn position(&self, vertex: VertexId) -> DVec3 {
        self.vertices[vertex.index()]
    }

    /// The first of the vertices near a place, or a new one if none is near.
    pub(super) fn vertex_at(&mut self, place: DVec3) -> VertexId {
        let [x, y, z] = self.cell(place);
        let mut first: Option<VertexId> = None;
        for dx in -1..=1 {
            for dy in -1..=1 {
                for dz in -1..=1 {
                    let cell = [x.saturating_add(dx), y.saturating_add(dy), z.saturating_add(dz)];
                    for &vertex in self.cells.get(&cell).into_iter().flatten() {
                        let is_first = first.is_none_or(|first| vertex < first);
                        if is_first && self.position(vertex).distance(place) <= self.near {
                            first = Some(vertex);
                        }
                    }
                }
            }
        }
        if let Some(vertex) = first {
            return vertex;
        }
        let vertex = VertexId::from(self.vertices.len());
        self.vertices.push(place);
        self.enter(vertex);
        vertex
    }

    fn enter(&mut self, vertex: VertexId) {
        let cell = self.cell(self.position(vertex));
        self.cells.entry(cell).or_default().push(vertex);
    }

    /// The cell of a place: twice as wide as what counts as near. The conversion brings what
    /// lies beyond the whole numbers to the nearest of them.
    fn cell(&self, place: DVec3) -> [i64; 3] {
        place.to_array().map(|c| (c / (2.0 * self.near)).floor() as i64)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn near_places_are_one_vertex_across_the_walls_of_cells() {
        let mut vertices = vec![DVec3::ZERO, DVec3::X];
        let mut places = Places::new(&mut vertices, 0.01);
        for way in [DVec3::X, DVec3::NEG_X, DVec3::ONE.normalize(), DVec3::NEG_Y] {
            assert_eq!(places.vertex_at(way * 0.0099), VertexId(0));
        }
        assert_eq!(places.vertex_at(DVec3::X * 1.002), VertexId(1));
        let new = places.vertex_at(DVec3::NEG_X * 0.0101);
        assert_eq!((new, places.position(new)), (VertexId(2), DVec3::NEG_X * 0.0101));
        // Between two, the first.
        assert_eq!(places.vertex_at(DVec3::NEG_X * 0.006), VertexId(0));
        assert_eq!(places.vertex_at(DVec3::NEG_X * 0.0102), VertexId(2));
        // Far away, all cells are one, and places are still told apart.
        let [a, b] = [1e300, 2e300].map(|x| places.vertex_at(DVec3::splat(x)));
        assert_ne!(a, b);
    }
}
