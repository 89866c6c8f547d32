//! The document beside the scene, and one that this project has lit.

use scene::TriangleId;
use scene_import::{Options, open_bytes};
use serde_json::Value;

use crate::glb::{Glb, TRIANGLE, pack};
use crate::{import, warnings};

fn keeping() -> Options {
    Options { keep_document: true, ..Options::default() }
}

#[test]
fn shapes_say_which_triangles_came_from_where() {
    let mut glb = Glb::default();
    let square = glb.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]]);
    let file = glb.build(&format!(
        r#""meshes":[{{"primitives":[
            {{"attributes":{{"POSITION":{square}}},"mode":1}},
            {{"attributes":{{"POSITION":{square}}},"mode":5}}]}}],
        "nodes":[{{"name":"empty"}},{{"mesh":0}},{{"mesh":0,"scale":[1,1,-1]}}]"#
    ));
    assert_eq!(import("a.glb", &file).document, None);
    let imported = open_bytes("a.glb", &file, &keeping()).expect("the test's file is sound");
    let document = imported.document.expect("it was asked for");
    let shapes = &document.shapes;
    let which: Vec<_> = shapes.iter().map(|s| (s.node, s.mesh, s.primitive, s.first)).collect();
    assert_eq!(which, [(1, 0, 1, TriangleId(0)), (2, 0, 1, TriangleId(2))]);
    assert_eq!([shapes[0].mirrored, shapes[1].mirrored], [false, true]);
    // A strip: every other triangle runs the other way round.
    assert_eq!(*shapes[0].corners, [[0, 1, 2], [1, 3, 2]]);
    assert_eq!(document.buffers, [glb.bin().into()]);
    let json: Value = serde_json::from_str(&document.json).expect("the JSON of the file");
    assert_eq!(json["nodes"][0]["name"], "empty");
}

#[test]
fn images_come_along_and_a_missing_one_is_named() {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    let json = glb.json(
        r#""images":[{"uri":"here.png"},{"uri":"gone.png"},{"uri":"data:image/png;base64,AAAA"}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]"#,
    );
    let path = folder.path().join("a.glb");
    std::fs::write(folder.path().join("here.png"), b"any bytes").expect("room for a file");
    std::fs::write(&path, pack(&json, glb.bin())).expect("room for a file");
    let imported = scene_import::open(&path, &keeping()).expect("the test's file is sound");
    let said = warnings(&imported);
    assert!(said.iter().any(|w| w.contains("images[1]") && w.contains("gone.png")), "{said:?}");
    let document = imported.document.expect("it was asked for");
    assert_eq!(document.images, [Some(b"any bytes"[..].into()), None, None]);
}

#[test]
fn a_lit_document_is_read_as_it_was() {
    let mut glb = Glb::default();
    let positions = glb.floats(&TRIANGLE);
    let light = glb.floats(&[[9.0_f32; 3]; 3]);
    let colours = glb.floats(&[[0.5_f32; 3]; 3]);
    let lit = |material: usize, ours: &str| {
        format!(
            r#"{{"attributes":{{"POSITION":{positions},"COLOR_0":{light},"COLOR_1":{colours},"_RADIOSITY":{light}}},
            "material":{material},"extras":{{"radiosity":{{"lit":true{ours}}}}}}}"#
        )
    };
    let [front, back, copy, none] =
        [lit(0, ""), lit(0, r#","face":"back""#), lit(1, ""), lit(2, "")];
    let original = r#"{"name":"red","doubleSided":true,"pbrMetallicRoughness":{"baseColorFactor":[0.8,0.2,0.1,1],"metallicFactor":0}}"#;
    let unlit = r#""extensions":{"KHR_materials_unlit":{}},"pbrMetallicRoughness":{"baseColorFactor":[1,1,1,1]}"#;
    let json = glb.json(&format!(
        r#""extensionsUsed":["KHR_materials_unlit"],
        "materials":[
            {{"name":"red",{unlit},"extras":{{"radiosity":{{"original":{original}}}}}}},
            {{"name":"red",{unlit},"extras":{{"radiosity":{{"litFormOf":0}}}}}},
            {{{unlit},"extras":{{"radiosity":{{"litFormOf":null}}}}}}],
        "meshes":[{{"primitives":[{front},{back},{copy},{none}]}}],"nodes":[{{"mesh":0}}]"#
    ));
    let marked = json.replace(
        r#""asset":{"version":"2.0"}"#,
        r#""asset":{"version":"2.0","extras":{"radiosity":{"litDocument":true}}}"#,
    );
    let file = pack(&marked, glb.bin());
    let imported = open_bytes("a.glb", &file, &keeping()).expect("the test's file is sound");
    let scene = &imported.scene;
    // The back is gone; the colours of the file halve what is reflected; no material is a warning.
    assert_eq!(scene.triangles().len(), 3);
    for id in [TriangleId(0), TriangleId(1)] {
        let red = scene.material_of(id);
        assert_eq!((red.name.as_str(), red.sides), ("red", scene::Sides::Both));
        assert!((red.reflectance.0[0] - 0.4).abs() < 1e-7, "{:?}", red.reflectance);
    }
    let said = warnings(&imported);
    let about = ["material is missing", "repeats triangle 0", "repeats triangle 0"];
    assert!(said.len() == 3 && said.iter().zip(about).all(|(w, a)| w.contains(a)), "{said:?}");
    let document = imported.document.expect("it was asked for");
    let json: Value = serde_json::from_str(&document.json).expect("the JSON of the file");
    let original: Value = serde_json::from_str(original).expect("as above");
    assert_eq!(json["materials"], Value::Array(vec![original]));
    assert_eq!(json.get("extensionsUsed"), None);
    assert_eq!(json["asset"], serde_json::json!({ "version": "2.0" }));
    // Where nothing says that it is lit, the file is what it says.
    let imported = import("a.glb", pack(&json_without(&marked), glb.bin()));
    assert_eq!(imported.scene.triangles().len(), 3);
    assert_eq!(imported.scene.material_of(TriangleId(0)).name, "red");
    assert_eq!(imported.scene.material_of(TriangleId(0)).sides, scene::Sides::Front);
}

fn json_without(marked: &str) -> String {
    marked.replace("litDocument", "other")
}
