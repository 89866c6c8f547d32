//! Round a lamp that is small beside the elements, the mesh is finer.

use std::f64::consts::PI;

use form_factor::lambert;
use glam::{DVec3, dvec3};
use radiosity_core::{Mesh, MeshConfig};
use scene::Scene;

use crate::models::{Model, solve_mesh, until};

/// Side of the lamp, and its height above a floor of side 1.
const SIDE: f64 = 0.01;
const HEIGHT: f64 = 0.005;
const LAMP: [[f64; 3]; 4] =
    [[0.5, 0.5, HEIGHT], [0.5, 0.51, HEIGHT], [0.51, 0.51, HEIGHT], [0.51, 0.5, HEIGHT]];

/// The floor's reflectance, and the lamp's: so low that light which the lamp sends back does not
/// count.
const FLOOR: f64 = 0.5;
const MIRROR: f64 = 1e-6;

fn lamp_above_a_floor() -> Scene {
    let mut model = Model::new();
    let lamp = model.surface(MIRROR, 1.0);
    let floor = model.surface(FLOOR, 0.0);
    model.quad(LAMP, lamp);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], floor);
    model.scene()
}

/// What comes back to the lamp, over what it emits: ρ ∫F² dA over the lamp's area, with F the
/// form factor of the lamp at a place of the floor (Lambert 1760), by the midpoint rule.
fn returned() -> f64 {
    const STEPS: usize = 400;
    // F falls with the fourth power of the distance: beyond ten lamps nothing counts.
    const REACH: f64 = 0.1;
    let [a, b, c, d] = LAMP.map(DVec3::from_array);
    let step = 2.0 * REACH / STEPS as f64;
    let at = |i: usize| 0.5 * (0.5 + 0.51) - REACH + (i as f64 + 0.5) * step;
    let mut sum = 0.0;
    for (i, j) in (0..STEPS).flat_map(|i| (0..STEPS).map(move |j| (i, j))) {
        let place = dvec3(at(i), at(j), 0.0);
        let form_factor: f64 = [[a, b, c], [a, c, d]]
            .map(|half| lambert(place, DVec3::Z, half).form_factor)
            .into_iter()
            .sum();
        sum += form_factor * form_factor;
    }
    FLOOR * sum * step * step / (SIDE * SIDE)
}

#[test]
fn a_spot_sends_its_light_back_to_the_lamp() {
    // As wide as it is high doubled: between two plates and a point near a plane.
    let expected = returned();
    assert!((0.05..0.5).contains(&expected), "{expected}");
    let scene = lamp_above_a_floor();
    let error = |config: MeshConfig| {
        let mesh = Mesh::from_scene(&scene, &config);
        let exitance = solve_mesh(&scene, &mesh, until(1e-6)).solution.triangle_exitance(&scene);
        let found = ((exitance[0][0] + exitance[1][0]) / 2.0 - 1.0) / MIRROR;
        found / expected - 1.0
    };
    for elements in [1000, 4000] {
        let graded = MeshConfig::with_elements(elements);
        let even = MeshConfig { graded: false, ..graded };
        let (graded, even) = (error(graded), error(even));
        println!("{elements}: off by {graded:.3}, by {even:.3} with elements of one size");
        assert!(graded.abs() < 0.03 && even < -0.2, "{elements}: {graded} {even}");
    }
}

#[test]
fn elements_are_as_small_as_the_spot_and_no_smaller_far_away() {
    let mesh = Mesh::from_scene(&lamp_above_a_floor(), &MeshConfig::with_elements(2000));
    let longest = |at: DVec3| {
        mesh.elements()
            .iter()
            .map(|e| e.vertices.map(|v| mesh.vertices()[v.index()]))
            .filter(|p| ((p[0] + p[1] + p[2]) / 3.0).distance(at) < longest_edge(*p))
            .map(longest_edge)
            .fold(0.0, f64::max)
    };
    assert!(longest(dvec3(0.505, 0.505, 0.0)) <= 4.0 * HEIGHT);
    assert!(longest(dvec3(0.9, 0.1, 0.0)) > 4.0 * SIDE);
}

fn longest_edge([a, b, c]: [DVec3; 3]) -> f64 {
    a.distance(b).max(b.distance(c)).max(c.distance(a))
}

#[test]
fn grading_keeps_angles_and_leaves_no_t_vertex() {
    let mesh = Mesh::from_scene(&lamp_above_a_floor(), &MeshConfig::with_elements(3000));
    let mut edges = std::collections::HashMap::new();
    for e in mesh.elements() {
        let p = e.vertices.map(|v| mesh.vertices()[v.index()]);
        for k in 0..3 {
            let angle = (p[(k + 1) % 3] - p[k]).angle_between(p[(k + 2) % 3] - p[k]);
            // Rosenberg & Stenger 1975: half of 45°.
            assert!(angle > PI / 8.0 * (1.0 - 1e-9), "{angle}");
            let (a, b) = (e.vertices[k], e.vertices[(k + 1) % 3]);
            *edges.entry((a.min(b), a.max(b))).or_insert(0) += 1;
        }
    }
    // An edge that one element alone has lies on the rim of the lamp or of the floor.
    let on_rim = |v: scene::VertexId| {
        let p = mesh.vertices()[v.index()];
        p.z > 0.0 || [p.x, p.y].iter().any(|x| *x == 0.0 || *x == 1.0)
    };
    assert!(edges.iter().all(|((a, b), &n)| n == 2 || (n == 1 && on_rim(*a) && on_rim(*b))));
}

#[test]
fn a_finer_mesh_splits_the_elements_of_a_coarser_one() {
    // What the statement compares place by place: every vertex stays.
    let scene = lamp_above_a_floor();
    let [coarse, fine] =
        [700, 2800].map(|n| Mesh::from_scene(&scene, &MeshConfig::with_elements(n)));
    assert_eq!(coarse.vertices(), &fine.vertices()[..coarse.vertices().len()]);
}
