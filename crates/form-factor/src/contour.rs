//! The form factor as a double integral around the two rims.
//!
//! A·F = 1/2π ∮∮ ln r dx·dy: an edge of the larger is integrated in closed form, an edge of the
//! smaller by Gauss's rule. The rule's error falls like ρ⁻²ⁿ, where ρ is the sum of the
//! half axes of the ellipse around the edge, in half edges, that just meets the other edge
//! (Trefethen 2013, theorem 19.3); so the number of nodes follows from the geometry. Where that
//! takes too many, the two edges nearly meet: a closed form serves edges in one plane, halving
//! serves the others.
//!
//! # References
//! Schröder & Hanrahan 1993, "On the form factor between two polygons"; Hottel & Sarofim 1967.

use std::f64::consts::TAU;

use glam::DVec3;

use crate::edge_pair::{Edge, closed_form, inner};
use crate::gauss::{COUNTS, LINE};

/// Nodes beyond which a closed form or halving is cheaper.
const MOST: usize = 16;

/// Halvings of an edge: from its length down to a rounding of it.
const HALVINGS: u32 = 52;

/// Roundings that a term of the sum may be off by: two logarithms, an arctangent and their sum.
const ROUNDINGS: f64 = 8.0 * f64::EPSILON;

/// A sum, how far off it may be, and the edge integrals it took.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sum {
    pub(crate) value: f64,
    /// What the rules leave out.
    pub(crate) left_out: f64,
    /// What rounding may make of the terms.
    pub(crate) rounding: f64,
    pub(crate) effort: u32,
}

/// The exchange area A·F of two polygons that lie in front of one another, with at most about
/// `allowed` left out by the rules.
pub(crate) fn contour(outer: &[DVec3], inner_rim: &[DVec3], allowed: f64) -> Sum {
    let mut sum = Sum::default();
    let pairs = (outer.len() * inner_rim.len()) as f64;
    let allowed = allowed * TAU / pairs.sqrt();
    for i in 0..outer.len() {
        let edge = Edge::new(outer[i], outer[(i + 1) % outer.len()]);
        if edge.length > 0.0 {
            along(&edge, inner_rim, allowed, &mut sum);
        }
    }
    sum.value /= TAU;
    sum.left_out /= TAU;
    sum.rounding *= ROUNDINGS / TAU;
    sum
}

/// Adds the pairs of one outer edge with all inner ones.
fn along(outer: &Edge, rim: &[DVec3], allowed: f64, sum: &mut Sum) {
    let n = rim.len();
    for j in 0..n {
        let edge = Edge::new(rim[j], rim[(j + 1) % n]);
        let cosine = outer.direction.dot(edge.direction);
        if cosine != 0.0 && edge.length > 0.0 {
            pair(outer, &edge, cosine, allowed, HALVINGS, sum);
        }
    }
}

/// Adds cosine · ∫∫ ln r over two edges.
fn pair(outer: &Edge, edge: &Edge, cosine: f64, allowed: f64, halvings: u32, sum: &mut Sum) {
    let rho = ellipse(outer, edge);
    let size = cosine.abs() * outer.length * edge.length.min(rho * outer.length);
    let needed = ((size / allowed).ln().max(0.0) / (2.0 * rho.ln())).ceil().max(2.0);
    if needed <= MOST as f64 {
        let rule = COUNTS.iter().position(|&count| count as f64 >= needed).unwrap_or(0);
        let integral: f64 = LINE[rule].iter().map(|&(s, w)| w * inner(outer.at(s), edge)).sum();
        sum.value += cosine * outer.length * integral;
        sum.left_out += size * rho.powi(-2 * COUNTS[rule] as i32);
        sum.rounding += cosine.abs() * outer.length * terms(outer.from, edge);
        sum.effort += COUNTS[rule] as u32;
    } else if let Some((integral, largest)) = closed_form(outer, edge) {
        sum.value += cosine * integral;
        sum.rounding += cosine.abs() * largest;
        sum.effort += 4;
    } else if halvings == 0 {
        sum.left_out += size;
    } else {
        let middle = outer.at(0.5);
        for half in [Edge::new(outer.from, middle), Edge::new(middle, outer.to)] {
            pair(&half, edge, cosine, allowed / 2.0, halvings - 1, sum);
        }
    }
}

/// The size of the terms that make up the integral over `edge` from a place near `x`.
fn terms(x: DVec3, edge: &Edge) -> f64 {
    let (start, end) = (edge.from - x, edge.to - x);
    let term = |v: DVec3| {
        let r2 = v.length_squared().max(f64::MIN_POSITIVE);
        v.dot(edge.direction).abs() * (1.0 + r2.ln().abs())
    };
    edge.length + term(start) + term(end)
}

/// The sum of the half axes, in half edges, of the largest ellipse around `outer` in which the
/// integral over `edge` has no singular point. Those are where a complex point of the outer
/// line is at distance 0 from an end of the edge, or from its line at a point between the ends.
fn ellipse(outer: &Edge, edge: &Edge) -> f64 {
    let far = |from: f64, to: f64| {
        let axis = ((from + to) / outer.length).max(1.0);
        axis + (axis * axis - 1.0).sqrt()
    };
    let end = |corner: DVec3| far(corner.distance(outer.from), corner.distance(outer.to));
    let mut rho = end(edge.from).min(end(edge.to));
    if let Some((real, imaginary, between)) = crossing(outer, edge)
        && between
    {
        let (before, after) = (real, real - outer.length);
        rho = rho.min(far(before.hypot(imaginary), after.hypot(imaginary)));
    }
    rho.max(1.0 + f64::EPSILON)
}

/// Where the lines of two edges come closest: the place on the outer line, the distance
/// between the lines over the sine of their angle, and whether the place on the inner line is
/// on the edge. `None` if they are parallel.
fn crossing(outer: &Edge, edge: &Edge) -> Option<(f64, f64, bool)> {
    let normal = outer.direction.cross(edge.direction);
    let sine2 = normal.length_squared();
    if sine2 < f64::EPSILON * f64::EPSILON {
        return None;
    }
    let apart = edge.from - outer.from;
    let real = apart.cross(edge.direction).dot(normal) / sine2;
    let on_inner = apart.cross(outer.direction).dot(normal) / sine2;
    let imaginary = apart.dot(normal).abs() / sine2;
    let slack = 0.1 * edge.length + imaginary;
    Some((real, imaginary, on_inner > -slack && on_inner < edge.length + slack))
}
