//! What an observer may do on the way: stop at any moment, look at the light, keep meshes small.

use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use accel::{Bvh, BvhConfig};
use radiosity_core::{
    Asked, Control, Mesh, Needs, Observer, Reached, RefineConfig, Refined, Sequential,
    ShootingConfig, StepReport, Stopper, refine,
};
use scene::{Rgb, Scene, Solution};

use crate::models::{Model, until};

/// Stops after so many questions; keeps the light of each step; allows so many elements.
struct Visitor {
    asked: Arc<AtomicUsize>,
    patience: usize,
    looks: bool,
    seen: Vec<(u64, Solution)>,
    most: Vec<usize>,
}

impl Visitor {
    fn patient(patience: usize) -> Self {
        Self { asked: Arc::default(), patience, looks: false, seen: Vec::new(), most: Vec::new() }
    }
}

impl Observer for Visitor {
    fn step(&mut self, _: &StepReport) -> Control {
        Control::Continue
    }

    fn stopper(&self) -> Option<Stopper> {
        let (asked, patience) = (Arc::clone(&self.asked), self.patience);
        Some(Arc::new(move || asked.fetch_add(1, Ordering::Relaxed) >= patience))
    }

    fn elements(&mut self, planned: usize) -> usize {
        if self.most.is_empty() { planned } else { self.most.remove(0) }
    }

    fn wants_solution(&mut self, _: &StepReport) -> bool {
        self.looks
    }

    fn solution(&mut self, report: &StepReport, mesh: &Mesh, solution: &Solution) {
        assert_eq!(mesh.elements().len(), solution.elements.len());
        self.seen.push((report.shots, solution.clone()));
    }
}

/// A room with a lamp and a board that casts a shadow.
fn room() -> Scene {
    let mut model = Model::new();
    let (wall, lamp) = (model.surface(0.5, 0.0), model.surface(0.0, 9.0));
    model.cube([wall; 6]);
    model.quad([[0.4, 0.4, 0.99], [0.4, 0.6, 0.99], [0.6, 0.6, 0.99], [0.6, 0.4, 0.99]], lamp);
    model.quad([[0.3, 0.3, 0.5], [0.8, 0.3, 0.5], [0.8, 0.7, 0.5], [0.3, 0.7, 0.5]], wall);
    model.scene()
}

fn visited(scene: &Scene, asked: Asked, visitor: &mut Visitor) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    refine(scene, &bvh, &bvh, &Sequential, until(1e-2), RefineConfig::until(asked), &[], visitor)
}

#[test]
fn a_stop_at_any_moment_leaves_the_light_of_a_whole_step() {
    let scene = room();
    for asked in [Asked::Unstated(200), Asked::Elements(400)] {
        let mut witness = Visitor { looks: true, ..Visitor::patient(usize::MAX) };
        let whole = visited(&scene, asked, &mut witness);
        assert_eq!(whole.reached, Reached::Elements);
        let questions = witness.asked.load(Ordering::Relaxed);
        let (mut dark, mut half) = (0, 0);
        for patience in (0..20).chain((20..questions).step_by(questions / 40)) {
            let refined = visited(&scene, asked, &mut Visitor::patient(patience));
            if refined.reached != Reached::Stopped {
                // Asked after the light was there, while it was judged.
                assert!(refined.solution == whole.solution, "{asked:?} {patience}");
            } else if refined.work.shots == 0 {
                dark += 1;
                for element in &refined.solution.elements {
                    let emittance = scene.material_of(element.triangle).emittance;
                    assert_eq!(element.exitance, emittance);
                }
            } else {
                half += 1;
                let known = witness.seen.iter().any(|(_, solution)| *solution == refined.solution);
                assert!(known, "{asked:?} {patience}: the light of no step");
            }
            if let Some(statement) = refined.statement {
                assert!(statement.triangles.e1.total() > 0.0, "{asked:?} {patience}");
            }
        }
        assert!(dark > 0 && half > 5, "{asked:?}: {dark} {half} of {questions}");
    }
}

#[test]
fn looking_at_the_light_changes_nothing() {
    let scene = room();
    let asked = Asked::Error(0.05);
    let mut witness = Visitor { looks: true, ..Visitor::patient(usize::MAX) };
    let watched = visited(&scene, asked, &mut witness);
    let alone = visited(&scene, asked, &mut Visitor::patient(usize::MAX));
    assert!(watched.solution == alone.solution);
    assert!(witness.seen.is_sorted_by_key(|(shots, _)| *shots), "shots of all levels");
    // Shooting only adds light, and the last step's is the result but for what corrections add.
    let light = |s: &Solution| s.elements.iter().map(|e| e.exitance).sum::<Rgb>()[0];
    assert!(light(&witness.seen.last().unwrap().1) > 0.0);
    assert!(witness.seen.last().unwrap().1 == alone.solution);
}

#[test]
fn a_small_mesh_that_is_the_last_after_all_is_estimated_all_the_same() {
    let scene = room();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let needs = Needs { early_estimates: false, ..Needs::EVERYTHING };
    let config = ShootingConfig { needs, ..until(1e-2) };
    let refining = RefineConfig::until(Asked::Error(1e-4));
    let mut visitor = Visitor { most: vec![1000, 1000, 200], ..Visitor::patient(usize::MAX) };
    let refined = refine(&scene, &bvh, &bvh, &Sequential, config, refining, &[], &mut visitor);
    assert_eq!(refined.reached, Reached::ElementLimit);
    let statement = refined.statement.unwrap();
    assert!(statement.triangles.e1.total().is_finite() && statement.sample > 100, "{statement:?}");
}

#[test]
fn fewer_elements_make_coarser_levels_or_none() {
    let scene = room();
    let run = |asked, most: &[usize]| {
        let mut visitor = Visitor { most: most.to_vec(), ..Visitor::patient(usize::MAX) };
        let refined = visited(&scene, asked, &mut visitor);
        assert_eq!(refined.reached, Reached::ElementLimit, "{asked:?} {most:?}");
        refined.mesh.elements().len()
    };
    assert!(run(Asked::Unstated(5000), &[300]) <= 300);
    // The first level as it was planned, the second with less than its four times as many.
    let coarser = run(Asked::Elements(1600), &[1000, 250]);
    assert!((151..=250).contains(&coarser), "{coarser}");
    // Too few to be worth a second.
    let first = run(Asked::Elements(1600), &[1000, 110]);
    assert!(first <= 110, "{first}");
    assert!(run(Asked::Error(1e-4), &[1000, 1000, 200]) <= 450);
}
