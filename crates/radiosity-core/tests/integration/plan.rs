//! What is left out changes no bit where the plan says so, and is left out.

use accel::{Bvh, BvhConfig, Nothing, Occluder, Proven};
use radiosity_core::plan::{Decision, Effect, Structure, Topic};
use radiosity_core::{
    Asked, Plan, PlanConfig, RefineConfig, Refined, Sequential, ShootingConfig, refine,
};
use scene::{MaterialId, Scene, Sides, TriangleId};

use crate::models::{Model, until};

const ELEMENTS: usize = 600;

fn config() -> PlanConfig {
    PlanConfig { elements: Some(ELEMENTS), available: 8, ..PlanConfig::until(0.01) }
}

/// Solves a scene as planned.
fn solve(scene: &Scene, plan: &Plan, asked: Asked) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let some = Bvh::build_of(
        &triangles,
        |t| plan.in_structure(t),
        &BvhConfig::default(),
        |parts, work| parts.iter_mut().for_each(work),
    );
    let structure: &dyn Occluder = match plan.structure {
        Structure::None => &Nothing,
        _ => &some,
    };
    let occluder = Proven::new(structure, &plan.proofs);
    let shooting = ShootingConfig { needs: plan.needs, correction: plan.correction, ..until(1e-4) };
    let refining = RefineConfig::until(asked);
    refine(scene, &bvh, &occluder, &Sequential, shooting, refining, &[], &mut ())
}

/// The same scene as planned, and with everything.
fn both(scene: &Scene) -> (Plan, [Refined; 2]) {
    let plan = Plan::of(scene, &config());
    let everything = Plan::of(scene, &PlanConfig { everything: true, ..config() });
    assert!(everything.decisions.iter().all(|d| !d.leaves_out));
    let solved = [&plan, &everything].map(|p| solve(scene, p, Asked::Unstated(ELEMENTS)));
    (plan, solved)
}

fn decision(plan: &Plan, topic: Topic) -> &Decision {
    plan.decisions.iter().find(|d| d.topic == topic).unwrap()
}

/// Makes sure that both ways have the same light, to the bit.
fn same([a, b]: &[Refined; 2]) {
    assert_eq!(a.mesh.elements().len(), b.mesh.elements().len());
    for (a, b) in a.solution.elements.iter().zip(&b.solution.elements) {
        let bits = |light: scene::Rgb| light.0.map(f64::to_bits);
        assert_eq!(bits(a.exitance), bits(b.exitance), "{a:?} {b:?}");
        assert_eq!(a.corner_exitance.map(bits), b.corner_exitance.map(bits));
    }
}

fn lit_room(model: &mut Model) -> [MaterialId; 3] {
    let (wall, lamp, thing) =
        (model.surface(0.5, 0.0), model.surface(0.2, 1.0), model.surface(0.4, 0.0));
    model.cube([wall, lamp, wall, wall, wall, wall]);
    [wall, lamp, thing]
}

/// A small box seen from outside.
fn thing(model: &mut Model, low: [f64; 3], high: [f64; 3], material: MaterialId) {
    let p = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { high[k] } else { low[k] });
    for face in [[2, 3, 1, 0], [5, 7, 6, 4], [1, 5, 4, 0], [6, 7, 3, 2], [4, 6, 2, 0], [3, 7, 5, 1]]
    {
        model.quad(face.map(p), material);
    }
}

#[test]
fn a_convex_room_needs_no_occluder_and_no_census() {
    let mut model = Model::new();
    lit_room(&mut model);
    let (plan, solved) = both(&model.scene());
    assert!(plan.facts.closed && plan.facts.nothing_blocks());
    assert!(!plan.needs.segments && !plan.needs.census);
    assert_eq!(plan.structure, Structure::None);
    same(&solved);
    let [needed, everything] = &solved;
    assert_eq!((needed.total_work.rays, needed.total_work.directions), (0, 0));
    assert!(everything.total_work.rays > 10_000 && everything.total_work.directions > 1000);
    assert!(needed.ledger.imbalance() < 1e-12);
    assert_eq!(needed.ledger, everything.ledger);
}

