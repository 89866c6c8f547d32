//! The mean of what is visible, by pieces of the smaller polygon that are cut until it is settled.
//!
//! What is visible from a point changes smoothly but for kinks along known lines, so pieces are
//! cut there first, and by halves then, the worst first.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec3;

use crate::between::Exchange;
use crate::clip::{area_vector, cut, halves};
use crate::corners::Corners;
use crate::gauss::{Node, TRIANGLE};
use crate::kink::{Kink, Probe, kink};
use crate::pair::Pair;
use crate::shadow::{Blocker, Sight, sight};
use crate::shaft::Shaft;

/// Where a piece of the smaller polygon is looked at: a rule of 6 nodes, exact to degree 4, and,
/// without weight, the corners: a line across a triangle always sets one apart.
const PROBES: usize = 9;
const NODES: [Node; PROBES] = {
    let [a, b, c, d, e, f] = *TRIANGLE[2] else { panic!("that rule has 6 nodes") };
    let (near, far) = (1.0 - 2.0 * INSET, INSET);
    let corners = [[near, far, far], [far, near, far], [far, far, near]];
    [a, b, c, d, e, f, (0.0, corners[0]), (0.0, corners[1]), (0.0, corners[2])]
};

/// How far inside the piece its corners are looked at from, so that they are not on the rim of
/// what they look at.
const INSET: f64 = 1e-7;

/// The largest factors by which halving a piece lowers its error: where it is not settled that of
/// a kink, which runs through half the pieces only, and where it is that of a rule of degree 4.
const SLOW: f64 = 4.0;
const FAST: f64 = 16.0;

/// A rule that has corners and is exact to degree 2, less the rule of [`NODES`]: 0 for quadratic
/// polynomials, and for steps and kinks a measure of what any rule may miss.
const NULL: [f64; PROBES] = {
    let (corner, inner, outer) = (0.25 / 3.0, 0.287_694_612 / 3.0, -0.537_694_612 / 3.0);
    [inner, inner, inner, outer, outer, outer, corner, corner, corner]
};

/// The share of [`NULL`] that counts as error, where a piece is settled and where it is not.
const SETTLED_NULL: f64 = 0.02;
const NULL_SHARE: f64 = 0.4;

/// As long as a piece has no parts, its error counts so many times, and so much of the range of
/// its values is added.
const GUESS: f64 = 3.0;
const RANGE: f64 = 0.02;

/// Safety factor of the error where a piece is not settled.
const UNSETTLED: f64 = 1.5;

/// The same where it is: the parts are at least this much better than the whole.
const CONVERGED: f64 = 0.25;

/// Change within a piece, in the light without occluders, beyond which it is not settled.
const STEEP: f64 = 0.25;

/// The share of the tolerance below which an error is not trusted: few points were taken.
const CHECKED: f64 = 0.5;

/// Roundings of a sum of fragments.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The integral over the smaller polygon, as it is being settled.
pub(crate) struct Search<'a> {
    pair: &'a Pair,
    blockers: &'a [Blocker],
    touches: f64,
    points: u32,
    most_points: u32,
}

impl<'a> Search<'a> {
    /// `touches` is the length that counts as none.
    pub(crate) fn new(
        pair: &'a Pair,
        blockers: &'a [Blocker],
        touches: f64,
        most_points: u32,
    ) -> Self {
        Self { pair, blockers, touches, points: 0, most_points }
    }

