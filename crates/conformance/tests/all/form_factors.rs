//! Form factors against 97 exact values, where that data is present, and the stiff cases among
//! them, which are written out here.
//!
//! The exact values are double contour integrals in closed form, in 60 digits, confirmed by an
//! independent integral over the areas.

use std::f64::consts::{PI, TAU};

use form_factor::{
    Estimate, FLOOR, Occluders, Polygon, REFERENCE, between, between_occluded, lambert,
};
use glam::DVec3;
use serde_json::Value;

/// Largest difference of a closed form at a point, absolute: some hundred roundings of
/// numbers up to 1.
const CLOSED: f64 = 1e-12;

/// The settings, and the relative error that each promises.
const SETTINGS: [(f64, f64); 4] = [(1e-2, 1e-2), (1e-3, 1e-3), (1e-4, 1e-4), (REFERENCE, 1e-9)];

/// The same for light below a billionth, and for polygons that are nearly coplanar: absolute.
const ABSOLUTE: f64 = 1e-9;

/// How far exact values may be off by the last digit of the corners, relative.
const CORNERS: f64 = 4.0 * f64::EPSILON;

/// Corners of the polygons that bracket a disc.
const DISC: u32 = 48;

#[test]
fn exact_form_factors() {
    let Some(data) = crate::exact_cases::data() else { return };
    let entries = data["form_factors"].as_array().unwrap();
    println!("case: exact, then for each setting: error / stated error, relative");
    for entry in entries {
        let id = entry["id"].as_str().unwrap();
        let exact = number(&entry["F12"]);
        let columns = match entry["kind"].as_str().unwrap() {
            "point_to_polygon" => from_a_point(entry, id, exact),
            "coaxial_discs" => between_discs(entry, id, exact),
            "occluded" => occluded(entry, id, exact),
            _ => unoccluded(entry, id, exact),
        };
        println!("{id}: {exact:.6e} {columns}");
    }
    assert!(entries.len() >= 97, "the data has lost entries: {}", entries.len());
}

fn from_a_point(entry: &Value, id: &str, exact: f64) -> String {
    let normal = point(&entry["normal"]).normalize();
    let corners = points(&entry["poly2"]);
    let f: f64 = (2..corners.len())
        .map(|i| [corners[0], corners[i - 1], corners[i]])
        .map(|triangle| lambert(point(&entry["point"]), normal, triangle).form_factor)
        .sum();
    assert!((f - exact).abs() <= CLOSED, "{id}: {f} {exact}");
    format!("{:.1e} (a point: one closed form)", (f - exact).abs() / exact)
}

fn unoccluded(entry: &Value, id: &str, exact: f64) -> String {
    let (one, two) = (polygon(&entry["poly1"]), polygon(&entry["poly2"]));
    let back = number(&entry["F21"]);
    let mut columns = String::new();
    for (tolerance, promised) in SETTINGS {
        for (f, exact) in
            [(between(&one, &two, tolerance), exact), (between(&two, &one, tolerance), back)]
        {
            let error = (f.value - exact).abs();
            let at_most = if exact < 1e-12 { ABSOLUTE } else { promised * exact };
            assert!(error <= at_most, "{id} {tolerance:e}: {f:?} {exact}");
            assert!(error <= f.error + CORNERS * exact, "{id} {tolerance:e}: {f:?} {exact}");
        }
        columns += &column(between(&one, &two, tolerance), exact);
    }
    columns
}

fn occluded(entry: &Value, id: &str, exact: f64) -> String {
    let (one, two) = (polygon(&entry["poly1"]), polygon(&entry["poly2"]));
    let screens = entry["occluders"].as_array().unwrap().iter().map(points);
    let triangles: Vec<_> = screens
        .flat_map(|c| (2..c.len()).map(move |i| [c[0], c[i - 1], c[i]]).collect::<Vec<_>>())
        .collect();
    let occluders = Occluders::build(&triangles);
    let mut columns = String::new();
    // What lies below the floor of occluded pairs is not asked for.
    for (tolerance, promised) in &SETTINGS[..3] {
        let f = between_occluded(&one, &two, &occluders, *tolerance);
        let error = (f.value - exact).abs();
        assert!(error <= (promised * exact).max(FLOOR), "{id} {tolerance:e}: {f:?} {exact}");
        assert!(error <= f.error, "{id} {tolerance:e}: {f:?} {exact}");
        assert!(f.value <= between(&one, &two, REFERENCE).value * (1.0 + promised));
        columns += &column(f, exact);
    }
    columns + " (no reference setting: visibility is sampled on one side)"
}

