//! The mean of what is visible, by pieces of the smaller polygon that are cut until it is settled.
//!
//! What is visible from a point changes smoothly but for kinks along known lines, so pieces are
//! cut there first, and by halves then, the worst first.

use std::collections::BinaryHeap;

use glam::DVec3;

use crate::between::{Exchange, unblocked};
use crate::clip::{area_vector, cut, halves};
use crate::corners::Corners;
use crate::cover::covers;
use crate::gauss::{Node, TRIANGLE};
use crate::kink::{Kink, Probe, kink};
use crate::missed::missed;
use crate::pair::{Pair, Part};
use crate::piece::{Piece, Ranked, Sums, Total};
use crate::shadow::{Blocker, Shadows, Sight, Target};
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
const UNSETTLED: f64 = 2.0;

/// The same where it is: the parts are at least this much better than the whole.
const CONVERGED: f64 = 0.25;

/// Change within a piece, in the light without occluders, beyond which it is not settled.
const STEEP: f64 = 0.25;

/// The share of the tolerance below which an error is not trusted: few points were taken.
const CHECKED: f64 = 0.5;

/// The share of the tolerance that the light of a piece without occluders may take.
const CLEAR: f64 = 0.1;

/// Roundings of a sum of fragments.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Growth of the list of pieces after which sums are taken anew, so that what large pieces left in
/// them by rounding is gone.
const AFRESH: f64 = 1.5;

/// The integral over the smaller polygon, as it is being settled.
pub(crate) struct Search<'a> {
    pair: &'a Pair,
    blockers: &'a [Blocker],
    shadows: Shadows<'a>,
    touches: f64,
    tolerance: f64,
    points: u32,
    most_points: u32,
    touched: Vec<bool>,
}

impl<'a> Search<'a> {
    /// `touches` is the length that counts as none.
    pub(crate) fn new(
        pair: &'a Pair,
        target: &'a Target,
        blockers: &'a [Blocker],
        touches: f64,
        most_points: u32,
    ) -> Self {
        let shadows = Shadows::new(target, touches);
        let touched = Vec::new();
        Self { pair, blockers, shadows, touches, tolerance: 0.0, points: 0, most_points, touched }
    }

    /// The visible part of the exchange area `clear`, to a relative tolerance or an absolute floor.
    pub(crate) fn visible(&mut self, clear: Exchange, tolerance: f64, floor: f64) -> Exchange {
        self.tolerance = tolerance;
        let mut pieces = self.first_pieces();
        let mut total = Total::of(&pieces);
        let mut fresh = pieces.len();
        // The difference to the light without occluders is exact where nothing is hidden; what is
        // visible is exact where all is.
        let hidden = total.error(|e| e.hidden) + clear.error < total.error(|e| e.visible);
        let rank = |piece: &Piece| match (piece.proved, hidden) {
            (true, _) => 0.0,
            (_, true) => piece.errors.hidden,
            (_, false) => piece.errors.visible,
        };
        let ranked = |(at, piece): (usize, &Piece)| Ranked { error: rank(piece), at };
        let mut queue: BinaryHeap<_> = pieces.iter().enumerate().map(ranked).collect();
        loop {
            let visible = (total.sums.visible, total.error(|e| e.visible));
            let rest = (clear.value - total.sums.hidden, total.error(|e| e.hidden) + clear.error);
            let (value, error) = if rest.1 < visible.1 { rest } else { visible };
            let wanted = (tolerance * value).max(floor);
            let open = error > wanted && self.points < self.most_points;
            let worst =
                queue.peek().filter(|worst| open && worst.error > 0.0).map(|worst| worst.at);
            let enough = pieces.len() as f64 > AFRESH * fresh as f64;
            if (worst.is_none() && pieces.len() > fresh) || enough {
                total = Total::of(&pieces);
                fresh = pieces.len();
                continue;
            }
            let Some(worst) = worst else {
                let value = value.clamp(0.0, clear.value);
                let unchecked = CHECKED * tolerance * value.min(clear.value - value);
                return Exchange {
                    value,
                    error: error.max(unchecked) + ROUNDING * clear.value,
                    effort: clear.effort + self.points,
                };
            };
            queue.pop();
            let parts = self.split(&pieces[worst]);
            total.add(&pieces[worst], -1.0);
            pieces[worst].is_split = true;
            for part in parts {
                total.add(&part, 1.0);
                queue.push(Ranked { error: rank(&part), at: pieces.len() });
                pieces.push(part);
            }
        }
    }

