//! Far apart: the kernel cos θ cos θ' / π r², by a rule on each of the two polygons.
//!
//! All terms are positive, so nothing cancels, at any distance.

use std::f64::consts::PI;

use glam::DVec3;

use crate::between::Exchange;
use crate::clip;
use crate::gauss::{DEGREES, Node, TRIANGLE};
use crate::polygon::binade;
use crate::{Estimate, Polygon};

/// Sizes of the pair over its distance beyond which the bounds below say nothing.
const NEAR: f64 = 0.5;

/// Each rule's error in units of qᵈ⁺¹·A/πr²·(cos θ + ¼)(cos θ' + ¼), where q is the sum of the
/// radii over the distance of the centres and d the rule's degree: twice the largest among a
/// million random pairs of triangles and quadrilaterals, fat and thin.
const BOUND: [f64; 5] = [3.5, 0.6, 0.23, 0.055, 0.016];

/// Roundings of a height or a kernel.
const ROUNDINGS: f64 = 4.0 * f64::EPSILON;

/// The ¼ above: what a cosine may gain within the pair.
const OBLIQUE: f64 = 0.25;

/// Each rule's error in units of qᵈ·F, found in the same way. Heights over the other's plane are
/// linear, so of their product with r⁻⁴ a rule misses but a share; the rule of one point has no
/// such bound.
const SHARE: [f64; 5] = [f64::INFINITY, 1.6, 0.8, 0.25, 0.13];

/// The form factor from `a` to `b` by the cheapest rule that is surely good enough, or `None`
/// if there is none or part of one polygon may lie behind the other.
pub(crate) fn product(a: &Polygon, b: &Polygon, tolerance: f64) -> Option<Estimate> {
    let sight = Sight::new(a, b)?;
    let rule = sight.rule(tolerance)?;
    let apart = sight.above[0] >= b.radius() && sight.above[1] >= a.radius();
    (apart || (in_front(a, b) && in_front(b, a))).then(|| sight.estimate(a, b, rule))
}

/// Whether no corner of `b` is behind `a`.
fn in_front(a: &Polygon, b: &Polygon) -> bool {
    b.corners().iter().all(|&corner| a.normal().dot(corner - a.corners()[0]) >= 0.0)
}

/// The exchange area of two polygons that lie in front of one another, piece by piece; `None`
/// if that takes more than `most` kernels.
pub(crate) fn pieces(a: &Polygon, b: &Polygon, tolerance: f64, most: u32) -> Option<Exchange> {
    let mut sum = Exchange { value: 0.0, error: 0.0, effort: 0 };
    let mut open = vec![(a.clone(), b.clone())];
    while let Some((a, b)) = open.pop() {
        let estimate = Sight::new(&a, &b).and_then(|sight| {
            let rule = sight.rule(tolerance)?;
            Some(sight.estimate(&a, &b, rule))
        });
        if let Some(estimate) = estimate {
            sum.value += estimate.value * a.area();
            sum.error += estimate.error * a.area();
            sum.effort += estimate.effort;
        } else {
            sum.effort += 1;
            if a.radius() > b.radius() {
                open.extend(halves(&a).map(|half| (half, b.clone())));
            } else {
                open.extend(halves(&b).map(|half| (a.clone(), half)));
            }
        }
        if sum.effort > most {
            return None;
        }
    }
    Some(sum)
}

fn halves(polygon: &Polygon) -> impl Iterator<Item = Polygon> {
    let part = |corners| Polygon::part(corners, polygon.normal());
    clip::halves(polygon.corners()).map(part).into_iter().flatten()
}

/// One polygon from the centre of another.
struct Sight {
    /// Heights of the centre of each over the other's plane.
    above: [f64; 2],
    distance: f64,
    /// F by the rule of one point.
    value: f64,
    /// The area over πr², times what the cosines may be.
    scale: f64,
    /// Sum of the radii over the distance.
    q: f64,
}

