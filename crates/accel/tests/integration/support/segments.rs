//! Segments to ask about.

use accel::{NO_TRIANGLE, Segment};
use glam::DVec3;

use super::Triangle;
use super::rng::Rng;

/// Between two random points of a box.
pub(crate) fn random(lo: DVec3, hi: DVec3, rng: &mut Rng) -> Segment {
    Segment::new(rng.point(lo, hi), rng.point(lo, hi))
}

/// From a little in front of a random triangle's centroid to a point on another triangle, both
/// ignored: what a solver asks.
pub(crate) fn shooting(scene: &[Triangle], offset: f64, rng: &mut Rng) -> Segment {
    let (source, target) = (rng.below(scene.len()), rng.below(scene.len()));
    let [a, b, c] = scene[source];
    let normal = (b - a).cross(c - a).normalize_or_zero();
    let from = (a + b + c) / 3.0 + offset * normal;
    let ignore = [source as u32, if target == source { NO_TRIANGLE } else { target as u32 }];
    Segment { from, to: rng.on(&scene[target]), ignore }
}
