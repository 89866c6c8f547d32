//! Energy, linearity and repeatability.

use std::sync::Mutex;

use accel::{Bvh, BvhConfig, Octree, OctreeConfig};
use radiosity_core::{
    Census, Control, Exchange, Executor, Mesh, MeshConfig, Schedule, Sequential, Shooting,
    ShootingConfig, StepReport, StopReason,
};
use scene::{Scene, Solution};

use crate::models::{Model, paired, solve, until};

/// A cube with one lamp, one two-sided screen and a hole: all four fates of light.
fn open_box(emittance: f64) -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.45, 0.0);
    let lamp = model.surface(0.2, emittance);
    let screen = model.sided(0.4, 0.0, scene::Sides::Both);
    let board = model.surface(0.3, 0.0);
    model.cube([wall, lamp, wall, wall, wall, wall]);
    model.quad([[0.3, 0.3, 0.4], [0.7, 0.3, 0.5], [0.7, 0.7, 0.5], [0.3, 0.7, 0.4]], screen);
    model.triangle([[0.1, 0.1, 0.2], [0.1, 0.6, 0.2], [0.6, 0.1, 0.2]], board);
    let closed = model.scene();
    // Leave out one wall.
    let mut builder = scene::SceneBuilder::new();
    let group = builder.group("open");
    for id in closed.ids().filter(|id| !(4..6).contains(&id.0)) {
        let v = closed.corners(id).map(|p| builder.vertex(p));
        let m = builder.material(closed.material_of(id).clone()).unwrap();
        builder.triangle(v, m, group).unwrap();
    }
    builder.finish()
}

#[test]
fn every_watt_is_accounted_for() {
    for config in [until(1e-4), paired(1e-4), until(0.3)] {
        let solved = solve(&open_box(3.0), 300, config);
        let l = solved.ledger;
        assert!(l.imbalance() < 1e-12, "{}", l.imbalance());
        for term in [l.absorbed, l.escaped, l.wrong_side, l.unshot] {
            assert!(term[0] > 0.0, "{l:?}");
        }
        assert_eq!(l.emitted[2], 0.0);
    }
}

#[test]
fn a_closed_scene_loses_nothing_but_the_defect() {
    let mut model = Model::new();
    let wall = model.surface(0.7, 0.0);
    let lamp = model.surface(0.2, 1.0);
    model.cube([wall, lamp, wall, wall, wall, wall]);
    let scene = model.scene();
    let defect = |elements| {
        let l = solve(&scene, elements, until(1e-3)).ledger;
        assert_eq!(l.wrong_side[0], 0.0);
        assert_eq!(l.escaped, l.form_factor_defect, "no sampled direction leaves a closed scene");
        l.share(l.form_factor_defect).abs()
    };
    // Finer elements account for more of the light.
    let (coarse, fine) = (defect(600), defect(2400));
    assert!(coarse < 2e-2 && fine < coarse / 1.5, "{coarse} {fine}");
}

#[test]
fn light_scales_by_powers_of_two_bit_for_bit() {
    let one = solve(&open_box(1.0), 200, until(1e-3));
    for exponent in [100, -100, 300] {
        let k = 2f64.powi(exponent);
        let scaled = solve(&open_box(k), 200, until(1e-3));
        assert_eq!(one.shots, scaled.shots);
        for (a, b) in one.solution.elements.iter().zip(&scaled.solution.elements) {
            assert_eq!(a.exitance * k, b.exitance);
        }
    }
}

/// Runs the items from the last to the first.
struct Backwards;

impl Executor for Backwards {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        items.iter_mut().rev().for_each(f);
    }
}

/// Runs even items before odd ones, on two threads.
struct EvenOdd;

impl Executor for EvenOdd {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        let (even, odd): (Vec<_>, Vec<_>) =
            items.iter_mut().enumerate().partition(|i| i.0 % 2 == 0);
        let all = Mutex::new(even.into_iter().chain(odd).collect::<Vec<_>>().into_iter());
        std::thread::scope(|s| {
            for _ in 0..2 {
                s.spawn(|| {
                    while let Some((_, item)) = { all.lock().unwrap().next() } {
                        f(item);
                    }
                });
            }
        });
    }
}

fn solution_on<E: Executor>(scene: &Scene, executor: &E) -> Solution {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let mesh = Mesh::from_scene(scene, &MeshConfig::with_elements(3000));
    let census = Census::take(scene, &mesh, &bvh, Exchange::OneSided, executor);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, executor, until(0.05));
    shooting.run(&mut ());
    shooting.solution()
}

#[test]
fn any_order_and_any_thread_gives_the_same_bits() {
    let scene = open_box(5.0);
    let expected = solution_on(&scene, &Sequential);
    assert_eq!(solution_on(&scene, &Backwards), expected);
    assert_eq!(solution_on(&scene, &EvenOdd), expected);
}

#[test]
fn octree_and_bvh_give_the_same_light() {
    let scene = open_box(5.0);
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let octree = Octree::build(&triangles, &OctreeConfig::default());
    let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(500));
    let census = Census::default();
    let mut a = Shooting::new(&mesh, &bvh, &census, &Sequential, until(1e-2));
    let mut b = Shooting::new(&mesh, &octree, &census, &Sequential, until(1e-2));
    a.run(&mut ());
    b.run(&mut ());
    assert_eq!(a.solution(), b.solution());
}

#[test]
fn the_observer_hears_every_shot_and_may_stop() {
    let scene = open_box(1.0);
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(100));
    let census = Census::default();
    let config = ShootingConfig { schedule: Schedule::Single, ..until(1e-6) };
    let mut shooting = Shooting::new(&mesh, &bvh, &census, &Sequential, config);
    let mut heard = Vec::new();
    let reason = shooting.run(&mut |r: &StepReport| {
        heard.push(r.shots);
        if r.shots == 3 { Control::Stop } else { Control::Continue }
    });
    assert_eq!((reason, heard), (StopReason::Stopped, vec![1, 2, 3]));
    assert!(shooting.ledger().imbalance() < 1e-12, "a stopped solution is still whole");
}

#[test]
fn sheets_back_to_back_in_one_place_are_no_wrong_side() {
    // Two closed cubes that share a wall: its two sheets lie in one place.
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    let lamp = model.surface(0.5, 1.0);
    model.cube_at(0.0, [wall, lamp, wall, wall, wall, wall]);
    model.cube_at(1.0, [wall; 6]);
    let solved = solve(&model.scene(), 400, until(1e-3));
    assert_eq!(solved.ledger.wrong_side[0], 0.0);
    // And no light passes them.
    let dark = |e: &&scene::SolutionElement| e.triangle.0 >= 12;
    for e in solved.solution.elements.iter().filter(dark) {
        assert_eq!(e.exitance[0], 0.0, "{e:?} {:?}", solved.solution.corners(e));
    }
}
