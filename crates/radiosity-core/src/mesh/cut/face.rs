//! One triangle with its cuts, to pieces: a constrained Delaunay triangulation in its plane.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3};
use scene::VertexId;
use spade::handles::FixedVertexHandle;
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation};

use super::places::Places;
use super::{Edge, Surface, edge};
use crate::mesh::triangle_area;
use crate::mesh::weld::unit_normal;

/// What is to be done to a triangle.
#[derive(Default)]
pub(super) struct Face {
    /// Cuts from vertex to vertex.
    pub(super) across: Vec<[VertexId; 2]>,
    /// Vertices on edges.
    pub(super) on_edges: Vec<(Edge, VertexId)>,
    /// Parts of edges along which something stands, from vertex to vertex.
    pub(super) along: Vec<(Edge, [VertexId; 2])>,
}

/// What counts as 0 beside an edge of length 1: far below the rounding of f64, and above the
/// 1e-43 that spade refuses.
const NEXT_TO_NOTHING: f64 = 1e-30;

/// Two points that a line joins, the smaller number first.
type Line = (usize, usize);

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
        let across = self.across(&mut drawing, places, room)?;
        let mut pieces = triangulate(&drawing, &rim, &across, &mut barriers)?;
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
            for pair in chain.windows(2) {
                let (i, j) = (pair[0], pair[1]);
                rim.insert((i.min(j), i.max(j)));
                let stands = along.clone().any(|ends| {
                    let spot = |v| chain.iter().position(|&i| drawing.vertices[i] == v);
                    let here = chain.iter().position(|&c| c == i);
                    match (spot(ends[0]), spot(ends[1]), here) {
                        (Some(a), Some(b), Some(here)) => (a.min(b)..a.max(b)).contains(&here),
                        _ => false,
                    }
                });
                if stands {
                    barriers.push(edge(drawing.vertices[i], drawing.vertices[j]));
                }
            }
        }
        rim
    }

    /// The cuts, parted where they cross or touch each other.
    fn across(
        &self,
        drawing: &mut Drawing,
        places: &mut Places<'_>,
        room: usize,
    ) -> Option<BTreeSet<Line>> {
        let mut whole: Vec<Line> = Vec::new();
        for ends in &self.across {
            let [i, j] = ends.map(|v| drawing.point(v, places));
            whole.push((i.min(j), i.max(j)));
        }
        whole.sort_unstable();
        whole.dedup();
        // Each cut adds a piece or more, and so does each point beyond the corners.
        let most = room.saturating_add(3);
        if whole.len() > room || !drawing.add_crossings(&whole, places, most) {
            return None;
        }
        Some(drawing.parted(&whole))
    }
}

/// The triangle in coordinates of its plane, its longest edge being 1.
struct Drawing {
    origin: DVec3,
    axes: [DVec3; 2],
    scale: f64,
    /// What counts as near, in these coordinates.
    near: f64,
    vertices: Vec<VertexId>,
    at: Vec<DVec2>,
    /// The points by their vertices.
    numbers: BTreeMap<VertexId, usize>,
}

impl Drawing {
    fn new(surface: &Surface, places: &Places<'_>) -> Self {
        let corner = surface.corners.map(|v| places.position(v));
        let length = |k: usize| corner[k].distance_squared(corner[(k + 1) % 3]);
        let longest = (0..3).max_by(|&a, &b| length(a).total_cmp(&length(b))).unwrap_or(0);
        let scale = length(longest).sqrt();
        let x = (corner[(longest + 1) % 3] - corner[longest]) / scale;
        let mut drawing = Self {
            origin: corner[longest],
            axes: [x, surface.normal.cross(x)],
            scale,
            near: places.near() / scale,
            vertices: Vec::new(),
            at: Vec::new(),
            numbers: BTreeMap::new(),
        };
        for v in surface.corners {
            drawing.point(v, places);
        }
        drawing
    }

    /// The point of a vertex, entered if it is new.
    fn point(&mut self, vertex: VertexId, places: &Places<'_>) -> usize {
        if let Some(&number) = self.numbers.get(&vertex) {
            return number;
        }
        let from = (places.position(vertex) - self.origin) / self.scale;
        let number = self.vertices.len();
        self.vertices.push(vertex);
        self.at.push(DVec2::from(self.axes.map(|axis| from.dot(axis))));
        self.numbers.insert(vertex, number);
        number
    }

    /// The place of a point in space.
    fn place(&self, at: DVec2) -> DVec3 {
        self.origin + (self.axes[0] * at.x + self.axes[1] * at.y) * self.scale
    }

    /// Orders points along an edge, and leaves out those that are there twice.
    fn sort_along(&self, chain: &mut Vec<usize>, ends: [VertexId; 2], places: &Places<'_>) {
        // In the same direction from both sides of the edge, and so with the same ties.
        let [from, to] = [ends[0].min(ends[1]), ends[0].max(ends[1])].map(|v| places.position(v));
        let along = |i: usize| (places.position(self.vertices[i]) - from).dot(to - from);
        chain.sort_by(|&i, &j| {
            along(i).total_cmp(&along(j)).then(self.vertices[i].cmp(&self.vertices[j]))
        });
        chain.dedup();
    }

