//! Refinement: the statement lies above the true error, and the work ends where it should.

use accel::{Bvh, BvhConfig};
use radiosity_core::{
    Asked, Control, LevelReport, Observer, Probe, Reached, RefineConfig, Refined, Sequential,
    StepReport, StopReason, refine,
};
use scene::{Rgb, Scene, TriangleId};

use crate::models::{Model, until};

/// Form factor between directly opposed unit squares at distance 1 (Howell, catalogue, C-11).
const F: f64 = 0.199_824_895_698_387;

fn run(scene: &Scene, asked: Asked, most: usize, probes: &[Probe]) -> Refined {
    watched(scene, asked, most, probes, &mut ())
}

fn watched(
    scene: &Scene,
    asked: Asked,
    most: usize,
    probes: &[Probe],
    observer: &mut impl Observer,
) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let refining = RefineConfig { most_elements: most, ..RefineConfig::until(asked) };
    refine(scene, &bvh, &bvh, &Sequential, until(1e-4), refining, probes, observer)
}

/// Two plates that light each other: E = 1 below, ρ on both. By symmetry both triangles of a
/// plate have its mean, the solution of B₁ = 1 + ρ₁FB₂, B₂ = ρ₂FB₁.
fn plates(reflectance: f64) -> (Scene, f64) {
    let mut model = Model::new();
    let lamp = model.surface(reflectance, 1.0);
    let white = model.surface(reflectance, 0.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], lamp);
    model.quad([[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]], white);
    (model.scene(), reflectance * F)
}

/// A box with a lamp in the roof and a board in the air: shadows with soft edges.
fn shadows() -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.6, 0.0);
    let lamp = model.surface(0.0, 9.0);
    model.cube([wall; 6]);
    model.quad([[0.4, 0.4, 0.99], [0.4, 0.6, 0.99], [0.6, 0.6, 0.99], [0.6, 0.4, 0.99]], lamp);
    model.quad([[0.3, 0.3, 0.5], [0.8, 0.3, 0.5], [0.8, 0.7, 0.5], [0.3, 0.7, 0.5]], wall);
    model.scene()
}

#[test]
fn the_statement_bounds_the_error_of_a_known_solution() {
    // Without a second bounce: the upper plate's mean is exactly ρ·F.
    let (mut model, reflectance) = (Model::new(), 0.7);
    let lamp = model.surface(0.0, 1.0);
    let white = model.surface(reflectance, 0.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], lamp);
    model.quad([[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]], white);
    let scene = model.scene();
    for target in [0.03, 0.01, 0.003] {
        let refined = run(&scene, Asked::Error(target), 1 << 20, &[]);
        let stated = refined.statement.unwrap().triangles.e1;
        let exitance = refined.solution.triangle_exitance(&scene);
        let mean = (exitance[2][0] + exitance[3][0]) / 2.0;
        let error = (mean / (reflectance * F) - 1.0).abs();
        println!(
            "asked {target}: {} elements, stated {stated:?}, true {error:.2e}",
            refined.mesh.elements().len()
        );
        assert!(refined.reached == Reached::Error && stated.total() <= target);
        assert!(error <= stated.total(), "{error} {stated:?}");
    }
}

#[test]
fn the_statement_bounds_the_distance_to_a_finer_solution() {
    let scene = shadows();
    let fine = run(&scene, Asked::Unstated(12_000), 1 << 20, &[]);
    let truth = fine.solution.triangle_exitance(&scene);
    for elements in [750, 3_000] {
        let refined = run(&scene, Asked::Elements(elements), 1 << 20, &[]);
        let stated = refined.statement.unwrap().triangles.e1;
        let ours = refined.solution.triangle_exitance(&scene);
        let (mut error, mut power) = (0.0, 0.0);
        for id in scene.ids().filter(|id| !scene.material_of(*id).emits()) {
            let (a, b) = (ours[id.index()][0], truth[id.index()][0]);
            error += scene.area(id) * (a - b).abs();
            power += scene.area(id) * b;
        }
        let error = error / power;
        println!("{elements} elements: stated {stated:?}, off by {error:.2e}");
        assert!(error <= stated.total(), "{error} {stated:?}");
        assert!(stated.total() <= 10.0 * error, "{error} {stated:?}");
    }
}

