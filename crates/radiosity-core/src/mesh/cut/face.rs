//! One triangle with its cuts, to pieces: a constrained Delaunay triangulation in its plane.

use std::collections::BTreeSet;

use scene::VertexId;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::drawing::{Drawing, Line};
use super::places::Places;
use super::{Edge, Surface, edge};
use crate::mesh::triangle_area;
use crate::mesh::weld::unit_normal;

/// What is to be done to a triangle.
#[derive(Default)]
pub(super) struct Face {
    /// Cuts from vertex to vertex.
    pub(super) across: Vec<[VertexId; 2]>,
    /// Cuts along which nothing stands: light is the same on both sides of them.
    pub(super) seams: Vec<[VertexId; 2]>,
    /// Vertices on edges.
    pub(super) on_edges: Vec<(Edge, VertexId)>,
    /// Parts of edges along which something stands, from vertex to vertex.
    pub(super) along: Vec<(Edge, [VertexId; 2])>,
}

/// What counts as 0 beside an edge of length 1: far below the rounding of f64, and above the
/// 1e-43 that spade refuses.
const NEXT_TO_NOTHING: f64 = 1e-30;

impl Face {
    /// The pieces, in the winding of the triangle, and the edges along contacts; `None` if the
    /// triangle cannot be triangulated, or if it is soon clear that it falls into more than
    /// `room` pieces.
    pub(super) fn cut(
        &self,
        surface: &Surface,
        places: &mut Places<'_>,
        room: usize,
    ) -> Option<(Vec<[VertexId; 3]>, Vec<Edge>)> {
        let mut drawing = Drawing::new(surface, places);
        let mut barriers = Vec::new();
        let rim = self.rim(surface, &mut drawing, places, &mut barriers);
        let lines = self.lines(surface, &mut drawing, places, room)?;
        let mut pieces = triangulate(&drawing, &rim, &lines, &mut barriers)?;
        let area = |v: &[VertexId; 3]| triangle_area(v.map(|v| places.position(v)));
        pieces.retain(|v| unit_normal(v.map(|v| places.position(v))).is_some());
        // The rim may bend by what is near, and a piece without area may be left out.
        let corner = surface.corners.map(|v| places.position(v));
        let around: f64 = (0..3).map(|k| corner[k].distance(corner[(k + 1) % 3])).sum();
        let lost = pieces.iter().map(area).sum::<f64>() - area(&surface.corners);
        (lost.abs() <= places.near() * around).then_some((pieces, barriers))
    }

    /// The edges of the triangle, parted at the vertices on them.
    fn rim(
        &self,
        surface: &Surface,
        drawing: &mut Drawing,
        places: &Places<'_>,
        barriers: &mut Vec<Edge>,
    ) -> BTreeSet<Line> {
        let mut rim = BTreeSet::new();
        for k in 0..3 {
            let at = surface.edge(k);
            let ends = [surface.corners[k], surface.corners[(k + 1) % 3]];
            let along = self.along.iter().filter(|(e, _)| *e == at).map(|(_, ends)| *ends);
            let on = self.on_edges.iter().filter(|(e, _)| *e == at).map(|(_, v)| *v);
            let mut chain: Vec<usize> = ends
                .into_iter()
                .chain(on)
                .chain(along.clone().flatten())
                .map(|v| drawing.point(v, places))
                .collect();
            drawing.sort_along(&mut chain, ends, places);
            let spot = |v| chain.iter().position(|&i| drawing.vertices[i] == v);
            let stands: Vec<_> = along
                .filter_map(|ends| Some((spot(ends[0])?, spot(ends[1])?)))
                .map(|(a, b)| a.min(b)..a.max(b))
                .collect();
            for (n, pair) in chain.windows(2).enumerate() {
                let (i, j) = (pair[0], pair[1]);
                rim.insert((i.min(j), i.max(j)));
                if stands.iter().any(|span| span.contains(&n)) {
                    barriers.push(edge(drawing.vertices[i], drawing.vertices[j]));
                }
            }
        }
        rim
    }

