//! The nearest triangle along a ray.

use crate::NO_TRIANGLE;
use crate::triangle::Crossing;

/// Where a ray first meets a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray's parameter at the hit, in lengths of the direction it was asked with; above 0.
    pub t: f64,
    /// The triangle's index when the occluder was built.
    pub triangle: u32,
    /// Whether the ray meets the side from which the corners appear counter-clockwise.
    pub front: bool,
}

impl Hit {
    /// Where a search starts: nothing met up to the end of the segment that stands for the ray.
    pub(crate) const NONE: Self = Self { t: 1.0, triangle: NO_TRIANGLE, front: false };

    /// Takes `crossing` if it comes before the best so far, or at the same place with a lesser
    /// index, so that the order of the search does not show.
    pub(crate) fn improve(&mut self, triangle: u32, crossing: &Crossing) {
        if crossing.t < self.t || (crossing.t == self.t && triangle < self.triangle) {
            *self = Self { t: crossing.t, triangle, front: crossing.front };
        }
    }

    /// The answer in the ray's own parameter; `span` says where the segment lies on the ray.
    pub(crate) fn finish(self, span: (f64, f64)) -> Option<Self> {
        let t = span.0 + (span.1 - span.0) * self.t;
        (self.triangle != NO_TRIANGLE && t > 0.0).then_some(Self { t, ..self })
    }
}
