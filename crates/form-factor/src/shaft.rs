//! The convex hull of two polygons: what lies outside blocks nothing between them.

use glam::DVec3;

use crate::clip::cut;
use crate::corners::Corners;
use crate::occluders::Bounds;

/// Corners of the one times corners of the other beyond which only the box serves: planes take
/// their product times their sum.
const MOST_CORNERS: usize = 64;

/// The hull of two convex polygons by planes that support it, and its box.
///
/// # References
/// Haines & Wallace 1991, "Shaft culling for efficient ray-traced radiosity".
pub(crate) struct Shaft {
    /// Outward normal and height of each plane.
    planes: Vec<(DVec3, f64)>,
    bounds: Bounds,
    /// Length that counts as none.
    touches: f64,
}

impl Shaft {
    pub(crate) fn new(one: &[DVec3], two: &[DVec3], touches: f64) -> Self {
        let mut planes = Vec::new();
        if one.len() * two.len() <= MOST_CORNERS {
            support(one, two, touches, &mut planes);
            support(two, one, touches, &mut planes);
        }
        Self { planes, bounds: Bounds::of(one.iter().chain(two).copied()), touches }
    }

    /// Whether a box may reach into the inside.
    pub(crate) fn meets(&self, bounds: &Bounds) -> bool {
        let Bounds { low, high } = *bounds;
        if self.misses_box(bounds) {
            return false;
        }
        self.planes.iter().all(|&(normal, height)| {
            let nearest = DVec3::select(normal.cmplt(DVec3::ZERO), high, low);
            normal.dot(nearest) < height - self.touches
        })
    }

    /// Whether a convex polygon may reach into the inside.
    pub(crate) fn meets_polygon(&self, corners: &[DVec3]) -> bool {
        if self.misses_box(&Bounds::of(corners.iter().copied())) {
            return false;
        }
        self.planes.iter().all(|&(normal, height)| {
            corners.iter().any(|&corner| normal.dot(corner) < height - self.touches)
        })
    }

    /// The part of a convex polygon in the inside.
    pub(crate) fn part(&self, corners: &[DVec3]) -> Option<Corners> {
        let mut part: Corners = corners.iter().copied().collect();
        for &(normal, height) in &self.planes {
            part = cut(&part, -normal, normal * height, self.touches)?;
        }
        Some(part)
    }

    fn misses_box(&self, bounds: &Bounds) -> bool {
        let touches = DVec3::splat(self.touches);
        bounds.low.cmpge(self.bounds.high - touches).any()
            || bounds.high.cmple(self.bounds.low + touches).any()
    }
}

/// Adds the planes through an edge of `one` and a corner of `two` with all on one side.
fn support(one: &[DVec3], two: &[DVec3], touches: f64, planes: &mut Vec<(DVec3, f64)>) {
    for i in 0..one.len() {
        let (p, q) = (one[i], one[(i + 1) % one.len()]);
        for &corner in two {
            let normal = (q - p).cross(corner - p).normalize_or_zero();
            if normal == DVec3::ZERO {
                continue;
            }
            let heights = one.iter().chain(two).map(|&c| normal.dot(c - p));
            let (low, high) = heights.fold((0.0f64, 0.0f64), |(l, h), x| (l.min(x), h.max(x)));
            if high <= touches {
                planes.push((normal, normal.dot(p)));
            } else if low >= -touches {
                planes.push((-normal, -normal.dot(p)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, z: f64) -> [DVec3; 4] {
        [[x, 0.0, z], [x + 1.0, 0.0, z], [x + 1.0, 1.0, z], [x, 1.0, z]].map(DVec3::from)
    }

    #[test]
    fn inside_meets_and_outside_does_not() {
        // From x in 0..1 at the bottom to 4..5 at the top: a slanted shaft.
        let shaft = Shaft::new(&square(0.0, 0.0), &square(4.0, 4.0), 1e-14);
        assert!(shaft.meets_polygon(&square(2.0, 2.0)));
        assert!(shaft.meets_polygon(&square(2.9, 2.0)));
        assert!(!shaft.meets_polygon(&square(3.0, 2.0)), "touches");
        assert!(!shaft.meets_polygon(&square(3.1, 2.0)), "in the box, but not in the shaft");
        assert!(!shaft.meets_polygon(&square(0.5, 4.0)), "beside the upper square");
        let bounds = |x: f64| Bounds::of(square(x, 2.0));
        assert!(shaft.meets(&bounds(2.5)) && !shaft.meets(&bounds(3.5)));
    }
}
