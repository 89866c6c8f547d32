//! Reflectances near 1: the work stays a few sweeps, and the light stays right.

use radiosity_core::{Correction, ShootingConfig, StopReason};
use scene::MaterialId;

use crate::models::{Model, Solved, solve, until};

/// Work allowed at any reflectance, in sweeps; a sweep is a shot per patch. Plain shooting
/// needs 6.9/(1 − ρ) for the same unshot share: 6,900 at .999.
const SWEEPS: f64 = 20.0;

/// A cube that shines from its floor: what it gives out, and the mean exitance.
fn lamp_floor(reflectance: f64, elements: usize, config: ShootingConfig) -> (Solved, f64) {
    let mut model = Model::new();
    let wall = model.surface(reflectance, 0.0);
    let lamp = model.surface(reflectance, 1.0);
    model.cube([lamp, wall, wall, wall, wall, wall]);
    let scene = model.scene();
    let solved = solve(&scene, elements, config);
    let exitance = solved.solution.triangle_exitance(&scene);
    let area: f64 = scene.ids().map(|id| scene.area(id)).sum();
    let power: f64 = scene.ids().map(|id| exitance[id.index()][0] * scene.area(id)).sum();
    (solved, power / area)
}

/// A cube with a smaller one standing free in it, seen from outside.
fn furnished(model: &mut Model, wall: MaterialId, inner: MaterialId) {
    model.cube([wall; 6]);
    let p =
        |i: usize| [0, 1, 2].map(|axis| 0.3 + 0.35 * ((i >> axis) & 1) as f64 + 0.02 * axis as f64);
    for face in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
    {
        model.quad(face.map(p), inner);
    }
}

#[test]
fn few_sweeps_at_any_reflectance() {
    for reflectance in [0.9, 0.99, 0.999, 0.9999, 0.999_999] {
        for elements in [12, 384, 3000] {
            let (solved, mean) = lamp_floor(reflectance, elements, until(1e-6));
            let sweeps = solved.shots as f64 / solved.patches as f64;
            // All that is emitted is absorbed: ΣA(1 − ρ)H = 1, and so ΣA·B = 1 + ρ/(1 − ρ).
            let exact = (1.0 + reflectance / (1.0 - reflectance)) / 6.0;
            let error = (mean / exact - 1.0).abs();
            println!("{reflectance}, {elements} elements: {sweeps:.1} sweeps, error {error:.1e}");
            assert!(solved.corrected && solved.reason == StopReason::Converged);
            assert!(sweeps <= SWEEPS, "{reflectance} {elements}: {sweeps}");
            // Rows sum to 1; columns only as well as second-order quadrature of the corners
            // does, which is not amplified.
            assert!(error < 1e-3, "{reflectance} {elements}: {error}");
            // Rounding of sums of light that is 1/(1 − ρ) times what is emitted.
            let balance = solved.ledger.imbalance() * (1.0 - reflectance);
            assert!(balance < 1e-13, "{reflectance} {elements}: {balance:e}");
        }
    }
}

#[test]
fn a_white_furnace_with_things_in_it_stays_even() {
    for reflectance in [0.9, 0.999, 0.999_999] {
        let mut model = Model::new();
        let wall = model.surface(reflectance, 1.0);
        furnished(&mut model, wall, wall);
        let solved = solve(&model.scene(), 1000, until(1e-9));
        let exact = 1.0 / (1.0 - reflectance);
        let values = solved.solution.elements.iter().flat_map(|e| {
            let [a, b, c] = e.corner_exitance;
            [e.exitance, a, b, c]
        });
        let worst = values.map(|b| (b[0] / exact - 1.0).abs()).fold(0.0, f64::max);
        let sweeps = solved.shots as f64 / solved.patches as f64;
        let [least, most] = solved.closed_rows.unwrap();
        println!("{reflectance}: {sweeps:.1} sweeps, off by {worst:.1e}, raw rows {least}..{most}");
        // Left open, a row that is off by δ is worth δ/(1 − ρ). Closed, what remains is that
        // later shots are cut into other cells than those the rows were learnt from.
        let defect = (1.0 - least).max(most - 1.0);
        assert!(worst < 0.1 * defect && sweeps <= SWEEPS, "{reflectance}: {worst:e}, {sweeps}");
    }
}

#[test]
fn corrected_light_is_the_light_of_plain_shooting() {
    let build = |model: &mut Model| {
        let wall = model.surface(0.9, 0.0);
        let lamp = model.surface(0.8, 1.0);
        let black = model.surface(0.05, 0.0);
        // Open at the top: nothing is closed, only corrected.
        model.cube([lamp, wall, wall, wall, black, wall]);
    };
    let light = |correction| {
        let mut model = Model::new();
        build(&mut model);
        let scene = model.scene();
        // Overshooting would make up for half of what is missing without corrections.
        let config = ShootingConfig { correction, overshoot: false, ..until(1e-9) };
        let solved = solve(&scene, 500, config);
        (solved.solution.triangle_exitance(&scene), solved.shots)
    };
    let (corrected, few) = light(Correction::Auto);
    let (plain, many) = light(Correction::Never);
    println!("{few} shots with corrections, {many} without");
    assert!(2 * few < many);
    for (a, b) in corrected.iter().zip(&plain) {
        // The two take the light in other portions, and so through other cells.
        assert!((a[0] / b[0] - 1.0).abs() < 2e-3, "{a:?} {b:?}");
    }
}

#[test]
fn nothing_is_corrected_where_light_is_lost() {
    let (solved, _) = lamp_floor(0.5, 384, until(1e-4));
    assert!(!solved.corrected);
}

#[test]
fn unshot_light_below_zero_is_shot_too() {
    // A black wall takes what a correction put everywhere: the unshot is negative beside it.
    let mut model = Model::new();
    let wall = model.surface(0.999, 0.0);
    let lamp = model.surface(0.999, 1.0);
    let black = model.surface(0.0, 0.0);
    model.cube([lamp, black, wall, wall, wall, wall]);
    let solved = solve(&model.scene(), 384, until(1e-9));
    let all = solved.solution.elements.iter();
    let least = all.clone().map(|e| e.exitance[0]).fold(f64::INFINITY, f64::min);
    let most = all.map(|e| e.exitance[0]).fold(0.0, f64::max);
    assert!(solved.reason == StopReason::Converged && least >= -1e-14 * most, "{least}");
}

#[test]
fn light_scales_with_its_source_bit_for_bit() {
    let bits = |exponent: i32| {
        let mut model = Model::new();
        let wall = model.surface(0.95, 0.0);
        let lamp = model.surface(0.3, 2f64.powi(exponent));
        furnished(&mut model, wall, lamp);
        let solved = solve(&model.scene(), 300, until(1e-5));
        let all = solved.solution.elements.into_iter();
        all.map(|e| (e.exitance[0] * 2f64.powi(-exponent)).to_bits()).collect::<Vec<_>>()
    };
    let one = bits(0);
    for exponent in [100, -100, 1000] {
        assert!(bits(exponent) == one, "2^{exponent}");
    }
}

/// Slowly, but it ends: what is shot in advance of bounces that come back a thousand times must not
/// keep the unshot power from falling.
#[test]
fn a_white_box_without_corrections_converges() {
    let mut model = Model::new();
    let (wall, lamp) = (model.surface(0.999, 0.0), model.surface(0.999, 1.0));
    model.cube([wall, lamp, wall, wall, wall, wall]);
    let config = ShootingConfig { correction: Correction::Never, ..until(0.05) };
    assert_eq!(solve(&model.scene(), 12, config).reason, StopReason::Converged);
}
