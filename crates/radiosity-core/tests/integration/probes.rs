//! Irradiance at places: on surfaces that reflect nothing, and in the open, against closed forms.

use std::f64::consts::TAU;

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use radiosity_core::{
    Asked, Needs, Probe, RefineConfig, Refined, Sequential, ShootingConfig, refine,
};
use scene::{Rgb, Scene, TriangleId};

use crate::models::{Model, until};

/// Between directly opposed unit squares at distance 1 (Howell, catalogue, C-11).
const OPPOSED: f64 = 0.199_824_895_698_387;

/// What one form factor may be off by, as `ShootingConfig::tolerance` has it.
const TOLERANCE: f64 = 1e-2;

/// The form factor from a point to a parallel rectangle a × b at distance c that has a corner above the
/// point (Howell, catalogue, B-3).
fn parallel(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / c, b / c);
    let (x2, y2) = ((1.0 + x * x).sqrt(), (1.0 + y * y).sqrt());
    (x / x2 * (y / x2).atan() + y / y2 * (x / y2).atan()) / TAU
}

/// From a point that looks along the sides of length a, at distance c from the plane (Howell, B-4).
fn perpendicular(a: f64, b: f64, c: f64) -> f64 {
    let (x, y) = (a / b, c / b);
    let root = x.hypot(y);
    ((1.0 / y).atan() - y / root * (1.0 / root).atan()) / TAU
}

/// A black lamp above a floor of some reflectance, both unit squares, one apart.
fn lamp_over(floor: f64) -> Scene {
    let mut model = Model::new();
    let (lamp, floor) = (model.surface(0.0, 1.0), model.surface(floor, 0.0));
    model.quad([[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]], lamp);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], floor);
    model.scene()
}

fn lit(scene: &Scene, needs: Needs, probes: &[Probe]) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let refining = RefineConfig::until(Asked::Elements(1024));
    let config = ShootingConfig { needs, ..until(1e-6) };
    refine(scene, &bvh, &bvh, &Sequential, config, refining, probes, &mut ())
}

fn free(position: [f64; 3], normal: DVec3) -> Probe {
    Probe::Free { position: position.into(), normal }
}

/// That the red irradiance is as expected, and the green one half of it, as the lamp's light is.
fn assert_near(irradiance: Rgb, expected: f64) {
    let [r, g, b] = irradiance.0;
    assert!((r - expected).abs() <= TOLERANCE * expected, "{r}, expected {expected}");
    assert!((g - r / 2.0).abs() <= 1e-12 * r && b == 0.0, "{irradiance:?}");
}

#[test]
fn a_black_floor_knows_what_arrives_whatever_is_left_out() {
    let scene = lamp_over(0.0);
    let at = |area| Probe::Surface { triangle: TriangleId(2), uv: [0.0, 0.5], area };
    for black in [true, false] {
        let needs = Needs { black, ..Needs::EVERYTHING };
        // The middle of the diagonal, and all of one of two equal halves.
        let refined = lit(&scene, needs, &[at(None), at(Some(0.5))]);
        assert_near(refined.probe_irradiance[0], 4.0 * parallel(0.5, 0.5, 1.0));
        assert_near(refined.probe_irradiance[1], OPPOSED);
        assert_eq!(refined.probes, [Rgb::ZERO; 2], "nothing leaves it");
        // A bound on what black places receive, though no exitance is wrong there.
        assert!(refined.statement.unwrap().probes.unwrap().e1.total() > 0.0);
    }
}

#[test]
fn a_surface_reflects_its_share_of_what_arrives() {
    let scene = lamp_over(0.3);
    let at = |area| Probe::Surface { triangle: TriangleId(3), uv: [0.3, 0.3], area };
    let refined = lit(&scene, Needs::EVERYTHING, &[at(None), at(Some(0.01))]);
    for (leaves, arrives) in refined.probes.iter().zip(&refined.probe_irradiance) {
        assert!(arrives[0] > 0.1 && *leaves == *arrives * 0.3, "{leaves:?} {arrives:?}");
    }
}

#[test]
fn a_place_in_the_open_sees_the_lamp_as_the_closed_forms_do() {
    let probes = [
        free([0.3, 0.6, 0.4], DVec3::Z),
        free([0.25, 0.5, 0.5], DVec3::X),
        free([0.5, 0.5, 0.5], DVec3::NEG_Z),
        // Above the lamp, and on the floor itself.
        free([0.5, 0.5, 1.5], DVec3::Z),
        free([0.5, 0.5, 0.0], DVec3::Z),
    ];
    let refined = lit(&lamp_over(0.0), Needs::EVERYTHING, &probes);
    let corners = [(0.3, 0.6), (0.7, 0.6), (0.3, 0.4), (0.7, 0.4)];
    let up = corners.into_iter().map(|(a, b)| parallel(a, b, 0.6)).sum();
    let aside = 2.0 * perpendicular(0.75, 0.5, 0.5);
    let on_the_floor = 4.0 * parallel(0.5, 0.5, 1.0);
    for (got, expected) in refined.probe_irradiance.iter().zip([up, aside, 0.0, 0.0, on_the_floor])
    {
        println!("expected {expected:.6}, got {:.6}", got[0]);
        assert_near(*got, expected);
    }
    assert_eq!(refined.probes, [Rgb::ZERO; 5]);
}

#[test]
fn a_place_in_the_open_is_shaded_and_lit_by_what_reflects() {
    let board = |reflectance| {
        let mut model = Model::new();
        let (lamp, board) = (model.surface(0.0, 1.0), model.surface(reflectance, 0.0));
        model.quad([[0., 0., 1.], [0., 1., 1.], [1., 1., 1.], [1., 0., 1.]], lamp);
        model.quad([[-9., -9., 0.5], [9., -9., 0.5], [9., 9., 0.5], [-9., 9., 0.5]], board);
        let probes = [free([0.5, 0.5, 0.2], DVec3::Z), free([0.5, 0.5, 0.75], DVec3::NEG_Z)];
        // As if a plan had found that nothing blocks: in the open that does not hold.
        let needs = Needs { segments: false, singles: false, ..Needs::EVERYTHING };
        lit(&model.scene(), needs, &probes).probe_irradiance
    };
    let (dark, bright) = (board(0.0), board(0.5));
    assert_eq!([dark[0], bright[0]], [Rgb::ZERO; 2], "the board blocks the lamp");
    assert_eq!(dark[1], Rgb::ZERO);
    // Twice the reflectance reflects twice as much: all of it is of the first bounce. Both are form
    // factors of their own.
    assert!(bright[1][0] > 0.01);
    assert!((bright[1][0] / board(0.25)[1][0] / 2.0 - 1.0).abs() < 2.0 * TOLERANCE);
}
