//! Input at the limits: nothing, too much of the same, too thin, too far, too flat.

use accel::{
    Bvh, BvhConfig, NO_TRIANGLE, Occluder, Octree, OctreeConfig, Segment, Target, rounding_band,
};
use glam::{DVec3, dvec3};

use crate::support::all::All;
use crate::support::reference::{self, Verdict};
use crate::support::rng::Rng;
use crate::support::{Triangle, scenes, segments};

const FLOOR: Triangle = [DVec3::ZERO, DVec3::X, DVec3::Y];

fn through(x: f64, y: f64) -> Segment {
    Segment::new(dvec3(x, y, 1.0), dvec3(x, y, -1.0))
}

/// Compares all structures with the reference on random segments; returns how many it was sure of.
fn agree(scene: &[Triangle], lo: DVec3, hi: DVec3, count: usize) -> usize {
    let all = All::build(scene);
    all.bvh.validate().expect("a valid hierarchy");
    all.octree.validate().expect("a valid octree");
    let band = rounding_band(all.bvh.extent());
    let mut rng = Rng(41);
    let mut sure = 0;
    for _ in 0..count {
        let segment = segments::random(lo, hi, &mut rng);
        let answer = all.occluded(&segment);
        match reference::occluded(scene, &segment, band) {
            Verdict::Unsure => {}
            verdict => {
                sure += 1;
                assert_eq!(answer, verdict == Verdict::Blocked, "{segment:?}");
            }
        }
    }
    sure
}

#[test]
fn an_empty_scene_blocks_nothing() {
    let all = All::build(&[]);
    assert!(!all.occluded(&through(0.2, 0.2)));
    assert_eq!(all.bvh.nearest(DVec3::ZERO, DVec3::X), None);
    assert_eq!(all.brute.nearest(DVec3::ZERO, DVec3::X), None);
    all.bvh.validate().expect("nothing is valid");
    all.octree.validate().expect("nothing is valid");
}

#[test]
fn one_triangle() {
    let all = All::build(&[FLOOR]);
    assert!(all.occluded(&through(0.2, 0.2)));
    assert!(!all.occluded(&through(0.6, 0.6)));
    // From below as well as from above, and not when the segment ends before it.
    let Segment { from, to, .. } = through(0.2, 0.2);
    assert!(all.occluded(&Segment::new(to, from)));
    assert!(!all.occluded(&Segment::new(from, dvec3(0.2, 0.2, 0.01))));
    assert!(!all.occluded(&Segment::new(dvec3(0.2, 0.2, -0.01), to)));
    assert!(agree(&[FLOOR], DVec3::NEG_ONE, DVec3::splat(2.0), 20_000) > 19_900);
}

#[test]
fn zero_area_never_blocks() {
    let point = [DVec3::ONE; 3];
    let needle = [DVec3::ZERO, DVec3::ONE, DVec3::splat(3.0)];
    let doubled = [DVec3::ZERO, DVec3::X, DVec3::X];
    let not_finite = [DVec3::ZERO, DVec3::X, dvec3(0.0, f64::NAN, 0.0)];
    let infinite = [DVec3::ZERO, DVec3::X, dvec3(0.0, f64::INFINITY, 0.0)];
    let empty = [point, needle, doubled, not_finite, infinite];
    let all = All::build(&empty);
    assert_eq!(all.bvh.stats().triangles, 0);
    assert_eq!(all.octree.stats().triangles, 0);
    assert!(!all.occluded(&Segment::new(dvec3(1.0, -1.0, 0.0), dvec3(1.0, 3.0, 2.0))));

    // Among others they leave indices as they were.
    let mut scene = empty.to_vec();
    scene.push(FLOOR);
    let all = All::build(&scene);
    assert!(all.occluded(&through(0.2, 0.2)));
    assert!(!all.occluded(&Segment { ignore: [5, NO_TRIANGLE], ..through(0.2, 0.2) }));
    assert_eq!(all.bvh.nearest(dvec3(0.2, 0.2, 1.0), DVec3::NEG_Z).map(|h| h.triangle), Some(5));
}

