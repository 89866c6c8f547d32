//! The mean over the smaller polygon of Lambert's exact form to the larger one.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use crate::clip::{area_vector, halves};
use crate::contour::Sum;
use crate::gauss::{DEGREES, Node, TRIANGLE};
use crate::pair::Part;

/// Radius over distance beyond which the bounds below say nothing.
const NEAR: f64 = 0.6;

/// The error of each rule in units of qᵈ⁺¹·min(1, A/πD²), where q is the radius of the smaller
/// polygon over the distance D of its centre from the larger one, A the larger one's area and d
/// the rule's degree: twice the largest among half a million random pairs of triangles and
/// quadrilaterals, fat and thin, of sizes 1 to 30.
const BOUND: [f64; 5] = [0.95, 0.15, 0.06, 0.013, 0.005];

/// What bounds the error of a mean.
pub(crate) struct Outlook {
    q: f64,
    scale: f64,
}

impl Outlook {
    /// From the centre of a piece of the smaller polygon to the larger one.
    pub(crate) fn new(piece: &[DVec3], large: &Part) -> Self {
        let centre = piece.iter().sum::<DVec3>() / piece.len() as f64;
        let radius2 = piece.iter().map(|c| c.distance_squared(centre)).fold(0.0, f64::max);
        let distance = distance(centre, large);
        Self {
            q: radius2.sqrt() / distance,
            scale: (large.area / (PI * distance * distance)).min(1.0),
        }
    }

    /// What a rule may err by, as a form factor; infinite where the two are near.
    pub(crate) fn bound(&self, rule: usize) -> f64 {
        if self.q <= NEAR {
            BOUND[rule] * self.scale * self.q.powi(DEGREES[rule] + 1)
        } else {
            f64::INFINITY
        }
    }

    /// The cheapest rule that errs by at most `allowed`.
    pub(crate) fn rule(&self, allowed: f64) -> Option<usize> {
        (0..BOUND.len()).find(|&rule| self.bound(rule) <= allowed)
    }
}

/// The exchange area of two polygons, by pieces of the smaller that err by at most `allowed` as a
/// form factor; what is left when the effort is spent goes with the error that it has.
pub(crate) fn by_pieces(small: &Part, large: &Part, allowed: f64, most: u32) -> Sum {
    let mut sum = Sum::default();
    let mut open = vec![small.corners.clone()];
    while let Some(piece) = open.pop() {
        let outlook = Outlook::new(&piece, large);
        let rule = outlook.rule(allowed);
        if rule.is_none() && sum.effort < most {
            sum.effort += 1;
            open.extend(halves(&piece));
            continue;
        }
        let rule = rule.unwrap_or(DEGREES.len() - 1);
        let part = mean(&piece, small.normal, &large.corners, rule);
        let area = area_vector(&piece).dot(small.normal);
        sum.value += part.value;
        sum.left_out += outlook.bound(rule) * area;
        sum.rounding += part.rounding;
        sum.effort += part.effort;
    }
    sum
}

/// The exchange area of a piece of the smaller polygon with the larger one.
pub(crate) fn mean(piece: &[DVec3], normal: DVec3, large: &[DVec3], rule: usize) -> Sum {
    let mut sum = Sum::default();
    let rule: &[Node] = TRIANGLE[rule];
    for pair in piece[1..].windows(2) {
        let (u, v) = (pair[0] - piece[0], pair[1] - piece[0]);
        let area = u.cross(v).dot(normal) / 2.0;
        for &(weight, w) in rule {
            let (value, terms) = seen(piece[0] + u * w[1] + v * w[2], normal, large);
            sum.value += area * weight * value;
            sum.rounding += area * weight * terms * 4.0 * f64::EPSILON;
        }
        sum.effort += rule.len() as u32;
    }
    sum
}

/// Lambert's form factor from a point to a polygon in front of it, and the size of its terms.
pub(crate) fn seen(x: DVec3, normal: DVec3, corners: &[DVec3]) -> (f64, f64) {
    let (mut sum, mut terms) = (0.0, 0.0);
    let mut before = corners[corners.len() - 1] - x;
    for &corner in corners {
        let after = corner - x;
        let cross = before.cross(after);
        let sine = cross.length();
        if sine > 0.0 {
            let term = sine.atan2(before.dot(after)) * normal.dot(cross) / sine;
            sum += term;
            terms += term.abs();
        }
        before = after;
    }
    // Corners run counter-clockwise seen from the large polygon's front.
    (-sum / TAU, terms / TAU)
}

/// From a point to the nearest point of a polygon.
pub(crate) fn distance(x: DVec3, polygon: &Part) -> f64 {
    let corners = &polygon.corners;
    let height = polygon.normal.dot(x - corners[0]);
    let mut inside = true;
    let mut nearest2 = f64::INFINITY;
    for i in 0..corners.len() {
        let (p, q) = (corners[i], corners[(i + 1) % corners.len()]);
        let (edge, from) = (q - p, x - p);
        inside &= polygon.normal.cross(edge).dot(from) >= 0.0;
        let along = (from.dot(edge) / edge.length_squared()).clamp(0.0, 1.0);
        nearest2 = nearest2.min((from - edge * along).length_squared());
    }
    if inside { height.abs() } else { nearest2.sqrt() }
}
