//! Where two triangles touch or cross each other: a segment of the line that their planes
//! have in common.
//!
//! Both triangles meet that line in an interval, and the contact is what the intervals share
//! (Möller 1997). Its ends are corners of the triangles, or places where an edge of one goes
//! through the plane of the other. Such a place is computed from the edge, in the order of its
//! vertices, and from the plane alone; so the triangles on both sides of the edge get it with
//! the same bits.

use glam::DVec3;
use scene::VertexId;

use super::Surface;

/// Planes at a smaller angle than this, in radians, have no common line that f64 could tell.
const PARALLEL: f64 = 1e-9;

/// A contact of two triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Contact {
    /// Its ends, further apart than what counts as near.
    pub(super) ends: [End; 2],
    /// Which of the two triangles it parts: those of which a lit side has the other one before
    /// it, and not only behind.
    pub(super) parts: [bool; 2],
}

/// An end of a contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum End {
    /// At a corner of one of the triangles.
    Corner(VertexId),
    /// On an edge of one of them.
    Edge(DVec3),
}

/// The contact of two triangles, or `None` if they are coplanar or meet in less than a
/// segment longer than `near`.
pub(super) fn between(vertices: &[DVec3], surfaces: [&Surface; 2], near: f64) -> Option<Contact> {
    let [a, b] = surfaces.map(|s| s.corners.map(|v| vertices[v.index()]));
    // The heights of each one's corners over the other's plane.
    let over_a = heights(b, a[0], surfaces[0].normal, near)?;
    let over_b = heights(a, b[0], surfaces[1].normal, near)?;
    let line = surfaces[0].normal.cross(surfaces[1].normal);
    if line.length() < PARALLEL {
        return None;
    }
    let line = line.normalize();
    let along = |place: DVec3| (place - a[0]).dot(line);
    let first = interval(vertices, surfaces[0], over_b, along)?;
    let second = interval(vertices, surfaces[1], over_a, along)?;
    let start = later(first[0], second[0], near);
    // Seen from the other end of the line, the earlier is the later.
    let turned = |(t, end): (f64, End)| (-t, end);
    let end = turned(later(turned(first[1]), turned(second[1]), near));
    let parts = |over: [f64; 3], lit: [bool; 2]| {
        over.iter().any(|&h| h > 0.0 && lit[0] || h < 0.0 && lit[1])
    };
    (end.0 - start.0 > near).then(|| Contact {
        ends: [start.1, end.1],
        parts: [parts(over_a, surfaces[0].lit), parts(over_b, surfaces[1].lit)],
    })
}

/// Heights of the corners of one triangle over the plane of another, those within `near` as 0;
/// `None` if the triangle lies in the plane, or on one side of it with at most one corner there.
fn heights(corners: [DVec3; 3], origin: DVec3, normal: DVec3, near: f64) -> Option<[f64; 3]> {
    let heights = corners.map(|p| {
        let height = (p - origin).dot(normal);
        if height.abs() <= near { 0.0 } else { height }
    });
    let count = |is: fn(f64) -> bool| heights.iter().filter(|&&h| is(h)).count();
    let (below, on) = (count(|h| h < 0.0), count(|h| h == 0.0));
    let through = below > 0 && below + on < 3;
    (through || on == 2).then_some(heights)
}

/// Where a triangle meets the plane over which its corners have the given heights: two ends
/// with their places along the line, in its order.
fn interval(
    vertices: &[DVec3],
    surface: &Surface,
    heights: [f64; 3],
    along: impl Fn(DVec3) -> f64,
) -> Option<[(f64, End); 2]> {
    let corner = |k: usize| vertices[surface.corners[k].index()];
    let mut ends = [None; 2];
    let mut found = 0;
    let mut add = |place: DVec3, end: End| {
        if let Some(slot) = ends.get_mut(found) {
            *slot = Some((along(place), end));
        }
        found += 1;
    };
    for k in 0..3 {
        if heights[k] == 0.0 {
            add(corner(k), End::Corner(surface.corners[k]));
        }
        let next = (k + 1) % 3;
        if heights[k] * heights[next] < 0.0 {
            let (p, q) =
                if surface.corners[k] < surface.corners[next] { (k, next) } else { (next, k) };
            let place = corner(p).lerp(corner(q), heights[p] / (heights[p] - heights[q]));
            add(place, End::Edge(place));
        }
    }
    let [Some(first), Some(second)] = ends else { return None };
    Some(if first.0 <= second.0 { [first, second] } else { [second, first] })
}

/// The later of two ends; of two in about one place, a corner, and the smaller one.
fn later(a: (f64, End), b: (f64, End), near: f64) -> (f64, End) {
    if (a.0 - b.0).abs() <= near {
        match (a.1, b.1) {
            (End::Corner(v), End::Corner(w)) => {
                if v <= w {
                    a
                } else {
                    b
                }
            }
            (End::Corner(_), _) => a,
            (_, End::Corner(_)) => b,
            _ if a.0 >= b.0 => a,
            _ => b,
        }
    } else if a.0 > b.0 {
        a
    } else {
        b
    }
}