#[test]
fn ignored_triangles_do_not_block_and_others_do() {
    let upper = FLOOR.map(|v| v + 0.5 * DVec3::Z);
    let all = All::build(&[FLOOR, upper]);
    let ask = |ignore| all.occluded(&Segment { ignore, ..through(0.2, 0.2) });
    assert!(ask([NO_TRIANGLE; 2]) && ask([0, NO_TRIANGLE]) && ask([NO_TRIANGLE, 1]) && ask([1, 1]));
    assert!(!ask([0, 1]) && !ask([1, 0]));
}

#[test]
fn segments_that_are_none_are_not_blocked() {
    let all = All::build(&scenes::room());
    let p = dvec3(1.0, 1.0, 1.0);
    assert!(all.occluded(&Segment::new(p, dvec3(-9.0, 1.0, 1.0))));
    assert!(!all.occluded(&Segment::new(p, p)));
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(!all.occluded(&Segment::new(p, dvec3(bad, 1.0, 1.0))));
        assert!(!all.occluded(&Segment::new(DVec3::splat(bad), p)));
    }
}

#[test]
fn slivers() {
    // A fan of 300 triangles a metre long and 0.1 mm wide, and needles in random directions.
    let at = |i: usize| dvec3(1.0, 1e-4 * i as f64, 0.2 * (i % 2) as f64);
    let mut scene: Vec<Triangle> = (0..300).map(|i| [DVec3::ZERO, at(i), at(i + 1)]).collect();
    let mut rng = Rng(42);
    for _ in 0..300 {
        let (a, along) = (rng.point(DVec3::ZERO, DVec3::ONE), rng.direction());
        scene.push([a, a + along, a + 0.5 * along + 1e-3 * rng.direction()]);
    }
    assert!(agree(&scene, DVec3::ZERO, DVec3::ONE, 20_000) > 19_000);
}

#[test]
fn huge_beside_tiny() {
    // A plane of 2 km with a room of 1 m on it: the room is 16,000 rounding bands wide.
    let edge = 1000.0;
    let plane = [dvec3(-edge, -edge, 0.0), dvec3(3.0 * edge, -edge, 0.0), dvec3(-edge, edge, 0.0)];
    let mut scene = vec![plane];
    scene.extend(scenes::cuboid(dvec3(0.0, 0.0, 0.1), dvec3(1.0, 1.0, 1.1)));
    let sure = agree(&scene, dvec3(-1.0, -1.0, -1.0), dvec3(2.0, 2.0, 2.0), 20_000);
    assert!(sure > 19_000, "sure of {sure}");
}

#[test]
fn any_unit_of_length_gives_the_same_answers() {
    let scene = scenes::soup(100, 9);
    let answers = |scale: f64| -> Vec<bool> {
        let scaled: Vec<Triangle> = scene.iter().map(|t| t.map(|v| v * scale)).collect();
        let all = All::build(&scaled);
        let mut rng = Rng(43);
        (0..2000)
            .map(|_| {
                let segment = segments::random(DVec3::ZERO, DVec3::ONE, &mut rng);
                all.occluded(&Segment::new(segment.from * scale, segment.to * scale))
            })
            .collect()
    };
    let expected = answers(1.0);
    // Powers of two, which change no digit: from below the f32 range to above it.
    for exponent in [-600, -140, -10, 10, 140, 600] {
        assert_eq!(answers(2_f64.powi(exponent)), expected, "2^{exponent}");
    }
}

