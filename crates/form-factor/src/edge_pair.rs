//! ∫∫ ln r over two edges: one in closed form for any point of the other, both in closed form
//! where the edges lie in one plane.

use glam::DVec3;

/// A straight piece of a rim.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Edge {
    pub(crate) from: DVec3,
    pub(crate) to: DVec3,
    pub(crate) direction: DVec3,
    pub(crate) length: f64,
}

/// Lines that pass at less than this, in lengths of the shorter edge, lie in one plane: what the
/// closed form then leaves out is of the order of the square.
const ONE_PLANE: f64 = 1e-9;

/// Sine below which edges are parallel: some roundings of a direction.
const PARALLEL: f64 = 4.0 * f64::EPSILON;

/// How much farther than the shorter edge is long the edges' lines may meet, and how much longer the longer
/// edge may be: beyond, terms cancel, and halving does better.
const REACH: f64 = 64.0;

impl Edge {
    pub(crate) fn new(from: DVec3, to: DVec3) -> Self {
        let along = to - from;
        let length = along.length();
        let direction = if length > 0.0 { along / length } else { DVec3::ZERO };
        Self { from, to, direction, length }
    }

    #[inline]
    pub(crate) fn at(&self, share: f64) -> DVec3 {
        self.from + (self.to - self.from) * share
    }
}

/// ∫ ln |x − y| dy over an edge.
#[inline]
pub(crate) fn inner(x: DVec3, edge: &Edge) -> f64 {
    let (start, end) = (edge.from - x, edge.to - x);
    let (before, after) = (start.dot(edge.direction), end.dot(edge.direction));
    let height = start.cross(edge.direction).length();
    let angle = (height * edge.length).atan2(height * height + before * after);
    let logs = x_ln(after, end.length_squared()) - x_ln(before, start.length_squared());
    0.5 * logs - edge.length + height * angle
}

/// x ln r², and its limit 0 where r = 0.
#[inline]
fn x_ln(x: f64, r2: f64) -> f64 {
    if r2 > 0.0 { x * r2.ln() } else { 0.0 }
}

/// ∫∫ ln r over two edges in one plane, and the largest term it is made of; `None` if they lie
/// in none, or terms would cancel.
pub(crate) fn closed_form(one: &Edge, two: &Edge) -> Option<(f64, f64)> {
    let normal = one.direction.cross(two.direction);
    let sine2 = normal.length_squared();
    if let Some((x, y)) = from_common_end(one, two) {
        return Some(from_crossing(one, two, x, y));
    }
    let shorter = one.length.min(two.length);
    if shorter * REACH < one.length.max(two.length) {
        return None;
    }
    if sine2 <= PARALLEL * PARALLEL {
        return Some(parallel(one, two));
    }
    let apart = two.from - one.from;
    if apart.dot(normal).abs() > ONE_PLANE * shorter * sine2.sqrt() {
        return None;
    }
    let s = apart.cross(two.direction).dot(normal) / sine2;
    let t = apart.cross(one.direction).dot(normal) / sine2;
    if s.abs().max(t.abs()) > REACH * shorter {
        return None;
    }
    Some(from_crossing(one, two, [-s, one.length - s], [-t, two.length - t]))
}

/// Where two edges begin and end, from an end that they share.
fn from_common_end(one: &Edge, two: &Edge) -> Option<([f64; 2], [f64; 2])> {
    let forward = |edge: &Edge| [0.0, edge.length];
    let backward = |edge: &Edge| [-edge.length, 0.0];
    if one.from == two.from {
        Some((forward(one), forward(two)))
    } else if one.from == two.to {
        Some((forward(one), backward(two)))
    } else if one.to == two.from {
        Some((backward(one), forward(two)))
    } else if one.to == two.to {
        Some((backward(one), backward(two)))
    } else {
        None
    }
}

