//! A scene has no axes: turned, it has the same light.

use conformance::{Case, Engine, solve};
use glam::{DQuat, DVec3};
use radiosity_core::ShootingConfig;
use scene::{Scene, SceneBuilder};

/// Rounding breaks ties between edges of equal length in another way, so the mesh is another
/// one of the same fineness: each triangle's mean moves by less than its own error, 1 %.
const SAME_FINENESS: f64 = 1e-2;

fn turned(scene: &Scene, turn: DQuat) -> Scene {
    let mut builder = SceneBuilder::new();
    let groups: Vec<_> = scene.groups().iter().map(|name| builder.group(name)).collect();
    let materials: Vec<_> =
        scene.materials().iter().map(|m| builder.material(m.clone()).unwrap()).collect();
    for t in scene.triangles() {
        let corners = t.vertices.map(|v| builder.vertex(turn * scene.vertices()[v.index()]));
        builder.triangle(corners, materials[t.material.index()], groups[t.group.index()]).unwrap();
    }
    builder.finish()
}

#[test]
fn a_turned_scene_has_the_same_light() {
    let axis = DVec3::new(1.0, 2.0, 3.0).normalize();
    for id in ["two_plates_half", "general_furnace_furnished", "white_furnace_cube_half"] {
        let case = Case::load(id).unwrap();
        let scene = case.scene().unwrap();
        for angle in [0.3, 1.0, 2.5] {
            let turned = turned(&scene, DQuat::from_axis_angle(axis, angle));
            let config = ShootingConfig::until(case.unshot);
            let light = [&scene, &turned].map(|s| {
                let solved = solve(s, case.elements, config, Engine::FIRST).unwrap();
                solved.solution.triangle_exitance(s)
            });
            let (mut difference, mut total) = (0.0, 0.0);
            for id in scene.ids() {
                let [straight, turned] = [0, 1].map(|i| light[i][id.index()][0]);
                difference += scene.area(id) * (straight - turned).abs();
                total += scene.area(id) * straight;
            }
            let error = difference / total;
            println!("{id} turned by {angle}: {error:.1e}");
            assert!(error < SAME_FINENESS, "{id} turned by {angle}: {error}");
        }
    }
}