#[test]
fn stiff_open_and_two_sided_scenes_keep_their_light_to_the_bit() {
    // Closed and stiff: corrections, and rows that are closed.
    let mut stiff = Model::new();
    let (wall, lamp) = (stiff.surface(0.95, 0.0), stiff.surface(0.9, 1.0));
    stiff.cube([wall, lamp, wall, wall, wall, wall]);
    thing(&mut stiff, [0.3, 0.4, 0.2], [0.5, 0.6, 0.5], wall);
    // Stiff and convex: no census, no segment.
    let mut convex = Model::new();
    let (wall, lamp) = (convex.surface(0.95, 0.0), convex.surface(0.9, 1.0));
    convex.cube([wall, lamp, wall, wall, wall, wall]);
    // Open: a wall is missing.
    let mut open = Model::new();
    let [wall, lamp, material] = {
        let (wall, lamp) = (open.surface(0.5, 0.0), open.surface(0.2, 1.0));
        [wall, lamp, open.surface(0.4, 0.0)]
    };
    let p = |i: usize| [(i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64];
    open.quad([0, 1, 3, 2].map(p), wall);
    open.quad([4, 6, 7, 5].map(p), lamp);
    open.quad([0, 4, 5, 1].map(p), wall);
    thing(&mut open, [0.3, 0.4, 0.2], [0.5, 0.6, 0.5], material);
    // A panel that is lit on both sides.
    let mut sided = Model::new();
    lit_room(&mut sided);
    let panel = sided.sided(0.5, 0.0, Sides::Both);
    sided.quad([[0.5, 0.1, 0.1], [0.5, 0.9, 0.1], [0.5, 0.9, 0.8], [0.5, 0.1, 0.8]], panel);
    for (model, corrected) in [(stiff, true), (convex, true), (open, false), (sided, false)] {
        let (plan, solved) = both(&model.scene());
        assert!(plan.decisions.iter().any(|d| d.leaves_out));
        assert_eq!([&solved[0], &solved[1]].map(|s| s.corrected), [corrected; 2]);
        same(&solved);
    }
}

#[test]
fn channels_that_are_multiples_are_computed_once() {
    // The models' red, green and blue emittances are 1, 1/2 and 0; reflectances are grey.
    let mut model = Model::new();
    lit_room(&mut model);
    let plan = Plan::of(&model.scene(), &config());
    assert_eq!((plan.needs.channels.only, plan.needs.channels.times), (Some(0), [1.0, 0.5, 0.0]));
    assert_eq!(decision(&plan, Topic::Channels).effect, Effect::Rounding);
}

#[test]
fn a_small_thing_leaves_most_ways_open() {
    let mut model = Model::new();
    let [_, _, material] = lit_room(&mut model);
    thing(&mut model, [0.7, 0.7, 0.3], [0.8, 0.8, 0.4], material);
    let scene = model.scene();
    // A longer solve, so that its mesh is looked at.
    let plan = Plan::of(&scene, &PlanConfig { elements: Some(50_000), ..config() });
    assert_eq!(plan.blockers(), 12);
    assert!(plan.proofs.objects.is_some(), "{:?}", decision(&plan, Topic::Ways));
    let everything = Plan::of(&scene, &PlanConfig { everything: true, ..config() });
    let solved = [&plan, &everything].map(|p| solve(&scene, p, Asked::Unstated(ELEMENTS)));
    same(&solved);
    let [needed, everything] = solved.map(|s| s.total_work);
    assert_eq!(needed.form_factors, everything.form_factors);
    assert!(needed.rays < everything.rays * 7 / 10, "{} of {}", needed.rays, everything.rays);
}

#[test]
fn a_wall_hides_what_is_behind_it() {
    // A wall across the room, all but a gap at one side.
    let mut model = Model::new();
    let [_, _, material] = lit_room(&mut model);
    thing(&mut model, [0.48, 0.05, 0.001], [0.52, 0.999, 0.999], material);
    let scene = model.scene();
    let plan = Plan::of(&scene, &PlanConfig { elements: Some(50_000), ..config() });
    assert!(!plan.proofs.walls.is_empty(), "{:?}", decision(&plan, Topic::Walls));
    let everything = Plan::of(&scene, &PlanConfig { everything: true, ..config() });
    let solved = [&plan, &everything].map(|p| solve(&scene, p, Asked::Unstated(6 * ELEMENTS)));
    same(&solved);
    let [needed, everything] = solved.map(|s| s.total_work);
    let (few, all) = (needed.form_factors, everything.form_factors);
    assert!(few < all * 9 / 10, "{few} of {all}");
}

#[test]
fn a_room_without_a_lamp_is_left_dark_unseen() {
    // Two rooms wall to wall; the second has no lamp.
    let mut model = Model::new();
    let [wall, _, material] = lit_room(&mut model);
    model.cube_at(1.0, [wall; 6]);
    thing(&mut model, [1.2, 0.2, 0.2], [1.4, 0.4, 0.4], material);
    let scene = model.scene();
    let (plan, solved) = both(&scene);
    assert!(plan.proofs.spaces.shells() > 0, "{:?}", decision(&plan, Topic::Spaces));
    same(&solved);
    let [needed, everything] = &solved;
    let (few, all) = (needed.total_work.form_factors, everything.total_work.form_factors);
    assert!(few < all * 9 / 10, "{few} of {all}");
    let dark = needed.solution.elements.iter().filter(|e| e.triangle >= TriangleId(12));
    assert!(dark.clone().count() > 100 && dark.into_iter().all(|e| e.exitance == scene::Rgb::ZERO));
}

#[test]
fn black_surfaces_receive_nothing_and_the_books_still_close() {
    let mut model = Model::new();
    let (black, lamp, thing_) =
        (model.surface(0.0, 0.0), model.surface(0.0, 1.0), model.surface(0.5, 0.0));
    model.cube([black, lamp, black, black, black, black]);
    thing(&mut model, [0.4, 0.4, 0.4], [0.6, 0.6, 0.6], thing_);
    let (plan, [needed, everything]) = both(&model.scene());
    assert!(plan.facts.black > 0.9 && !plan.needs.black);
    let (few, all) = (needed.total_work.form_factors, everything.total_work.form_factors);
    assert!(few < all / 4, "{few} of {all}");
    // Nothing but the box reflects, and it does not see itself: one bounce, the same light.
    for (a, b) in needed.solution.elements.iter().zip(&everything.solution.elements) {
        let difference = (a.exitance - b.exitance).abs().max_channel();
        assert!(difference <= 1e-12, "{difference}");
    }
    // The books are sampled where surfaces receive nothing, 32 directions a patch: within a few per
    // cent of what is absorbed, and exact in sum.
    assert!(needed.ledger.imbalance() < 1e-12);
    let absorbed = |r: &Refined| r.ledger.share(r.ledger.absorbed);
    assert!((absorbed(&needed) - absorbed(&everything)).abs() < 0.05, "{}", absorbed(&needed));
}

#[test]
fn black_surfaces_stay_whole_while_the_rest_is_refined() {
    let mut model = Model::new();
    let (black, lamp, thing_) =
        (model.surface(0.0, 0.0), model.surface(0.0, 1.0), model.surface(0.5, 0.0));
    model.cube([black, lamp, black, black, black, black]);
    thing(&mut model, [0.4, 0.4, 0.4], [0.6, 0.6, 0.6], thing_);
    let scene = model.scene();
    let plan = Plan::of(&scene, &PlanConfig { elements: None, error: 0.05, ..config() });
    let refined = solve(&scene, &plan, Asked::Error(0.05));
    let black = |e: &radiosity_core::Element| {
        let root = refined.mesh.root_of(e);
        root.reflectance == scene::Rgb::ZERO && root.emittance == scene::Rgb::ZERO
    };
    let whole = refined.mesh.elements().iter().filter(|e| black(e)).count();
    // Ten black triangles, and what the edges that they share with the lamp ask for; of the area, they
    // are four fifths.
    let all = refined.mesh.elements().len();
    assert!(whole >= 10 && whole * 4 < all, "{whole} of {all}");
}

#[test]
fn early_estimates_decide_nothing() {
    let mut model = Model::new();
    let [_, _, material] = lit_room(&mut model);
    thing(&mut model, [0.4, 0.4, 0.4], [0.6, 0.6, 0.6], material);
    let scene = model.scene();
    let mut plan = Plan::of(&scene, &PlanConfig { elements: None, ..config() });
    assert!(!plan.needs.early_estimates);
    let without = solve(&scene, &plan, Asked::Error(0.03));
    plan.needs.early_estimates = true;
    let with = solve(&scene, &plan, Asked::Error(0.03));
    assert_eq!(without.statement, with.statement);
    same(&[without, with]);
    let timed = Plan::of(&scene, &PlanConfig { timed: true, ..config() });
    assert!(timed.needs.early_estimates, "a time limit may end the work on any mesh");
}

#[test]
fn threads_are_as_many_as_pay() {
    let mut model = Model::new();
    lit_room(&mut model);
    let scene = model.scene();
    let threads = |elements, asked| {
        let elements = Some(elements);
        Plan::of(&scene, &PlanConfig { elements, threads: asked, ..config() }).threads
    };
    assert_eq!([threads(12, None), threads(100_000, None)], [1, 8]);
    assert_eq!([threads(12, Some(3)), threads(100_000, Some(3))], [3, 3]);
}

#[test]
fn a_plan_is_the_same_every_time_and_knows_empty_scenes() {
    let mut model = Model::new();
    let [_, _, material] = lit_room(&mut model);
    thing(&mut model, [0.4, 0.4, 0.4], [0.6, 0.6, 0.6], material);
    let scene = model.scene();
    let [a, b] = [(); 2].map(|()| Plan::of(&scene, &config()));
    assert_eq!((a.decisions, a.needs, a.planned), (b.decisions, b.needs, b.planned));
    let empty = Model::new().scene();
    let plan = Plan::of(&empty, &config());
    assert_eq!(plan.facts.triangles, 0);
    let solved = solve(&empty, &plan, Asked::Unstated(ELEMENTS));
    assert_eq!(solved.mesh.elements().len(), 0);
}
