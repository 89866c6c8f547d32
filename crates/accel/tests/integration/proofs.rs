//! What is said of many segments at once holds of each of them.

use accel::proof::{Objects, Plane, Spaces, Walls, never_block};
use accel::{Bvh, BvhConfig, NO_TRIANGLE, Occluder, Proofs, Proven, Segment, Sight};
use glam::{DVec3, dvec3};

use crate::support::Triangle;
use crate::support::rng::Rng;
use crate::support::scenes;

/// How far from surfaces segments begin and end, as the solver has it.
fn lift(triangles: &[Triangle]) -> f64 {
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for p in triangles.iter().flatten() {
        (low, high) = (low.min(*p), high.max(*p));
    }
    5e-6 * (high - low).length()
}

/// Two rooms wall to wall with things in them, fronts inward.
fn two_rooms() -> Vec<Triangle> {
    let mut scene = scenes::room();
    let second = scenes::room();
    scene.extend(second.iter().map(|t| t.map(|p| p + dvec3(5.0, 0.0, 0.0))));
    scene
}

/// A room with one small box in the air and a screen across half of it.
fn screened() -> Vec<Triangle> {
    let mut scene = scenes::cuboid(DVec3::ZERO, dvec3(5.0, 4.0, 3.0));
    scene.iter_mut().for_each(|t| t.swap(1, 2));
    scene.extend(scenes::cuboid(dvec3(4.0, 3.0, 1.0), dvec3(4.2, 3.2, 1.2)));
    scene.extend(scenes::cuboid(dvec3(2.4, 0.5, 0.2), dvec3(2.5, 3.9, 2.9)));
    scene
}

/// A place on a triangle, off its rim.
fn place(rng: &mut Rng, t: &Triangle) -> DVec3 {
    rng.on(t).lerp((t[0] + t[1] + t[2]) / 3.0, 0.02)
}

fn proofs(triangles: &[Triangle]) -> (Vec<bool>, Proofs) {
    let lift = lift(triangles);
    let never = never_block(triangles, |_| false, lift);
    let may_block = |t: usize| !never[t];
    let proofs = Proofs {
        walls: Walls::of(triangles, may_block, 1.0 / 256.0, 16),
        objects: Some(Objects::of(triangles, may_block)),
        spaces: Spaces::of(triangles, |_| false, lift),
        lift,
    };
    (never, proofs)
}

/// Pieces of triangles, small enough for proofs to hold of some.
fn pieces(triangles: &[Triangle]) -> Vec<(usize, Triangle)> {
    let mut pieces: Vec<(usize, Triangle)> = triangles.iter().copied().enumerate().collect();
    for _ in 0..2 {
        let quarter = |(i, [a, b, c]): (usize, Triangle)| {
            let (ab, bc, ca) = (a.midpoint(b), b.midpoint(c), c.midpoint(a));
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]].map(|t| (i, t))
        };
        pieces = pieces.into_iter().flat_map(quarter).collect();
    }
    pieces
}

fn bounds(t: &Triangle) -> (DVec3, DVec3) {
    (t[0].min(t[1]).min(t[2]), t[0].max(t[1]).max(t[2]))
}

/// Compares what is said of pairs of pieces with segments between them; returns how many were open,
/// blocked, unknown.
fn compare(triangles: &[Triangle], seed: u64) -> [usize; 3] {
    let (_, proofs) = proofs(triangles);
    let bvh = Bvh::build(triangles, &BvhConfig::default());
    let proven = Proven::new(&bvh, &proofs);
    let pieces = pieces(triangles);
    let mut rng = Rng(seed);
    let mut counts = [0; 3];
    let pick = |rng: &mut Rng| pieces[rng.below(pieces.len())];
    for _ in 0..20_000 {
        let ((i, from), (j, to)) = (pick(&mut rng), pick(&mut rng));
        let (Some(a), Some(b)) = (Plane::of(from), Plane::of(to)) else { continue };
        let (low, high) = bounds(&to);
        let sight = proven.look_from(from).map(|o| o.sight(low, high, Some(&b)));
        let sight = sight.unwrap_or(Sight::Unknown);
        for _ in 0..4 {
            let (p, q) = (place(&mut rng, &from), place(&mut rng, &to));
            let facing = a.height(q) > 1e-9 && from.iter().any(|c| b.height(*c) > 1e-9);
            if !facing {
                continue;
            }
            counts[sight as usize] += 1;
            let ends = (p + proofs.lift * a.normal, q + proofs.lift * b.normal);
            let ignore = [i as u32, j as u32];
            let blocked = bvh.occluded(&Segment { from: ends.0, to: ends.1, ignore });
            match sight {
                Sight::Open => assert!(!blocked, "{from:?} to {to:?}: {p} to {q}"),
                Sight::Blocked => assert!(blocked, "{from:?} to {to:?}: {p} to {q}"),
                Sight::Unknown => {}
            }
        }
    }
    counts
}

