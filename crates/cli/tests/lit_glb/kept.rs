//! What was in the document is in the lit one.

use serde_json::{Value, json};

use crate::file::{Glb, index};
use crate::model;

fn lit() -> (tempfile::TempDir, Value, Glb) {
    let folder = tempfile::tempdir().unwrap();
    let scene = model::write(folder.path());
    let original = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
    let [glb, _] = model::solve(&scene, folder.path(), &["--elements", "300"]);
    let glb = Glb::read(&glb);
    (folder, original, glb)
}

fn names(root: &Value, list: &str) -> Vec<Value> {
    root[list].as_array().unwrap().iter().map(|entry| entry["name"].clone()).collect()
}

#[test]
fn nodes_names_animations_and_the_rest_of_the_document_stay() {
    let (_folder, original, lit) = lit();
    for list in ["scenes", "cameras", "textures", "samplers", "skins", "animations", "extensions"] {
        assert_eq!(lit.json[list], original[list], "{list}");
    }
    assert_eq!(lit.json["scene"], 0);
    assert_eq!(lit.json["asset"]["copyright"], "nobody");
    assert_eq!(lit.json["asset"]["extras"]["kept"], true);
    assert_eq!(names(&lit.json, "nodes"), names(&original, "nodes"));
    let nodes = |root: &Value| root["nodes"].as_array().unwrap().clone();
    for (mut mine, mut theirs) in nodes(&lit.json).into_iter().zip(nodes(&original)) {
        for node in [&mut mine, &mut theirs] {
            node.as_object_mut().unwrap().remove("mesh");
        }
        assert_eq!(mine, theirs);
    }
    // Those of the animation and the skin keep their numbers, so their values are those of the file.
    let rest = index(&lit.json["skins"][0]["inverseBindMatrices"]);
    assert_eq!(lit.entries(&json!(rest))[0][..6], [1.0, 0.0, 0.0, 0.0, 0.0, 1.0]);
    let moves = &lit.json["animations"][0]["samplers"][0]["output"];
    assert_eq!(lit.entries(moves), [[0.0, 1.0, 0.0], [0.0, 2.0, 0.0]]);
}

#[test]
fn materials_keep_their_names_and_what_they_were() {
    let (_folder, original, lit) = lit();
    let materials = lit.json["materials"].as_array().unwrap();
    // "red" is used by lines and by another scene, which stay as they were; "puppet" has none.
    let red = materials.iter().filter(|m| m["name"] == "red").count();
    assert_eq!((materials.len(), red), (6, 2));
    for (mine, theirs) in materials.iter().zip(original["materials"].as_array().unwrap()) {
        assert_eq!(mine["name"], theirs["name"]);
        if theirs["name"] == "red" {
            assert_eq!(mine, theirs);
            continue;
        }
        assert_eq!(mine["extras"]["radiosity"]["original"], *theirs);
        assert_eq!(mine["extensions"], json!({ "KHR_materials_unlit": {} }));
    }
    let checker = &materials[0]["pbrMetallicRoughness"];
    assert_eq!(checker["baseColorTexture"], json!({ "index": 0 }));
    let image = &lit.json["images"][0];
    assert_eq!((&image["name"], &image["mimeType"]), (&json!("checker"), &json!("image/png")));
    assert_eq!(image.get("uri"), None);
    assert_eq!(lit.view(index(&image["bufferView"])), include_bytes!("checker.png"));
    assert_eq!(lit.json["extensionsUsed"], json!(["KHR_lights_punctual", "KHR_materials_unlit"]));
}

#[test]
fn instances_part_only_where_their_light_differs() {
    let (_folder, original, lit) = lit();
    let mesh = |node: &str| index(&lit.node(node)["mesh"]);
    // Nothing shines on these two, so their light is the same.
    assert_eq!((mesh("dark one"), mesh("dark two")), (3, 3));
    // This one is in a scene that was not lit, and so is the mesh that it shows.
    assert_eq!(mesh("elsewhere"), 2);
    assert_eq!(lit.json["meshes"][2], original["meshes"][2]);
    let apart = [mesh("near"), mesh("mirror")];
    assert_eq!(apart, [7, 8]);
    for part in apart {
        let mesh = &lit.json["meshes"][part];
        assert_eq!((&mesh["name"], &mesh["extras"]), (&json!("plate"), &json!({ "kept": 1 })));
        // The lines stay beside the lit faces.
        assert_eq!(mesh["primitives"][1], original["meshes"][2]["primitives"][1]);
    }
}

