//! Octree, BVH and brute force, one by one and in batches: one answer.
//!
//! More than whether it fails: whether all say the same.

#![no_main]

use accel::{
    BruteForce, BruteForceConfig, Bvh, BvhConfig, NO_TRIANGLE, Occluder, Octree, OctreeConfig,
    Segment, Target,
};
use arbitrary::Arbitrary;
use glam::{DVec3, dvec3};
use libfuzzer_sys::fuzz_target;

/// A coordinate: mostly on a coarse grid, so that edges meet, lie in planes and line up; now and
/// then any number at all.
#[derive(Arbitrary, Clone, Copy, Debug)]
enum Coordinate {
    Grid(i8),
    Fine(i8, i16),
    Narrow(f32),
    Any(f64),
}

impl Coordinate {
    fn value(self) -> f64 {
        match self {
            Self::Grid(steps) => f64::from(steps % 8),
            // Beside the grid by some hundred-thousandths: within and beyond the rounding band.
            Self::Fine(steps, off) => f64::from(steps % 8) + f64::from(off) * 1e-8,
            Self::Narrow(x) => f64::from(x),
            Self::Any(x) => x,
        }
    }
}

type Point = [Coordinate; 3];

fn place([x, y, z]: Point) -> DVec3 {
    dvec3(x.value(), y.value(), z.value())
}

#[derive(Arbitrary, Debug)]
struct Scene {
    triangles: Vec<[Point; 3]>,
    from: Point,
    ignore: u8,
    targets: Vec<(Point, u8)>,
}

/// More find nothing that fewer do not, and take longer.
const MOST: usize = 200;

fuzz_target!(|scene: Scene| {
    let count = scene.triangles.len().min(MOST);
    let triangles: Vec<[DVec3; 3]> =
        scene.triangles[..count].iter().map(|corners| corners.map(place)).collect();
    let index = |i: u8| if usize::from(i) < count { u32::from(i) } else { NO_TRIANGLE };
    let targets: Vec<Target> = scene
        .targets
        .iter()
        .take(MOST)
        .map(|&(point, ignore)| Target { point: place(point), ignore: index(ignore) })
        .collect();
    let (from, ignore) = (place(scene.from), index(scene.ignore));

    let brute = BruteForce::build(&triangles, &BruteForceConfig::default());
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let octree = Octree::build(&triangles, &OctreeConfig::default());
    let expected: Vec<bool> = targets
        .iter()
        .map(|t| brute.occluded(&Segment { from, to: t.point, ignore: [ignore, t.ignore] }))
        .collect();
    let occluders: [(&str, &dyn Occluder); 3] =
        [("brute force", &brute), ("bvh", &bvh), ("octree", &octree)];
    for (name, occluder) in occluders {
        let mut batch = vec![false; targets.len()];
        occluder.occluded_batch(from, ignore, &targets, &mut batch);
        assert_eq!(batch, expected, "{name}: batch");
        for (target, expected) in targets.iter().zip(&expected) {
            let segment = Segment { from, to: target.point, ignore: [ignore, target.ignore] };
            assert_eq!(occluder.occluded(&segment), *expected, "{name}: {segment:?}");
        }
    }
});
