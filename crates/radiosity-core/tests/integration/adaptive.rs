//! Meshes that grow where they are told to, or where the light asks for it.

use std::collections::HashMap;

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use radiosity_core::{
    Asked, Element, Mesh, MeshConfig, Reached, RefineConfig, Refined, Sequential, Split, refine,
};
use scene::Scene;

use crate::models::{Model, until};

fn cube() -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    model.cube([wall; 6]);
    model.scene()
}

fn corners(mesh: &Mesh, element: &Element) -> [DVec3; 3] {
    element.vertices.map(|v| mesh.vertices()[v.index()])
}

fn middle(mesh: &Mesh, element: &Element) -> DVec3 {
    let [a, b, c] = corners(mesh, element);
    (a + b + c) / 3.0
}

/// Each directed edge of a conforming closed mesh has its opposite exactly once.
fn is_closed(mesh: &Mesh) -> bool {
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for e in mesh.elements() {
        for k in 0..3 {
            let (a, b) = (e.vertices[k].0, e.vertices[(k + 1) % 3].0);
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
        }
    }
    edges.values().all(|&sum| sum == 0)
}

fn least_angle(mesh: &Mesh) -> f64 {
    let of = |e| {
        let p = corners(mesh, e);
        [0, 1, 2].map(|k| (p[(k + 1) % 3] - p[k]).angle_between(p[(k + 2) % 3] - p[k]))
    };
    mesh.elements().iter().flat_map(of).fold(f64::INFINITY, f64::min).to_degrees()
}

/// Densities between 1 and 1,000 without any order in them.
fn wild(mesh: &Mesh) -> Vec<f64> {
    let of = |i: usize| 1000f64.powf((i as f64 * 0.618_033_988_749_895).fract());
    (0..mesh.elements().len()).map(of).collect()
}

#[test]
fn wherever_a_mesh_grows_it_stays_whole() {
    let mut mesh = Mesh::from_scene(&cube(), &MeshConfig::with_elements(50));
    for elements in [300, 1500, 4000] {
        let before = mesh.clone();
        mesh = mesh.refined(&wild(&mesh), &MeshConfig::with_elements(elements));
        assert!(mesh.elements().len() <= elements && mesh.elements().len() > elements * 9 / 10);
        assert!(is_closed(&mesh), "no vertex lies inside a neighbour's edge");
        // Squares' halves are bisected into triangles alike; closure makes no others.
        assert!((least_angle(&mesh) - 45.0).abs() < 1e-9, "{}", least_angle(&mesh));
        let area: f64 = mesh.elements().iter().map(|e| e.area).sum();
        assert!((area - 6.0).abs() < 1e-12);
        assert_eq!(mesh.vertices()[..before.vertices().len()], *before.vertices());
    }
}

#[test]
fn elements_go_where_they_are_deserved() {
    let coarse = Mesh::from_scene(&cube(), &MeshConfig::with_elements(192));
    let on_floor = |mesh: &Mesh, e: &_| middle(mesh, e).z < 1e-9;
    for factor in [1.0, 16.0] {
        let of = |e| if on_floor(&coarse, e) { factor } else { 1.0 };
        let density: Vec<f64> = coarse.elements().iter().map(of).collect();
        let mesh = coarse.refined(&density, &MeshConfig::with_elements(6_000));
        let count = |there: &dyn Fn(f64) -> bool| {
            mesh.elements().iter().filter(|e| there(middle(&mesh, e).z)).count() as f64
        };
        // The ceiling touches no edge of the floor's: no closure reaches it. Elements are halved,
        // so that a face has elements of two sizes on the way from one to the other.
        let found = count(&|z| z < 1e-9) / count(&|z| z > 1.0 - 1e-9);
        assert!((found / factor).log2().abs() < 0.5, "{found} of {factor}");
    }
}

