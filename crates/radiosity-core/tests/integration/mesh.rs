//! What every mesh promises: area, winding, shape, no T-vertices, shared points.

use std::collections::HashMap;

use glam::DVec3;
use radiosity_core::{Mesh, MeshConfig};
use scene::{Scene, Sides};

use crate::models::Model;

fn mesh(scene: &Scene, elements: usize) -> Mesh {
    Mesh::from_scene(scene, &MeshConfig::with_elements(elements))
}

fn cube() -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    model.cube([wall; 6]);
    model.scene()
}

#[test]
fn splitting_keeps_area_and_winding() {
    let mesh = mesh(&cube(), 1000);
    let area: f64 = mesh.elements().iter().map(|e| e.area).sum();
    assert!((area - 6.0).abs() < 1e-12);
    for e in mesh.elements() {
        let [a, b, c] = e.vertices.map(|v| mesh.vertices()[v.index()]);
        assert!((b - a).cross(c - a).dot(mesh.root_of(e).normal) > 0.0);
    }
}

#[test]
fn a_closed_surface_stays_closed() {
    // Each directed edge of a conforming closed mesh has its opposite exactly once.
    let mesh = mesh(&cube(), 777);
    let mut edges: HashMap<(u32, u32), i32> = HashMap::new();
    for e in mesh.elements() {
        for k in 0..3 {
            let (a, b) = (e.vertices[k].0, e.vertices[(k + 1) % 3].0);
            *edges.entry((a.min(b), a.max(b))).or_default() += if a < b { 1 } else { -1 };
        }
    }
    assert!(edges.values().all(|&sum| sum == 0));
}

#[test]
fn the_smallest_angle_stays_at_least_half() {
    // Rosenberg & Stenger 1975.
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    model.triangle([[0., 0., 0.], [5., 0., 0.], [1.0, 0.7, 0.]], wall);
    let scene = model.scene();
    let least = |mesh: &Mesh| {
        mesh.elements()
            .iter()
            .flat_map(|e| {
                let p = e.vertices.map(|v| mesh.vertices()[v.index()]);
                [0, 1, 2].map(|k| (p[(k + 1) % 3] - p[k]).angle_between(p[(k + 2) % 3] - p[k]))
            })
            .fold(f64::INFINITY, f64::min)
    };
    let before = least(&mesh(&scene, 1));
    assert!(least(&mesh(&scene, 500)) >= before / 2.0 * (1.0 - 1e-9));
}

#[test]
fn coplanar_neighbours_share_points_and_creases_do_not() {
    // A unit square of two triangles: 4 points. A cube: 4 per face.
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], wall);
    assert_eq!(mesh(&model.scene(), 2).points().len(), 4);
    assert_eq!(mesh(&cube(), 12).points().len(), 24);
}

#[test]
fn a_wall_on_a_floor_parts_the_floors_points() {
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], m);
    model.quad([[1., 0., 0.], [2., 0., 0.], [2., 1., 0.], [1., 1., 0.]], m);
    let floor = mesh(&model.scene(), 4);
    assert_eq!(floor.points().len(), 6);

    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], m);
    model.quad([[1., 0., 0.], [2., 0., 0.], [2., 1., 0.], [1., 1., 0.]], m);
    model.quad([[1., 0., 0.], [1., 1., 0.], [1., 1., 1.], [1., 0., 1.]], m);
    let parted = mesh(&model.scene(), 6);
    // 4 on each side of the wall, and the wall's own 4.
    assert_eq!(parted.points().len(), 12);
    let sides = parted.points().iter().filter(|p| (p.position.x - 1.0).abs() < 0.1);
    assert!(sides.filter(|p| p.normal == DVec3::Z).all(|p| p.position.x != 1.0));
}

#[test]
fn two_sided_surfaces_have_elements_back_to_back() {
    let mut model = Model::new();
    let m = model.sided(0.5, 0.0, Sides::Both);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], m);
    let mesh = mesh(&model.scene(), 64);
    let up = mesh.elements().iter().filter(|e| mesh.root_of(e).normal.z > 0.0).count();
    assert_eq!((up, mesh.elements().len()), (32, 64));
    // Front and back split at the same vertices, but have points of their own.
    assert!(mesh.points().iter().filter(|p| p.normal.z > 0.0).count() * 2 == mesh.points().len());
}

#[test]
fn patches_cover_all_elements_in_order() {
    let config = MeshConfig { patch_elements: 10, ..MeshConfig::with_elements(1000) };
    let mesh = Mesh::from_scene(&cube(), &config);
    let mut next = 0;
    for patch in mesh.patches() {
        assert_eq!(patch.elements.start, next);
        assert!((1..=10).contains(&patch.elements.len()));
        next = patch.elements.end;
    }
    assert_eq!(next as usize, mesh.elements().len());
}
