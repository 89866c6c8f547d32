//! The light in a lit file is read back.

use glam::DVec3;
use scene::{Face, Rgb, Sides};
use scene_import::open_lit;

use crate::file::Glb;
use crate::model;

#[test]
fn the_light_of_the_scenes_own_document_comes_back() {
    let folder = tempfile::tempdir().unwrap();
    let scene = model::write(folder.path());
    let [glb, _] = model::solve(&scene, folder.path(), &["--elements", "300"]);
    let file = Glb::read(&glb);
    let lit = open_lit(&glb).unwrap();
    let scale = &file.json["asset"]["extras"]["radiosity"]["exposureScale"];
    assert_eq!(lit.exposure, scale.as_f64().unwrap());
    let of = |group: &str, face: Face| {
        let in_group = lit.solution.elements.iter().filter(|e| {
            let triangle = &lit.scene.triangles()[e.triangle.index()];
            e.face == face && lit.scene.groups()[triangle.group.index()] == group
        });
        in_group.collect::<Vec<_>>()
    };
    for node in ["floor", "lamp", "near", "mirror", "sheet", "rising", "puppet"] {
        let primitive = &file.primitives(node)[0];
        let light = file.attribute(primitive, "_RADIOSITY");
        let faces = file.faces(primitive);
        let elements = of(node, Face::Front);
        assert_eq!(elements.len(), faces.len(), "{node}");
        for (element, face) in elements.iter().zip(faces) {
            // A mirrored triangle has its corners in another order.
            let mut expected = face.map(|i| light[i][1]);
            let mut found = element.corner_exitance.map(|light| light.0[1]);
            expected.sort_by(f64::total_cmp);
            found.sort_by(f64::total_cmp);
            assert_eq!(found, expected, "{node}");
        }
    }
    assert_eq!(of("sheet", Face::Back).len(), file.faces(&file.primitives("sheet")[1]).len());
    let red = lit.scene.material_of(of("near", Face::Front)[0].triangle);
    assert_eq!((red.name.as_str(), red.sides), ("red", Sides::Front));
    assert_eq!(red.reflectance.0.map(|c| c as f32), [0.8, 0.2, 0.1]);
}

#[test]
fn the_light_of_a_document_of_our_making_comes_back_wherever_it_lies() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("far.tri");
    let far = DVec3::new(4e6, 1.0, -2e6);
    let corner = |p: DVec3| format!("{} {} {}\n", p.x, p.y, p.z);
    let corners = [far, far + DVec3::X, far + DVec3::Y].map(corner).concat();
    std::fs::write(&path, format!("Triangle\n255 0 0 255 255 255\n{corners}")).unwrap();
    let flags = ["--elements", "4", "--sides", "both"];
    let [glb, _] = model::solve(&path, folder.path(), &flags);
    let lit = open_lit(&glb).unwrap();
    let [front, back] = [Face::Front, Face::Back]
        .map(|face| lit.solution.elements.iter().filter(|e| e.face == face).count());
    assert!(front > 0 && front == back, "{front} {back}");
    for element in &lit.solution.elements {
        // Emittance of a .tri lamp: 100 times the back, whose largest channel is 255.
        assert_eq!(element.exitance, Rgb::splat(25_500.0));
        for place in lit.solution.corners(element) {
            // Single precision of a triangle of side 1.
            assert!((place - far).clamp(DVec3::ZERO, DVec3::ONE).distance(place - far) < 1e-6);
        }
    }
    let cut = std::fs::read(&glb).unwrap();
    for end in 0..cut.len() {
        std::fs::write(&glb, &cut[..end]).unwrap();
        assert!(open_lit(&glb).is_err(), "{end}");
    }
    for at in 0..cut.len() {
        for other in [0, 0xff, b'9', b'"'] {
            let mut broken = cut.clone();
            broken[at] = other;
            std::fs::write(&glb, &broken).unwrap();
            // There is an answer, whatever it is.
            let _ = open_lit(&glb);
        }
    }
}

#[test]
fn what_was_not_lit_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let scene = model::write(folder.path());
    let message = open_lit(&scene).unwrap_err().to_string();
    assert!(message.starts_with("studio.gltf: asset.extras.radiosity.exposureScale"), "{message}");
    let [glb, _] = model::solve(&scene, folder.path(), &["--elements", "100"]);
    let mut bytes = std::fs::read(&glb).unwrap();
    while let Some(at) = bytes.windows(10).position(|w| w == b"_RADIOSITY") {
        bytes[at..at + 10].copy_from_slice(b"_SOMETHING");
    }
    std::fs::write(&glb, bytes).unwrap();
    let message = open_lit(&glb).unwrap_err().to_string();
    let expected = "lit.glb: no mesh has _RADIOSITY: expected a .glb that `radiosity solve` wrote";
    assert_eq!(message, expected);
}