/// Regular polygons in and around the discs exchange less and more than these.
fn between_discs(entry: &Value, id: &str, exact: f64) -> String {
    let [r1, r2, h] = ["r1", "r2", "h"].map(|name| entry[name].as_f64().unwrap());
    let exchange = exact * PI * r1 * r1;
    let outside = 1.0 / (PI / f64::from(DISC)).cos();
    let mut columns = String::new();
    for (tolerance, promised) in SETTINGS {
        let [low, high] = [1.0, outside].map(|scale| {
            let lower = disc(r1 * scale, 0.0, 1.0);
            let f = between(&lower, &disc(r2 * scale, h, -1.0), tolerance);
            (lower.area() * f.value, lower.area() * f.error)
        });
        assert!(low.0 - low.1 <= exchange && exchange <= high.0 + high.1, "{id} {tolerance:e}");
        // Areas are off by −2π²/3n² and π²/3n², so the disc lies at two thirds of the bracket but
        // for a share of it.
        let middle = (low.0 + 2.0 * high.0) / 3.0;
        let at_most = promised + 1.0 / f64::from(DISC * DISC);
        assert!((middle / exchange - 1.0).abs() <= at_most, "{id} {tolerance:e}: {middle}");
        columns += &format!("| {:.1e} ", (middle / exchange - 1.0).abs());
    }
    columns + "| (polygons around the discs)"
}

fn disc(radius: f64, height: f64, turn: f64) -> Polygon {
    let corner = |i: u32| {
        let (sin, cos) = (turn * TAU * f64::from(i) / f64::from(DISC)).sin_cos();
        DVec3::new(radius * cos, radius * sin, height)
    };
    Polygon::new(&(0..DISC).map(corner).collect::<Vec<_>>()).unwrap()
}

fn column(f: Estimate, exact: f64) -> String {
    let scale = if exact > 0.0 { exact } else { 1.0 };
    format!("| {:.1e} / {:.1e} ", (f.value - exact).abs() / scale, f.error / scale)
}

fn polygon(value: &Value) -> Polygon {
    Polygon::new(&points(value)).unwrap()
}

fn points(value: &Value) -> Vec<DVec3> {
    value.as_array().unwrap().iter().map(point).collect()
}

fn point(value: &Value) -> DVec3 {
    let [x, y, z] = [0, 1, 2].map(|i| value[i].as_f64().unwrap());
    DVec3::new(x, y, z)
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

fn triangle(corners: [[f64; 3]; 3]) -> Polygon {
    Polygon::triangle(corners.map(DVec3::from)).unwrap()
}

fn moved(polygon: &Polygon, to: impl Fn(DVec3) -> DVec3) -> Polygon {
    Polygon::new(&polygon.corners().iter().map(|&c| to(c)).collect::<Vec<_>>()).unwrap()
}

/// Two triangles in general position, and what the first sees of the second.
fn general() -> (Polygon, Polygon, f64) {
    let one = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.25, 0.875, 0.0]]);
    let two = triangle([[0.25, 0.125, 1.25], [0.125, 1.125, 0.75], [1.25, 0.375, 0.875]]);
    (one, two, 0.130_572_604_378_692_78)
}

fn all_settings(one: &Polygon, two: &Polygon, exact: f64) {
    for (tolerance, promised) in SETTINGS {
        let f = between(one, two, tolerance);
        assert!((f.value - exact).abs() <= promised * exact, "{tolerance:e}: {f:?} {exact}");
        assert!((f.value - exact).abs() <= f.error + CORNERS * exact, "{f:?} {exact}");
    }
}