#[test]
fn no_element_is_split_beyond_the_limits() {
    let ask = MeshConfig::with_elements(100_000);
    // Halves of halves of halves: eight of each of twelve triangles, all alike.
    let mesh = Mesh::from_scene(&cube(), &MeshConfig { most_depth: 3, ..ask });
    assert_eq!(mesh.elements().len(), 12 * 8);
    // Triangles of 1/2, 1/4, 1/8: those of 1/8 may no longer be split.
    let mesh = Mesh::from_scene(&cube(), &MeshConfig { least_area: 0.125, ..ask });
    assert_eq!(mesh.elements().len(), 6 * 8);
    let coarse = Mesh::from_scene(&cube(), &MeshConfig::with_elements(12));
    let deep = MeshConfig { most_depth: 4, ..ask };
    let grown = coarse.refined(&wild(&coarse), &deep);
    assert_eq!(grown.elements().len(), 12 * 16, "depth counts from the triangles of the scene");
}

#[test]
fn cuts_at_centroids_leave_edges_and_make_needles() {
    let coarse = Mesh::from_scene(&cube(), &MeshConfig::with_elements(12));
    let config = MeshConfig { split: Split::Centroid, ..MeshConfig::with_elements(12 * 27) };
    let mesh = coarse.refined(&[1.0; 12], &config);
    assert_eq!(mesh.elements().len(), 12 * 27);
    assert!(is_closed(&mesh));
    // Two thirds of a corner's angle at most go to one part; after three cuts there are parts
    // with less than a fifth of 45°.
    assert!(least_angle(&mesh) < 9.0, "{}", least_angle(&mesh));
    let longest = |e| {
        let [a, b, c] = corners(&mesh, e);
        a.distance(b).max(b.distance(c)).max(c.distance(a))
    };
    let diagonals = mesh.elements().iter().filter(|e| longest(e) > 1.41).count();
    assert_eq!(diagonals, 12, "each diagonal still is an edge of two elements");
}

/// A long hall with a lamp above one end of its floor.
fn hall() -> Scene {
    let mut model = Model::new();
    let (wall, lamp) = (model.surface(0.3, 0.0), model.surface(0.0, 40.0));
    let p = |i: usize| [8.0 * (i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64];
    for face in [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    {
        model.quad(face.map(p), wall);
    }
    model.quad([[0.3, 0.3, 0.8], [0.3, 0.7, 0.8], [0.7, 0.7, 0.8], [0.7, 0.3, 0.8]], lamp);
    model.quad([[0.4, 0.3, 0.4], [0.7, 0.3, 0.4], [0.7, 0.6, 0.4], [0.4, 0.6, 0.4]], wall);
    model.scene()
}

fn refined(refining: RefineConfig) -> Refined {
    let scene = hall();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    refine(&scene, &bvh, &bvh, &Sequential, until(1e-2), refining, &[], &mut ())
}

#[test]
fn meshes_follow_the_light() {
    let asked = RefineConfig { most_elements: 4_000, ..RefineConfig::until(Asked::Error(1e-9)) };
    let [adaptive, even] = [Split::LongestEdge, Split::None]
        .map(|split| refined(RefineConfig { split, ..asked }).mesh);
    let share = |mesh: &Mesh, within: &dyn Fn(f64) -> bool| {
        let on_floor = |e: &&Element| middle(mesh, e).z < 1e-9;
        let floor: Vec<_> = mesh.elements().iter().filter(on_floor).collect();
        let there = floor.iter().filter(|e| within(middle(mesh, e).x)).count();
        there as f64 / floor.len() as f64
    };
    let lit = |x: f64| x < 2.0;
    let (follows, plain) = (share(&adaptive, &lit), share(&even, &lit));
    assert!(follows > 1.5 * plain, "{follows} {plain}");
}

#[test]
fn a_mesh_that_may_not_be_split_says_so() {
    let asked = RefineConfig { most_depth: 4, ..RefineConfig::until(Asked::Error(1e-9)) };
    let refined = refined(asked);
    assert_eq!(refined.reached, Reached::SizeLimit);
    assert!(refined.mesh.elements().len() < 32 * 20);
}