#[test]
fn open_ways_are_open_and_hidden_ones_are_blocked() {
    let mut all = [0; 3];
    for (seed, scene) in [scenes::room(), screened(), two_rooms()].iter().enumerate() {
        let counts = compare(scene, seed as u64 + 1);
        println!("open {}, blocked {}, unknown {}", counts[0], counts[1], counts[2]);
        all = [0, 1, 2].map(|i| all[i] + counts[i]);
    }
    assert!(all.iter().all(|n| *n > 1000), "each is said of many: {all:?}");
}

#[test]
fn tilted_and_moved_the_same_holds() {
    let turn = glam::DMat3::from_euler(glam::EulerRot::XYZ, 0.3, -0.7, 1.1);
    let moved = |t: &Triangle| t.map(|p| turn * p + dvec3(1e3, -2e3, 5e2));
    let scene: Vec<Triangle> = screened().iter().map(moved).collect();
    let counts = compare(&scene, 9);
    assert!(counts[0] + counts[1] > 1000, "{counts:?}");
}

#[test]
fn what_never_blocks_changes_no_answer() {
    for (seed, scene) in [scenes::room(), screened(), two_rooms()].iter().enumerate() {
        let (never, proofs) = proofs(scene);
        assert!(never.iter().any(|n| *n) && !never.iter().all(|n| *n));
        let all = Bvh::build(scene, &BvhConfig::default());
        let some = Bvh::build_of(
            scene,
            |t| !never[t],
            &BvhConfig::default(),
            |parts, work| parts.iter_mut().for_each(work),
        );
        let mut rng = Rng(seed as u64 + 77);
        let pick = |rng: &mut Rng| rng.below(scene.len());
        for _ in 0..100_000 {
            let (i, j) = (pick(&mut rng), pick(&mut rng));
            let (Some(a), Some(b)) = (Plane::of(scene[i]), Plane::of(scene[j])) else { continue };
            let (p, q) = (place(&mut rng, &scene[i]), place(&mut rng, &scene[j]));
            if a.height(q) > 1e-9 && b.height(p) > 1e-9 {
                let from = p + proofs.lift * a.normal;
                let to = q + proofs.lift * b.normal;
                let segment = Segment { from, to, ignore: [i as u32, j as u32] };
                assert_eq!(all.occluded(&segment), some.occluded(&segment), "{segment:?}");
            }
        }
    }
}

#[test]
fn all_of_a_box_from_inside_never_blocks_and_of_a_wedge_some_may() {
    let mut cube = scenes::cuboid(DVec3::ZERO, DVec3::ONE);
    assert!(never_block(&cube, |_| false, 5e-6).iter().all(|n| *n), "from outside");
    cube.iter_mut().for_each(|t| t.swap(1, 2));
    assert!(never_block(&cube, |_| false, 5e-6).iter().all(|n| *n), "from inside");
    // Two planes at 30 degrees, each in front of the other: a lift off one may cross the other.
    let (sin, cos) = std::f64::consts::FRAC_PI_6.sin_cos();
    let at = |x: f64, y: f64| dvec3(x, y, 0.0);
    let tilted = |x: f64, y: f64| dvec3(x * cos, y, x * sin);
    let wedge = [
        [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0)],
        [tilted(0.0, 0.0), tilted(0.0, 1.0), tilted(1.0, 0.0)],
    ];
    assert_eq!(never_block(&wedge, |_| false, 5e-6), [false; 2]);
}

#[test]
fn different_spaces_see_nothing_of_each_other() {
    let scene = two_rooms();
    let spaces = Spaces::of(&scene, |_| false, lift(&scene));
    assert!(spaces.shells() > 0);
    let bvh = Bvh::build(&scene, &BvhConfig::default());
    let mut rng = Rng(5);
    let (mut apart, mut together) = (0, 0);
    for _ in 0..20_000 {
        let mut point = || rng.point(dvec3(0.1, 0.1, 0.1), dvec3(9.9, 3.9, 2.9));
        let (p, q) = (point(), point());
        let (Some(a), Some(b)) = (spaces.space(p), spaces.space(q)) else { continue };
        if a == b {
            together += 1;
            continue;
        }
        apart += 1;
        let segment = Segment { from: p, to: q, ignore: [NO_TRIANGLE; 2] };
        assert!(bvh.occluded(&segment), "{p} and {q}");
    }
    assert!(apart > 1000 && together > 1000, "{apart} {together}");
}