#[test]
fn sliver_1e4() {
    let sliver = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.0001, 0.0]];
    let above = [[0.0, 0.0, 0.0001], [0.5, 0.0001, 0.0001], [1.0, 0.0, 0.0001]];
    all_settings(&triangle(sliver), &triangle(above), 0.295_587_129_417_134_07);
    let fat = triangle([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.5, 0.0, 1.0]]);
    all_settings(&triangle(sliver), &fat, 0.499_955_274_333_699_7);
}

#[test]
fn nearly_coplanar() {
    let hinge = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.8, 0.0]]);
    let wing = triangle([
        [1.0, 0.0, 0.0],
        [0.0, 0.0, 0.0],
        [0.4, -0.699_998_933_839_301_3, 0.001_221_729_856_128_825_8],
    ]);
    let flat = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    let lift = 2f64.powi(-20);
    let lifted = triangle([[1.5, 1.5, 0.0], [1.5, 0.75, lift], [0.75, 1.5, lift]]);
    for (one, two, exact) in
        [(&hinge, &wing, 2.656_622_229_790_739e-7), (&flat, &lifted, 6.720_072_280_341_145e-14)]
    {
        for (tolerance, _) in SETTINGS {
            let f = between(one, two, tolerance);
            assert!((f.value - exact).abs() <= ABSOLUTE && f.value >= 0.0, "{f:?} {exact}");
        }
    }
}

#[test]
fn shared_edge_1_over_r2() {
    let one = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.3, 0.8, 0.0]]);
    let at = |y: f64, z: f64| triangle([[1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.4, y, z]]);
    all_settings(
        &one,
        &at(0.606_217_782_649_107_1, 0.349_999_999_999_999_9),
        0.608_261_818_117_415_4,
    );
    all_settings(&one, &at(4.286_263_797_015_736e-17, 0.7), 0.215_879_783_512_864_36);
}

#[test]
fn small_beside_huge() {
    let tiny = 2f64.powi(-20);
    let small = triangle([[0.25, 0.25, 0.0], [0.25 + tiny, 0.25, 0.0], [0.25, 0.25 + tiny, 0.0]]);
    let huge = triangle([[-1000.0, -1000.0, 1.0], [-1000.0, 3000.0, 1.0], [3000.0, -1000.0, 1.0]]);
    all_settings(&small, &huge, 0.999_999_429_115_041_3);
    all_settings(&huge, &small, 5.684_338_640_975_518e-20);
}

#[test]
fn offset_1e6() {
    let (one, two, exact) = general();
    let far = |polygon: &Polygon| moved(polygon, |c| c + DVec3::splat(2f64.powi(20)));
    let (there, here) =
        (between(&far(&one), &far(&two), REFERENCE), between(&one, &two, REFERENCE));
    assert_eq!(there.value, here.value, "each coordinate is exact");
    assert!((here.value - exact).abs() <= ABSOLUTE * exact);
    // Corners that round to 1e-10 at 1e6.
    let odd =
        |polygon: &Polygon, by: f64| moved(polygon, |c| c * 0.9137 + DVec3::splat(0.1234 + by));
    let there = between(&odd(&one, 1e6), &odd(&two, 1e6), REFERENCE).value;
    assert!((there - exact).abs() <= ABSOLUTE * exact, "{there}");
}

#[test]
fn unit_scale() {
    let (one, two, exact) = general();
    for (scale, at_most) in [
        (1e-6, 1e-13),
        (1e6, 1e-13),
        (1e-80, 1e-13),
        (1e-110, 1e-13),
        (1e80, 1e-13),
        (1e100, 1e-13),
    ] {
        let [a, b] = [&one, &two].map(|polygon| moved(polygon, |c| c * scale));
        let here = between(&one, &two, REFERENCE).value;
        let f = between(&a, &b, REFERENCE).value;
        assert!(
            (f / here - 1.0).abs() <= at_most && (f - exact).abs() <= ABSOLUTE,
            "{scale:e} {f}"
        );
    }
}

