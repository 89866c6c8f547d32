//! The first hit along a ray: BVH against brute force, and both against closed forms.

use glam::{DVec3, dvec3};

use crate::support::all::All;
use crate::support::rng::Rng;
use crate::support::scenes;

#[test]
fn bvh_finds_what_brute_force_finds() {
    let scenes = [scenes::room(), scenes::columns(4, 8), scenes::soup(1000, 4), scenes::sphere(10)];
    for scene in scenes {
        let all = All::build(&scene);
        let (lo, hi) = scenes::bounds(&scene);
        let margin = 0.5 * (hi - lo);
        let mut rng = Rng(31);
        let mut hits = 0;
        for _ in 0..30_000 {
            let origin = rng.point(lo - margin, hi + margin);
            let direction = 10_f64.powf(6.0 * rng.unit() - 3.0) * rng.direction();
            let hit = all.bvh.nearest(origin, direction);
            assert_eq!(hit, all.brute.nearest(origin, direction), "{origin} {direction}");
            hits += usize::from(hit.is_some());
        }
        assert!(hits > 1000 && hits < 30_000, "{hits} hits");
    }
}

#[test]
fn distances_in_a_cube_are_those_to_its_planes() {
    let all = All::build(&scenes::cube(5));
    let mut rng = Rng(32);
    for _ in 0..20_000 {
        let origin = rng.point(DVec3::splat(-0.9), DVec3::splat(0.9));
        let direction = rng.direction();
        // The ray leaves [-1, 1]³ through the first of the three planes ahead.
        let t = (DVec3::ONE - origin * direction.signum()) / direction.abs();
        let expected = t.min_element();
        let hit = all.bvh.nearest(origin, direction).expect("a cube is closed");
        // The oblique distance to a plane errs by the band over the cosine, which is at least
        // 1/√3 for the first plane met from the centre, and 0.05 over a length of 2 near a face.
        let band = accel::rounding_band(2.0) * 40.0;
        assert!((hit.t - expected).abs() < band, "{hit:?}, expected {expected}");
    }
}

#[test]
fn sides_follow_the_winding() {
    let floor = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let all = All::build(&[floor]);
    for (x, y) in [(0.2, 0.3), (0.5, 0.1)] {
        for slant in [DVec3::ZERO, dvec3(0.1, 0.05, 0.0), dvec3(-0.05, 0.1, 0.0)] {
            let down = all.bvh.nearest(dvec3(x, y, 1.0) - slant, slant - DVec3::Z);
            let up = all.bvh.nearest(dvec3(x, y, -1.0) - slant, slant + DVec3::Z);
            assert!(down.is_some_and(|hit| hit.front), "{down:?}");
            assert!(up.is_some_and(|hit| !hit.front), "{up:?}");
        }
    }
    // From inside, the fronts of a room; from outside, its backs; along every axis.
    let room = All::build(&scenes::cuboid(DVec3::NEG_ONE, DVec3::ONE));
    let mut rng = Rng(33);
    for _ in 0..5000 {
        let direction = rng.direction();
        let inside = room.bvh.nearest(0.3 * rng.direction(), direction).expect("closed");
        assert!(!inside.front, "fronts of this box look outward");
        let outside = room.bvh.nearest(-5.0 * direction, direction).expect("through the centre");
        assert!(outside.front && outside.t > 3.2 && outside.t < 4.0 + 1e-5, "{outside:?}");
    }
}

#[test]
fn rays_that_are_none_meet_nothing() {
    let all = All::build(&scenes::room());
    let inside = dvec3(1.0, 1.0, 1.0);
    for (origin, direction) in [
        (inside, DVec3::ZERO),
        (inside, DVec3::splat(f64::NAN)),
        (inside, DVec3::X * f64::INFINITY),
        (DVec3::splat(f64::NAN), DVec3::X),
        (dvec3(-1.0, 1.0, 1.0), DVec3::NEG_X),
    ] {
        assert_eq!(all.bvh.nearest(origin, direction), None);
        assert_eq!(all.brute.nearest(origin, direction), None);
    }
}

#[test]
fn coincident_triangles_give_the_least_index() {
    let floor = [DVec3::ZERO, DVec3::X, DVec3::Y];
    let all = All::build(&vec![floor; 1000]);
    let hit = all.bvh.nearest(dvec3(0.2, 0.2, 1.0), DVec3::NEG_Z).expect("a floor below");
    assert_eq!(hit.triangle, 0);
    assert_eq!(all.brute.nearest(dvec3(0.2, 0.2, 1.0), DVec3::NEG_Z), Some(hit));
}