#[test]
fn what_vertices_carry_is_interpolated() {
    let (_folder, _, lit) = lit();
    let floor = &lit.primitives("floor")[0];
    let positions = lit.attribute(floor, "POSITION");
    assert!(positions.len() > 20, "{}", positions.len());
    let (uv, normals) = (lit.attribute(floor, "TEXCOORD_0"), lit.attribute(floor, "NORMAL"));
    let ids = lit.attribute(floor, "_ID");
    for (vertex, place) in positions.iter().enumerate() {
        // In this square u = x and v = z.
        let off = (uv[vertex][0] - place[0]).abs().max((uv[vertex][1] - place[2]).abs());
        assert!(off < 1e-6, "{place:?} {:?}", uv[vertex]);
        assert_eq!(normals[vertex], [0.0, 1.0, 0.0]);
        assert!([0.0, 1.0, 2.0, 3.0].contains(&ids[vertex][0]));
    }
    // The corners of the mesh have the numbers that they had.
    let at = |x: f64, z: f64| positions.iter().position(|p| *p == [x, 0.0, z]).unwrap();
    let corners = [(0.0, 0.0), (0.0, 1.0), (1.0, 1.0), (1.0, 0.0)].map(|(x, z)| at(x, z));
    assert_eq!(corners.map(|corner| ids[corner][0]), [0.0, 1.0, 2.0, 3.0]);

    let rising = &lit.primitives("rising")[0];
    let moved = lit.entries(&rising["targets"][0]["POSITION"]);
    for (place, moved) in lit.attribute(rising, "POSITION").iter().zip(moved) {
        // Linear on each of the two triangles: corners 0, 1, 2, 3 rise by 1, 0, 1/2, 0.
        let (x, z) = (place[0], place[2]);
        let expected = if x <= z { 1.0 - z + 0.5 * x } else { 1.0 - x + 0.5 * z };
        assert!((moved[1] - expected).abs() < 1e-6, "{place:?} {moved:?}");
    }

    let puppet = &lit.primitives("puppet")[0];
    assert_eq!(lit.attribute(puppet, "JOINTS_0").len(), 4);
    assert_eq!(lit.attribute(puppet, "POSITION").len(), 4);
    assert_eq!(lit.faces(puppet).len(), 2);
    let sheet = &lit.primitives("sheet")[0];
    let faded: Vec<f64> = lit.attribute(sheet, "COLOR_1").iter().map(|c| c[2]).collect();
    assert_eq!(faded.iter().copied().fold(1.0, f64::min), f64::from(64.0_f32 / 255.0));
}

#[test]
fn what_could_not_be_written_at_the_end_is_refused_at_the_start() {
    let folder = tempfile::tempdir().unwrap();
    let scene = model::write(folder.path());
    let mut document: Value = serde_json::from_slice(&std::fs::read(&scene).unwrap()).unwrap();
    // Nothing that a scene needs: only the light's way back does.
    let numbers = index(&document["meshes"][0]["primitives"][0]["attributes"]["_ID"]);
    document["accessors"][numbers]["count"] = json!(4000);
    std::fs::write(&scene, document.to_string()).unwrap();
    let run = |output: &str| {
        std::process::Command::new(env!("CARGO_BIN_EXE_radiosity"))
            .current_dir(folder.path())
            .args(["solve", "studio.gltf", "--elements", "100", "-o", output])
            .output()
            .unwrap()
    };
    let refused = run("lit.glb");
    let said = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(1), "{said}");
    let expected = format!(
        "studio.gltf: the scene's glTF document: accessors[{numbers}]: expected entries that lie \
         within their buffer"
    );
    assert!(said.contains(&expected), "{said}");
    assert!(!said.contains("shots"), "{said}");
    assert!(!folder.path().join("lit.glb").exists());
    assert_eq!(run("lit.csv").status.code(), Some(0));
}
