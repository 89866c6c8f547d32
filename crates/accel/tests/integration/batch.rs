//! A batch answers exactly what single questions answer.

use accel::{NO_TRIANGLE, Nothing, Occluder, Segment, Target};

use crate::support::all::All;
use crate::support::rng::Rng;
use crate::support::scenes;

#[test]
fn batches_answer_as_single_segments_do() {
    for scene in [scenes::room(), scenes::columns(4, 8), scenes::soup(500, 3)] {
        let all = All::build(&scene);
        let (lo, hi) = scenes::bounds(&scene);
        let mut rng = Rng(11);
        for _ in 0..50 {
            // The first end may lie outside the scene, where it is cut off.
            let from = rng.point(lo - (hi - lo), hi + (hi - lo));
            let ignore = rng.below(scene.len()) as u32;
            let targets: Vec<Target> = (0..200)
                .map(|i| {
                    let triangle = rng.below(scene.len());
                    let point = rng.on(&scene[triangle]);
                    let ignore = if i % 3 == 0 { NO_TRIANGLE } else { triangle as u32 };
                    Target { point, ignore }
                })
                .collect();
            let single: Vec<bool> = targets
                .iter()
                .map(|t| all.occluded(&Segment { from, to: t.point, ignore: [ignore, t.ignore] }))
                .collect();
            let occluders: [&dyn Occluder; 3] = [&all.brute, &all.bvh, &all.octree];
            for occluder in occluders {
                let mut blocked = vec![false; targets.len()];
                occluder.occluded_batch(from, ignore, &targets, &mut blocked);
                assert_eq!(blocked, single);
            }
        }
    }
}

#[test]
fn the_last_blocker_is_not_carried_to_a_segment_that_ignores_it() {
    let [a, b, c] = [glam::DVec3::X, glam::DVec3::Y, glam::DVec3::NEG_ONE.with_z(0.0)];
    let all = All::build(&[[a, b, c]]);
    let point = glam::dvec3(0.0, 0.0, -1.0);
    let targets = [Target { point, ignore: NO_TRIANGLE }, Target { point, ignore: 0 }];
    let occluders: [&dyn Occluder; 3] = [&all.brute, &all.bvh, &all.octree];
    for occluder in occluders {
        let mut blocked = [false, true];
        occluder.occluded_batch(glam::DVec3::Z, NO_TRIANGLE, &targets, &mut blocked);
        assert_eq!(blocked, [true, false]);
    }
}

#[test]
fn nothing_never_blocks() {
    let through = Segment::new(glam::DVec3::ZERO, glam::DVec3::ONE);
    assert!(!Nothing.occluded(&through));
    let mut blocked = [true; 2];
    let targets = [Target { point: glam::DVec3::ONE, ignore: NO_TRIANGLE }; 2];
    Nothing.occluded_batch(glam::DVec3::ZERO, NO_TRIANGLE, &targets, &mut blocked);
    assert_eq!(blocked, [false; 2]);
}

#[test]
#[should_panic(expected = "one answer per target")]
fn a_batch_needs_one_answer_per_target() {
    let all = All::build(&scenes::room());
    all.bvh.occluded_batch(glam::DVec3::ZERO, NO_TRIANGLE, &[], &mut [false]);
}