#[test]
fn coincident_duplicates() {
    let (one, _, _) = general();
    let [p, q, r] = [0, 1, 2].map(|i| one.corners()[i]);
    for other in
        [[p, q, r], [q, r, p], [p, r, q]].map(|corners| Polygon::triangle(corners).unwrap())
    {
        for (tolerance, _) in SETTINGS {
            assert_eq!(between(&one, &other, tolerance).value, 0.0);
            assert_eq!(between(&other, &one, tolerance).value, 0.0);
        }
    }
}

/// The rectangle of 0..`a` by 0..1 and one at height `c` above it, and screens halfway up over the
/// given ranges of x.
fn screened(a: f64, c: f64, screens: &[[f64; 2]], tolerance: f64) -> Estimate {
    let corners = |x: [f64; 2], z: f64| {
        [[x[0], 0.0, z], [x[1], 0.0, z], [x[1], 1.0, z], [x[0], 1.0, z]].map(DVec3::from)
    };
    let lower = Polygon::new(&corners([0.0, a], 0.0)).unwrap();
    let mut above = corners([0.0, a], c);
    above.reverse();
    let upper = Polygon::new(&above).unwrap();
    let halves = |&x: &[f64; 2]| {
        let [p, q, r, s] = corners(x, c / 2.0);
        [[p, q, r], [p, r, s]]
    };
    let occluders = Occluders::build(&screens.iter().flat_map(halves).collect::<Vec<_>>());
    between_occluded(&lower, &upper, &occluders, tolerance)
}

#[test]
fn slit_visibility() {
    for (width, exact) in
        [(0.1, 0.032_380_784_513_116_7), (2f64.powi(-10), 3.233_612_813_517_17e-4)]
    {
        for (tolerance, promised) in &SETTINGS[..3] {
            let screens = [[0.0, 0.5 - width / 2.0], [0.5 + width / 2.0, 1.0]];
            let f = screened(1.0, 1.0, &screens, *tolerance);
            assert!((f.value - exact).abs() <= promised * exact, "{width}: {f:?} {exact}");
            assert!((f.value - exact).abs() <= f.error, "{width}: {f:?} {exact}");
        }
    }
}

#[test]
fn exactly_half_blocked() {
    for (a, c, exact) in
        [(1.0, 0.25, 0.316_018_215_006_930_1), (2.0, 3.0, 0.030_165_692_684_976_844)]
    {
        for (tolerance, promised) in &SETTINGS[..3] {
            let f = screened(a, c, &[[0.0, a / 2.0]], *tolerance);
            assert!((f.value - exact).abs() <= promised * exact, "{a} {c}: {f:?} {exact}");
        }
    }
}

#[test]
fn small_near_rim_of_large() {
    let large = triangle([[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.4, 0.9, 0.0]]);
    let (d, y) = (0.01, -0.1 * 0.01);
    let (low, high) = (0.5 - d / 2.0, 0.5 + d / 2.0);
    let wall = [[low, y, 0.0], [low, y, d], [high, y, 0.0]];
    // Independent: the mean of Lambert's form over the wall, 512 × 512 points laid over it by
    // squares of the unit square, denser towards the rim.
    let n = 512;
    let (mut sum, mut weights) = (0.0, 0.0);
    for i in 0..n {
        for j in 0..n {
            let [s, t] = [i, j].map(|k| (f64::from(k) + 0.5) / f64::from(n));
            let z = d * t * t;
            let width = (d - z) * 2.0 * t;
            let at = DVec3::new(low + (d - z) * s, y, z);
            let corners = [0, 1, 2].map(|k| large.corners()[k]);
            sum += width * lambert(at, DVec3::Y, corners).form_factor;
            weights += width;
        }
    }
    let exact = sum / weights;
    for (tolerance, _) in SETTINGS {
        let f = between(&triangle(wall), &large, tolerance);
        let integral = 1e-5;
        assert!((f.value / exact - 1.0).abs() <= tolerance.max(integral), "{f:?} {exact}");
    }
}