    /// Adds the points in which segments cross each other, unless there are more than `most`
    /// points then.
    fn add_crossings(&mut self, segments: &[Line], places: &mut Places<'_>, most: usize) -> bool {
        let spans = |&(i, j): &Line| {
            let [p, q] = [self.at[i], self.at[j]];
            [p.min(q), p.max(q)]
        };
        let mut order: Vec<([DVec2; 2], Line)> = segments.iter().map(|s| (spans(s), *s)).collect();
        order.sort_by(|a, b| a.0[0].x.total_cmp(&b.0[0].x).then(a.1.cmp(&b.1)));
        for (n, (span, s)) in order.iter().enumerate() {
            for (other, t) in &order[n + 1..] {
                if other[0].x > span[1].x {
                    break;
                }
                if other[0].y <= span[1].y
                    && span[0].y <= other[1].y
                    && let Some(at) = self.crossing(*s, *t)
                {
                    let vertex = places.vertex_at(self.place(at));
                    self.point(vertex, places);
                }
            }
            if self.at.len() > most {
                return false;
            }
        }
        true
    }

    /// Where two segments cross inside of both.
    fn crossing(&self, s: Line, t: Line) -> Option<DVec2> {
        let [a, b, c, d] = [s.0, s.1, t.0, t.1].map(|i| self.at[i]);
        let (r, w) = (b - a, d - c);
        let turn = r.perp_dot(w);
        let u = (c - a).perp_dot(w) / turn;
        let v = (c - a).perp_dot(r) / turn;
        let inside = |x: f64| x > 0.0 && x < 1.0;
        // Where one stays near the other all along, their ends part them.
        let parallel = turn.abs() <= self.near * r.length().max(w.length());
        (!parallel && inside(u) && inside(v)).then(|| a + r * u)
    }

    /// The segments, parted at all points that lie on them.
    fn parted(&self, segments: &[Line]) -> BTreeSet<Line> {
        let mut by_x: Vec<usize> = (0..self.at.len()).collect();
        by_x.sort_by(|&i, &j| self.at[i].x.total_cmp(&self.at[j].x).then(i.cmp(&j)));
        let mut parts = BTreeSet::new();
        for &(i, j) in segments {
            let [p, q] = [self.at[i], self.at[j]];
            let (way, length) = ((q - p).normalize_or_zero(), p.distance(q));
            let [low, high] = [p.x.min(q.x) - self.near, p.x.max(q.x) + self.near];
            let start = by_x.partition_point(|&k| self.at[k].x < low);
            let mut on: Vec<(f64, usize)> = by_x[start..]
                .iter()
                .take_while(|&&k| self.at[k].x <= high)
                .map(|&k| ((self.at[k] - p).dot(way), (self.at[k] - p).perp_dot(way), k))
                .filter(|&(t, off, _)| off.abs() <= self.near && t > 0.0 && t < length)
                .map(|(t, _, k)| (t, k))
                .filter(|&(_, k)| k != i && k != j)
                .collect();
            on.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            let stops: Vec<usize> =
                [i].into_iter().chain(on.into_iter().map(|(_, k)| k)).chain([j]).collect();
            parts.extend(stops.windows(2).map(|w| (w[0].min(w[1]), w[0].max(w[1]))));
        }
        parts
    }
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
    across: &BTreeSet<Line>,
    barriers: &mut Vec<Edge>,
) -> Option<Vec<[VertexId; 3]>> {
    let mut mesh = ConstrainedDelaunayTriangulation::<Spot>::new();
    let mut handles: Vec<FixedVertexHandle> = Vec::with_capacity(drawing.at.len());
    for (number, at) in drawing.at.iter().enumerate() {
        // What is next to nothing beside an edge of length 1 may be below what spade takes.
        let [x, y] = at.to_array().map(|c| if c.abs() < NEXT_TO_NOTHING { 0.0 } else { c });
        handles.push(mesh.insert(Spot { at: Point2::new(x, y), number }).ok()?);
    }
    for &(i, j) in rim.iter().chain(across) {
        // A line that bends towards a point on it, by less than what is near, may come to cross
        // another one. That is as rare as three walls that miss each other by a hair.
        if mesh.can_add_constraint(handles[i], handles[j]) {
            mesh.add_constraint(handles[i], handles[j]);
        }
    }
    let vertex = |number: usize| drawing.vertices[number];
    for line in mesh.undirected_edges().filter(|line| line.is_constraint_edge()) {
        let [i, j] = line.vertices().map(|spot| spot.data().number);
        if !rim.contains(&(i.min(j), i.max(j))) {
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
