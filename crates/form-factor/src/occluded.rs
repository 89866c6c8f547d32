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
use crate::pair::{Pair, TOUCHES};
use crate::search::Search;
use crate::shadow::{Blocker, Target};
use crate::shaft::Shaft;
use crate::{Estimate, Occluders, Polygon, between};

/// Absolute error of a form factor below which nothing more is computed, whatever the
/// tolerance: light below a billionth is none.
pub const FLOOR: f64 = 1e-9;

/// Points on the smaller polygon that one pair may take: some tenths of a second.
pub const MOST_POINTS: u32 = 1 << 16;

/// The share of the tolerance that the light without occluders may take.
const CLEAR: f64 = 0.1;

/// The error asked of a form factor: it may be off by the larger of the two.
///
/// # Examples
/// ```
/// use form_factor::{Ask, Occluders, Polygon, between_occluded, between_occluded_within};
/// use glam::DVec3;
///
/// let square = |z: f64| [(0., 0.), (1., 0.), (1., 1.), (0., 1.)].map(|(x, y)| DVec3::new(x, y, z));
/// let mut above = square(1.0);
/// above.reverse();
/// let [a, b] = [square(0.0), above].map(|corners| Polygon::new(&corners).unwrap());
/// let [p, q, r] = [(0.1, 0.2), (1.7, 0.1), (0.3, 1.1)].map(|(x, y)| DVec3::new(x, y, 0.6));
/// let screen = Occluders::build(&[[p, q, r]]);
///
/// let quick = between_occluded_within(&a, &b, &screen, Ask { relative: 1e-4, absolute: 1e-3 });
/// let exact = between_occluded(&a, &b, &screen, 1e-4);
/// assert!(quick.error <= 1e-3 && quick.effort < exact.effort);
/// assert!((quick.value - exact.value).abs() <= quick.error + exact.error);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ask {
    /// As a share of the form factor.
    pub relative: f64,
    /// In either direction: what the form factor from the polygon of smaller area may be off by;
    /// that from the larger one is then off by less. Below [`FLOOR`] it counts as [`FLOOR`].
    pub absolute: f64,
}

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
    between_occluded_within(a, b, occluders, Ask { relative: tolerance, absolute: FLOOR })
}

/// The form factor from `a` to `b` behind `occluders`, as [`between_occluded`] has it, but no
/// better than asked: with an absolute error that is of no account, faint and nearly hidden pairs
/// cost little.
#[must_use]
pub fn between_occluded_within(
    a: &Polygon,
    b: &Polygon,
    occluders: &Occluders,
    ask: Ask,
) -> Estimate {
    let Some(pair) = Pair::new(a, b) else { return Estimate::NOTHING };
    let touches = TOUCHES * pair.frame.extent;
    let target = Target::new(&pair.large);
    let blockers = candidates(&pair, occluders, &target, touches);
    if blockers.is_empty() {
        return between(a, b, ask.relative);
    }
    let all: Vec<&Blocker> = blockers.iter().collect();
    if covers(&all, &pair.small.corners, &pair.large.corners, touches) {
        return Estimate { visibility: true, ..Estimate::NOTHING };
    }
    let clear = exchange(&pair.small, &pair.large, ask.relative * CLEAR);
    let smaller = if a.area() < b.area() { a } else { b };
    let floor = ask.absolute.max(FLOOR) * smaller.area_in(1.0 / pair.frame.scale);
    let mut search = Search::new(&pair, &target, &blockers, touches, MOST_POINTS);
    let visible = search.visible(clear, ask.relative, floor);
    Estimate { visibility: true, ..visible.seen_from(pair.from_area) }
}

/// The occluders that may stand between, cut to what lies in front of both polygons. Those that
/// look largest from the smaller polygon come first: they leave the least to the others.
fn candidates(pair: &Pair, occluders: &Occluders, target: &Target, touches: f64) -> Vec<Blocker> {
    let frame = pair.frame;
    let shaft = Shaft::new(&pair.small.corners, &pair.large.corners, touches);
    let mut blockers: Vec<Blocker> = Vec::new();
    occluders.visit(
        |bounds| shaft.meets(&frame.bounds(bounds)),
        |wall| {
            let corners: Corners = wall.iter().map(|&corner| frame.to_frame(corner)).collect();
            let blocker = blocker(&corners, pair, target, touches);
            blockers.extend(blocker.filter(|blocker| shaft.meets_polygon(&blocker.corners)));
        },
    );
    let centre = |corners: &[DVec3]| corners.iter().sum::<DVec3>() / corners.len() as f64;
    let from = centre(&pair.small.corners);
    let shade = |b: &Blocker| b.area / centre(&b.corners).distance_squared(from);
    blockers.sort_by(|one, two| shade(two).total_cmp(&shade(one)));
    blockers
}

/// The part of an occluder in front of both polygons; `None` if there is none, or both lie on one
/// side of its plane.
fn blocker(corners: &[DVec3], pair: &Pair, target: &Target, touches: f64) -> Option<Blocker> {
    let (small, large) = (&pair.small, &pair.large);
    let normal = area_vector(corners).try_normalize()?;
    let height = |corner: DVec3| normal.dot(corner - corners[0]);
    let heights = small.corners.iter().chain(large.corners.iter()).map(|&c| height(c));
    let (low, high) = heights.fold((0.0f64, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
    if low >= -touches || high <= touches {
        return None;
    }
    let corners = cut(corners, small.normal, small.corners[0], touches)?;
    let corners = cut(&corners, large.normal, large.corners[0], touches)?;
    let area = area_vector(&corners).length();
    Some(Blocker::new(corners, normal, area, target))
}
