//! The automatic camera: where it stands, and that it sees something.

use glam::DVec3;
use output::camera::automatic;
use output::picture::render;
use scene::{Camera, Face, Rgb, Scene, Solution, SolutionElement};

use crate::common::{closed_box, shared};

/// One element per triangle, all equally lit.
fn lit(scene: &Scene) -> Solution {
    let element = |id: scene::TriangleId| SolutionElement {
        vertices: scene.triangles()[id.index()].vertices,
        triangle: id,
        face: Face::Front,
        exitance: Rgb::splat(1.0),
        corner_exitance: [Rgb::splat(1.0); 3],
    };
    Solution { vertices: scene.vertices().to_vec(), elements: scene.ids().map(element).collect() }
}

/// The share of the picture that shows a surface.
fn filled(scene: &Scene, camera: &Camera) -> f64 {
    let picture = render(scene, &lit(scene), camera, (80, 60), 1).unwrap();
    let shown = picture.pixels().iter().filter(|p| p.surface.share + p.lamp.share > 0.0);
    shown.count() as f64 / picture.pixels().len() as f64
}

const SIZE: DVec3 = DVec3::new(5.0, 3.0, 4.0);

#[test]
fn a_room_is_seen_from_within_its_walls() {
    let scene = closed_box(DVec3::ZERO, SIZE, true, Some(DVec3::NEG_Y));
    let camera = automatic(&scene);
    assert_eq!((camera.name.as_str(), camera.up), ("automatic, room", DVec3::Y));
    assert!(filled(&scene, &camera) > 0.9);
    // 70° across a 4:3 picture.
    let across = 2.0 * ((camera.vertical_fov / 2.0).tan() * 4.0 / 3.0).atan();
    assert!((65.0..75.0).contains(&across.to_degrees()));
}

#[test]
fn an_object_is_seen_whole_from_outside() {
    let scene = closed_box(DVec3::ZERO, SIZE, false, None);
    let camera = automatic(&scene);
    assert_eq!(camera.name, "automatic, object");
    assert!((camera.position - 0.5 * SIZE).length() > SIZE.length());
    let share = filled(&scene, &camera);
    assert!((0.15..0.8).contains(&share), "{share}");
    // No corner falls outside the picture.
    let picture = render(&scene, &lit(&scene), &camera, (80, 60), 1).unwrap();
    let edge = |i: &usize| matches!(i % 80, 0 | 79) || matches!(i / 80, 0 | 59);
    let empty = |i: usize| picture.pixels()[i].surface.share == 0.0;
    assert!((0..80 * 60).filter(edge).all(empty));
}

#[test]
fn lamps_and_floors_say_which_way_is_up() {
    for (down, up) in [(DVec3::NEG_Z, DVec3::Z), (DVec3::NEG_Y, DVec3::Y)] {
        // A cube: every axis has the same area, so that the lamp alone decides.
        let scene = closed_box(DVec3::ZERO, DVec3::splat(4.0), true, Some(down));
        assert_eq!(automatic(&scene).up, up);
    }
    // No lamp: the floor of a flat box is its largest upward side.
    let flat = closed_box(DVec3::ZERO, DVec3::new(5.0, 4.0, 1.0), true, None);
    assert_eq!(automatic(&flat).up, DVec3::Z);
    let even = closed_box(DVec3::ZERO, DVec3::splat(1.0), true, None);
    assert_eq!(automatic(&even).up, DVec3::Y);
}

#[test]
fn the_choice_moves_with_the_scene() {
    let offset = DVec3::new(1e6, -2e6, 3e6);
    let here = automatic(&closed_box(DVec3::ZERO, SIZE, true, Some(DVec3::NEG_Y)));
    let there = automatic(&closed_box(offset, SIZE + offset, true, Some(DVec3::NEG_Y)));
    // The f64 spacing at 3e6 is 5e-10.
    assert!((there.position - offset - here.position).length() < 1e-8);
    assert!((there.target - offset - here.target).length() < 1e-8);
}

#[test]
fn nothing_and_a_point_still_have_a_camera() {
    let nowhere = closed_box(DVec3::ONE, DVec3::ONE, true, None);
    for scene in [Scene::default(), nowhere] {
        let camera = automatic(&scene);
        assert!(camera.position.is_finite() && camera.position != camera.target);
        assert_eq!(filled(&scene, &camera), 0.0);
    }
}

#[test]
fn the_models_are_seen_from_inside() {
    for name in ["room", "blocks", "box", "church"] {
        let Some(path) = shared(&format!("scenes/{name}.tri")) else { return };
        let mut builder = scene::SceneBuilder::new();
        let group = builder.group(name);
        let material = scene::Material {
            name: "grey".into(),
            reflectance: Rgb::splat(0.5),
            emittance: Rgb::ZERO,
            sides: scene::Sides::Front,
        };
        let grey = builder.material(material).unwrap();
        for record in
            tri_io::Reader::new(std::io::BufReader::new(std::fs::File::open(path).unwrap()))
        {
            let corners = record.unwrap().vertices.map(|p| builder.vertex(DVec3::from_array(p)));
            builder.triangle(corners, grey, group).unwrap();
        }
        let scene = builder.finish();
        let camera = automatic(&scene);
        assert_eq!(camera.name, "automatic, room");
        // Blocks has no ceiling and church has windows.
        assert!(filled(&scene, &camera) > 0.7, "{name}: {camera:?}");
    }
}
