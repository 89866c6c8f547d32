//! Refinement of a scene to a wanted number of triangles, by halving longest edges.

use glam::DVec3;

use crate::Triangle;

/// How far the number of triangles may be from the wanted one, as a part of it.
const COUNT_TOLERANCE: f64 = 0.005;

/// Trials of a longest edge: halving an interval this often exhausts an f64.
const MOST_TRIALS: u32 = 60;

/// Cuts `triangles` into about `count`, of even size, in the order of the originals.
///
/// Every triangle is halved across its longest edge until no edge is longer than a limit (Rivara
/// 1984), and the limit is sought that gives the number. An edge longer than the limit is always
/// cut, and always in its middle, so triangles that shared an edge share its pieces: no T-junction
/// appears. Returns the triangles as they are if there are already enough.
pub fn refine(triangles: &[Triangle], count: usize) -> Vec<Triangle> {
    if triangles.is_empty() || triangles.len() >= count {
        return triangles.to_vec();
    }
    let longest = triangles.iter().map(|t| longest_edge(t).1).fold(0.0, f64::max);
    let (mut low, mut high, mut limit) = (0.0, longest, longest);
    for _ in 0..MOST_TRIALS {
        limit = 0.5 * (low + high);
        let found: usize = triangles.iter().map(|t| pieces(t, limit, count)).sum();
        if (found as f64 - count as f64).abs() <= COUNT_TOLERANCE * count as f64 {
            break;
        }
        if found > count { low = limit } else { high = limit }
    }
    let mut refined = Vec::with_capacity(count + count / 8);
    for triangle in triangles {
        cut(triangle, limit, &mut |piece| refined.push(*piece));
    }
    refined
}

/// The number of pieces of a triangle, which need not be exact beyond `most`.
fn pieces(triangle: &Triangle, limit: f64, most: usize) -> usize {
    let (edge, square) = longest_edge(triangle);
    // A triangle's pieces are as many as this at least, so a tiny limit costs no time.
    if square > limit * most as f64 {
        return 2 * most;
    }
    if square <= limit {
        return 1;
    }
    halves(triangle, edge).iter().map(|half| pieces(half, limit, most)).sum()
}

fn cut(triangle: &Triangle, limit: f64, take: &mut impl FnMut(&Triangle)) {
    match longest_edge(triangle) {
        (edge, square) if square > limit => {
            halves(triangle, edge).iter().for_each(|half| cut(half, limit, take));
        }
        _ => take(triangle),
    }
}

/// The edge from corner `edge` to the next, and the square of its length; of equals the first.
fn longest_edge(t: &Triangle) -> (usize, f64) {
    let square = |edge: usize| t[edge].distance_squared(t[(edge + 1) % 3]);
    (1..3).fold(
        (0, square(0)),
        |best, edge| {
            if square(edge) > best.1 { (edge, square(edge)) } else { best }
        },
    )
}

fn halves(t: &Triangle, edge: usize) -> [Triangle; 2] {
    let (a, b, c) = (t[edge], t[(edge + 1) % 3], t[(edge + 2) % 3]);
    let middle: DVec3 = (a + b) * 0.5; // the same bits from either side
    [[c, a, middle], [c, middle, b]]
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::dvec3;
    use std::collections::BTreeMap;

    fn square() -> Vec<Triangle> {
        let p = |x: f64, y: f64| dvec3(x, y, 0.0);
        vec![[p(0.0, 0.0), p(3.0, 0.0), p(3.0, 1.0)], [p(0.0, 0.0), p(3.0, 1.0), p(0.0, 1.0)]]
    }

    #[test]
    fn the_count_is_met_and_the_area_kept() {
        let refined = refine(&square(), 1000);
        assert!((800..=1200).contains(&refined.len()), "{}", refined.len());
        let area: f64 = refined.iter().map(|t| 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).z).sum();
        assert!((area - 3.0).abs() < 1e-12, "{area}");
    }

    /// Inside the square each edge belongs to two triangles; a T-junction would leave one alone.
    #[test]
    fn no_t_junctions() {
        let mut uses = BTreeMap::new();
        let bits = |p: DVec3| p.to_array().map(f64::to_bits);
        for t in refine(&square(), 500) {
            for edge in 0..3 {
                let (a, b) = (t[edge], t[(edge + 1) % 3]);
                let border = (a.x == b.x && (a.x == 0.0 || a.x == 3.0))
                    || (a.y == b.y && (a.y == 0.0 || a.y == 1.0));
                if !border {
                    let key = (bits(a).min(bits(b)), bits(a).max(bits(b)));
                    *uses.entry(key).or_insert(0) += 1;
                }
            }
        }
        assert!(uses.len() > 500 && uses.values().all(|count| *count == 2));
    }

    #[test]
    fn enough_triangles_stay_as_they_are() {
        assert_eq!(refine(&square(), 2), square());
        assert!(refine(&[], 100).is_empty());
    }
}
