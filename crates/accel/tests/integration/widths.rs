//! Batches answer as single segments of brute force do, in every width, where it is hardest: ends
//! on vertices, edges and planes, slivers, every scale, every order.

use accel::{BruteForce, BruteForceConfig, Bvh, BvhConfig, NO_TRIANGLE, Occluder, Segment, Target};
use accel::{Width, bvh::Part};
use glam::{DVec3, dvec3};

use crate::support::rng::Rng;
use crate::support::{Triangle, scenes};

/// A point on a triangle: a vertex, on an edge, the centroid, or anywhere.
fn special(t: &Triangle, rng: &mut Rng) -> DVec3 {
    let (a, b) = (rng.below(3), rng.below(3));
    match rng.below(5) {
        0 => t[a],
        1 => 0.5 * (t[a] + t[b]),
        2 => t[a] + rng.unit() * (t[b] - t[a]),
        3 => (t[0] + t[1] + t[2]) / 3.0,
        _ => rng.on(t),
    }
}

/// Somewhere that has to do with a triangle: on it, in its plane, a little off, straight beyond.
fn end(scene: &[Triangle], from: DVec3, rng: &mut Rng) -> DVec3 {
    let t = scene[rng.below(scene.len())];
    let on = special(&t, rng);
    let normal = (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero();
    let size = (t[1] - t[0]).length();
    match rng.below(7) {
        0 | 1 => on,
        2 => on + (t[1] - t[0]) * (4.0 * rng.unit() - 2.0),
        3 => on + normal * size * 10_f64.powf(-8.0 * rng.unit()),
        4 => from + (on - from) * (1.0 + 10_f64.powf(-9.0 * rng.unit())),
        5 => from + (on - from) * (1.0 + 3.0 * rng.unit()),
        _ => from + (on - from) * 10_f64.powf(-12.0 * rng.unit()),
    }
}

fn check(name: &str, scene: &[Triangle], batches: usize, size: usize) {
    let brute = BruteForce::build(scene, &BruteForceConfig::default());
    let bvh = Bvh::build(scene, &BvhConfig::default());
    let widths = Width::ALL.map(|width| bvh.clone().with_width(width));
    let (lo, hi) = scenes::bounds(scene);
    let mut rng = Rng(41);
    let (mut blocked, mut asked) = (0, 0);
    for batch in 0..batches {
        let from =
            if batch % 3 == 0 { rng.point(lo, hi) } else { end(scene, 0.5 * (lo + hi), &mut rng) };
        let ignore = if batch % 2 == 0 { NO_TRIANGLE } else { rng.below(scene.len()) as u32 };
        let mut targets = Vec::new();
        // Some all over the scene, some close together, as a mesh lists them.
        while targets.len() < size {
            let first = end(scene, from, &mut rng);
            for i in 0..1 + rng.below(40) {
                let point = match i % 4 {
                    0 => first,
                    1 => first + 1e-3 * (hi - lo) * (rng.unit() - 0.5),
                    2 => end(scene, from, &mut rng),
                    _ => rng.point(lo - 0.1 * (hi - lo), hi + 0.1 * (hi - lo)),
                };
                let ignore = if i % 5 == 0 { rng.below(scene.len()) as u32 } else { NO_TRIANGLE };
                targets.push(Target { point, ignore });
            }
        }
        let expected: Vec<bool> = targets
            .iter()
            .map(|t| Segment { from, to: t.point, ignore: [ignore, t.ignore] })
            .map(|segment| brute.occluded(&segment))
            .collect();
        asked += targets.len();
        blocked += expected.iter().filter(|b| **b).count();
        for bvh in &widths {
            let mut answers = vec![batch % 2 == 0; targets.len()];
            bvh.occluded_batch(from, ignore, &targets, &mut answers);
            for (i, target) in targets.iter().enumerate() {
                let (a, e) = (answers[i], expected[i]);
                assert_eq!(a, e, "{name}, {:?}, batch {batch}: {from:?} {target:?}", bvh.width());
            }
        }
        for (target, expected) in targets.iter().zip(&expected).step_by(7) {
            let segment = Segment { from, to: target.point, ignore: [ignore, target.ignore] };
            for bvh in &widths {
                assert_eq!(bvh.occluded(&segment), *expected, "{name}, {:?}", bvh.width());
            }
        }
    }
    println!("{name}: {asked} segments in batches, {blocked} blocked, 0 differ in any width");
    assert!(blocked > asked / 50 && blocked < asked - asked / 50, "{name}: {blocked} of {asked}");
}

#[test]
fn made_scenes_in_every_width() {
    check("room", &scenes::room(), 60, 600);
    check("columns", &scenes::columns(4, 8), 40, 600);
    check("soup", &scenes::soup(800, 3), 40, 600);
    check("sphere", &scenes::sphere(10), 40, 600);
    check("cube", &scenes::cube(6), 60, 600);
}

#[test]
fn more_than_a_chunk_in_every_width() {
    check("room", &scenes::room(), 2, 10_000);
}

#[test]
fn slivers_in_every_width() {
    // From 1 : 10 to 1 : 10⁷, in every direction.
    let mut rng = Rng(42);
    let scene: Vec<Triangle> = (0..500)
        .map(|_| {
            let a = rng.point(DVec3::ZERO, DVec3::ONE);
            let along = 0.7 * rng.direction();
            let aside = 10_f64.powf(-1.0 - 6.0 * rng.unit()) * rng.direction();
            [a, a + along, a + rng.unit() * along + aside]
        })
        .collect();
    check("slivers", &scene, 40, 600);
}

#[test]
fn every_scale_in_every_width() {
    // Triangles from 1 to 10⁻³⁰ of the extent, the small ones where local coordinates are small.
    let mut rng = Rng(43);
    let mut scene = vec![
        [dvec3(-1.0, -1.0, -1.0), dvec3(1.0, -1.0, -0.9), dvec3(-1.0, 1.0, -0.8)],
        [dvec3(1.0, 1.0, 1.0), dvec3(-1.0, 1.0, 0.9), dvec3(1.0, -1.0, 0.8)],
    ];
    for i in 0..300 {
        let size = 10_f64.powf(-f64::from(i) / 10.0);
        let middle = 2.0 * size * rng.direction();
        scene.push([(); 3].map(|()| middle + size * rng.direction()));
    }
    check("every scale", &scene, 60, 600);
    for scale in [1e-12, 1e12] {
        let moved = dvec3(3.0, -2.0, 1.0) * scale;
        let scene: Vec<Triangle> =
            scenes::soup(300, 9).iter().map(|t| t.map(|v| v * scale + moved)).collect();
        check("scaled soup", &scene, 20, 400);
    }
}

#[test]
fn ends_that_are_none_or_far_off() {
    let scene = scenes::room();
    let brute = BruteForce::build(&scene, &BruteForceConfig::default());
    let bvh = Bvh::build(&scene, &BvhConfig::default());
    let mut rng = Rng(44);
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e9, 0.0];
    let ends: Vec<DVec3> = (0..400)
        .map(|_| {
            let mut point = rng.point(DVec3::ZERO, dvec3(5.0, 4.0, 3.0));
            if rng.below(3) == 0 {
                point[rng.below(3)] = odd[rng.below(odd.len())];
            }
            point
        })
        .collect();
    let targets: Vec<Target> =
        ends.iter().map(|&point| Target { point, ignore: NO_TRIANGLE }).collect();
    for &from in &ends[..60] {
        let expected: Vec<bool> =
            ends.iter().map(|&to| brute.occluded(&Segment::new(from, to))).collect();
        for width in Width::ALL {
            let mut answers = vec![true; targets.len()];
            bvh.clone().with_width(width).occluded_batch(from, NO_TRIANGLE, &targets, &mut answers);
            assert_eq!(answers, expected, "{from:?}, {width:?}");
        }
    }
}

