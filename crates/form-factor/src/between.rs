//! The form factor of two polygons with nothing in between: which estimator serves which pair.

use glam::DVec3;

use crate::clip::cut;
use crate::contour::{Sum, contour};
use crate::mean::{Outlook, by_pieces, distance, mean};
use crate::pair::{Pair, Part, smaller_first};
use crate::product::{pieces, product};
use crate::{Estimate, Polygon};

/// The relative tolerance of reference values.
pub const REFERENCE: f64 = 1e-10;

/// How much longer than the smaller polygon's edges the larger one's may be before it is cut into
/// what is near the smaller one and what is not: the contour's terms grow with the longer edge.
const CONTRAST: f64 = 32.0;

/// Distance in longest edges of the larger polygon from which kernels are tried.
const FAR: f64 = 3.0;

/// Half the width of what is near, in longest edges of the smaller polygon.
const NEIGHBOURHOOD: f64 = 8.0;

/// The share of its allowance that a first pass leaves for the sum to come out smaller than
/// expected.
const EXPECTED: f64 = 0.1;

/// Passes over the contour: each brings the rules' error down to what is wanted, if the sum of the
/// last is right.
const PASSES: u32 = 12;

/// Kernels that may be spent where the contour cancels: about a millisecond.
const MOST_KERNELS: u32 = 1 << 18;

/// What kernels are asked for where they cannot meet the tolerance.
const COARSE: f64 = 1e-5;

/// Points that may be spent on the mean of Lambert's form.
const MOST_POINTS: u32 = 1 << 12;

/// Gap, in longest edges of the smaller polygon, below which pieces get too many.
const GAP: f64 = 1.0 / 64.0;

/// The form factor from `a` to `b` with nothing in between, to a relative `tolerance`.
///
/// Only the part of each polygon in front of the other's plane exchanges light, and
/// `a.area()` · F a→b = `b.area()` · F b→a to rounding. What rounding denies to the tolerance
/// (polygons that are nearly coplanar, below [`REFERENCE`]) shows in [`Estimate::error`].
///
/// # Examples
/// ```
/// use form_factor::{Polygon, REFERENCE, between};
/// use glam::DVec3;
///
/// // Two faces of a cube (Howell, C-14): .200043776...
/// let floor = Polygon::new(&[DVec3::ZERO, DVec3::X, DVec3::X + DVec3::Y, DVec3::Y]).unwrap();
/// let wall = Polygon::new(&[DVec3::ZERO, DVec3::Y, DVec3::Y + DVec3::Z, DVec3::Z]).unwrap();
/// let f = between(&floor, &wall, REFERENCE);
/// assert!((f.value - 0.200043776075403).abs() < f.error + 1e-15 && f.error < 1e-11);
/// ```
///
/// # References
/// Far: Wallace, Elmquist & Haines 1989. Small beside large: Baum, Rushmeier & Winget 1989.
/// Near: Schröder & Hanrahan 1993; Hottel & Sarofim 1967.
#[must_use]
pub fn between(a: &Polygon, b: &Polygon, tolerance: f64) -> Estimate {
    let (small, large) = if smaller_first(a, b) { (a, b) } else { (b, a) };
    if let Some(far) = product(small, large, tolerance) {
        let unit = a.unit();
        let share = small.area_in(unit) / a.area_in(unit);
        return Estimate {
            value: (far.value * share).min(1.0),
            error: far.error * share,
            effort: far.effort,
            visibility: false,
        };
    }
    match Pair::new(a, b) {
        Some(pair) => exchange(&pair.small, &pair.large, tolerance).seen_from(pair.from_area),
        None => Estimate::NOTHING,
    }
}

/// An exchange area A·F in the units of a pair's frame.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exchange {
    pub(crate) value: f64,
    pub(crate) error: f64,
    pub(crate) effort: u32,
}

impl Exchange {
    /// The form factor from a polygon of this area.
    pub(crate) fn seen_from(self, area: f64) -> Estimate {
        Estimate {
            value: (self.value / area).clamp(0.0, 1.0),
            error: self.error / area,
            effort: self.effort,
            visibility: false,
        }
    }

    fn add(&mut self, sum: Sum) {
        self.value += sum.value;
        self.error += sum.left_out + sum.rounding;
        self.effort += sum.effort;
    }
}

/// The exchange area of two polygons that lie in front of one another.
pub(crate) fn exchange(small: &Part, large: &Part, tolerance: f64) -> Exchange {
    if let Some(exchange) = far(small, large, tolerance).or_else(|| apart(small, large, tolerance))
    {
        return exchange;
    }
    if large.longest > CONTRAST * small.longest {
        return beside(small, large, tolerance);
    }
    let near = near(small, &large.corners, tolerance);
    if near.error <= tolerance * near.value {
        return near;
    }
    without_cancelling(small, large, tolerance, near)
}

