//! A triangle and the cuts through it, drawn in its plane.

use std::collections::{BTreeMap, BTreeSet};

use glam::{DVec2, DVec3};
use scene::VertexId;

use super::Surface;
use super::places::Places;

/// Two points that a line joins, the smaller number first.
pub(super) type Line = (usize, usize);

/// The triangle in coordinates of its plane, its longest edge being 1.
pub(super) struct Drawing {
    origin: DVec3,
    axes: [DVec3; 2],
    scale: f64,
    /// What counts as near, in these coordinates.
    near: f64,
    pub(super) vertices: Vec<VertexId>,
    pub(super) at: Vec<DVec2>,
    /// The points by their vertices.
    numbers: BTreeMap<VertexId, usize>,
}

impl Drawing {
    /// The corners of a triangle.
    pub(super) fn new(surface: &Surface, places: &Places<'_>) -> Self {
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
    pub(super) fn point(&mut self, vertex: VertexId, places: &Places<'_>) -> usize {
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
    pub(super) fn sort_along(
        &self,
        chain: &mut Vec<usize>,
        ends: [VertexId; 2],
        places: &Places<'_>,
    ) {
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
    pub(super) fn add_crossings(
        &mut self,
        segments: &[Line],
        surface: &Surface,
        places: &mut Places<'_>,
        most: usize,
    ) -> bool {
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
                    let vertex = places.vertex_at(self.place(at), surface);
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
    pub(super) fn parted(&self, segments: &[Line]) -> BTreeSet<Line> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_parted_where_they_cross_and_where_points_lie_on_them() {
        let at = [[0., 0.], [8., 0.], [0., 8.], [1., 1.], [3., 3.], [1., 3.], [3., 1.]];
        let mut vertices: Vec<DVec3> = at.iter().map(|p| DVec3::new(p[0], p[1], 0.0)).collect();
        let mut places = Places::new(&mut vertices, 1e-6);
        let corners = [0, 1, 2].map(VertexId);
        let surface = Surface { corners, normal: DVec3::Z, lit: [true, false] };
        let mut drawing = Drawing::new(&surface, &places);
        for v in 3..7 {
            assert_eq!(drawing.point(VertexId(v), &places), v as usize);
        }
        // The diagonals of a square of side 2 cross in one more point, the eighth.
        let diagonals = [(3, 4), (5, 6)];
        assert!(!drawing.add_crossings(&diagonals, &surface, &mut places, 7));
        assert!(drawing.add_crossings(&diagonals, &surface, &mut places, 8));
        assert!(places.position(VertexId(7)).distance(DVec3::new(2.0, 2.0, 0.0)) < 1e-12);
        // It lies on both, and on a line along one of them.
        for lines in [vec![(3, 4), (5, 6)], vec![(3, 4), (5, 7), (6, 7), (3, 7)]] {
            let parts = drawing.parted(&lines);
            assert_eq!(parts, BTreeSet::from([(3, 7), (4, 7), (5, 7), (6, 7)]));
        }
    }
}
