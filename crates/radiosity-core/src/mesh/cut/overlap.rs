//! Where a triangle lies in the plane of an earlier one and over it: what of it is covered.
//!
//! Two surfaces in one plane that face the same way would both take the light of one. The first
//! takes it; of the other, what the first covers takes no part. So the later triangle is cut
//! along the edges of the earlier one, the *seams*, as far as they run over it, and the pieces
//! within are left out. The earlier triangle stays as it is.
//!
//! The place where a seam leaves the later triangle is computed from the edge there, in the
//! order of its vertices, and from the earlier triangle alone; so the triangles on both sides of
//! that edge get it with the same bits.

use glam::DVec3;
use scene::VertexId;

use super::Surface;
use super::contact::End;

/// Planes at a larger angle than this, in radians, are two, however close small triangles in them
/// may come. Corners in one plane but for `near` tilt a triangle by this only if it is itself
/// no larger than a thousand times that.
const SAME_PLANE: f64 = 1e-3;

/// What a triangle covers of a later one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Overlap {
    /// Which lit sides of the later triangle it covers, where it lies over it: front, back.
    pub(super) sides: [bool; 2],
    /// Whether the later triangle lies within it altogether.
    pub(super) whole: bool,
}

/// What the first of two triangles covers of the second, or `None` if they are not in one plane,
/// have no lit sides that face the same way, or touch at most.
pub(super) fn between(vertices: &[DVec3], surfaces: [&Surface; 2], near: f64) -> Option<Overlap> {
    let [earlier, later] = surfaces;
    let facing = earlier.normal.dot(later.normal);
    let [front, back] = if facing > 0.0 { [0, 1] } else { [1, 0] };
    let sides = [earlier.lit[front] && later.lit[0], earlier.lit[back] && later.lit[1]];
    if sides == [false; 2] || earlier.normal.cross(later.normal).length() > SAME_PLANE {
        return None;
    }
    let [first, second] = surfaces.map(|s| s.corners.map(|v| vertices[v.index()]));
    let within = |corners: [DVec3; 3], origin: DVec3, normal: DVec3| {
        corners.iter().all(|p| (*p - origin).dot(normal).abs() <= near)
    };
    let in_plane =
        within(second, first[0], earlier.normal) || within(first, second[0], later.normal);
    // Two convex shapes are apart if, and only if, an edge of one has the other on its far side.
    let reaches = |from: [DVec3; 3], normal: DVec3, to: [DVec3; 3]| {
        (0..3).all(|k| {
            let inward = normal.cross(from[(k + 1) % 3] - from[k]);
            let least = near * inward.length();
            to.iter().any(|p| (*p - from[k]).dot(inward) > least)
        })
    };
    if !in_plane || !reaches(first, earlier.normal, second) || !reaches(second, later.normal, first)
    {
        return None;
    }
    let whole = second.iter().all(|p| contains(first, earlier.normal, *p, near));
    Some(Overlap { sides, whole })
}

/// The parts of the earlier triangle's edges that part the later one, from end to end.
pub(super) fn seams(vertices: &[DVec3], surfaces: [&Surface; 2], near: f64) -> Vec<[End; 2]> {
    let [earlier, later] = surfaces;
    (0..3).filter_map(|k| seam(vertices, earlier, k, later, near)).collect()
}

/// Whether a place in the plane of a triangle lies inside of it, or outside by `near` at most.
pub(super) fn contains(corners: [DVec3; 3], normal: DVec3, place: DVec3, near: f64) -> bool {
    (0..3).all(|k| inside(corners, normal, k, place) >= -near)
}

/// How far a place lies inside of the k-th edge of a triangle, along the plane.
fn inside(corners: [DVec3; 3], normal: DVec3, k: usize, place: DVec3) -> f64 {
    let (from, to) = (corners[k], corners[(k + 1) % 3]);
    // Triangles have area, and so no edge is without length.
    (place - from).dot(normal.cross(to - from).normalize_or_zero())
}

/// The part of the earlier triangle's k-th edge that lies inside of the later one.
fn seam(
    vertices: &[DVec3],
    earlier: &Surface,
    k: usize,
    later: &Surface,
    near: f64,
) -> Option<[End; 2]> {
    let (v, w) = earlier.edge(k);
    let [p, q] = [v, w].map(|v| vertices[v.index()]);
    let corners = later.corners.map(|v| vertices[v.index()]);
    let mut start = (0.0, End::Corner(v));
    let mut end = (1.0, End::Corner(w));
    for k in 0..3 {
        let [from, to] = [p, q].map(|at| {
            let depth = inside(corners, later.normal, k, at);
            if depth.abs() <= near { 0.0 } else { depth }
        });
        if from <= 0.0 && to <= 0.0 {
            return None;
        }
        let at = from / (from - to);
        let place = || End::Edge(crossing(vertices, later, k, [p, q], earlier.normal));
        if from < 0.0 && at > start.0 {
            start = (at, place());
        }
        if to < 0.0 && at < end.0 {
            end = (at, place());
        }
    }
    ((end.0 - start.0) * p.distance(q) > near).then_some([start.1, end.1])
}

/// Where the k-th edge of a triangle crosses the line from p to q, seen along `normal`.
fn crossing(
    vertices: &[DVec3],
    later: &Surface,
    k: usize,
    [p, q]: [DVec3; 2],
    normal: DVec3,
) -> DVec3 {
    let (a, b): (VertexId, VertexId) = later.edge(k);
    let [a, b] = [a, b].map(|v| vertices[v.index()]);
    let across = normal.cross(q - p);
    let [over_a, over_b] = [a, b].map(|at| (at - p).dot(across));
    // A line that misses a corner by less than what is near goes through that corner.
    a.lerp(b, (over_a / (over_a - over_b)).clamp(0.0, 1.0))
}