    /// The visible part of the exchange area `clear`, to a relative tolerance or an absolute floor.
    pub(crate) fn visible(&mut self, clear: Exchange, tolerance: f64, floor: f64) -> Exchange {
        let mut pieces = self.first_pieces();
        let add = |a: f64, b: f64| a + b;
        let subtract = |a: f64, b: f64| a - b;
        let (mut sums, mut errors) = pieces.iter().fold(Default::default(), |(s, e), piece| {
            (piece.sums.map(s, add), piece.errors.map(e, add))
        });
        // The difference to the light without occluders is exact where nothing is hidden; what is
        // visible is exact where all is.
        let by_difference = |errors: Sums| errors.hidden + clear.error < errors.visible;
        let rank = if by_difference(errors) {
            |piece: &Piece| piece.errors.hidden
        } else {
            |piece: &Piece| piece.errors.visible
        };
        let ranked = |(at, piece): (usize, &Piece)| Ranked { error: rank(piece), at };
        let mut queue: BinaryHeap<_> = pieces.iter().enumerate().map(ranked).collect();
        loop {
            let (value, error) = if by_difference(errors) {
                (clear.value - sums.hidden, errors.hidden + clear.error)
            } else {
                (sums.visible, errors.visible)
            };
            let wanted = (tolerance * value).max(floor);
            let worst = queue.pop().filter(|worst| worst.error > 0.0);
            let Some(worst) = worst.filter(|_| error > wanted && self.points < self.most_points)
            else {
                let value = value.clamp(0.0, clear.value);
                let unchecked = CHECKED * tolerance * value.min(clear.value - value);
                return Exchange {
                    value,
                    error: error.max(unchecked) + ROUNDING * clear.value,
                    effort: clear.effort + self.points,
                };
            };
            let parent = &pieces[worst.at];
            (sums, errors) = (sums.map(parent.sums, subtract), errors.map(parent.errors, subtract));
            for half in self.split(parent) {
                (sums, errors) = (sums.map(half.sums, add), errors.map(half.errors, add));
                queue.push(Ranked { error: rank(&half), at: pieces.len() });
                pieces.push(half);
            }
        }
    }

    /// Quarters of each triangle of the smaller polygon's fan.
    fn first_pieces(&mut self) -> Vec<Piece> {
        let all: Vec<u32> = (0..self.blockers.len() as u32).collect();
        let small = &self.pair.small.corners;
        let mut pieces = Vec::new();
        for i in 2..small.len() {
            let whole = self.piece([small[0], small[i - 1], small[i]], &all);
            for half in self.split(&whole) {
                pieces.extend(self.split(&half));
            }
        }
        pieces
    }

    /// The parts of a piece. Together they are off by about what they differ from the whole, or
    /// somewhat more across the edge of a shadow; as two sums may agree by chance, errors fall by
    /// no more than [`SLOW`] or [`FAST`].
    fn split(&mut self, whole: &Piece) -> Vec<Piece> {
        let mut parts: Vec<Piece> = self
            .parts(whole)
            .into_iter()
            .map(|corners| self.piece(corners, &whole.blockers))
            .collect();
        let together =
            parts.iter().fold(Sums::default(), |sum, part| sum.map(part.sums, |a, b| a + b));
        let difference = together.map(whole.sums, |now, before| (now - before).abs());
        let settled = whole.settled && parts.iter().all(|part| part.settled);
        let (safety, slow) = if settled { (CONVERGED, FAST) } else { (UNSETTLED, SLOW) };
        let share = 1.0 / parts.len() as f64;
        let errors =
            difference.map(whole.errors, |now, before| (safety * now).max(before / slow) * share);
        for part in &mut parts {
            // Parts along a kink are not much smaller than the whole and confirm nothing: what is
            // known is how much the values in each differ.
            if whole.kink.is_none() {
                part.errors = errors.map(part.doubts, |error, doubt| error + doubt);
            }
            if part.blockers.is_empty() {
                part.errors.hidden = 0.0;
            }
        }
        parts
    }

    /// A piece in two or three triangles: along a line where the integrand has a kink, if one is
    /// known to cross it, or else at the middle of the longest edge.
    fn parts(&self, whole: &Piece) -> Vec<[DVec3; 3]> {
        if let Some(Kink { plane: (on, normal), .. }) = whole.kink {
            let sides = [normal, -normal].map(|side| cut(&whole.corners, side, on, self.touches));
            let fan = |side: Corners| -> Vec<[DVec3; 3]> {
                side[1..].windows(2).map(|pair| [side[0], pair[0], pair[1]]).collect()
            };
            return sides.into_iter().flatten().flat_map(fan).collect();
        }
        halves(&whole.corners).iter().map(|half| [half[0], half[1], half[2]]).collect()
    }

