//! Occluders: exact cases, proofs that nothing or all is seen, and an independent integral.

use form_factor::{
    Ask, FLOOR, Occluders, Polygon, REFERENCE, between, between_occluded, between_occluded_within,
};
use glam::DVec3;

use crate::{Random, ceiling, floor, polygon};

const SETTINGS: [f64; 3] = [1e-2, 1e-3, 1e-4];

/// The triangles of a fan.
fn triangles(polygon: &Polygon) -> impl Iterator<Item = [DVec3; 3]> {
    let c = polygon.corners().to_vec();
    (2..c.len()).map(move |i| [c[0], c[i - 1], c[i]])
}

fn occluders(polygons: &[&Polygon]) -> Occluders {
    Occluders::build(&polygons.iter().flat_map(|p| triangles(p)).collect::<Vec<_>>())
}

fn plates(height: f64) -> (Polygon, Polygon) {
    (floor([0.0, 1.0], [0.0, 1.0], 0.0), ceiling([0.0, 1.0], [0.0, 1.0], height))
}

#[test]
fn half_a_screen_in_the_middle_takes_half() {
    // Mirrored at the screen's middle each line that passes becomes one that is stopped.
    for (height, tolerances) in
        [(1.0, &SETTINGS[..]), (0.25, &SETTINGS[..]), (0.05, &SETTINGS[..2])]
    {
        let (lower, upper) = plates(height);
        let screen = floor([0.0, 0.5], [0.0, 1.0], height / 2.0);
        let half = between(&lower, &upper, REFERENCE).value / 2.0;
        for &tolerance in tolerances {
            let f = between_occluded(&lower, &upper, &occluders(&[&screen]), tolerance);
            assert!((f.value / half - 1.0).abs() <= tolerance, "{height} {tolerance:e}: {f:?}");
            assert!((f.value - half).abs() <= f.error, "{height} {tolerance:e}: {f:?} {half}");
        }
    }
}

#[test]
fn a_plate_whose_shadow_stays_inside_takes_its_own_form_factor() {
    // NISTIR 6925 (Walton 2002), after Shapiro 1983: what the small plate sees of the lower one
    // would have gone on to the upper one.
    let (lower, upper) = plates(1.0);
    let small = floor([0.25, 0.75], [0.25, 0.75], 0.75);
    let under = ceiling([0.25, 0.75], [0.25, 0.75], 0.75);
    let exact = between(&lower, &upper, REFERENCE).value - between(&lower, &under, REFERENCE).value;
    assert!((exact - 0.115_620_602_132_415).abs() < 1e-12);
    for tolerance in SETTINGS {
        let f = between_occluded(&lower, &upper, &occluders(&[&small]), tolerance);
        assert!((f.value - exact).abs() <= (tolerance * exact).min(f.error), "{f:?} {exact}");
    }
}

#[test]
fn a_screen_in_parts_that_covers_all_leaves_nothing() {
    let (lower, upper) = plates(1.0);
    let parts = [
        floor([-0.1, 0.3], [-0.1, 1.1], 0.5),
        floor([0.3, 1.1], [-0.1, 0.6], 0.5),
        floor([0.3, 1.1], [0.6, 1.1], 0.5),
    ];
    let [a, b, c] = &parts;
    let f = between_occluded(&lower, &upper, &occluders(&[a, b, c]), 1e-2);
    assert_eq!((f.value, f.error), (0.0, 0.0), "proved, not sampled");
    // Without one part the light through the gap remains.
    let gap = between_occluded(&lower, &upper, &occluders(&[a, b]), 1e-3);
    assert!(gap.value > 0.01 && gap.error <= 1e-3 * gap.value, "{gap:?}");
}