impl Sight {
    /// `None` if the pair is near, or one centre behind the other polygon.
    #[inline]
    fn new(a: &Polygon, b: &Polygon) -> Option<Self> {
        // From corner to corner first: exact even far from the origin.
        let apart = (b.corners()[0] - a.corners()[0]) + (b.centre() - a.centre());
        let (above_a, above_b) = (a.normal().dot(apart), -b.normal().dot(apart));
        let r = apart.length();
        let q = (a.radius() + b.radius()) / r;
        if above_a <= 0.0 || above_b <= 0.0 || q > NEAR {
            return None;
        }
        let (cos_a, cos_b) = (above_a / r, above_b / r);
        let share = b.area() / r / r / PI;
        let value = cos_a * cos_b * share;
        let scale = (cos_a + OBLIQUE) * (cos_b + OBLIQUE) * share;
        (value > 0.0 && scale.is_finite()).then_some(Self {
            above: [above_a, above_b],
            distance: r,
            value,
            scale,
            q,
        })
    }

    #[inline]
    fn bound(&self, rule: usize) -> f64 {
        let power = self.q.powi(DEGREES[rule]);
        (BOUND[rule] * self.scale * self.q * power).min(SHARE[rule] * self.value * power)
    }

    #[inline]
    fn rule(&self, tolerance: f64) -> Option<usize> {
        (0..BOUND.len()).find(|&rule| self.bound(rule) <= tolerance * self.value)
    }

    fn estimate(&self, a: &Polygon, b: &Polygon, rule: usize) -> Estimate {
        if rule == 0 {
            return Estimate {
                value: self.value.min(1.0),
                error: self.bound(0),
                effort: 1,
                visibility: false,
            };
        }
        let value = mean_kernel(a, b, TRIANGLE[rule], 1.0 / binade(self.distance));
        let nodes = TRIANGLE[rule].len() * TRIANGLE[rule].len();
        let effort = (nodes * (a.corners().len() - 2) * (b.corners().len() - 2)) as u32;
        // Heights are differences of coordinates as large as the distance.
        let grazing = self.distance / self.above[0] + self.distance / self.above[1];
        let rounding = ROUNDINGS * (2.0 + grazing) * value;
        Estimate {
            value: value.min(1.0),
            error: self.bound(rule) + rounding,
            effort,
            visibility: false,
        }
    }
}

/// The kernel's mean over `a`, integrated over `b`, with lengths in 1 / `scale`.
fn mean_kernel(a: &Polygon, b: &Polygon, rule: &[Node], scale: f64) -> f64 {
    let apart = (b.corners()[0] - a.corners()[0]) * scale;
    // Places relative to the first corner of `a`. Each height depends on one polygon alone.
    let mut on_b = [(DVec3::ZERO, 0.0); 16];
    let mut sum = 0.0;
    for (u, v) in fan(b, scale) {
        let area = u.cross(v).dot(b.normal()) / 2.0;
        for (slot, &(weight, w)) in on_b.iter_mut().zip(rule) {
            let at = apart + u * w[1] + v * w[2];
            *slot = (at, weight * area * a.normal().dot(at));
        }
        for (u, v) in fan(a, scale) {
            let area = u.cross(v).dot(a.normal()) / 2.0;
            for &(weight, w) in rule {
                let at = u * w[1] + v * w[2];
                let mut inner = 0.0;
                for &(y, weighted) in &on_b[..rule.len()] {
                    let r2 = (y - at).length_squared();
                    inner += weighted / (r2 * r2);
                }
                sum += weight * area * b.normal().dot(at - apart) * inner;
            }
        }
    }
    sum / (PI * a.area_in(1.0 / scale))
}

/// Two edges of each triangle of a fan around the first corner.
fn fan(polygon: &Polygon, scale: f64) -> impl Iterator<Item = (DVec3, DVec3)> {
    let first = polygon.corners()[0];
    let edge = move |corner: DVec3| (corner - first) * scale;
    polygon.corners()[1..].windows(2).map(move |pair| (edge(pair[0]), edge(pair[1])))
}
