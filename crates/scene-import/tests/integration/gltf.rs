//! glTF: nodes, instances, topologies, accessors, cameras, files beside it.

use std::fs;

use glam::DVec3;
use scene::TriangleId;
use scene_import::{Imported, Options, open};

use crate::glb::{Glb, TRIANGLE, pack};
use crate::{failure, import, warnings};

const MATERIAL: &str = r#""materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0}}]"#;

/// The triangle as mesh 0, with these further members.
fn triangle_with(nodes: &str) -> Vec<u8> {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.build(&format!(
        r#"{MATERIAL},"meshes":[{{"name":"leaf","primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],{nodes}"#
    ))
}

fn corners(imported: &Imported, triangle: u32) -> [[f64; 3]; 3] {
    imported.scene.corners(TriangleId(triangle)).map(|p: DVec3| p.to_array())
}

fn normal(imported: &Imported, triangle: u32) -> DVec3 {
    let [a, b, c] = imported.scene.corners(TriangleId(triangle));
    (b - a).cross(c - a).normalize()
}

fn assert_near(a: DVec3, b: DVec3) {
    assert!(a.distance(b) < 1e-12, "{a} {b}");
}

#[test]
fn instances_are_placed_by_their_nodes_and_mirrors_keep_their_fronts() {
    let file = triangle_with(
        r#""nodes":[{"name":"plain","mesh":0},
        {"translation":[1,2,3],"scale":[2,2,2],"children":[2]},
        {"mesh":0,"rotation":[0,0.70710678,0,0.70710678]},
        {"name":"mirror","mesh":0,"scale":[-1,1,1]},
        {"name":"flipped","mesh":0,"matrix":[1,0,0,0, 0,1,0,0, 0,0,-1,0, 0,0,5,1]}],
        "scenes":[{"nodes":[0,1,3,4]}],"scene":0"#,
    );
    let imported = import("a.glb", file);
    assert_eq!(imported.diagnostics, []);
    assert_eq!(imported.scene.groups(), ["plain", "leaf", "mirror", "flipped"]);
    assert_eq!(corners(&imported, 0), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    // A quarter turn about y takes x to −z; then twice the size, then the shift.
    let [a, b, c] = imported.scene.corners(TriangleId(1));
    assert_near(a, DVec3::new(1.0, 2.0, 3.0));
    assert_near(b, DVec3::new(1.0, 2.0, 1.0));
    assert_near(c, DVec3::new(1.0, 4.0, 3.0));
    assert_near(normal(&imported, 1), DVec3::X);
    // A mirror in the plane of the surface's normal leaves its front where it was, one
    // across it turns the front along.
    assert_near(normal(&imported, 2), DVec3::Z);
    assert_eq!(corners(&imported, 2), [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-1.0, 0.0, 0.0]]);
    assert_near(normal(&imported, 3), DVec3::NEG_Z);
}

#[test]
fn strips_and_fans_wind_alike() {
    // A square in zigzag and in ring order.
    let zigzag = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    let ring = [zigzag[0], zigzag[1], zigzag[3], zigzag[2]];
    for (mode, positions) in [(5, zigzag), (6, ring)] {
        let mut glb = Glb::default();
        glb.floats(&positions);
        let imported = import("a.glb", glb.build(&format!(
            r#"{MATERIAL},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0,"mode":{mode}}}]}}],"nodes":[{{"mesh":0}}]"#
        )));
        assert_eq!(imported.diagnostics, []);
        assert_eq!(imported.scene.triangles().len(), 2);
        assert_eq!(imported.scene.vertices().len(), 4);
        for i in 0..2 {
            assert_near(normal(&imported, i), DVec3::Z);
            assert_eq!(imported.scene.area(TriangleId(i)), 0.5);
        }
        assert_eq!(imported.scene.groups(), ["node 0"]);
    }
}