#[test]
fn nearest_is_the_same_in_every_width() {
    let scene = scenes::soup(500, 2);
    let bvh = Bvh::build(&scene, &BvhConfig::default());
    let widths = Width::ALL.map(|width| bvh.clone().with_width(width));
    let mut rng = Rng(45);
    for _ in 0..5_000 {
        let (origin, direction) = (rng.point(DVec3::ZERO, DVec3::ONE), rng.direction());
        let hits = widths.each_ref().map(|bvh| bvh.nearest(origin, direction));
        assert!(hits[0] == hits[1] && hits[1] == hits[2], "{origin} {direction}: {hits:?}");
    }
}

#[test]
fn a_width_that_the_machine_lacks_is_not_used() {
    let bvh = Bvh::build(&scenes::room(), &BvhConfig::default());
    assert_eq!(bvh.width(), Width::fastest());
    for width in Width::ALL {
        assert_eq!(bvh.clone().with_width(width).width(), width.min(Width::widest()));
    }
}

/// Backwards, and on as many threads as there are parts.
fn backwards(parts: &mut [Part<'_>], work: &(dyn Fn(&mut Part<'_>) + Sync)) {
    std::thread::scope(|scope| {
        for part in parts.iter_mut().rev() {
            scope.spawn(move || work(part));
        }
    });
}

#[test]
fn threads_build_the_same_hierarchy() {
    let flat: Vec<Triangle> = scenes::soup(20_000, 4);
    // All in one place but one: SAH splits unevenly, and medians take over.
    let mut heap = vec![scenes::soup(1, 5)[0]; 30_000];
    heap.push([DVec3::splat(5.0), DVec3::splat(5.5), dvec3(5.0, 6.0, 5.0)]);
    for scene in [flat, heap, scenes::columns(20, 16), scenes::room()] {
        let config = BvhConfig::default();
        let alone = Bvh::build(&scene, &config);
        let together = Bvh::build_with(&scene, &config, backwards);
        alone.validate().expect("a valid hierarchy");
        assert!(format!("{alone:?}") == format!("{together:?}"));
    }
}

#[test]
#[should_panic(expected = "once for each part")]
fn no_part_is_left_out() {
    Bvh::build_with(&scenes::soup(20_000, 4), &BvhConfig::default(), |parts, work| {
        parts.iter_mut().skip(1).for_each(work);
    });
}