/// The same for pieces that may be slivers or nearly coplanar, where the contour cancels: no other
/// way is tried, and the error says what rounding denies.
pub(crate) fn unblocked(small: &Part, large: &Part, tolerance: f64) -> Exchange {
    apart(small, large, tolerance).unwrap_or_else(|| near(small, &large.corners, tolerance))
}

/// Another way where rounding denies the tolerance to the contour: polygons that are apart, but
/// slender or nearly coplanar.
#[cold]
fn without_cancelling(small: &Part, large: &Part, tolerance: f64, near: Exchange) -> Exchange {
    let gap = |one: &Part, other: &Part| {
        one.corners.iter().map(|&corner| distance(corner, other)).fold(f64::INFINITY, f64::min)
    };
    if gap(small, large).min(gap(large, small)) < GAP * small.longest {
        return near;
    }
    let mut best = near;
    let mut means = Exchange { value: 0.0, error: 0.0, effort: 0 };
    means.add(by_pieces(small, large, tolerance * near.value / small.area * 0.5, MOST_POINTS));
    if means.error < best.error {
        best = means;
    }
    let whole = [small, large].map(|part| Polygon::part(part.corners.clone(), part.normal));
    let [Some(a), Some(b)] = whole else { return best };
    for tolerance in [tolerance, tolerance.max(COARSE)] {
        if best.error > tolerance * best.value
            && let Some(kernels) = pieces(&a, &b, tolerance, MOST_KERNELS)
            && kernels.error < best.error
        {
            best = kernels;
        }
    }
    best
}

/// By kernels, if the polygons are far from one another: one that was cut did not get here before.
fn far(small: &Part, large: &Part, tolerance: f64) -> Option<Exchange> {
    if small.corners[0].distance(large.corners[0]) < FAR * large.longest {
        return None;
    }
    let a = Polygon::part(small.corners.clone(), small.normal)?;
    let b = Polygon::part(large.corners.clone(), large.normal)?;
    let Estimate { value, error, effort, .. } = product(&a, &b, tolerance)?;
    Some(Exchange { value: value * a.area(), error: error * a.area(), effort })
}

/// By the mean of Lambert's form, if the larger is far enough for the size of the smaller.
fn apart(small: &Part, large: &Part, tolerance: f64) -> Option<Exchange> {
    let outlook = Outlook::new(&small.corners, large);
    let best = outlook.bound(4);
    if best > tolerance {
        return None;
    }
    let one = mean(&small.corners, small.normal, &large.corners, 0);
    let at_least = one.value / small.area - outlook.bound(0);
    let rule = outlook.rule(tolerance * at_least).or_else(|| {
        // So oblique that one point says little: the best rule may do.
        (best <= tolerance * tolerance).then_some(4)
    })?;
    let mut sum = Exchange { value: 0.0, error: outlook.bound(rule) * small.area, effort: 1 };
    sum.add(if rule == 0 { one } else { mean(&small.corners, small.normal, &large.corners, rule) });
    (sum.error <= tolerance * sum.value).then_some(sum)
}

/// By the contour, in passes: the first takes the form factor for about 1.
fn near(small: &Part, large: &[DVec3], tolerance: f64) -> Exchange {
    let mut allowed = tolerance * small.area * EXPECTED;
    let mut effort = 0;
    let mut pass = 0;
    loop {
        let sum = contour(&small.corners, large, allowed);
        effort += sum.effort;
        pass += 1;
        let error = sum.left_out + sum.rounding;
        let wanted = tolerance * sum.value;
        if error <= wanted || sum.left_out <= sum.rounding || pass == PASSES {
            return Exchange { value: sum.value.max(0.0), error, effort };
        }
        allowed *= (0.2 * wanted / sum.left_out).clamp(1e-4, 0.3);
    }
}

/// A small polygon beside a far larger one: the contour with what is near, the mean of Lambert's
/// form to the rest.
fn beside(small: &Part, large: &Part, tolerance: f64) -> Exchange {
    let centre = small.corners.iter().sum::<DVec3>() / small.corners.len() as f64;
    let across = large.normal.any_orthonormal_vector();
    let width = NEIGHBOURHOOD * small.longest;
    let mut sum = Exchange { value: 0.0, error: 0.0, effort: 0 };
    let mut rest = Some(large.corners.clone());
    for direction in [across, -across, large.normal.cross(across), across.cross(large.normal)] {
        let Some(corners) = rest else { break };
        let line = centre + direction * width;
        if let Some(far) = cut(&corners, direction, line, 0.0) {
            let far = Part::of(far, large.normal);
            sum.add(by_pieces(small, &far, tolerance * EXPECTED, MOST_POINTS));
        }
        rest = cut(&corners, -direction, line, 0.0);
    }
    if let Some(corners) = rest {
        let near = near(small, &corners, tolerance);
        sum.value += near.value;
        sum.error += near.error;
        sum.effort += near.effort;
    }
    sum
}
