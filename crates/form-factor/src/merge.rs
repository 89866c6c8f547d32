//! Triangles of one wall put together again: fewer blockers, and no edges where light meets none.

use glam::DVec3;

use crate::corners::Corners;

/// Polygons beyond which no pairs are tried.
const MOST: usize = 64;

/// Puts together convex polygons of one plane that share an edge and make a convex polygon.
pub(crate) fn merge(polygons: &mut Vec<Corners>, touches: f64) {
    if polygons.len() > MOST {
        return;
    }
    let mut at = 0;
    while at < polygons.len() {
        let mut partner = at + 1;
        while partner < polygons.len() {
            if let Some(union) = union(&polygons[at], &polygons[partner], touches) {
                polygons[at] = union;
                polygons.remove(partner);
                // The larger polygon may now fit one that came before.
                partner = at + 1;
            } else {
                partner += 1;
            }
        }
        at += 1;
    }
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