#[test]
fn ends_far_outside_are_cut_off() {
    let scene = scenes::room();
    let all = All::build(&scene);
    let mut rng = Rng(44);
    for _ in 0..5000 {
        let inside = rng.point(dvec3(0.1, 0.1, 0.1), dvec3(1.0, 1.0, 2.0));
        let direction = rng.direction();
        for distance in [1e2, 1e6, 1e12] {
            assert!(all.occluded(&Segment::new(inside, inside + distance * direction)));
            assert!(all.occluded(&Segment::new(inside - distance * direction, inside)));
        }
        // Beyond the walls nothing blocks.
        let outside = DVec3::splat(2.0) + 5.0 * direction;
        assert!(!all.occluded(&Segment::new(outside, outside + 1e9 * direction)));
    }
}

#[test]
fn duplicates_in_any_number() {
    // Each build must end, without deep recursion, and in memory proportional to the input.
    let slanted = [dvec3(0.1, 0.2, 0.3), dvec3(0.9, 0.15, 0.6), dvec3(0.2, 0.8, 0.95)];
    let needle = [DVec3::ZERO, DVec3::ONE, dvec3(0.5, 0.5, 0.501)];
    for (triangle, count) in [(FLOOR, 100_000), (slanted, 100_000), (needle, 100_000)] {
        let mut scene = vec![triangle; count];
        scene.push([DVec3::ZERO, dvec3(0.0, 0.0, 1e-3), dvec3(0.0, 1e-3, 0.0)]);
        let bvh = Bvh::build(&scene, &BvhConfig::default());
        let octree = Octree::build(&scene, &OctreeConfig::default());
        bvh.validate().expect("a valid hierarchy");
        let most = OctreeConfig::default().max_references * scene.len();
        assert!(octree.stats().references <= most, "{:?}", octree.stats());
        assert!(bvh.stats().depth < 36, "{:?}", bvh.stats());
        let centroid = (triangle[0] + triangle[1] + triangle[2]) / 3.0;
        let normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalize();
        let across = Segment::new(centroid + normal, centroid - normal);
        assert!(bvh.occluded(&across) && octree.occluded(&across));
        let beside = Segment { from: across.from + 2.0, to: across.to + 2.0, ..across };
        assert!(!bvh.occluded(&beside) && !octree.occluded(&beside));
    }
}

#[test]
fn sizes_that_halve_forever() {
    // Each triangle is half the one before: the worst case for equal bins.
    let scene: Vec<Triangle> = (0..2000)
        .map(|i| FLOOR.map(|v| v * 0.5_f64.powi(i % 140) + 1e-30 * f64::from(i)))
        .collect();
    let all = All::build(&scene);
    all.bvh.validate().expect("a valid hierarchy");
    all.octree.validate().expect("a valid octree");
    let mut rng = Rng(45);
    for _ in 0..5000 {
        all.occluded(&segments::random(DVec3::NEG_ONE, DVec3::ONE, &mut rng));
    }
}

#[test]
fn segments_in_cell_faces_and_along_axes() {
    // Cubes on a grid that coincides with octree faces, asked along grid lines: every coordinate
    // is a multiple of 1/8, so the segments run exactly in faces, edges and corners of cells.
    let mut scene = Vec::new();
    let mut rng = Rng(46);
    let grid = |rng: &mut Rng, n: usize| {
        dvec3(rng.below(n) as f64, rng.below(n) as f64, rng.below(n) as f64) / 8.0
    };
    for _ in 0..60 {
        let lo = grid(&mut rng, 16);
        scene.extend(scenes::cuboid(lo, lo + 0.125));
    }
    let all = All::build(&scene);
    let mut blocked = 0;
    let count = 60_000;
    for i in 0..count {
        let from = grid(&mut rng, 17);
        let mut to = grid(&mut rng, 17);
        if i % 3 != 0 {
            // Along an axis; and with negative zeros as well as positive ones in the direction.
            let axis = i % 2;
            to = from.with_x(if axis == 0 { to.x } else { from.x });
            to.y = if axis == 1 { from.y + to.y - from.y } else { from.y };
        }
        let shift = if i % 2 == 0 { DVec3::ZERO } else { 1e-9 * rng.direction() };
        blocked += usize::from(all.occluded(&Segment::new(from + shift, to + shift)));
    }
    assert!(blocked > count / 20 && blocked < count, "{blocked} blocked");
}

