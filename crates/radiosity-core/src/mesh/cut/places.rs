//! Vertices by their place, so that what lies in one place is one vertex.

use glam::DVec3;
use rustc_hash::FxHashMap;
use scene::VertexId;

use super::Surface;
use super::contact::End;

/// How far a vertex may be out of a plane to lie in it, as a share of what is near: a billionth
/// of the scene's extent, which is what the solver takes to be in a shooter's plane.
const FLAT: f64 = 1e-3;

/// The vertices, and the way to those near a place.
pub(super) struct Places<'a> {
    vertices: &'a mut Vec<DVec3>,
    near: f64,
    /// Vertices by the cell of a grid that they lie in; looked up, never walked.
    cells: FxHashMap<[i64; 3], Vec<VertexId>>,
}

impl<'a> Places<'a> {
    /// The vertices so far; places up to `near` apart count as one.
    pub(super) fn new(vertices: &'a mut Vec<DVec3>, near: f64) -> Self {
        let mut places = Self { vertices, near, cells: FxHashMap::default() };
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

    /// The vertex of a triangle's plane where a cut ends.
    pub(super) fn vertex_of(&mut self, end: End, surface: &Surface) -> VertexId {
        match end {
            // Corners that should be one, but are not to the bit, are one for cuts.
            End::Corner(vertex) => self.vertex_at(self.position(vertex), surface),
            End::Edge(place) => self.vertex_at(place, surface),
        }
    }

    /// The first of the vertices in a triangle's plane near a place, or a new one if none is near.
    ///
    /// A piece that is bent out of its plane, by no more than what is near, lies partly before the
    /// rest of the triangle, and they would light each other.
    pub(super) fn vertex_at(&mut self, place: DVec3, surface: &Surface) -> VertexId {
        let origin = self.position(surface.corners[0]);
        let height = |place: DVec3| (place - origin).dot(surface.normal);
        let flat = FLAT * self.near;
        let over = height(place);
        let place = if over.abs() <= flat { place } else { place - surface.normal * over };
        let first = self.first_near(place, |there| height(there).abs() <= flat);
        first.unwrap_or_else(|| self.add(place))
    }

    /// The first of the vertices near a place that will do.
    fn first_near(&self, place: DVec3, will_do: impl Fn(DVec3) -> bool) -> Option<VertexId> {
        let [x, y, z] = self.cell(place);
        let mut first: Option<VertexId> = None;
        for dx in -1..=1 {
            for dy in -1..=1 {
                for dz in -1..=1 {
                    let cell = [x.saturating_add(dx), y.saturating_add(dy), z.saturating_add(dz)];
                    for &vertex in self.cells.get(&cell).into_iter().flatten() {
                        let is_first = first.is_none_or(|first| vertex < first);
                        let there = self.position(vertex);
                        if is_first && there.distance(place) <= self.near && will_do(there) {
                            first = Some(vertex);
                        }
                    }
                }
            }
        }
        first
    }

    fn add(&mut self, place: DVec3) -> VertexId {
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
        let mut vertices = vec![DVec3::ZERO, DVec3::X, DVec3::Y];
        let mut places = Places::new(&mut vertices, 0.01);
        let corners = [0, 1, 2].map(VertexId);
        let floor = Surface { corners, normal: DVec3::Z, lit: [true, false] };
        let at = |places: &mut Places<'_>, place: DVec3| places.vertex_at(place, &floor);
        for way in [DVec3::X, DVec3::NEG_X, DVec3::new(0.6, -0.8, 0.0), DVec3::NEG_Y] {
            assert_eq!(at(&mut places, way * 0.0099), VertexId(0));
        }
        assert_eq!(at(&mut places, DVec3::X * 1.002), VertexId(1));
        let new = at(&mut places, DVec3::NEG_X * 0.0101);
        assert_eq!((new, places.position(new)), (VertexId(3), DVec3::NEG_X * 0.0101));
        // Between two, the first.
        assert_eq!(at(&mut places, DVec3::NEG_X * 0.006), VertexId(0));
        assert_eq!(at(&mut places, DVec3::NEG_X * 0.0102), VertexId(3));
        // Far away, all cells are one, and places are still told apart.
        let [a, b] = [1e300, 2e300].map(|x| at(&mut places, DVec3::X * x));
        assert_ne!(a, b);
    }

    #[test]
    fn a_vertex_for_a_plane_lies_in_it() {
        let above = DVec3::new(0.5, 0.2, 0.009);
        let mut vertices = vec![DVec3::ZERO, DVec3::X, DVec3::Y, above];
        let mut places = Places::new(&mut vertices, 0.01);
        let corners = [0, 1, 2].map(VertexId);
        let floor = Surface { corners, normal: DVec3::Z, lit: [true, false] };
        let wall = Surface { corners: [VertexId(0), VertexId(2), VertexId(3)], ..floor };
        let wall = Surface { normal: DVec3::new(0.009, 0.0, -0.5).normalize(), ..wall };
        let foot = places.vertex_of(End::Corner(VertexId(3)), &floor);
        assert_eq!((foot, places.position(foot)), (VertexId(4), DVec3::new(0.5, 0.2, 0.0)));
        // From then on it is there; the wall keeps its own, and a corner of both serves both.
        assert_eq!(places.vertex_at(above, &floor), foot);
        assert_eq!(places.vertex_of(End::Corner(VertexId(3)), &wall), VertexId(3));
        assert_eq!(places.vertex_at(DVec3::new(0.001, 0.0, 0.009), &floor), VertexId(0));
    }
}
