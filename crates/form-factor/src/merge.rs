//! Triangles of one wall put together again: fewer occluders, and no edges where there are none.

use glam::DVec3;

use crate::corners::Corners;

/// Rounds of putting pairs together: walls of up to 2¹⁶ triangles.
const ROUNDS: usize = 16;

/// Puts together convex polygons of one plane that share an edge and make a convex polygon.
/// `touches` is the length that counts as none.
pub(crate) fn merge(polygons: &mut Vec<Corners>, touches: f64) {
    for _ in 0..ROUNDS {
        let edges = shared_edges(polygons);
        let mut merged = vec![false; polygons.len()];
        let mut gone = vec![false; polygons.len()];
        for (one, two) in edges {
            if merged[one] || merged[two] {
                continue;
            }
            if let Some(union) = union(&polygons[one], &polygons[two], touches) {
                polygons[one] = union;
                (merged[one], merged[two], gone[two]) = (true, true, true);
            }
        }
        if !gone.contains(&true) {
            break;
        }
        let mut gone = gone.into_iter();
        polygons.retain(|_| !gone.next().unwrap_or(false));
    }
    polygons.iter_mut().for_each(|polygon| straighten(polygon, touches));
}

/// The pairs of polygons that have an edge in common, in the order of the polygons.
fn shared_edges(polygons: &[Corners]) -> Vec<(usize, usize)> {
    let key = |corner: DVec3| (corner + DVec3::ZERO).to_array().map(f64::to_bits);
    let mut edges: Vec<_> = polygons
        .iter()
        .enumerate()
        .flat_map(|(at, corners)| {
            (0..corners.len()).map(move |i| {
                let (p, q) = (key(corners[i]), key(corners[(i + 1) % corners.len()]));
                (p.min(q), p.max(q), at)
            })
        })
        .collect();
    edges.sort_unstable();
    let same = edges.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1));
    let mut pairs: Vec<_> = same
        .flat_map(|some| {
            let others = move |i: usize| some[i + 1..].iter().map(move |two| (some[i].2, two.2));
            (0..some.len()).flat_map(others)
        })
        .filter(|(one, two)| one != two)
        .collect();
    pairs.sort_unstable();
    pairs
}

/// Leaves out corners at which the rim does not turn.
fn straighten(polygon: &mut Corners, touches: f64) {
    if polygon.len() == 3 {
        return;
    }
    let mut kept: Vec<DVec3> = polygon.to_vec();
    let mut at = 0;
    while at < kept.len() && kept.len() > 3 {
        let n = kept.len();
        let (before, after) = (kept[(at + n - 1) % n], kept[(at + 1) % n]);
        let along = (after - before).normalize_or_zero();
        if along.cross(kept[at] - before).length() <= touches {
            kept.remove(at);
        } else {
            at += 1;
        }
    }
    *polygon = kept.into_iter().collect();
}

fn union(one: &[DVec3], two: &[DVec3], touches: f64) -> Option<Corners> {
    let normal = (one[1] - one[0]).cross(one[2] - one[0]).try_normalize()?;
    if two.iter().any(|&corner| normal.dot(corner - one[0]).abs() > touches) {
        return None;
    }
    let (n, m) = (one.len(), two.len());
    for i in 0..n {
        let (from, to) = (one[i], one[(i + 1) % n]);
        let Some(j) = two.iter().position(|&corner| corner == to) else { continue };
        // Either side of an occluder blocks, so `two` may run either way.
        let step = if two[(j + 1) % m] == from {
            m - 1
        } else if two[(j + m - 1) % m] == from {
            1
        } else {
            continue;
        };
        // All of `one` from `to` on to `from`, then the rest of `two` back to `to`.
        let first = (0..n).map(|k| one[(i + 1 + k) % n]);
        let rest = (1..m - 1).rev().map(|k| two[(j + step * k) % m]);
        let union: Corners = first.chain(rest).collect();
        return is_convex(&union, normal).then_some(union);
    }
    None
}

fn is_convex(corners: &[DVec3], normal: DVec3) -> bool {
    let n = corners.len();
    (0..n).all(|i| {
        let [p, q, r] = [0, 1, 2].map(|k| corners[(i + k) % n]);
        (q - p).cross(r - q).dot(normal) >= 0.0
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clip::area_vector;

    fn polygon(points: &[[f64; 2]]) -> Corners {
        points.iter().map(|&[x, y]| DVec3::new(x, y, 0.0)).collect()
    }

    #[test]
    fn a_wall_of_triangles_is_one_polygon_however_they_turn() {
        let [p, q, r, s] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let (t, u) = ([2.0, 0.0], [2.0, 1.0]);
        for other in [[p, r, s], [p, s, r], [s, p, r], [r, p, s]] {
            let mut wall = vec![polygon(&[p, q, r]), polygon(&other)];
            merge(&mut wall, 0.0);
            assert_eq!((wall.len(), wall[0].len()), (1, 4), "{other:?}");
            assert_eq!(area_vector(&wall[0]), DVec3::Z);
        }
        let mut strip = vec![
            polygon(&[p, q, r]),
            polygon(&[q, t, u]),
            polygon(&[q, u, r]),
            polygon(&[p, r, s]),
        ];
        merge(&mut strip, 0.0);
        assert_eq!(strip.len(), 1);
        assert_eq!(area_vector(&strip[0]), DVec3::Z * 2.0);
        let mut bent = vec![polygon(&[p, q, r]), polygon(&[p, r, [0.9, 1.5]])];
        bent[1] = bent[1].iter().map(|&c| c + DVec3::Z * c.y).collect();
        merge(&mut bent, 1e-9);
        assert_eq!(bent.len(), 2);
        let mut dented = vec![polygon(&[p, q, r]), polygon(&[q, [3.0, -1.0], r])];
        merge(&mut dented, 0.0);
        assert_eq!(dented.len(), 2);
    }
}
