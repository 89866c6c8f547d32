//! Takes convex polygons out of convex polygons of the same plane.

use glam::DVec3;

/// What a convex polygon leaves of `pieces`, all in one plane with normal `normal`. What is
/// thinner than `near` is dropped.
///
/// Each edge of the polygon in turn cuts off what lies outside it, so that a piece leaves
/// at most as many pieces as the polygon has edges, all convex.
pub(super) fn subtract(
    pieces: &[Vec<DVec3>],
    polygon: &[DVec3],
    normal: DVec3,
    near: f64,
) -> Vec<Vec<DVec3>> {
    let mut left = Vec::new();
    for piece in pieces {
        let mut outside = Vec::new();
        let mut rest = piece.clone();
        for (k, &from) in polygon.iter().enumerate() {
            let to = polygon[(k + 1) % polygon.len()];
            let inward = normal.cross(to - from).normalize_or_zero();
            outside.extend(side(&rest, |p| (from - p).dot(inward), near));
            rest = side(&rest, |p| (p - from).dot(inward), near).unwrap_or_default();
            if rest.is_empty() {
                break;
            }
        }
        // A piece that the polygon misses stays whole, not in the parts it was tried in.
        if rest.is_empty() {
            left.push(piece.clone());
        } else {
            left.extend(outside);
        }
    }
    left
}

/// The part of a convex polygon where `height` is positive, or `None` if nothing is higher
/// than `near`.
fn side(polygon: &[DVec3], height: impl Fn(DVec3) -> f64, near: f64) -> Option<Vec<DVec3>> {
    // A corner within `near` of the line counts as on it, so that no sliver comes of it.
    let heights: Vec<f64> =
        polygon.iter().map(|&p| height(p)).map(|h| if h.abs() <= near { 0.0 } else { h }).collect();
    if !heights.iter().any(|&h| h > 0.0) {
        return None;
    }
    let mut part = Vec::with_capacity(polygon.len() + 1);
    for (k, (&p, &h)) in polygon.iter().zip(&heights).enumerate() {
        let next = (k + 1) % polygon.len();
        if h >= 0.0 {
            part.push(p);
        }
        if h * heights[next] < 0.0 {
            part.push(p.lerp(polygon[next], h / (h - heights[next])));
        }
    }
    Some(part)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rectangle(x: [f64; 2], y: [f64; 2]) -> Vec<DVec3> {
        [(x[0], y[0]), (x[1], y[0]), (x[1], y[1]), (x[0], y[1])]
            .map(|(x, y)| DVec3::new(x, y, 0.0))
            .to_vec()
    }

    fn area(pieces: &[Vec<DVec3>]) -> f64 {
        let of = |p: &Vec<DVec3>| -> f64 {
            (1..p.len() - 1).map(|i| 0.5 * (p[i] - p[0]).cross(p[i + 1] - p[0]).z).sum()
        };
        pieces.iter().map(of).sum()
    }

    #[test]
    fn areas_are_those_of_squared_paper() {
        let wall = vec![rectangle([0.0, 6.0], [0.0, 3.0])];
        // A door that reaches the floor, then a window, one inside, one partly outside.
        let door = rectangle([1.0, 2.0], [0.0, 2.0]);
        let left = subtract(&wall, &door, DVec3::Z, 1e-9);
        assert_eq!((left.len(), area(&left)), (3, 16.0));
        let left = subtract(&left, &rectangle([3.0, 5.0], [1.0, 2.0]), DVec3::Z, 1e-9);
        assert_eq!(area(&left), 14.0);
        let left = subtract(&left, &rectangle([5.5, 9.0], [2.5, 9.0]), DVec3::Z, 1e-9);
        assert_eq!(area(&left), 13.75);
        // The same again takes nothing, and all of it leaves nothing.
        assert_eq!(subtract(&left, &door, DVec3::Z, 1e-9), left);
        assert_eq!(area(&subtract(&left, &wall[0], DVec3::Z, 1e-9)), 0.0);
    }

    #[test]
    fn what_only_touches_stays_as_it_was() {
        let wall = vec![rectangle([0.0, 6.0], [0.0, 3.0])];
        for beside in [rectangle([6.0, 7.0], [0.0, 3.0]), rectangle([8.0, 9.0], [0.0, 1.0])] {
            assert_eq!(subtract(&wall, &beside, DVec3::Z, 1e-9), wall);
        }
    }
}