    /// The cuts, parted where they cross or touch each other.
    fn lines(
        &self,
        surface: &Surface,
        drawing: &mut Drawing,
        places: &mut Places<'_>,
        room: usize,
    ) -> Option<Lines> {
        let [across, seams] = [&self.across, &self.seams].map(|cuts| {
            let mut whole: Vec<Line> = Vec::new();
            for ends in cuts {
                let [i, j] = ends.map(|v| drawing.point(v, places));
                whole.push((i.min(j), i.max(j)));
            }
            whole.sort_unstable();
            whole.dedup();
            whole
        });
        let all = [across.as_slice(), seams.as_slice()].concat();
        // Each cut adds a piece or more, and so does each point beyond the corners.
        let most = room.saturating_add(3);
        if all.len() > room || !drawing.add_crossings(&all, surface, places, most) {
            return None;
        }
        let across = drawing.parted(&across);
        let mut seams = drawing.parted(&seams);
        seams.retain(|line| !across.contains(line));
        Some(Lines { across, seams })
    }
}

/// Lines that do not cross each other.
struct Lines {
    across: BTreeSet<Line>,
    /// Those along which nothing stands.
    seams: BTreeSet<Line>,
}

/// A point of a triangulation, and its number in the drawing.
struct Spot {
    at: Point2<f64>,
    number: usize,
}

impl HasPosition for Spot {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.at
    }
}

/// The pieces of a drawing with lines that do not cross, or `None` if its numbers are beyond
/// what can be triangulated.
fn triangulate(
    drawing: &Drawing,
    rim: &BTreeSet<Line>,
    lines: &Lines,
    barriers: &mut Vec<Edge>,
) -> Option<Vec<[VertexId; 3]>> {
    let mut mesh = ConstrainedDelaunayTriangulation::<Spot>::new();
    let mut handles: Vec<FixedVertexHandle> = Vec::with_capacity(drawing.at.len());
    for (number, at) in drawing.at.iter().enumerate() {
        // What is next to nothing beside an edge of length 1 may be below what spade takes.
        let [x, y] = at.to_array().map(|c| if c.abs() < NEXT_TO_NOTHING { 0.0 } else { c });
        handles.push(mesh.insert(Spot { at: Point2::new(x, y), number }).ok()?);
    }
    for &(i, j) in rim.iter().chain(&lines.across).chain(&lines.seams) {
        // A line that bends towards a point on it, by less than what is near, may come to cross
        // another one. That is as rare as three walls that miss each other by a hair.
        let (from, to) = (handles[i], handles[j]);
        if from != to && mesh.can_add_constraint(from, to) {
            mesh.add_constraint(from, to);
        }
    }
    let vertex = |number: usize| drawing.vertices[number];
    for line in mesh.undirected_edges().filter(|line| line.is_constraint_edge()) {
        let [i, j] = line.vertices().map(|spot| spot.data().number);
        let line = (i.min(j), i.max(j));
        if !rim.contains(&line) && !lines.seams.contains(&line) {
            barriers.push(edge(vertex(i), vertex(j)));
        }
    }
    let outside = outside(&mesh);
    let inside = mesh.inner_faces().filter(|face| !outside[face.fix().index()]);
    Some(inside.map(|face| face.vertices().map(|spot| vertex(spot.data().number))).collect())
}

/// For each face, whether it lies outside the rim: the points of the rim are on straight lines
/// but for rounding, so that slivers may lie between it and the hull.
fn outside(mesh: &ConstrainedDelaunayTriangulation<Spot>) -> Vec<bool> {
    let mut outside = vec![false; mesh.num_all_faces()];
    outside[mesh.outer_face().fix().index()] = true;
    // A sliver is rarely more than one face deep, so that two passes will do.
    let mut spreads = true;
    while spreads {
        spreads = false;
        for line in mesh.undirected_edges().filter(|line| !line.is_constraint_edge()) {
            let side = line.as_directed();
            let [a, b] = [side.face(), side.rev().face()].map(|face| face.fix().index());
            if outside[a] != outside[b] {
                (outside[a], outside[b], spreads) = (true, true, true);
            }
        }
    }
    outside
}
