//! Kernels of `accel`: structures built, and segments asked about.
//!
//! All but those that say otherwise answer four lanes wide, which every machine can: the counts
//! then do not depend on the machine.

use accel::{Bvh, BvhConfig, Occluder, Octree, OctreeConfig, Segment, Target, Width};
use glam::DVec3;

use crate::count::count;
use crate::random::Random;
use crate::scenes;

/// Segments asked about one by one.
const SEGMENTS: usize = 4096;

/// Targets of a batch.
const TARGETS: usize = 16_384;

/// Segments start this far off their surfaces, as a share of the extent: as those of a shot do.
const LIFT: f64 = 5e-6;

/// Nodes depend on the triangles alone; the width is looked up before, since finding it asks the
/// machine.
pub(crate) fn build_bvh() -> f64 {
    let triangles = hall();
    Width::widest();
    count(|| Bvh::build(&triangles, &BvhConfig::default())).stats().nodes as f64
}

pub(crate) fn build_octree() -> f64 {
    let triangles = hall();
    count(|| Octree::build(&triangles, &OctreeConfig::default())).stats().leaves as f64
}

pub(crate) fn single_bvh() -> f64 {
    let triangles = hall();
    single(&bvh(&triangles, Width::Four), &triangles)
}

pub(crate) fn single_bvh_8() -> f64 {
    let triangles = hall();
    single(&bvh(&triangles, Width::Eight), &triangles)
}

pub(crate) fn single_octree() -> f64 {
    let triangles = hall();
    single(&Octree::build(&triangles, &OctreeConfig::default()), &triangles)
}

pub(crate) fn batch_bvh() -> f64 {
    let triangles = hall();
    batch(&bvh(&triangles, Width::Four), &triangles)
}

pub(crate) fn batch_bvh_8() -> f64 {
    let triangles = hall();
    batch(&bvh(&triangles, Width::Eight), &triangles)
}

pub(crate) fn batch_octree() -> f64 {
    let triangles = hall();
    batch(&Octree::build(&triangles, &OctreeConfig::default()), &triangles)
}

/// Rays that meet something.
pub(crate) fn nearest_bvh() -> f64 {
    let triangles = hall();
    let bvh = bvh(&triangles, Width::Four);
    let segments = segments(&triangles);
    let meets = |s: &&Segment| bvh.nearest(s.from, s.to - s.from).is_some();
    count(|| segments.iter().filter(meets).count()) as f64
}

/// A hierarchy that answers in this width and no other.
///
/// # Panics
/// If the machine has no such width: it would answer in a narrower one, and count differently.
pub(crate) fn bvh(triangles: &[[DVec3; 3]], width: Width) -> Bvh {
    let bvh = Bvh::build(triangles, &BvhConfig::default()).with_width(width);
    assert_eq!(bvh.width(), width, "the machine has no lanes of this width");
    bvh
}

fn hall() -> Vec<[DVec3; 3]> {
    scenes::read(scenes::HALL)
}

/// How many segments are blocked, asked one by one.
fn single(occluder: &dyn Occluder, triangles: &[[DVec3; 3]]) -> f64 {
    let segments = segments(triangles);
    count(|| segments.iter().filter(|segment| occluder.occluded(segment)).count()) as f64
}

/// How many segments from one place are blocked, asked all at once.
fn batch(occluder: &dyn Occluder, triangles: &[[DVec3; 3]]) -> f64 {
    let mut random = Random(5);
    let (from, ignore) = start(triangles, lift(triangles), &mut random);
    let targets: Vec<Target> = (0..TARGETS)
        .map(|i| {
            // In the order of the file, as a solver shoots.
            let target = i * triangles.len() / TARGETS;
            Target { point: random.on(triangles[target]), ignore: target as u32 }
        })
        .collect();
    let mut blocked = vec![false; TARGETS];
    count(|| occluder.occluded_batch(from, ignore, &targets, &mut blocked));
    blocked.iter().filter(|blocked| **blocked).count() as f64
}

/// From places in front of triangles to places on others.
fn segments(triangles: &[[DVec3; 3]]) -> Vec<Segment> {
    let mut random = Random(4);
    let lift = lift(triangles);
    (0..SEGMENTS)
        .map(|_| {
            let (from, ignore) = start(triangles, lift, &mut random);
            let target = random.below(triangles.len());
            Segment { from, to: random.on(triangles[target]), ignore: [ignore, target as u32] }
        })
        .collect()
}

/// A place in front of a triangle, and the triangle.
fn start(triangles: &[[DVec3; 3]], lift: f64, random: &mut Random) -> (DVec3, u32) {
    let source = random.below(triangles.len());
    let [a, b, c] = triangles[source];
    let normal = (b - a).cross(c - a).normalize_or_zero();
    ((a + b + c) / 3.0 + normal * lift, source as u32)
}

/// How far segments start off their surfaces.
fn lift(triangles: &[[DVec3; 3]]) -> f64 {
    let none = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let all = triangles.iter().flatten();
    let (low, high) = all.fold(none, |(low, high), v| (low.min(*v), high.max(*v)));
    LIFT * (high - low).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_structure_and_width_gives_the_same_answers() {
        let (single, batch) = (single_octree(), batch_octree());
        assert_eq!((single_bvh(), batch_bvh()), (single, batch));
        if Width::widest() >= Width::Eight {
            assert_eq!((single_bvh_8(), batch_bvh_8()), (single, batch));
        }
        // A closed hall with columns: some are blocked and some are not, and every ray ends.
        let share = [single / SEGMENTS as f64, batch / TARGETS as f64];
        assert!(share.iter().all(|share| (0.1..0.95).contains(share)), "{share:?}");
        assert_eq!(nearest_bvh(), SEGMENTS as f64);
    }

    #[test]
    fn structures_have_parts() {
        assert!(build_bvh() > 100.0 && build_octree() > 100.0);
    }
}
