//! Proof that nothing is visible: triangles of one plane cover all that two polygons see of one
//! another through it.

use glam::DVec3;

use crate::clip::cut;
use crate::corners::Corners;
use crate::shadow::Blocker;

/// Planes to try: a wall that covers all is among the first few or not there.
const MOST_PLANES: usize = 16;

/// Corners of the one times corners of the other beyond which no proof is tried.
const MOST_CORNERS: usize = 64;

/// Whether no straight line from `one` to `two` gets past the blockers of some plane.
pub(crate) fn covers(blockers: &[&Blocker], one: &[DVec3], two: &[DVec3], touches: f64) -> bool {
    if one.len() * two.len() > MOST_CORNERS {
        return false;
    }
    let mut tried: Vec<&Blocker> = Vec::new();
    for &blocker in blockers {
        let height = |corner: DVec3| blocker.normal.dot(corner - blocker.corners[0]);
        let in_plane = |other: &Blocker| other.corners.iter().all(|&c| height(c).abs() <= touches);
        if tried.iter().any(|other| in_plane(other)) {
            continue;
        }
        if tried.len() == MOST_PLANES {
            return false;
        }
        tried.push(blocker);
        let Some(section) = section(one, two, height, blocker.normal) else { continue };
        let (mut open, mut next) = (vec![section], Vec::new());
        for other in blockers.iter().copied().filter(|other| in_plane(other)) {
            let sides = sides(other);
            for fragment in open.drain(..) {
                subtract(fragment, &sides, touches, &mut next);
            }
            std::mem::swap(&mut open, &mut next);
        }
        if open.is_empty() {
            return true;
        }
    }
    false
}

/// The part of a plane that lies between two polygons on either side of it: the hull of the
/// crossings of the lines from corner to corner. `None` if they are not on either side.
fn section(
    one: &[DVec3],
    two: &[DVec3],
    height: impl Fn(DVec3) -> f64,
    normal: DVec3,
) -> Option<Corners> {
    let signs = |corners: &[DVec3], sign: f64| corners.iter().all(|&c| height(c) * sign > 0.0);
    if !(signs(one, 1.0) && signs(two, -1.0) || signs(one, -1.0) && signs(two, 1.0)) {
        return None;
    }
    let crossing = |p: DVec3, q: DVec3| p + (q - p) * (height(p) / (height(p) - height(q)));
    let crossings = one.iter().flat_map(|&p| two.iter().map(move |&q| (p, q)));
    Some(hull(crossings.map(|(p, q)| crossing(p, q)).collect(), normal))
}

/// The convex hull of points in a plane (Andrew 1979).
fn hull(mut points: Vec<DVec3>, normal: DVec3) -> Corners {
    let across = normal.any_orthonormal_vector();
    let up = normal.cross(across);
    let place = |p: &DVec3| (p.dot(across), p.dot(up));
    points.sort_by(|p, q| {
        let ((px, py), (qx, qy)) = (place(p), place(q));
        px.total_cmp(&qx).then(py.total_cmp(&qy))
    });
    let half = |points: &mut dyn Iterator<Item = DVec3>| {
        let mut chain: Vec<DVec3> = Vec::new();
        for point in points {
            while let [.., p, q] = chain[..]
                && (q - p).cross(point - q).dot(normal) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain.pop();
        chain
    };
    let lower = half(&mut points.iter().copied());
    let upper = half(&mut points.iter().rev().copied());
    lower.into_iter().chain(upper).collect()
}

/// A place on a plane and the plane's outward normal.
type Plane = (DVec3, DVec3);

/// Adds to `out` what of a convex polygon lies outside of all the planes' common inside.
fn subtract(fragment: Corners, planes: &[Plane], touches: f64, out: &mut Vec<Corners>) {
    let mut rest = fragment;
    for &(on, normal) in planes {
        out.extend(cut(&rest, normal, on, touches));
        match cut(&rest, -normal, on, touches) {
            Some(inside) => rest = inside,
            None => return,
        }
    }
}

/// The outward planes through a blocker's edges, upright on it.
fn sides(blocker: &Blocker) -> Vec<Plane> {
    let corners = &blocker.corners;
    let side = |i: usize| {
        let (from, to) = (corners[i], corners[(i + 1) % corners.len()]);
        (from, (to - from).cross(blocker.normal).normalize_or_zero())
    };
    (0..corners.len()).map(side).filter(|side| side.1 != DVec3::ZERO).collect()
}
