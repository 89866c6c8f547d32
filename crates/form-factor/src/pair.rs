//! Two polygons in a frame of their own: near the origin, of size about 1, each cut to what lies
//! in front of the other.

use std::cmp::Ordering;

use glam::DVec3;

use crate::Polygon;
use crate::clip::{area_vector, cut};
use crate::corners::Corners;
use crate::occluders::Bounds;

/// Heights over a plane that count as none, in the largest coordinate of the pair's frame:
/// some roundings of the plane's distance. What two polygons share stays shared.
pub(crate) const TOUCHES: f64 = 1e-14;

/// Two polygons, cut, in the order of size: the result does not depend on who comes first.
pub(crate) struct Pair {
    pub(crate) small: Part,
    pub(crate) large: Part,
    /// Area of the polygon that light leaves, whole, in the frame's units.
    pub(crate) from_area: f64,
    pub(crate) frame: Frame,
}

/// The part of a polygon that lies in front of the other's plane.
pub(crate) struct Part {
    pub(crate) corners: Corners,
    pub(crate) normal: DVec3,
    pub(crate) area: f64,
    pub(crate) longest: f64,
}

/// Where the pair's frame lies in the world.
#[derive(Clone, Copy)]
pub(crate) struct Frame {
    pub(crate) origin: DVec3,
    pub(crate) scale: f64,
    /// The largest coordinate of the pair in this frame.
    pub(crate) extent: f64,
}

impl Frame {
    #[inline]
    pub(crate) fn to_frame(self, at: DVec3) -> DVec3 {
        (at - self.origin) * self.scale
    }

    pub(crate) fn bounds(self, bounds: &Bounds) -> Bounds {
        Bounds { low: self.to_frame(bounds.low), high: self.to_frame(bounds.high) }
    }
}

impl Pair {
    /// `None` if no light goes between the two: neither is in front of the other.
    pub(crate) fn new(a: &Polygon, b: &Polygon) -> Option<Self> {
        let (small, large) = if smaller_first(a, b) { (a, b) } else { (b, a) };
        // Differences to a corner of the smaller are exact where it matters: near it.
        let mut frame =
            Frame { origin: small.corners()[0], scale: 1.0 / small.unit(), extent: 0.0 };
        let s = small.corners().iter().map(|&c| frame.to_frame(c)).collect::<Corners>();
        let l = large.corners().iter().map(|&c| frame.to_frame(c)).collect::<Corners>();
        frame.extent = s.iter().chain(l.iter()).fold(0.0, |e, c| c.abs().max_element().max(e));
        let touches = TOUCHES * frame.extent;
        let cut_large = cut(&l, small.normal(), s[0], touches)?;
        let cut_small = cut(&s, large.normal(), l[0], touches)?;
        let (small, large) = (Part::new(small, cut_small)?, Part::new(large, cut_large)?);
        let from_area = a.area_in(1.0 / frame.scale);
        let swap = small.longest > large.longest;
        let (small, large) = if swap { (large, small) } else { (small, large) };
        Some(Self { small, large, from_area, frame })
    }
}

impl Part {
    /// `None` if nothing is left.
    fn new(whole: &Polygon, corners: Corners) -> Option<Self> {
        let part = Self::of(corners, whole.normal());
        (part.area > 0.0).then_some(part)
    }

    pub(crate) fn of(corners: Corners, normal: DVec3) -> Self {
        let area = area_vector(&corners).dot(normal);
        let n = corners.len();
        let longest2 =
            (0..n).map(|i| corners[i].distance_squared(corners[(i + 1) % n])).fold(0.0, f64::max);
        Self { corners, normal, area, longest: longest2.sqrt() }
    }
}

/// Whether `a` comes first in a total order of distinct polygons by size, so that both
/// directions of a pair compute the same.
pub(crate) fn smaller_first(a: &Polygon, b: &Polygon) -> bool {
    let coordinates = |p: &Polygon| p.corners().to_vec().into_iter().flat_map(|c| c.to_array());
    let size = a.radius().total_cmp(&b.radius()).then(a.area().total_cmp(&b.area()));
    size.then_with(|| coordinates(a).partial_cmp(coordinates(b)).unwrap_or(Ordering::Equal)).is_le()
}