/// Edges at `x` and `y` along lines that cross at 0. The field (x, y)·ln r has the divergence
/// 2 ln r + 1, so the integral over the rectangle of x and y is one around its rim.
fn from_crossing(one: &Edge, two: &Edge, x: [f64; 2], y: [f64; 2]) -> (f64, f64) {
    let term = |at: f64, corner: DVec3, over: &Edge| {
        if at == 0.0 { 0.0 } else { at * inner(corner, over) }
    };
    let terms = [
        term(x[1], one.to, two),
        -term(x[0], one.from, two),
        term(y[1], two.to, one),
        -term(y[0], two.from, one),
        -one.length * two.length,
    ];
    (terms.iter().sum::<f64>() / 2.0, terms.iter().fold(0.0, |most, t| t.abs().max(most)))
}

/// Edges along one direction: a second difference of the second integral of ln √(z² + h²).
fn parallel(one: &Edge, two: &Edge) -> (f64, f64) {
    let apart = [two.from - one.from, two.to - one.from];
    let y = apart.map(|v| v.dot(one.direction));
    let height = apart[0].cross(one.direction).length();
    let second = |z: f64| {
        let (z2, h2) = (z * z, height * height);
        let angle = if height > 0.0 { height * z * (z / height).atan() } else { 0.0 };
        0.25 * x_ln(z2 - h2, z2 + h2) - 0.75 * z2 + angle
    };
    let (low, high) = (y[0].min(y[1]), y[0].max(y[1]));
    let terms =
        [second(one.length - low), -second(-low), -second(one.length - high), second(-high)];
    (terms.iter().sum(), terms.iter().fold(0.0, |most, t| t.abs().max(most)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gauss::LINE;

    /// ∫∫ ln r by Gauss's rule on 64 × 64 pieces.
    fn by_pieces(one: &Edge, two: &Edge) -> f64 {
        let mut sum = 0.0;
        for i in 0..64 {
            for &(s, w) in LINE[8] {
                sum += w * inner(one.at((f64::from(i) + s) / 64.0), two);
            }
        }
        sum * one.length / 64.0
    }

    fn edge(from: [f64; 3], to: [f64; 3]) -> Edge {
        Edge::new(DVec3::from(from), DVec3::from(to))
    }

    #[test]
    fn one_edge_matches_integration() {
        let two = edge([1.0, 2.0, 3.0], [2.0, 4.0, 2.5]);
        for x in [DVec3::ZERO, DVec3::new(1.2, 1.0, 2.0), DVec3::new(3.0, 6.0, 2.0)] {
            let mut sum = 0.0;
            for i in 0..64 {
                for &(t, w) in LINE[8] {
                    sum += w * two.at((f64::from(i) + t) / 64.0).distance(x).ln() / 64.0;
                }
            }
            assert!((inner(x, &two) - sum * two.length).abs() < 1e-14);
        }
    }

    #[test]
    fn closed_forms_match_integration() {
        let one = edge([0.0, 0.0, 0.0], [1.0, 0.0, 0.0]);
        let close = [
            (edge([0.0, 0.0, 0.0], [0.5, 2.0, 0.0]), "a common end"),
            (edge([-0.5, 2.0, 0.0], [1.0, 0.0, 0.0]), "a common end"),
            (edge([1.0, 0.0, 0.0], [3.0, 0.0, 0.0]), "one line"),
            (edge([1.0, 0.0, 0.0], [0.0, 0.0, 0.0]), "the same backwards"),
            (edge([0.2, 0.0, 0.0], [3.0, 0.0, 0.0]), "overlapping"),
            (edge([-1.0, 0.3, 0.1], [0.4, 0.3, 0.1]), "parallel"),
            (edge([0.4, 0.3, 0.1], [-1.0, 0.3, 0.1]), "backwards"),
            (edge([0.3, 0.3, 0.3], [0.4, 2.0, 2.0]), "in one plane"),
            (edge([0.5, -1.0, 0.0], [0.7, 1.0, 0.0]), "crossing"),
        ];
        for (two, name) in close {
            let (exact, _) = closed_form(&one, &two).expect(name);
            // The pieces converge like their number to the second where the edges meet.
            let expected = by_pieces(&one, &two);
            assert!((exact - expected).abs() < 2e-6, "{name}: {exact} {expected}");
            let (swapped, _) = closed_form(&two, &one).expect(name);
            assert!((exact - swapped).abs() < 1e-14, "{name}");
        }
        assert!(closed_form(&one, &edge([0.5, -1.0, 0.1], [0.7, 1.0, 0.1])).is_none(), "skew");
    }
}