#[test]
fn tips_a_hair_from_cell_corners() {
    // Bounds of ±63/64 make the octree's root cell ±1 and its faces multiples of powers of two.
    // Each triangle lies in one octant around a corner of cells, with its tip an f32 unit or so
    // from the corner; segments pass through the tip across the octant, so that rounding may lead
    // the walk past the triangle's own cell. Only the padding of the cells' lists finds it then.
    let far = 63.0 / 64.0;
    let mut scene = scenes::cuboid(DVec3::splat(far - 1e-3), DVec3::splat(far));
    scene.extend(scenes::cuboid(DVec3::splat(-far), DVec3::splat(1e-3 - far)));
    let mut rng = Rng(47);
    let mut tips = Vec::new();
    for place in 0..343 * 8 {
        let step = |n: i32| f64::from(n % 7 - 3) / 4.0;
        let corner = dvec3(step(place), step(place / 7), step(place / 49));
        let sign = |bit: i32| f64::from((((place / 343) >> bit) & 1) * 2 - 1);
        let into = dvec3(sign(0), sign(1), sign(2));
        let tip = corner + into * rng.point(DVec3::ZERO, DVec3::splat(1e-7));
        let mut other = || tip + into * rng.point(DVec3::splat(0.01), DVec3::splat(0.1));
        scene.push([tip, other(), other()]);
        tips.push((tip, into));
    }
    let all = All::build(&scene);
    assert!(all.octree.stats().depth >= 3, "{:?}", all.octree.stats());
    let mut blocked = 0;
    let count = 400_000;
    for _ in 0..count {
        let (tip, into) = tips[rng.below(tips.len())];
        let direction = rng.direction();
        let across = direction - into * direction.dot(into) / 3.0;
        let aim = tip + into * 1e-8 * rng.unit();
        let segment =
            Segment::new(aim - across * 0.3 * rng.unit(), aim + across * 0.3 * rng.unit());
        blocked += usize::from(all.octree.occluded(&segment));
        assert_eq!(all.octree.occluded(&segment), all.bvh.occluded(&segment), "{segment:?}");
    }
    assert!(blocked > count / 20 && blocked < count, "{blocked} blocked");
}

#[test]
fn the_band_is_in_units_of_the_extent() {
    let all = All::build(&[FLOOR.map(|v| 8.0 * v + 100.0)]);
    assert_eq!(all.bvh.extent(), 8.0);
    assert_eq!(all.octree.extent(), 8.0);
    assert_eq!(all.brute.extent(), 8.0);
    assert_eq!(rounding_band(8.0), 8.0 * 8.0 * f64::from(f32::EPSILON));
    // Well above the band (8e-6) an end before the triangle is told from one behind it.
    let at = |z: f64| Segment::new(dvec3(102.0, 102.0, 105.0), dvec3(102.0, 102.0, 100.0 + z));
    let band = rounding_band(8.0);
    assert!(!all.occluded(&at(1.01 * band)) && all.occluded(&at(-1.01 * band)));
}

