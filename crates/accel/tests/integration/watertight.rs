//! Segments aimed at the shared edges and vertices of closed surfaces do not leak out.

use accel::Segment;
use glam::DVec3;

use crate::support::all::All;
use crate::support::rng::Rng;
use crate::support::{Triangle, scenes};

/// Aims from inside at vertices, edge midpoints and random points of edges, and beyond.
fn check(name: &str, scene: &[Triangle], inside: impl Fn(&mut Rng) -> DVec3, count: usize) {
    let all = All::build(scene);
    let mut rng = Rng(21);
    for i in 0..count {
        let triangle = scene[rng.below(scene.len())];
        let side = rng.below(3);
        let (a, b) = (triangle[side], triangle[(side + 1) % 3]);
        let aim = match i % 3 {
            0 => a,
            1 => 0.5 * (a + b),
            _ => a + rng.unit() * (b - a),
        };
        let from = inside(&mut rng);
        // Ends at most 100 times as far, so that some ends lie outside the bounds and are cut off.
        let to = from + (aim - from) * (1.5 + 100.0 * rng.unit() * f64::from(i as u32 % 2));
        let segment = Segment::new(from, to);
        assert!(all.occluded(&segment), "{name}: {segment:?} escapes at {aim}");
        let hit = all.bvh.nearest(from, aim - from);
        assert_eq!(hit, all.brute.nearest(from, aim - from), "{name}: {segment:?}");
        assert!(hit.is_some_and(|hit| (hit.t - 1.0).abs() < 1e-3), "{name}: {hit:?}");
    }
    println!("{name}: {count} segments at edges and vertices, 0 escapes");
}

/// Points within half the radius of the surfaces around the origin.
fn near_centre(rng: &mut Rng) -> DVec3 {
    0.5 * rng.unit() * rng.direction()
}

#[test]
fn sphere_is_tight() {
    check("sphere", &scenes::sphere(12), near_centre, 100_000);
}

#[test]
fn cube_is_tight() {
    check("cube", &scenes::cube(6), near_centre, 100_000);
}

#[test]
fn the_very_centre_sees_no_gap() {
    // Coordinates along the axes and diagonals are exact here: edge functions are exact zeros.
    check("sphere from its centre", &scenes::sphere(12), |_| DVec3::ZERO, 20_000);
    check("cube from its centre", &scenes::cube(6), |_| DVec3::ZERO, 20_000);
}

#[test]
fn moved_turned_and_stretched_surfaces_are_tight() {
    let turn = glam::DQuat::from_axis_angle(DVec3::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let place = |p: DVec3| turn * (p * DVec3::new(1.0, 30.0, 0.01)) * 1e3 + DVec3::splat(1e5);
    let scene: Vec<Triangle> = scenes::sphere(12).iter().map(|t| t.map(place)).collect();
    let all = All::build(&scene);
    let mut rng = Rng(22);
    for _ in 0..50_000 {
        let triangle = scene[rng.below(scene.len())];
        let aim = triangle[0] + rng.unit() * (triangle[1] - triangle[0]);
        let from = place(near_centre(&mut rng));
        assert!(all.occluded(&Segment::new(from, from + 1000.0 * (aim - from))));
    }
}