    /// Halves of each triangle of the smaller polygon's fan.
    fn first_pieces(&mut self) -> Vec<Piece> {
        let all: Vec<u32> = (0..self.blockers.len() as u32).collect();
        let small = &self.pair.small.corners;
        let mut pieces = Vec::new();
        for i in 2..small.len() {
            let whole = self.piece([small[0], small[i - 1], small[i]], &all);
            if whole.proved {
                pieces.push(whole);
                continue;
            }
            for half in self.split(&whole) {
                if half.proved {
                    pieces.push(half);
                } else {
                    pieces.extend(self.split(&half));
                }
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
        let difference = together.map(whole.sums, |now, before| now - before);
        let settled = whole.settled && parts.iter().all(|part| part.settled);
        let (safety, slow) = if settled { (CONVERGED, FAST) } else { (UNSETTLED, SLOW) };
        let share = 1.0 / parts.iter().filter(|part| !part.proved).count().max(1) as f64;
        let errors = difference
            .map(whole.errors, |now, before| (safety * now.abs()).max(before / slow) * share);
        // Parts along a kink are not much smaller than the whole and confirm nothing: what is
        // known is how much the values in each differ.
        if whole.kink.is_none() {
            for part in parts.iter_mut().filter(|part| !part.proved) {
                part.errors = errors.map(part.doubts, |error, doubt| error + doubt);
                part.drift = difference.map(Sums::default(), |now, _| safety * now * share);
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
        if blockers.is_empty() {
            return self.proved(corners, false);
        }
        let (origin, u, v) = (corners[0], corners[1] - corners[0], corners[2] - corners[0]);
        let mut sums = Sums::default();
        let mut probes = [Probe::default(); PROBES];
        self.touched.clear();
        self.touched.resize(between.len(), false);
        for (probe, &(weight, place)) in probes.iter_mut().zip(NODES.iter()) {
            let point = origin + u * place[1] + v * place[2];
            let some = between.iter().copied();
            let seen = self.shadows.sight(point, small.normal, some, &mut self.touched);
            sums.visible += weight * area * seen.visible;
            sums.hidden += weight * area * (seen.all - seen.visible);
            *probe = Probe { place, weight, seen };
        }
        self.points += PROBES as u32;
        let dark = probes.iter().all(|probe| probe.seen.visible == 0.0);
        if dark && covers(&between, &corners, &large.corners, self.touches) {
            return self.proved(corners, true);
        }
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
        let missed =
            missed(&corners, small.normal, &NODES[..6], large, &between, &shaft, sums.hidden);
        let doubts =
            ranges.map(nulls, |range, null| (overlooked * range + share * null) * area + missed);
        let guess = |doubt, range| GUESS * doubt + RANGE * range * area;
        Piece {
            corners,
            kink,
            settled,
            proved: false,
            is_split: false,
            blockers,
            sums,
            doubts,
            errors: doubts.map(ranges, guess),
            drift: Sums::default(),
        }
    }

    /// A piece of which all is known to be hidden, or nothing.
    fn proved(&mut self, corners: [DVec3; 3], hidden: bool) -> Piece {
        let Pair { small, large, .. } = self.pair;
        let part = Part::of(corners.into_iter().collect(), small.normal);
        let clear = unblocked(&part, large, self.tolerance * CLEAR);
        self.points += 1;
        let (all, none) = (clear.value, 0.0);
        let (sums, errors) = if hidden {
            (Sums { visible: none, hidden: all }, Sums { visible: 0.0, hidden: clear.error })
        } else {
            (Sums { visible: all, hidden: none }, Sums { visible: clear.error, hidden: 0.0 })
        };
        Piece {
            corners,
            kink: None,
            settled: true,
            proved: true,
            is_split: false,
            blockers: Vec::new(),
            sums,
            doubts: Sums::default(),
            errors,
            drift: Sums::default(),
        }
    }
}
