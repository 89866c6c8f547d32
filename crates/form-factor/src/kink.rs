//! Lines on which what is visible has a kink: the edge of a shadow passes a corner there.

use glam::DVec3;

use crate::clip::{area_vector, cut};
use crate::pair::Part;
use crate::shadow::{Blocker, Sight};

/// Blockers whose lines are tried.
const MOST_BLOCKERS: usize = 8;

/// A point of a triangle and what it sees.
#[derive(Clone, Copy, Default)]
pub(crate) struct Probe {
    /// In barycentric coordinates.
    pub(crate) place: [f64; 3],
    /// In the rule; 0 if the point only serves to tell patterns apart.
    pub(crate) weight: f64,
    pub(crate) seen: Sight,
}

/// A place on a plane and the plane's normal.
type Plane = (DVec3, DVec3);

/// A line across a triangle.
#[derive(Clone, Copy)]
pub(crate) struct Kink {
    pub(crate) plane: Plane,
    /// The share of the triangle beyond the line, if all nodes of the rule are on this side.
    pub(crate) overlooked: f64,
}

/// The line that best tells the probes of one pattern of shadows from those of another: in a plane
/// through an edge of a blocker and a corner of the target, or the other way around. Of equals
/// that which passes nearest the triangle's centre; `None` if none tells them apart. Also
/// whether there is any such line at all.
///
/// # References
/// Heckbert 1992, "Discontinuity meshing for radiosity"; Lischinski, Tampieri & Greenberg 1992.
pub(crate) fn kink(
    triangle: &[DVec3; 3],
    probes: &[Probe],
    blockers: &[&Blocker],
    target: &Part,
    touches: f64,
) -> (Option<Kink>, bool) {
    let mut crossed = blockers.len() > MOST_BLOCKERS;
    let alike = same(probes.iter()) == probes.len();
    let mut best: Option<Plane> = None;
    let mut best_score = (same(probes.iter()) + 1, f64::INFINITY);
    let mut attempt = |from: DVec3, to: DVec3, corner: DVec3| {
        let normal = (to - from).cross(corner - from).normalize_or_zero();
        let heights = triangle.map(|c| normal.dot(c - from));
        let (low, high) = range_of(heights);
        if low >= -touches || high <= touches {
            return;
        }
        crossed = true;
        if alike {
            return;
        }
        let above = |p: &&Probe| height(&heights, p) > 0.0;
        let score = same(probes.iter().filter(above)) + same(probes.iter().filter(|p| !above(p)));
        let off_centre = heights.iter().sum::<f64>().abs() / (high - low);
        if score > best_score.0 || (score == best_score.0 && off_centre < best_score.1) {
            best_score = (score, off_centre);
            best = Some((from, normal));
        }
    };
    for blocker in blockers.iter().take(MOST_BLOCKERS) {
        for (from, to) in edges(&blocker.corners) {
            target.corners.iter().for_each(|&corner| attempt(from, to, corner));
        }
        for (from, to) in edges(&target.corners) {
            blocker.corners.iter().for_each(|&corner| attempt(from, to, corner));
        }
    }
    let share = |plane| overlooked(triangle, plane, probes, touches);
    (best.map(|plane| Kink { plane, overlooked: share(plane) }), crossed)
}

/// The share of a triangle beyond a plane, if all nodes of the rule are on this side.
fn overlooked(triangle: &[DVec3; 3], plane: Plane, probes: &[Probe], touches: f64) -> f64 {
    let (on, normal) = plane;
    let heights = triangle.map(|c| normal.dot(c - on));
    let nodes = probes.iter().filter(|p| p.weight > 0.0);
    let above = nodes.clone().filter(|p| height(&heights, p) > 0.0).count();
    if above > 0 && above < nodes.count() {
        return 0.0;
    }
    let beyond = if above > 0 { -normal } else { normal };
    let area = |corners: &[DVec3]| area_vector(corners).length();
    cut(triangle, beyond, on, touches).map_or(0.0, |part| area(&part) / area(triangle))
}

fn height(heights: &[f64; 3], probe: &Probe) -> f64 {
    (0..3).map(|i| heights[i] * probe.place[i]).sum()
}

fn range_of(values: [f64; 3]) -> (f64, f64) {
    values.iter().fold((0.0, 0.0), |(low, high), &x| (x.min(low), x.max(high)))
}

fn edges(corners: &[DVec3]) -> impl Iterator<Item = (DVec3, DVec3)> {
    (0..corners.len()).map(move |i| (corners[i], corners[(i + 1) % corners.len()]))
}

/// The probes of the most common pattern among some.
fn same<'a>(some: impl Iterator<Item = &'a Probe> + Clone) -> usize {
    let of = |p: &Probe| some.clone().filter(|q| q.seen.pattern == p.seen.pattern).count();
    some.clone().map(of).max().unwrap_or(0)
}