#[test]
fn indices_name_the_corners_and_leftovers_are_told() {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.indices(&[2, 0, 1, 0]);
    let rest = |extra: &str| {
        format!(
            r#"{MATERIAL},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0{extra}}}]}}],"nodes":[{{"mesh":0}}]"#
        )
    };
    let imported = import("a.glb", glb.build(&rest("")));
    assert_eq!(corners(&imported, 0), [[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]);
    let path = "nodes[0].mesh[0].primitives[0]";
    assert_eq!(
        warnings(&imported),
        [format!("{path}: left out: 1 vertices that make no triangle")]
    );
    let imported = import("a.glb", glb.build(&rest(r#","mode":1"#)));
    assert_eq!(warnings(&imported), [format!("{path}: left out: primitive of Lines")]);
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.indices(&[0, 1, 3]);
    assert_eq!(
        failure("a.glb", glb.build(&rest(""))),
        format!("a.glb: {path}.indices: expected indices below 3, found 3")
    );
}

#[test]
fn sparse_accessors_replace_entries() {
    let mut glb = Glb::default();
    let base = glb.floats(&TRIANGLE);
    assert_eq!(base, 0);
    let at = glb.view(&[1, 0]);
    let to = glb.view(&[2.0_f32, 0.0, 0.0].map(f32::to_le_bytes).concat());
    let bounds = r#""min":[0,0,0],"max":[2,1,0]"#;
    let sparse = format!(
        r#""sparse":{{"count":1,"indices":{{"bufferView":{at},"componentType":5123}},"values":{{"bufferView":{to}}}}}"#
    );
    glb.accessor(&format!(
        r#""bufferView":0,"componentType":5126,"count":3,"type":"VEC3",{bounds},{sparse}"#
    ));
    glb.accessor(&format!(r#""componentType":5126,"count":3,"type":"VEC3",{bounds},{sparse}"#));
    let mesh = |a: usize| {
        format!(r#"{{"primitives":[{{"attributes":{{"POSITION":{a}}},"material":0}}]}}"#)
    };
    let imported = import(
        "a.glb",
        glb.build(&format!(
            r#"{MATERIAL},"meshes":[{},{}],"nodes":[{{"mesh":0}},{{"mesh":1}}]"#,
            mesh(1),
            mesh(2)
        )),
    );
    assert_eq!(corners(&imported, 0), [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    // Without a buffer of its own an accessor starts from zeros.
    assert_eq!(corners(&imported, 1), [[0.0; 3], [2.0, 0.0, 0.0], [0.0; 3]]);
    assert_eq!(
        warnings(&imported),
        ["nodes[1].mesh[0].primitives[0].triangle 0: the triangle has no area"
            .replace("mesh[0]", "mesh[1]")]
    );
}

#[test]
fn cameras_look_along_their_negative_z() {
    let file = triangle_with(
        r#""cameras":[{"type":"perspective","perspective":{"yfov":0.75,"znear":0.1}},
        {"type":"orthographic","orthographic":{"xmag":1,"ymag":1,"zfar":2,"znear":0}}],
        "nodes":[{"name":"eye","camera":0,"translation":[1,2,3],"rotation":[0,0.70710678,0,0.70710678]},{"camera":1}]"#,
    );
    let imported = import("a.glb", file);
    let [camera] = imported.scene.cameras() else { panic!("one camera") };
    assert_eq!((camera.name.as_str(), camera.vertical_fov), ("eye", 0.75));
    assert_eq!(camera.position, DVec3::new(1.0, 2.0, 3.0));
    // A quarter turn about y takes −z to −x.
    assert_near(camera.target, DVec3::new(0.0, 2.0, 3.0));
    assert_near(camera.up, DVec3::Y);
    assert_eq!(warnings(&imported), ["nodes[1]: left out: orthographic camera"]);
    assert_eq!(imported.scene.triangles(), []);
}

#[test]
fn what_a_scene_cannot_hold_is_told() {
    let file = triangle_with(
        r#""extensionsUsed":["KHR_lights_punctual","EXT_wind"],
        "extensions":{"KHR_lights_punctual":{"lights":[{"name":"sun","type":"directional"}]}},
        "nodes":[{"mesh":0,"skin":0},{"extensions":{"KHR_lights_punctual":{"light":0}}}],
        "skins":[{"joints":[0]}],
        "animations":[{"channels":[],"samplers":[]}],
        "scenes":[{"nodes":[0,1]},{"name":"attic","nodes":[]}]"#,
    );
    assert_eq!(
        warnings(&import("a.glb", file)),
        [
            "a.glb: extensionsUsed: left out: extension EXT_wind",
            "a.glb: animations: left out: animations: the scene stands at rest",
            "a.glb: scenes[1]: left out: scene attic",
            "nodes[0]: left out: skin: the mesh stands as modelled",
            "nodes[1]: left out: light sun: only surfaces emit",
        ]
    );
}

#[test]
fn coordinates_that_are_not_finite_are_refused() {
    for (wild, found) in [(f32::NAN, "NaN"), (f32::INFINITY, "inf"), (f32::NEG_INFINITY, "-inf")] {
        let mut glb = Glb::default();
        let mut positions = [TRIANGLE, TRIANGLE].concat();
        positions[4][2] = wild;
        glb.floats(&positions);
        let file = glb.build(&format!(
            r#"{MATERIAL},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],"nodes":[{{"mesh":0}}]"#
        ));
        assert_eq!(
            failure("a.glb", file),
            format!("a.glb: accessors[0]: expected finite numbers, found {found} in entry 4")
        );
    }
    // f32 has no 1e39.
    for transform in ["\"translation\":[0,1e39,0]", "\"scale\":[1,1,-1e39]"] {
        let file = triangle_with(&format!(r#""nodes":[{{"mesh":0,{transform}}}]"#));
        let text = failure("a.glb", file);
        assert!(text.ends_with("expected glTF JSON: number out of range"), "{text}");
    }
}

#[test]
fn triangles_that_a_transform_loses_collapse_in_their_place() {
    // Nine times 10³⁸ is beyond f64, and a rotation of length 0 turns to nowhere.
    let grown: Vec<_> =
        (0..9).map(|i| format!(r#"{{"scale":[1e38,1e38,1e38],"children":[{}]}}"#, i + 1)).collect();
    let nodes = grown.join(",");
    let file = triangle_with(&format!(
        r#""nodes":[{nodes},{{"mesh":0}},{{"mesh":0,"rotation":[0,0,0,0]}},{{"mesh":0}}]"#
    ));
    let imported = import("a.glb", file);
    assert_eq!([0, 1].map(|i| imported.scene.area(TriangleId(i))), [0.0; 2]);
    assert_eq!(imported.scene.area(TriangleId(2)), 0.5);
    let lost =
        "triangle 0: a coordinate is not finite: the triangle is collapsed to a point".to_owned();
    assert_eq!(
        warnings(&imported),
        [9, 10].map(|node| format!("nodes[{node}].mesh[0].primitives[0].{lost}"))
    );
}

#[test]
fn an_empty_document_is_an_empty_scene() {
    for json in [
        r#"{"asset":{"version":"2.0"}}"#,
        r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[]}],"scene":0}"#,
    ] {
        let imported = import("a.gltf", json);
        assert_eq!(imported.scene.triangles(), []);
        assert_eq!(imported.diagnostics, []);
        assert_eq!(import("a.glb", pack(json, b"")).scene.triangles(), []);
    }
}

#[test]
fn buffers_may_lie_beside_the_file_or_within_it() {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    let rest = format!(
        r#"{MATERIAL},"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"material":0}}]}}],"nodes":[{{"mesh":0}}]"#
    );
    let json = |uri: &str| {
        glb.json(&rest).replace(r#""buffers":[{"#, &format!(r#""buffers":[{{"uri":"{uri}","#))
    };
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.GLTF");
    fs::write(folder.path().join("my data.bin"), glb.bin()).unwrap();
    // The three corners are nine floats, of which the second and eighth are 1: 0x3f800000.
    let zeros = |n: usize| "%00".repeat(n);
    let inline = format!("data:,{}%00%00%80%3f{}%00%00%80%3f{}", zeros(12), zeros(12), zeros(4));
    for uri in ["my%20data.bin", &inline] {
        fs::write(&path, json(uri)).unwrap();
        let imported = open(&path, &Options::default()).unwrap();
        assert_eq!(corners(&imported, 0), [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
    }
    assert_eq!(
        failure("a.gltf", json("my%20data.bin")),
        "a.gltf: buffers[0]: \"my%20data.bin\" cannot be read: the scene was opened without its folder"
    );
    for uri in ["gone.bin", "%FF.bin", "http://example.org/a.bin"] {
        fs::write(&path, json(uri)).unwrap();
        let error = open(&path, &Options::default()).unwrap_err().to_string();
        let expected = format!("a.GLTF: buffers[0]: {uri:?} cannot be read: ");
        assert!(error.starts_with(&expected), "{error}");
    }
    fs::write(folder.path().join("my data.bin"), [0; 8]).unwrap();
    fs::write(&path, json("my%20data.bin")).unwrap();
    let error = open(&path, &Options::default()).unwrap_err().to_string();
    assert_eq!(error, "a.GLTF: buffers[0]: expected 36 bytes, found 8");
}