/// Powers of two change no digit of a coordinate, so no unit that f64 can hold changes an answer.
/// Coordinates are multiples of 2⁻⁷ up to 2, so 2⁻¹⁰⁶⁷ is the least unit that holds them exactly, and
/// 2¹⁰²² the greatest.
#[test]
fn units_at_the_ends_of_the_range_change_no_answer() {
    let mut rng = Rng(43);
    let coarse = |p: DVec3| (p * 128.0).round() / 128.0;
    let corner = |rng: &mut Rng| coarse(rng.point(DVec3::splat(-1.5), DVec3::splat(1.5)));
    // Few enough for one block, for one node, and for several.
    for count in [1, 3, 20, 100] {
        let scene: Vec<Triangle> =
            (0..count).map(|_| [corner(&mut rng), corner(&mut rng), corner(&mut rng)]).collect();
        let from = corner(&mut rng);
        let targets: Vec<Target> =
            (0..200).map(|_| Target { point: corner(&mut rng), ignore: NO_TRIANGLE }).collect();
        let answers = |exponent: i32| {
            // In two steps, because 2⁻¹⁰⁶⁷ is no power that `exp2` need know.
            let unit =
                |p: DVec3| p * 2.0_f64.powi(exponent / 2) * 2.0_f64.powi(exponent - exponent / 2);
            let scene: Vec<Triangle> = scene.iter().map(|t| t.map(unit)).collect();
            let targets: Vec<Target> =
                targets.iter().map(|t| Target { point: unit(t.point), ..*t }).collect();
            let all = All::build(&scene);
            let mut batch = vec![false; targets.len()];
            let occluders: [&dyn Occluder; 3] = [&all.brute, &all.bvh, &all.octree];
            occluders.map(|occluder| {
                occluder.occluded_batch(unit(from), NO_TRIANGLE, &targets, &mut batch);
                for (target, blocked) in targets.iter().zip(&batch) {
                    let segment = Segment::new(unit(from), target.point);
                    assert_eq!(all.occluded(&segment), *blocked, "2^{exponent}: {segment:?}");
                }
                batch.clone()
            })
        };
        let [expected, ..] = answers(0);
        assert!(expected.contains(&true) && expected.contains(&false), "{count}");
        for exponent in [-1067, -1060, -1022, -1000, -997, 900, 996, 997, 1000, 1015, 1021, 1022] {
            for answers in answers(exponent) {
                assert_eq!(answers, expected, "{count} triangles in units of 2^{exponent}");
            }
        }
    }
}

/// Where f64 numbers are 1 apart, the middle of a scene of odd width is rounded; its outermost walls
/// still block.
#[test]
fn a_scene_a_few_roundings_wide_keeps_its_walls() {
    let o = 2.0_f64.powi(52);
    for shift in [0.0, 1.0] {
        for wide in 3..64 {
            let (o, wide) = (o + shift, f64::from(wide));
            let wall = |x: f64| [dvec3(x, o, o), dvec3(x, o + wide, o), dvec3(x, o, o + wide)];
            let all = All::build(&[wall(o), wall(o + wide)]);
            let inside = 1.0;
            let at = |x: f64| dvec3(x, o + inside, o + inside);
            for (x, other) in [(o, 1), (o + wide, 0)] {
                let segment =
                    Segment { from: at(x - 2.0), to: at(x + 2.0), ignore: [other, NO_TRIANGLE] };
                assert!(all.occluded(&segment), "{wide} wide, wall at {x}");
            }
        }
    }
}

/// A scene centred at 0, and a segment along the diagonal, on which an empty box of the octree lies
/// outside of a scene that is held within 1.
#[test]
fn nothing_is_met_on_the_diagonal_of_a_huge_scene() {
    for unit in [1.0, 2.0_f64.powi(1000), 2.0_f64.powi(1010), 2.0_f64.powi(1023)] {
        let at = |x: f64, y: f64, z: f64| unit * dvec3(x, y, z);
        let scene = [
            [at(-1.0, -1.0, 1.0), at(-1.0, 1.0, 1.0), at(-1.0, 0.0, -1.0)],
            [at(1.0, 1.0, -1.0), at(1.0, -1.0, -1.0), at(1.0, 0.0, 1.0)],
        ];
        let (from, to) = (at(-0.75, -0.75, -0.75), at(0.75, 0.75, 0.75));
        let all = All::build(&scene);
        assert!(!all.occluded(&Segment::new(from, to)));
        assert!(all.occluded(&Segment::new(from, at(-1.25, 0.5, 0.75))));
    }
}
