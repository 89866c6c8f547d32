//! Form factors with closed forms, in the open and past an occluder.

use form_factor::{Occluders, Polygon, REFERENCE, between, between_occluded};
use glam::DVec3;

use super::{Check, Outcome};
use crate::howell::{
    opposed_rectangles, parallel_rectangles, perpendicular_rectangles, point_to_parallel_rectangle,
};

/// Tolerances asked of each pair in the open; each must be met.
const TOLERANCES: [f64; 4] = [1e-2, 1e-3, 1e-4, REFERENCE];

/// Tolerance asked past an occluder, and met.
const OCCLUDED: f64 = 1e-3;

/// Rounding of a closed form at a point: some hundred roundings of numbers up to 1.
const POINT: f64 = 1e-12;

pub(super) fn checks() -> Vec<Check> {
    let mut checks = Vec::new();
    for (a, b, c) in
        [(1.0, 1.0, 1.0), (1.0, 1.0, 1e-3), (1.0, 1.0, 10.0), (1.0, 100.0, 1.0), (2.0, 3.0, 0.5)]
    {
        let exact = opposed_rectangles(a, b, c);
        let pair = move || (floor(a, b), ceiling(a, b, c));
        both(&mut checks, &format!("opposed rectangles {a} x {b} at {c} (C-11)"), exact, pair);
    }
    for (h, w, l) in [(1.0, 1.0, 1.0), (2.0, 1.0, 1.0), (1e-3, 1.0, 1.0), (1.0, 1.0, 1000.0)] {
        let exact = perpendicular_rectangles(h, w, l);
        let pair = move || (floor(w, l), wall(h, l));
        both(&mut checks, &format!("common edge, {w} and {h} x {l} (C-14)"), exact, pair);
    }
    let exact = point_to_parallel_rectangle(1.0, 1.0, 1.0);
    checks.push(Check::new("point to a square's corner (B-3)", move || {
        let [a, b, c, d] =
            [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]].map(|[x, y]| DVec3::new(x, y, 1.0));
        let f = |corners| form_factor::lambert(DVec3::ZERO, DVec3::Z, corners).form_factor;
        Outcome::relative(exact, f([a, b, c]) + f([a, c, d]), POINT)
    }));
    let open = opposed_rectangles(1.0, 1.0, 1.0);
    // Shapiro's test: a plate of half the side at 3/4 of the gap throws a shadow that lies
    // within the target, so its own form factor is missing (Walton, NISTIR 6925, 2002).
    let plate = parallel_rectangles([[0.0, 1.0]; 2], [[0.25, 0.75]; 2], 0.75);
    occluded(&mut checks, "squares past a plate (Shapiro)", open - plate, [0.25, 0.75], 0.75);
    // By symmetry about the middle a quarter of the screen in the middle plane stops a quarter.
    occluded(&mut checks, "squares past a quarter screen", 0.75 * open, [0.0, 0.5], 0.5);
    occluded(&mut checks, "squares past a whole screen", 0.0, [-0.125, 1.125], 0.5);
    checks
}

/// A pair at every tolerance.
fn both(
    checks: &mut Vec<Check>,
    name: &str,
    exact: f64,
    pair: impl Fn() -> (Polygon, Polygon) + Copy + Send + Sync + 'static,
) {
    for tolerance in TOLERANCES {
        checks.push(Check::new(format!("{name} to {tolerance:.0e}"), move || {
            let (a, b) = pair();
            Outcome::relative(exact, between(&a, &b, tolerance).value, tolerance)
        }));
    }
}

/// Opposed unit squares with a square screen between them.
fn occluded(checks: &mut Vec<Check>, name: &str, exact: f64, screen: [f64; 2], z: f64) {
    checks.push(Check::new(format!("{name} to {OCCLUDED:.0e}"), move || {
        let [low, high] = screen;
        let [a, b, c, d] =
            [[low, low], [high, low], [high, high], [low, high]].map(|[x, y]| DVec3::new(x, y, z));
        let occluders = Occluders::build(&[[a, b, c], [a, c, d]]);
        let (from, to) = (floor(1.0, 1.0), ceiling(1.0, 1.0, 1.0));
        let f = between_occluded(&from, &to, &occluders, OCCLUDED).value;
        Outcome::relative(exact, f, OCCLUDED)
    }));
}

fn polygon(corners: [[f64; 3]; 4]) -> Polygon {
    Polygon::new(&corners.map(DVec3::from)).expect("the corners are those of a rectangle")
}

fn floor(x: f64, y: f64) -> Polygon {
    polygon([[0.0; 3], [x, 0.0, 0.0], [x, y, 0.0], [0.0, y, 0.0]])
}

fn ceiling(x: f64, y: f64, z: f64) -> Polygon {
    polygon([[0.0, 0.0, z], [0.0, y, z], [x, y, z], [x, 0.0, z]])
}

/// At right angles to the floor, along its edge on the y axis.
fn wall(z: f64, y: f64) -> Polygon {
    polygon([[0.0; 3], [0.0, y, 0.0], [0.0, y, z], [0.0, 0.0, z]])
}
