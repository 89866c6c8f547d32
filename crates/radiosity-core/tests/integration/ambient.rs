//! Unshot light as an even ambient light: what it brings near, what it leaves dark, what is said of it.

use radiosity_core::{Asked, RefineConfig, Sequential, ShootingConfig, refine};
use scene::{Rgb, Scene, Solution};

use crate::models::{Model, solve, until};
use accel::{Bvh, BvhConfig};

/// A room whose lamp shines at the ceiling, so that nearly all light is reflected; beside it, behind
/// a wall, a closed one without a lamp.
fn rooms() -> Scene {
    let mut model = Model::new();
    let (wall, lamp) = (model.surface(0.6, 0.0), model.surface(0.6, 5.0));
    model.cube([wall; 6]);
    model.quad([[0.3, 0.3, 0.5], [0.7, 0.3, 0.5], [0.7, 0.7, 0.5], [0.3, 0.7, 0.5]], lamp);
    model.quad([[0.3, 0.3, 0.5], [0.3, 0.7, 0.5], [0.7, 0.7, 0.5], [0.7, 0.3, 0.5]], wall);
    model.cube_at(3.0, [wall; 6]);
    model.scene()
}

fn power(scene: &Scene, solution: &Solution) -> f64 {
    let area = |corners: [glam::DVec3; 3]| {
        let [a, b, c] = corners;
        (b - a).cross(c - a).length() / 2.0
    };
    let of = |e: &scene::SolutionElement| {
        let lit = e.exitance - scene.material_of(e.triangle).emittance;
        lit[0] * area(e.vertices.map(|v| solution.vertices[v.index()]))
    };
    solution.elements.iter().map(of).sum()
}

#[test]
fn what_is_still_to_come_is_shown_and_dark_rooms_stay_dark() {
    let scene = rooms();
    let all = power(&scene, &solve(&scene, 800, until(1e-6)).solution);
    let early = solve(&scene, 800, until(0.3));
    let config = ShootingConfig { ambient: true, ..until(0.3) };
    let guessed = solve(&scene, 800, config);
    assert_eq!(early.shots, guessed.shots, "the shots do not know of it");
    // By the ledger alone: in a closed scene all that is emitted is absorbed in the end.
    let missing = |solution| (power(&scene, solution) / all - 1.0).abs();
    let (plain, better) = (missing(&early.solution), missing(&guessed.solution));
    assert!(plain > 0.1 && better < plain / 4.0, "{plain} {better}");
    for (element, plain) in guessed.solution.elements.iter().zip(&early.solution.elements) {
        if plain.exitance == Rgb::ZERO {
            assert_eq!(element.exitance, Rgb::ZERO);
        }
        if scene.corners(element.triangle)[0].x > 2.0 {
            assert_eq!(element.corner_exitance, [Rgb::ZERO; 3]);
        }
    }
}

#[test]
fn the_statement_holds_for_what_is_guessed() {
    let scene = rooms();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let refining = RefineConfig::until(Asked::Elements(1200));
    let solved = |unshot, ambient| {
        let config = ShootingConfig { ambient, ..until(unshot) };
        refine(&scene, &bvh, &bvh, &Sequential, config, refining, &[], &mut ())
    };
    let converged = power(&scene, &solved(1e-7, false).solution);
    let (plain, guessed) = (solved(0.3, false), solved(0.3, true));
    let iteration = |r: &radiosity_core::Refined| r.statement.unwrap().triangles.e1.iteration;
    let off = (power(&scene, &guessed.solution) / converged - 1.0).abs();
    assert!(off < iteration(&guessed), "{off} {}", iteration(&guessed));
    // What is guessed counts as unknown, beside what is missing.
    let added = power(&scene, &guessed.solution) - power(&scene, &plain.solution);
    let said = iteration(&guessed) * power(&scene, &guessed.solution);
    let missing = iteration(&plain) * power(&scene, &plain.solution);
    assert!((said / (missing + added) - 1.0).abs() < 0.05, "{said} {missing} {added}");
}
