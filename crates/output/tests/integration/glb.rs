//! Binary glTF, taken apart chunk by chunk.

use glam::{DQuat, DVec3};
use output::{Exposure, Format, Options};
use scene::{Camera, Face, Rgb, Scene, Sides, Solution};
use serde_json::{Value, json};

use crate::common::{Lit, bytes, rectangle, square};

struct Glb {
    json: Value,
    binary: Vec<u8>,
}

fn word(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

fn parse(bytes: &[u8]) -> Glb {
    assert_eq!(&bytes[..4], b"glTF");
    assert_eq!((word(bytes, 4), word(bytes, 8)), (2, bytes.len()));
    let length = word(bytes, 12);
    assert_eq!((&bytes[16..20], length % 4), (&b"JSON"[..], 0));
    let json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    let rest = &bytes[20 + length..];
    if rest.is_empty() {
        return Glb { json, binary: Vec::new() };
    }
    assert_eq!((word(rest, 0) % 4, &rest[4..8]), (0, &b"BIN\0"[..]));
    assert_eq!(rest.len(), 8 + word(rest, 0));
    Glb { json, binary: rest[8..].to_vec() }
}

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}

impl Glb {
    /// The components of an accessor, after the rules on its place have been checked.
    fn read(&self, accessor: &Value) -> Vec<f64> {
        let accessor = &self.json["accessors"][index(accessor)];
        let view = &self.json["bufferViews"][index(&accessor["bufferView"])];
        let (size, decode): (usize, fn(&[u8]) -> f64) = match index(&accessor["componentType"]) {
            5126 => (4, |b| f64::from(f32::from_le_bytes(b.try_into().unwrap()))),
            5125 => (4, |b| f64::from(u32::from_le_bytes(b.try_into().unwrap()))),
            5123 => (2, |b| f64::from(u16::from_le_bytes(b.try_into().unwrap()))),
            other => panic!("component type {other}"),
        };
        let parts = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC3" => 3,
            "VEC4" => 4,
            other => panic!("type {other}"),
        };
        let (offset, count) = (index(&accessor["byteOffset"]), index(&accessor["count"]));
        let stride = view.get("byteStride").map_or(size * parts, index);
        let (start, length) = (index(&view["byteOffset"]), index(&view["byteLength"]));
        assert!(count > 0 && [start, offset, stride].iter().all(|n| n.is_multiple_of(4)));
        assert!(offset + stride * (count - 1) + size * parts <= length);
        assert!(start + length <= index(&self.json["buffers"][0]["byteLength"]));
        let component = |i: usize, k: usize| {
            let at = start + offset + i * stride + k * size;
            decode(&self.binary[at..at + size])
        };
        (0..count * parts).map(|n| component(n / parts, n % parts)).collect()
    }
}

#[test]
fn a_rectangle_is_one_primitive_with_its_light() {
    let options = Options { exposure: Exposure::Scale(0.5), ..Options::default() };
    let glb = parse(&bytes(Format::Glb, &square(Rgb::new(0.2, 0.6, 1.8)), &options));
    let mesh = &glb.json["meshes"][0];
    let primitive = &mesh["primitives"][0];
    let attribute = |name: &str| glb.read(&primitive["attributes"][name]);
    assert_eq!(attribute("POSITION"), [0., 0., 0., 2., 0., 0., 2., 1., 0., 0., 1., 0.]);
    assert_eq!(attribute("NORMAL")[..6], [0., 0., 1., 0., 0., 1.]);
    // Linear: 0.1 and 0.3 of 65535 as they are, 0.9 bent to 1 − 0.2/1.5.
    assert_eq!(attribute("COLOR_0")[..4], [6554., 19661., 56797., 65535.]);
    assert_eq!(attribute("_RADIOSITY")[..3], [0.2_f32, 0.6, 1.8].map(f64::from));
    assert_eq!(glb.read(&primitive["indices"]), [0., 1., 2., 0., 2., 3.]);
    let position = &glb.json["accessors"][index(&primitive["attributes"]["POSITION"])];
    assert_eq!(position["min"], json!([0.0, 0.0, 0.0]));
    assert_eq!(position["max"], json!([2.0, 1.0, 0.0]));
    let colour = &glb.json["accessors"][index(&primitive["attributes"]["COLOR_0"])];
    assert_eq!(colour["normalized"], json!(true));
    assert_eq!(glb.json["buffers"][0]["byteLength"], json!(glb.binary.len()));
    assert_eq!((&glb.json["nodes"][0]["name"], &mesh["name"]), (&json!("table"), &json!("table")));
    assert_eq!(glb.json["asset"]["version"], "2.0");
    let material = &glb.json["materials"][0];
    assert_eq!((&material["name"], &material["doubleSided"]), (&json!("wood"), &json!(false)));
    assert_eq!(material["extras"]["radiosity"]["reflectance"], json!([0.25, 0.5, 0.75]));
    assert_eq!(material["extensions"], json!({ "KHR_materials_unlit": {} }));
    assert_eq!(glb.json["extensionsUsed"], json!(["KHR_materials_unlit"]));
}