    fn piece(&mut self, corners: [DVec3; 3], blockers: &[u32]) -> Piece {
        let Pair { small, large, .. } = self.pair;
        let shaft = Shaft::new(&corners, &large.corners, self.touches);
        let blockers: Vec<u32> = blockers
            .iter()
            .copied()
            .filter(|&at| shaft.meets_polygon(&self.blockers[at as usize].corners))
            .collect();
        let between: Vec<&Blocker> =
            blockers.iter().map(|&at| &self.blockers[at as usize]).collect();
        let area = area_vector(&corners).dot(small.normal);
        let (origin, u, v) = (corners[0], corners[1] - corners[0], corners[2] - corners[0]);
        let mut sums = Sums::default();
        let mut probes = [Probe::default(); PROBES];
        for (probe, &(weight, place)) in probes.iter_mut().zip(NODES.iter()) {
            let point = origin + u * place[1] + v * place[2];
            let seen = sight(point, small.normal, large, &between, self.touches);
            sums.visible += weight * area * seen.visible;
            sums.hidden += weight * area * (seen.all - seen.visible);
            *probe = Probe { place, weight, seen };
        }
        self.points += PROBES as u32;
        let range = |value: fn(&Sight) -> f64| {
            let values = probes.iter().map(|probe| value(&probe.seen));
            let (low, high) =
                values.fold((f64::INFINITY, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
            high - low
        };
        let ranges = Sums { visible: range(|s| s.visible), hidden: range(|s| s.all - s.visible) };
        let steep = ranges.visible.min(ranges.hidden) > STEEP * probes[0].seen.all;
        let (kink, crossed) = kink(&corners, &probes, &between, large, self.touches);
        let settled = !crossed && !steep;
        let overlooked = kink.map_or(0.0, |kink| kink.overlooked);
        // What the probes do not agree on, if what is visible were a quadratic polynomial.
        let null = |value: fn(&Sight) -> f64| {
            let terms = probes.iter().zip(NULL).map(|(probe, weight)| weight * value(&probe.seen));
            terms.sum::<f64>().abs()
        };
        let nulls = Sums { visible: null(|s| s.visible), hidden: null(|s| s.all - s.visible) };
        let share = if settled { SETTLED_NULL } else { NULL_SHARE };
        let doubts = ranges.map(nulls, |range, null| (overlooked * range + share * null) * area);
        let guess = |doubt, range| GUESS * doubt + RANGE * range * area;
        Piece { corners, kink, settled, blockers, sums, doubts, errors: doubts.map(ranges, guess) }
    }
}

/// A piece of the smaller polygon, and integrals over it.
struct Piece {
    corners: [DVec3; 3],
    /// A line across which the edges of shadows cut the larger polygon in another way.
    kink: Option<Kink>,
    /// Whether there is one pattern of shadows, and no steep change from light to shadow.
    settled: bool,
    /// Indices of the blockers that matter to it.
    blockers: Vec<u32>,
    sums: Sums,
    /// How far the sums may be off by what lies between the probes, whatever the parts say.
    doubts: Sums,
    /// How far the sums may be off; at first a guess from how much the probes differ.
    errors: Sums,
}

/// Exchange areas: of what is visible, and of what is hidden.
#[derive(Clone, Copy, Default)]
struct Sums {
    visible: f64,
    hidden: f64,
}

impl Sums {
    fn map(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self { visible: f(self.visible, other.visible), hidden: f(self.hidden, other.hidden) }
    }
}

/// A piece that may be halved; the worst one comes first, and of equals the oldest.
struct Ranked {
    error: f64,
    at: usize,
}

impl Ord for Ranked {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error).then(other.at.cmp(&self.at))
    }
}

impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ranked {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Ranked {}