#[test]
fn a_thin_slit_lets_a_thin_light_through() {
    // Light through a slit of width w falls like w: two widths, one ratio.
    let (lower, upper) = plates(1.0);
    let through = |width: f64| {
        let (left, right) = (0.5 - width / 2.0, 0.5 + width / 2.0);
        let screens = [floor([0.0, left], [0.0, 1.0], 0.5), floor([right, 1.0], [0.0, 1.0], 0.5)];
        let [one, two] = &screens;
        between_occluded(&lower, &upper, &occluders(&[one, two]), 1e-4).value
    };
    let (wide, thin) = (through(2f64.powi(-10)), through(2f64.powi(-14)));
    assert!((wide / 3.233_612_813_517e-4 - 1.0).abs() < 1e-4, "{wide}");
    assert!((wide / thin / 16.0 - 1.0).abs() < 1e-2, "{wide} {thin}");
}

#[test]
fn the_walls_of_a_room_do_not_block_one_another() {
    let c = |i: usize| [(i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64];
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let room = faces.map(|face| polygon(face.map(c)));
    let all = Occluders::build(&room.iter().flat_map(triangles).collect::<Vec<_>>());
    for a in &room {
        for b in &room {
            assert_eq!(between_occluded(a, b, &all, 1e-4), between(a, b, 1e-4));
        }
    }
}

#[test]
fn occluded_pairs_agree_with_rays() {
    // An independent integral: both polygons sampled, each line tested against each triangle.
    let mut random = Random(987_654_321);
    let mut partly = 0;
    for _ in 0..24 {
        let (lower, upper) = plates(1.0);
        let between_them = |random: &mut Random| {
            let middle = DVec3::new(0.5, 0.5, 0.5) + random.vector() * 0.5;
            [(); 3].map(|()| middle + random.vector())
        };
        let screens = [between_them(&mut random), between_them(&mut random)];
        let tree = Occluders::build(&screens);
        let f = between_occluded(&lower, &upper, &tree, 1e-3);
        let back = between_occluded(&upper, &lower, &tree, 1e-3);
        assert_eq!(f.value, back.value, "equal areas exchange equal shares");
        let clear = between(&lower, &upper, REFERENCE).value;
        assert!(f.value <= clear + f.error);
        partly += usize::from(f.value > 0.05 * clear && f.value < 0.95 * clear);
        let (rays, deviation) = by_rays(&mut random, &screens);
        assert!((f.value - rays).abs() <= f.error + 5.0 * deviation, "{f:?} {rays} ± {deviation}");
    }
    assert!(partly > 10, "{partly}");
}

/// The form factor of the two unit plates at distance 1 and its standard deviation.
fn by_rays(random: &mut Random, screens: &[[DVec3; 3]]) -> (f64, f64) {
    const RAYS: u32 = 40_000;
    let (mut sum, mut squares) = (0.0, 0.0);
    for _ in 0..RAYS {
        let from = DVec3::new(random.number(), random.number(), 0.0);
        let to = DVec3::new(random.number(), random.number(), 1.0);
        let along = to - from;
        let hit = |&[p, q, r]: &[DVec3; 3]| {
            let volume = |a: DVec3, b: DVec3| (a - from).cross(b - from).dot(along);
            let sides = [volume(p, q), volume(q, r), volume(r, p)];
            let normal = (q - p).cross(r - p);
            let crosses = normal.dot(from - p) * normal.dot(to - p) < 0.0;
            crosses && (sides.iter().all(|&s| s > 0.0) || sides.iter().all(|&s| s < 0.0))
        };
        let r2 = along.length_squared();
        let value =
            if screens.iter().any(hit) { 0.0 } else { 1.0 / (std::f64::consts::PI * r2 * r2) };
        sum += value;
        squares += value * value;
    }
    let n = f64::from(RAYS);
    (sum / n, ((squares / n - (sum / n).powi(2)) / n).sqrt())
}

#[test]
fn a_screen_over_half_of_plates_that_almost_touch_is_within_what_is_stated() {
    // The penumbra is a hundredth of the plates wide. No closed form: the value is that of a
    // tolerance a hundred times as tight.
    let lower = floor([0.0, 1.0], [0.0, 1.0], 0.0);
    let upper = ceiling([0.0, 1.0], [0.0, 1.0], 0.01);
    let screen = occluders(&[&floor([0.0, 0.5], [0.0, 1.0], 0.005)]);
    let exact = between_occluded(&lower, &upper, &screen, 1e-6);
    for tolerance in [1e-1, 1e-2, 1e-3, 1e-4] {
        let f = between_occluded(&lower, &upper, &screen, tolerance);
        assert!((f.value - exact.value).abs() <= f.error, "{tolerance}: {f:?} {exact:?}");
        assert!(f.error <= tolerance * f.value, "{tolerance}: {f:?}");
    }
}

#[test]
fn what_is_all_but_hidden_is_left_at_the_floor() {
    let (lower, upper) = plates(1.0);
    // A hole a millionth across.
    let hole = 5e-7;
    let (low, high) = (0.5 - hole, 0.5 + hole);
    let parts = [
        floor([-1.0, low], [-1.0, 2.0], 0.5),
        floor([high, 2.0], [-1.0, 2.0], 0.5),
        floor([low, high], [-1.0, low], 0.5),
        floor([low, high], [high, 2.0], 0.5),
    ];
    let [a, b, c, d] = &parts;
    let f = between_occluded(&lower, &upper, &occluders(&[a, b, c, d]), 1e-2);
    // The hole as a lamp of its own: twice as near and four times as bright to each plate.
    assert!(f.value <= 1e-11 && f.error <= 2.0 * FLOOR, "{f:?}");
}

#[test]
fn no_more_is_computed_than_is_asked_for() {
    let (lower, upper) = (floor([0.0, 2.0], [0.0, 1.0], 0.0), ceiling([0.0, 1.0], [0.0, 1.0], 1.0));
    let small = floor([0.25, 0.75], [0.25, 0.75], 0.75);
    let under = ceiling([0.25, 0.75], [0.25, 0.75], 0.75);
    let screens = occluders(&[&small]);
    // Part of the shadow falls beside the upper plate, so that there is no closed form.
    let exact = between_occluded(&upper, &lower, &screens, 1e-5);
    let mut last = u32::MAX;
    for absolute in [1e-5, 1e-3, 1e-1] {
        let ask = Ask { relative: 1e-5, absolute };
        let f = between_occluded_within(&upper, &lower, &screens, ask);
        let back = between_occluded_within(&lower, &upper, &screens, ask);
        assert!(f.error <= absolute && (f.value - exact.value).abs() <= f.error, "{f:?} {exact:?}");
        assert_eq!((back.value * 2.0, back.error * 2.0), (f.value, f.error), "one exchange");
        assert!(f.effort <= last && f.visibility, "{f:?}");
        last = f.effort;
    }
    assert!(last * 2 < exact.effort, "{last} {}", exact.effort);
    assert!(!between_occluded(&lower, &under, &screens, 1e-3).visibility, "nothing in between");
}

#[test]
fn a_speck_beside_a_common_edge_is_found() {
    // It hides no more than its area times 1, and no less than that times what passes through its
    // middle: the two plates seen from there.
    let [o, x, y, z] = [DVec3::ZERO, DVec3::X, DVec3::Y, DVec3::Z];
    let lower = polygon([[0.0; 3], x.to_array(), (x + y).to_array(), y.to_array()]);
    let wall = polygon([o, y, y + z, z].map(|c| c.to_array()));
    let clear = between(&lower, &wall, REFERENCE).value;
    let at = DVec3::new(0.02, 0.37, 0.02);
    let across = DVec3::new(1.0, 0.0, 1.0) * 0.01;
    let speck = Occluders::build(&[[at, at + across, at + y * 0.02]]);
    let area = across.length() * 0.02 / 2.0;
    let exact = between_occluded(&lower, &wall, &speck, 1e-6);
    let hidden = clear - exact.value;
    assert!(hidden > 0.5 * area && hidden < area, "{hidden} {area}");
    for tolerance in SETTINGS {
        let f = between_occluded(&lower, &wall, &speck, tolerance);
        assert!((f.value - exact.value).abs() <= f.error + exact.error, "{f:?} {exact:?}");
    }
}