/// Two groups that share two materials, an empty group, and a two-sided surface.
fn furnished() -> (Scene, Solution) {
    let mut lit = Lit::default();
    let [table, nothing, shelf] = ["table", "nothing", "shelf"].map(|n| lit.builder.group(n));
    let wood = lit.material("wood", 0.0, Sides::Front);
    let glow = lit.material("glow", 3.0, Sides::Both);
    assert_ne!(table, nothing);
    for (z, group, material) in [(0.0, table, wood), (1.0, shelf, glow), (2.0, table, glow)] {
        lit.quad(rectangle(z), group, material, |p| Rgb::splat(p.x + z));
    }
    let mut back = lit.solution.elements[2];
    back.face = Face::Back;
    back.vertices.swap(1, 2);
    lit.solution.elements.insert(3, back);
    lit.finish()
}

#[test]
fn groups_and_materials_keep_their_names_and_faces() {
    let glb = parse(&bytes(Format::Glb, &furnished(), &Options::default()));
    let nodes = glb.json["nodes"].as_array().unwrap();
    let names: Vec<_> = nodes.iter().map(|n| n["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["table", "nothing", "shelf"]);
    assert_eq!(nodes[1].get("mesh"), None);
    let materials = |node: usize| {
        let mesh = &glb.json["meshes"][index(&nodes[node]["mesh"])];
        let primitives = mesh["primitives"].as_array().unwrap().clone();
        primitives.iter().map(|p| index(&p["material"])).collect::<Vec<_>>()
    };
    // The back of the shelf is a primitive of its own.
    assert_eq!((materials(0), materials(2)), (vec![0, 1], vec![1, 1]));
    let mut faces = 0;
    for mesh in glb.json["meshes"].as_array().unwrap() {
        for primitive in mesh["primitives"].as_array().unwrap() {
            let positions = glb.read(&primitive["attributes"]["POSITION"]);
            let indices = glb.read(&primitive["indices"]);
            assert!(indices.iter().all(|i| (*i as usize) < positions.len() / 3));
            faces += indices.len() / 3;
            for attribute in primitive["attributes"].as_object().unwrap().values() {
                assert!(!glb.read(attribute).is_empty());
            }
        }
    }
    assert_eq!(faces, 7);
    let shelf = &glb.json["meshes"][index(&nodes[2]["mesh"])]["primitives"];
    for (side, up, count) in [(0, 1.0, 6), (1, -1.0, 3)] {
        let normals = glb.read(&shelf[side]["attributes"]["NORMAL"]);
        assert!(normals.chunks(3).all(|normal| normal == [0.0, 0.0, up]));
        assert_eq!(glb.read(&shelf[side]["indices"]).len(), count);
    }
}

/// What `scene-import` reads back, member by member; its own tests have the same text.
#[test]
fn extras_hold_what_gltf_has_no_place_for() {
    let (scene, solution) = furnished();
    let mut builder = scene::SceneBuilder::new();
    for name in scene.groups() {
        builder.group(name);
    }
    // A third has no short decimal and is no f32: all its digits must be there.
    for material in scene.materials() {
        let reflectance = Rgb::new(1.0 / 3.0, 0.5, 1.0);
        builder.material(scene::Material { reflectance, ..material.clone() }).unwrap();
    }
    let ids: Vec<_> = scene.vertices().iter().map(|&p| builder.vertex(p)).collect();
    for triangle in scene.triangles() {
        let corners = triangle.vertices.map(|v| ids[v.index()]);
        builder.triangle(corners, triangle.material, triangle.group).unwrap();
    }
    builder.camera(Camera {
        name: "door".into(),
        position: DVec3::new(0.1, 0.2, 5.0),
        target: DVec3::new(0.1, 0.2, 1.0),
        up: DVec3::Y,
        vertical_fov: 0.7,
    });
    let options = Options { exposure: Exposure::Scale(0.25), ..Options::default() };
    let json = parse(&bytes(Format::Glb, &(builder.finish(), solution), &options)).json;
    let extras = |value: &Value| value["extras"].to_string();
    assert_eq!(
        [&json["materials"][0], &json["materials"][1]].map(extras),
        [
            r#"{"radiosity":{"emittance":[0.0,0.0,0.0],"reflectance":[0.3333333333333333,0.5,1.0],"sides":"front"}}"#,
            r#"{"radiosity":{"emittance":[3.0,3.0,3.0],"reflectance":[0.3333333333333333,0.5,1.0],"sides":"both"}}"#,
        ]
    );
    let shelf = &json["meshes"][1]["primitives"];
    assert_eq!(shelf[0].get("extras"), None);
    assert_eq!(extras(&shelf[1]), r#"{"radiosity":{"face":"back"}}"#);
    // By value, as zeros may have a sign.
    let unturned = json!({ "translation": [0.1, 0.2, 5.0], "rotation": [0.0, 0.0, 0.0, 1.0] });
    assert_eq!(json["nodes"][3]["extras"], json!({ "radiosity": unturned }));
    assert_eq!(extras(&json["cameras"][0]), r#"{"radiosity":{"targetDistance":4.0,"yfov":0.7}}"#);
    assert_eq!(extras(&json["asset"]), r#"{"radiosity":{"exposureScale":0.25}}"#);
}

#[test]
fn a_camera_looks_where_it_looked() {
    let (scene, solution) = square(Rgb::splat(1.0));
    let mut builder = scene::SceneBuilder::new();
    let group = builder.group("table");
    let material = builder.material(scene.materials()[0].clone()).unwrap();
    let ids = rectangle(0.0).map(|p| builder.vertex(p));
    for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
        builder.triangle([ids[a], ids[b], ids[c]], material, group).unwrap();
    }
    let camera = Camera {
        name: "door".into(),
        position: DVec3::new(1.0, -4.0, 2.0),
        target: DVec3::new(1.5, 0.5, 0.0),
        up: DVec3::Z,
        vertical_fov: 0.75,
    };
    builder.camera(camera.clone());
    let glb = parse(&bytes(Format::Glb, &(builder.finish(), solution), &Options::default()));
    let node = &glb.json["nodes"][1];
    assert_eq!((&node["name"], &node["camera"]), (&json!("door"), &json!(0)));
    assert_eq!(node["translation"], json!([1.0, -4.0, 2.0]));
    let rotation: [f64; 4] = serde_json::from_value(node["rotation"].clone()).unwrap();
    let turn = DQuat::from_array(rotation);
    let forward = (camera.target - camera.position).normalize();
    assert!((turn * DVec3::NEG_Z - forward).length() < 1e-12);
    assert!((turn * DVec3::X).dot(camera.up).abs() < 1e-12, "level horizon");
    assert!((turn * DVec3::Y).dot(camera.up) > 0.0);
    assert_eq!(glb.json["cameras"][0]["perspective"]["yfov"], 0.75);
}

#[test]
fn a_scene_far_from_the_origin_moves_into_a_root_node() {
    let mut lit = Lit::default();
    let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
    let offset = DVec3::new(1e7, -2e7, 3e6);
    let corners = rectangle(0.0).map(|p| p + offset);
    lit.quad(corners, group, grey, |_| Rgb::splat(1.0));
    let glb = parse(&bytes(Format::Glb, &lit.finish(), &Options::default()));
    let root = &glb.json["nodes"][1];
    assert_eq!((&glb.json["scenes"][0]["nodes"], &root["children"]), (&json!([1]), &json!([0])));
    let centre: [f64; 3] = serde_json::from_value(root["translation"].clone()).unwrap();
    assert_eq!(root["extras"], json!({ "radiosity": { "translation": centre } }));
    let positions = glb.read(&glb.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"]);
    for (position, corner) in positions.chunks(3).zip(corners) {
        // Halves and ones: exact in f32 about the centre.
        assert_eq!(DVec3::from_slice(position) + DVec3::from_array(centre), corner);
    }
}

#[test]
fn what_readers_cannot_narrow_to_f32_is_refused() {
    let build = |shift: f64, eye: f64| {
        let mut lit = Lit::default();
        let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
        // Far out, an f64 has digits for a large rectangle alone.
        let corners = rectangle(0.0).map(|p| p * (1.0 + 1e-10 * shift) + DVec3::X * shift);
        lit.quad(corners, group, grey, |_| Rgb::splat(1.0));
        lit.builder.camera(Camera {
            name: "eye".into(),
            position: DVec3::new(shift, eye, 0.0),
            target: DVec3::new(shift, 0.0, 0.0),
            up: DVec3::Z,
            vertical_fov: 1.0,
        });
        let (scene, solution) = lit.finish();
        let mut bytes = Vec::new();
        output::write(Format::Glb, &mut bytes, &scene, &solution, &Options::default())
            .map_err(|error| error.to_string())
    };
    assert_eq!(build(1e38, -1e30), Ok(()));
    let scene = "too large for the format: a scene farther out than f32 can hold";
    assert_eq!(build(1e39, -1e30), Err(scene.to_owned()));
    let camera = "too large for the format: a camera farther out than f32 can hold";
    assert_eq!(build(0.0, -1e39), Err(camera.to_owned()));
}

#[test]
fn nothing_at_all_is_still_a_document() {
    let nothing = (Scene::default(), Solution::default());
    let glb = parse(&bytes(Format::Glb, &nothing, &Options::default()));
    let members = glb.json.as_object().unwrap().keys().map(String::as_str).collect::<Vec<_>>();
    assert_eq!((members, glb.binary.len()), (vec!["asset"], 0));
}

#[test]
fn the_same_solution_gives_the_same_bytes() {
    let once = bytes(Format::Glb, &furnished(), &Options::default());
    assert_eq!(once, bytes(Format::Glb, &furnished(), &Options::default()));
}
