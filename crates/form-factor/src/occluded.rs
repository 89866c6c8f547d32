//! The form factor of two polygons with occluders in between.
//!
//! From points of the smaller polygon, what is visible of the larger one is cut out exactly and
//! has Lambert's exact form factor; the mean over the smaller one is taken by halving where it
//! is not yet settled. Visibility is thus inside the integral, and thin slits are not missed.

use glam::DVec3;

use crate::between::exchange;
use crate::clip::{area_vector, cut};
use crate::corners::Corners;
use crate::cover::covers;
use crate::merge::merge;
use crate::pair::{Pair, Part, TOUCHES};
use crate::search::Search;
use crate::shadow::Blocker;
use crate::shaft::Shaft;
use crate::{Estimate, Occluders, Polygon, between};

/// Absolute error of a form factor below which nothing more is computed, whatever the
/// tolerance: light below a billionth is none.
pub const FLOOR: f64 = 1e-9;

/// Points on the smaller polygon that one pair may take: some tens of milliseconds.
pub const MOST_POINTS: u32 = 1 << 16;

/// The share of the tolerance that the light without occluders may take.
const CLEAR: f64 = 0.1;

/// The form factor from `a` to `b` behind `occluders`, to a relative `tolerance`.
///
/// Both sides of an occluder block. Those in the plane of a polygon, behind it or at its rim do
/// not: the polygons themselves and the neighbouring walls of a room may be among them. Never
/// more than with nothing in between. Below [`FLOOR`] the tolerance is absolute; a pair that takes
/// more than [`MOST_POINTS`] is left with the error that [`Estimate::error`] then states.
#[must_use]
pub fn between_occluded(
    a: &Polygon,
    b: &Polygon,
    occluders: &Occluders,
    tolerance: f64,
) -> Estimate {
    let Some(pair) = Pair::new(a, b) else { return Estimate::NOTHING };
    let touches = TOUCHES * pair.frame.extent;
    let blockers = candidates(&pair, occluders, touches);
    if blockers.is_empty() {
        return between(a, b, tolerance);
    }
    if covers(&blockers, &pair.small.corners, &pair.large.corners, touches) {
        return Estimate::NOTHING;
    }
    let clear = exchange(&pair.small, &pair.large, tolerance * CLEAR);
    let floor = FLOOR * pair.small.area;
    let mut search = Search::new(&pair, &blockers, touches, MOST_POINTS);
    search.visible(clear, tolerance, floor).seen_from(pair.from_area)
}

/// The occluders that may stand between, cut to what lies in front of both polygons.
fn candidates(pair: &Pair, occluders: &Occluders, touches: f64) -> Vec<Blocker> {
    let (small, large) = (&pair.small, &pair.large);
    let frame = pair.frame;
    let shaft = Shaft::new(&small.corners, &large.corners, touches);
    let mut polygons: Vec<Corners> = Vec::new();
    occluders.visit(
        |bounds| shaft.meets(&frame.bounds(bounds)),
        |triangle| {
            let corners = triangle.map(|corner| frame.to_frame(corner));
            if blocker(&corners, small, large, touches)
                .is_some_and(|blocker| shaft.meets_polygon(&blocker.corners))
            {
                polygons.push(corners.into_iter().collect());
            }
        },
    );
    merge(&mut polygons, touches);
    polygons.iter().filter_map(|corners| blocker(corners, small, large, touches)).collect()
}

/// The part of an occluder in front of both polygons; `None` if there is none, or both lie on one
/// side of its plane.
fn blocker(corners: &[DVec3], small: &Part, large: &Part, touches: f64) -> Option<Blocker> {
    let normal = area_vector(corners).try_normalize()?;
    let height = |corner: DVec3| normal.dot(corner - corners[0]);
    let heights = small.corners.iter().chain(large.corners.iter()).map(|&c| height(c));
    let (low, high) = heights.fold((0.0f64, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
    if low >= -touches || high <= touches {
        return None;
    }
    let corners = cut(corners, small.normal, small.corners[0], touches)?;
    let corners = cut(&corners, large.normal, large.corners[0], touches)?;
    Some(Blocker { corners, normal })
}