#[test]
fn a_limit_ends_the_work_and_the_statement_says_what_was_reached() {
    let scene = shadows();
    let refined = run(&scene, Asked::Error(1e-4), 5_000, &[]);
    assert_eq!(refined.reached, Reached::ElementLimit);
    assert!(refined.mesh.elements().len() <= 5_000);
    assert!(refined.statement.unwrap().triangles.e1.total() > 1e-4);
}

/// Says stop after so many shots of the third level.
struct Impatient {
    levels: usize,
    shots: u32,
}

impl Observer for Impatient {
    fn step(&mut self, _: &StepReport) -> Control {
        if self.levels < 2 {
            return Control::Continue;
        }
        self.shots += 1;
        if self.shots > 5 { Control::Stop } else { Control::Continue }
    }

    fn level(&mut self, _: &LevelReport) {
        self.levels += 1;
    }
}

#[test]
fn a_level_cut_short_gives_way_to_the_one_before() {
    let scene = shadows();
    let mut observer = Impatient { levels: 0, shots: 0 };
    let refined = watched(&scene, Asked::Error(1e-4), 1 << 20, &[], &mut observer);
    assert_eq!(refined.reached, Reached::Stopped);
    // The second level: after five shots the third is mostly dark.
    assert_eq!(refined.mesh.elements().len(), 400);
    assert!(refined.statement.unwrap().triangles.e1.total().is_finite());
}

#[test]
fn what_is_not_asked_for_is_left_out() {
    let scene = shadows();
    assert!(run(&scene, Asked::Unstated(500), 1 << 20, &[]).statement.is_none());
    // One mesh, too coarse for another below it, says nothing of its own error.
    let one = run(&scene, Asked::Elements(16), 1 << 20, &[]).statement.unwrap();
    assert!(one.triangles.e1.mesh.is_infinite() && one.triangles.e1.iteration < 1e-3);
    // No light: nothing to be wrong about.
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    model.cube([wall; 6]);
    let dark = run(&model.scene(), Asked::Error(0.01), 1 << 20, &[]);
    assert_eq!((dark.reached, dark.reason), (Reached::Shooting, StopReason::NoLight));
}

#[test]
fn a_probe_is_a_place_and_not_an_element() {
    let (scene, _) = plates(0.7);
    // The middle of the lower plate's diagonal sees a unit square at distance 1 from below its
    // middle: four times the form factor of a corner (Howell, B-3), 0.239456.
    let place = |uv| Probe::Surface { triangle: TriangleId(2), uv, area: None };
    let probes = [place([0.5, 0.0]), place([0.0, 0.0]), place([1.0 / 3.0; 2])];
    let refined = run(&scene, Asked::Elements(64), 1 << 20, &probes);
    let lit_by = |f: f64| 0.7 * f * 1.0;
    // Light that went to and fro adds ρ²F² or so, 2 %, of which the coarse mesh knows.
    let [edge, corner, _] = [0, 1, 2].map(|i| refined.probes[i][0]);
    assert!(edge > corner, "the middle of an edge sees more than a corner");
    // A corner sees the square's corner opposite: B-3 with a = b = c, 0.138532.
    let more = corner / lit_by(0.138_531_605_994_893) - 1.0;
    assert!((0.0..0.04).contains(&more), "{more}");
}

#[test]
fn a_probe_with_an_area_is_the_mean_over_it() {
    let (scene, _) = plates(0.7);
    let whole = Probe::Surface { triangle: TriangleId(2), uv: [1.0 / 3.0; 2], area: Some(0.5) };
    let refined = run(&scene, Asked::Elements(256), 1 << 20, &[whole]);
    let mean = refined.solution.triangle_exitance(&scene)[2];
    // 64 samples of light that is linear in each of 64 elements.
    assert!((refined.probes[0][0] / mean[0] - 1.0).abs() < 1e-3);
    assert_ne!(mean, Rgb::ZERO);
}
