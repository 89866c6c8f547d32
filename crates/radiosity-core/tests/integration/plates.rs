//! Two facing unit squares at distance 1: the exact interreflection of their means.

use crate::models::{Model, paired, solve, until};
use scene::Rgb;

/// Form factor between directly opposed unit squares at distance 1 (Howell, catalogue, C-11).
const F: f64 = 0.199_824_895_698_387;

fn plates(upper_faces_down: bool) -> scene::Scene {
    let mut model = Model::new();
    let lamp = model.surface(0.0, 1.0);
    let white = model.surface(0.8, 0.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], lamp);
    let down = [[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]];
    let mut upper = down;
    if !upper_faces_down {
        upper.reverse();
    }
    model.quad(upper, white);
    model.scene()
}

/// The upper plate's mean exitance over its exact value, less 1.
fn error_with(elements: usize) -> f64 {
    let scene = plates(true);
    let solved = solve(&scene, elements, until(1e-6));
    let b = solved.solution.triangle_exitance(&scene);
    assert_eq!(b[0], Rgb::new(1.0, 0.5, 0.0), "a black lamp shows its emittance alone");
    (b[2][0] + b[3][0]) / 2.0 / (0.8 * F) - 1.0
}

#[test]
fn mean_exitance_converges_to_reflectance_times_form_factor() {
    // Means of corners: second order, so four times the elements leave a quarter of the error.
    let (coarse, fine) = (error_with(256), error_with(1024));
    assert!(coarse.abs() < 6e-3 && fine.abs() < 2e-3, "{coarse} {fine}");
    assert!((3.0..5.0).contains(&(coarse / fine)), "{coarse} {fine}");
}

#[test]
fn what_passes_the_upper_plate_escapes() {
    let l = solve(&plates(true), 1024, until(1e-3)).ledger;
    // 1 − F of the light passes the upper plate, and of what it reflects, 1 − F the lower.
    let expected = 1.0 - F + 0.8 * F * (1.0 - F);
    assert!((l.escaped[0] / l.emitted[0] / expected - 1.0).abs() < 2e-3, "{l:?}");
}

#[test]
fn a_back_takes_no_light_and_is_reported() {
    let scene = plates(false);
    let solved = solve(&scene, 64, until(1e-3));
    assert_eq!(solved.solution.triangle_exitance(&scene)[2], Rgb::ZERO);
    // The share of light that meets the back is F; it is sampled in 32 directions a patch.
    let share = solved.ledger.wrong_side[0] / solved.ledger.emitted[0];
    assert!((share - F).abs() < 0.03, "{share}");
}

#[test]
fn paired_surfaces_exchange_back_to_back_but_not_front_to_back() {
    let scene = plates(false);
    let solved = solve(&scene, 64, paired(1e-3));
    assert_eq!(solved.solution.triangle_exitance(&scene)[2], Rgb::ZERO);
    // Both turned away from each other: they see each other's back.
    let mut model = Model::new();
    let lamp = model.surface(0.0, 1.0);
    let white = model.surface(0.4, 0.0);
    model.quad([[0., 0., 0.], [0., 1., 0.], [1., 1., 0.], [1., 0., 0.]], lamp);
    model.quad([[0., 0., 1.], [1., 0., 1.], [1., 1., 1.], [0., 1., 1.]], white);
    let scene = model.scene();
    let solved = solve(&scene, 1024, paired(1e-3));
    let b = solved.solution.triangle_exitance(&scene);
    assert!(((b[2][0] + b[3][0]) / 2.0 / (0.4 * F) - 1.0).abs() < 2e-3, "{b:?}");
    assert!(solved.ledger.imbalance() < 1e-12);
}

#[test]
fn a_screen_in_between_leaves_only_its_own_shadow() {
    let mut model = Model::new();
    let lamp = model.surface(0.0, 1.0);
    let white = model.surface(0.8, 0.0);
    let black = model.surface(0.0, 0.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], lamp);
    model.quad([[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]], white);
    model.quad([[-9., -9., 0.5], [-9., 9., 0.5], [9., 9., 0.5], [9., -9., 0.5]], black);
    let scene = model.scene();
    let solved = solve(&scene, 128, until(1e-3));
    assert_eq!(solved.solution.triangle_exitance(&scene)[2], Rgb::ZERO);
}

#[test]
fn points_inside_help_where_a_lamp_touches_a_wall() {
    // A lamp of height .1 stands on a wall 1 wide; the wall's mean irradiance is exactly the
    // form factor between perpendicular rectangles with a common edge (Howell, C-14).
    let (h, w) = (0.1f64, 1.0f64);
    let (h2, w2) = (h * h, w * w);
    let logs = ((1.0 + w2) * (1.0 + h2) / (1.0 + w2 + h2)).ln()
        + w2 * (w2 * (1.0 + w2 + h2) / ((1.0 + w2) * (w2 + h2))).ln()
        + h2 * (h2 * (1.0 + h2 + w2) / ((1.0 + h2) * (h2 + w2))).ln();
    let root = (h2 + w2).sqrt();
    let exact = (w * (1.0 / w).atan() + h * (1.0 / h).atan() - root * (1.0 / root).atan()
        + logs / 4.0)
        / (std::f64::consts::PI * w);
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    let lamp = model.surface(0.0, 1.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], wall);
    model.quad([[0., 0., 0.], [0., 1., 0.], [0., 1., h], [0., 0., h]], lamp);
    let scene = model.scene();
    let error = |bright: f64| {
        let config = radiosity_core::ShootingConfig { bright, ..until(1e-6) };
        let b = solve(&scene, 300, config).solution.triangle_exitance(&scene);
        ((b[0][0] + b[1][0]) / 2.0 / (0.5 * exact) - 1.0).abs()
    };
    let (corners, inside) = (error(f64::INFINITY), error(2.0));
    assert!(inside < 0.01 && inside < corners / 5.0, "{inside} {corners}");
}
