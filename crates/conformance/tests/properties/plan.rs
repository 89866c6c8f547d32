//! Whatever the scene, what a plan leaves out changes no bit where it says so.

use accel::{Bvh, BvhConfig, Nothing, Occluder, Proven};
use proptest::prelude::*;
use radiosity_core::plan::{Effect, Structure};
use radiosity_core::{
    Asked, Plan, PlanConfig, RefineConfig, Refined, Sequential, ShootingConfig, refine,
};
use scene::Scene;

use crate::rooms::{Piece, cube_of, room, scene};
use crate::runner;

/// Elements of the meshes that are lit; few, so that many scenes are.
const ELEMENTS: usize = 300;

/// The plan of a longer solve, so that walls and ways are looked for, too.
fn plan(scene: &Scene, everything: bool) -> Plan {
    let elements = Some(200_000);
    Plan::of(scene, &PlanConfig { elements, everything, ..PlanConfig::until(0.01) })
}

fn solve(scene: &Scene, plan: &Plan) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let config = BvhConfig::default();
    let bvh = Bvh::build(&triangles, &config);
    let some = Bvh::build_of(
        &triangles,
        |t| plan.in_structure(t),
        &config,
        |parts, work| {
            parts.iter_mut().for_each(work);
        },
    );
    let structure: &dyn Occluder = match plan.structure {
        Structure::None => &Nothing,
        _ => &some,
    };
    let occluder = Proven::new(structure, &plan.proofs);
    let (needs, correction) = (plan.needs, plan.correction);
    let shooting = ShootingConfig { needs, correction, ..ShootingConfig::until(1e-3) };
    let refining = RefineConfig::until(Asked::Unstated(ELEMENTS));
    refine(scene, &bvh, &occluder, &Sequential, shooting, refining, &[], &mut ())
}

/// How many scenes each kind of proof was of use in.
#[derive(Debug, Default)]
struct Used {
    unasked: u32,
    fewer: u32,
    dark: u32,
}

fn compare(pieces: &[Piece], used: &mut Used) -> Result<(), TestCaseError> {
    let scene = scene(pieces);
    let (needed, everything) = (plan(&scene, false), plan(&scene, true));
    let exact = needed.decisions.iter().all(|d| !d.leaves_out || d.effect == Effect::Exact);
    let [a, b] = [&needed, &everything].map(|plan| solve(&scene, plan));
    used.unasked += u32::from(a.total_work.rays < b.total_work.rays);
    used.fewer += u32::from(a.total_work.form_factors < b.total_work.form_factors);
    used.dark += u32::from(needed.proofs.spaces.shells() > 0);
    if exact {
        for (a, b) in a.solution.elements.iter().zip(&b.solution.elements) {
            prop_assert_eq!(a.exitance.0.map(f64::to_bits), b.exitance.0.map(f64::to_bits));
        }
    }
    Ok(())
}

#[test]
fn what_is_left_out_changes_no_bit() {
    let used = std::cell::RefCell::new(Used::default());
    runner(80).run(&room(), |pieces| compare(&pieces, &mut used.borrow_mut())).unwrap();
    let used = used.into_inner();
    assert!(used.unasked > 10, "{used:?}");
}

/// Two cubes side by side or apart, each with some of its walls, and triangles in both.
#[test]
fn nor_in_two_rooms() {
    let used = std::cell::RefCell::new(Used::default());
    let offsets = prop_oneof![Just(1.0), Just(1.5), Just(0.7)];
    runner(50)
        .run(&(room(), room(), offsets, any::<bool>()), |(inside, other, offset, whole)| {
            let surface = |p: &Piece| (p.reflectance, p.emittance, true);
            let walls: Vec<_> = inside.iter().chain(&other).map(surface).cycle().take(12).collect();
            let mut pieces = cube_of(&walls[..6]);
            let mut second = cube_of(&walls[6..]);
            second.iter_mut().flat_map(|p| &mut p.corners).for_each(|c| c.x += offset);
            // A hole in one of them, or none.
            if !whole {
                pieces.remove(3);
            }
            pieces.extend(second);
            pieces.extend(inside.into_iter().rev().take(2));
            compare(&pieces, &mut used.borrow_mut())
        })
        .unwrap();
    let used = used.into_inner();
    assert!(used.dark > 5 && used.fewer > 5, "{used:?}");
}
