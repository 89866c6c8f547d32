//! Cutting convex polygons by planes.

use glam::DVec3;

use crate::corners::Corners;

/// The part of a polygon in front of the plane through `on`, or `None` if no corner is farther
/// in front than `touches`. Corners within `touches` of the plane count as on it.
pub(crate) fn cut(corners: &[DVec3], normal: DVec3, on: DVec3, touches: f64) -> Option<Corners> {
    let height = |corner: DVec3| {
        let h = normal.dot(corner - on);
        if h.abs() <= touches { 0.0 } else { h }
    };
    let (mut any_above, mut any_below) = (false, false);
    for &corner in corners {
        let h = height(corner);
        any_above |= h > 0.0;
        any_below |= h < 0.0;
    }
    if !any_above {
        return None;
    }
    if !any_below {
        return Some(corners.iter().copied().collect());
    }
    let mut out = Corners::new();
    let mut before = corners[corners.len() - 1];
    let mut before_height = height(before);
    for &corner in corners {
        let h = height(corner);
        if (h > 0.0) != (before_height > 0.0) && h != 0.0 && before_height != 0.0 {
            out.push(before + (corner - before) * (before_height / (before_height - h)));
        }
        if h >= 0.0 {
            out.push(corner);
        }
        (before, before_height) = (corner, h);
    }
    (out.len() >= 3).then_some(out)
}

/// The normal times the area.
pub(crate) fn area_vector(corners: &[DVec3]) -> DVec3 {
    let first = corners[0];
    let fan = corners[1..].windows(2).map(|pair| (pair[0] - first).cross(pair[1] - first));
    fan.sum::<DVec3>() / 2.0
}

/// A polygon cut in two: a triangle at the middle of its longest edge, another by a diagonal.
pub(crate) fn halves(corners: &[DVec3]) -> [Corners; 2] {
    if let [p, q, r] = *corners {
        let [one, two, three] = [p.distance(q), q.distance(r), r.distance(p)];
        let [p, q, r] = if one >= two && one >= three {
            [p, q, r]
        } else if two >= three {
            [q, r, p]
        } else {
            [r, p, q]
        };
        let middle = (p + q) / 2.0;
        [[p, middle, r], [middle, q, r]].map(|triangle| triangle.into_iter().collect())
    } else {
        let half = corners.len() / 2;
        let rest = corners[half..].iter().chain(&corners[..1]);
        [corners[..=half].iter().copied().collect(), rest.copied().collect()]
    }
}
