//! docs/formats.md says what the program does: warnings, conversions and headers, each by a small file.
//!
//! What a case expects must be in the page, too, so that neither changes without the other.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

use std::f64::consts::PI;
use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};

/// A triangle in each of the formats of text.
const TRI: &str = "Triangle\n102 51 0 255 0 51\n0 0 0\n1 0 0\n0 1 0\n";
const OBJ: &str = "mtllib m.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
const VS3: &str = "F 3\nV 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nV 5 0 0 1\nV 6 1 0 1\n";

/// The page, its lines joined, so that a text may be broken anywhere.
fn page() -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/formats.md");
    std::fs::read_to_string(path).unwrap().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What the program says on both streams.
fn radiosity(folder: &Path, arguments: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .current_dir(folder)
        .args(arguments.split(' '))
        .output()
        .unwrap();
    let said = [output.stdout, output.stderr].concat();
    String::from_utf8(said).unwrap()
}

/// A folder with these files.
fn folder(files: &[(&str, &str)]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// What makes a glTF file odd.
type Change<'a> = &'a dyn Fn(&mut Value);

/// A glTF file of one triangle; `change` makes it what a case needs.
fn gltf(change: impl FnOnce(&mut Value)) -> String {
    let corners = [[0.0_f32, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let bytes = corners.as_flattened().iter().flat_map(|c| c.to_le_bytes());
    let data: String = bytes.map(|byte| format!("%{byte:02x}")).collect();
    let mut document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0, "name": "it" }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "material": 0 }] }],
        "materials": [{ "pbrMetallicRoughness": { "metallicFactor": 0.0 } }],
        "accessors": [{
            "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
            "min": [0.0, 0.0, 0.0], "max": [1.0, 1.0, 0.0],
        }],
        "bufferViews": [{ "buffer": 0, "byteLength": 36 }],
        "buffers": [{ "byteLength": 36, "uri": format!("data:application/octet-stream,{data}") }],
    });
    change(&mut document);
    document.to_string()
}

#[test]
fn each_warning_that_the_page_names_is_given() {
    let page = page();
    let check = |name: &str, files: &[(&str, &str)], expected: &[&str]| {
        let folder = folder(files);
        let said = radiosity(folder.path(), &format!("plan {name}"));
        for text in expected {
            assert!(said.contains(text), "{name}: expected {text:?} in\n{said}");
            assert!(page.contains(text), "not in docs/formats.md: {text}");
        }
    };
    let triangle = |corners: &str, normal: &str| {
        let vertices: Vec<String> =
            corners.split(", ").map(|c| format!("{c} {normal}\n")).collect();
        format!("Triangle\n9 9 9 0 0 0\n{}", vertices.concat())
    };
    let good = "0 0 0, 1 0 0, 0 1 0";
    let text = [triangle(good, "0 0 -1"), triangle(good, ""), triangle("0 0 0, 1 0 0, 2 0 0", "")];
    let warnings = [
        "the normals point to the triangle's back",
        "repeats triangle",
        "the triangle has no area",
    ];
    check("a.tri", &[("a.tri", &text.concat())], &warnings);

    let odd = OBJ.replace("mtllib m.mtl\nusemtl m\n", "mtllib none.mtl\n");
    let odd = format!("{odd}usemtl none\nf 1 3 2\nf 1 2\nl 1 2\np 1\n");
    let warnings = [
        "material library \"",
        "a usemtl before this face is missing",
        "a face of 2 corners makes no triangle",
        "left out: line elements",
        "point elements",
    ];
    check("a.obj", &[("a.obj", &odd)], &warnings);
    let library = "newmtl m\nmap_Ke -s 2 2 none.png\nd 0.5\n";
    let warnings =
        ["left out: texture option -s", "left out: transparency", "is left out, white is used"];
    check("b.obj", &[("b.obj", OBJ), ("m.mtl", library)], &warnings);
    let one = "a reflectance of exactly 1 loses no light";
    check("c.obj", &[("c.obj", OBJ), ("m.mtl", "newmtl m\nKd 1")], &[one]);
    let above = "is above 1 by a rounding: 1 is used";
    check("d.obj", &[("d.obj", OBJ), ("m.mtl", "newmtl m\nKd 1.0000005")], &[above]);
    let tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n";
    let reversed = "the triangle faces against its neighbours: reversed winding?";
    check("e.obj", &[("e.obj", tetrahedron)], &[reversed]);

    for (lines, warning) in [
        ("X 1 2\nS 1 1 2 3 4 0 0 1 a", "left out: a coordinate transformation"),
        ("S 1 1 2 3 4 0 0 1 a b", "left out: the line from \""),
        ("S 1 1 3 2 4 0 0 1 a", "the four corners are not those of a flat convex quadrilateral"),
        (
            "S 1 1 2 3 4 0 0 1 a\nS 2 1 2 6 5 1 0 1 b",
            "the surface does not lie in the plane of its base: both count in full",
        ),
        ("S 1 1 2 3 4 0 0 1 a\nS 2 1 3 2 0 1 0 1 b", "the surface faces away from its base"),
    ] {
        check("a.vs3", &[("a.vs3", &format!("{VS3}{lines}\n"))], &[warning]);
    }

    let lamp = json!({ "KHR_lights_punctual": { "lights": [{ "type": "point" }] } });
    let cases: [(Change<'_>, &str); 6] = [
        (
            &|d| d["materials"][0]["pbrMetallicRoughness"]["metallicFactor"] = json!(0.25),
            "the mirror-like share of the reflectance (metallic 0.25)",
        ),
        (&|d| d["materials"][0]["alphaMode"] = json!("BLEND"), "alpha: the surface is opaque"),
        (&|d| d["meshes"][0]["primitives"][0]["mode"] = json!(1), "left out: primitive of Line"),
        (&|d| d["scenes"] = json!([{ "nodes": [0] }, { "nodes": [0] }]), "left out: scene "),
        (
            &|d| {
                d["extensionsUsed"] = json!(["KHR_lights_punctual"]);
                d["extensions"] = lamp.clone();
                d["nodes"][0]["extensions"] = json!({ "KHR_lights_punctual": { "light": 0 } });
            },
            ": only surfaces emit",
        ),
        (
            &|d| {
                d["cameras"] = json!([{
                    "type": "orthographic",
                    "orthographic": { "xmag": 1.0, "ymag": 1.0, "znear": 0.1, "zfar": 9.0 },
                }]);
                d["nodes"][0]["camera"] = json!(0);
            },
            "orthographic camera",
        ),
    ];
    for (change, warning) in cases {
        check("a.gltf", &[("a.gltf", &gltf(change))], &[warning]);
    }
}

/// The first material of a scene file, as `convert` writes it into a GLB.
fn material(name: &str, files: &[(&str, &str)]) -> Value {
    let folder = folder(files);
    let said = radiosity(folder.path(), &format!("convert {name} out.glb"));
    let bytes = std::fs::read(folder.path().join("out.glb")).unwrap_or_else(|_| panic!("{said}"));
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let document: Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    document["materials"][0]["extras"]["radiosity"].clone()
}

#[test]
fn surfaces_become_what_the_page_says() {
    let expected = |reflectance: [f64; 3], emittance: [f64; 3], sides: &str| json!({ "reflectance": reflectance, "emittance": emittance, "sides": sides });
    // ρ = 0.5 · front / 255, E = 100 · back.
    let tri = expected([0.2, 0.1, 0.0], [25_500.0, 0.0, 5_100.0], "front");
    assert_eq!(material("a.tri", &[("a.tri", TRI)]), tri);
    // Kd, and π Ke.
    let library = "newmtl m\nKd 0.25 0.5 0.75\nKe 2 1 0\n";
    let obj = expected([0.25, 0.5, 0.75], [2.0 * PI, PI, 0.0], "front");
    assert_eq!(material("a.obj", &[("a.obj", OBJ), ("m.mtl", library)]), obj);
    // Grey of reflectance 0.5 instead of what is missing.
    assert_eq!(material("b.obj", &[("b.obj", OBJ)]), expected([0.5; 3], [0.0; 3], "front"));
    let surface = format!("{VS3}S 1 1 2 3 4 0 0 0.75 floor\n");
    assert_eq!(material("a.vs3", &[("a.vs3", &surface)]), expected([0.25; 3], [0.0; 3], "front"));
    // base · (1 − metallic), π L · strength, doubleSided. Powers of two: glTF has f32.
    let metal = gltf(|document| {
        document["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
        document["materials"][0] = json!({
            "pbrMetallicRoughness": { "baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 0.25 },
            "emissiveFactor": [1, 0.5, 0],
            "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 4 } },
            "doubleSided": true,
        });
    });
    assert_eq!(
        material("a.gltf", &[("a.gltf", &metal)]),
        expected([0.75, 0.375, 0.1875], [4.0 * PI, 2.0 * PI, 0.0], "both")
    );
}

#[test]
fn outputs_begin_as_the_page_says() {
    let page = page();
    // A floor and a lamp that faces it.
    let lamp = TRI.replace("0 0 0\n1 0 0\n0 1 0", "0 0 1\n0 1 1\n1 0 1");
    let scene = format!("{}{lamp}", TRI.replace("255 0 51", "0 0 0"));
    let places = "triangle,u,v,area\n0,0.25,0.25,0.125\n";
    let folder = folder(&[("a.tri", &scene), ("p.csv", places)]);
    let outputs = "-o a.csv -o a.ply -o b.tri -o a.probe.csv --probe p.csv";
    let said = radiosity(folder.path(), &format!("solve a.tri --elements 20 {outputs}"));
    assert!(said.contains("written"), "{said}");
    let said = radiosity(folder.path(), "form-factors a.tri -o F.csv -o F.npy -o F.npz");
    assert!(said.contains("written"), "{said}");

    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let begins = |name: &str, text: &str| {
        assert!(read(name).starts_with(text.as_bytes()), "{name}");
        let text = text.trim_end();
        assert!(page.contains(text), "not in docs/formats.md: {text}");
    };
    begins("a.csv", "triangle,area,B_r,B_g,B_b\n");
    begins("F.csv", "i,j,F,error\n");
    begins("F.names.csv", "row,name,area\n");
    assert!(read("a.probe.csv").starts_with(b"triangle,u,v,area,B_r,B_g,B_b\n"));
    assert!(page.contains("triangle,u,v[,area],B_r,B_g,B_b"));
    assert!(read("F.npy").starts_with(b"\x93NUMPY\x01\x00"));
    let archive = read("F.npz");
    for array in ["indices", "indptr", "data", "shape", "format", "error", "area", "name"] {
        let member = format!("{array}.npy");
        assert!(archive.windows(member.len()).any(|w| w == member.as_bytes()), "{member}");
        assert!(page.contains(&format!("`{array}`")), "not in docs/formats.md: {array}");
    }

    let header = read("a.ply");
    let header = String::from_utf8_lossy(&header);
    let (header, _) = header.split_once("end_header\n").unwrap();
    for property in ["x", "exitance_r", "red", "vertex_indices", "triangle"] {
        assert!(header.lines().any(|l| l.starts_with("property") && l.ends_with(property)));
        assert!(page.contains(property), "not in docs/formats.md: {property}");
    }
    // A record of an element: clamped colours, black behind, corners with normals.
    let records: Vec<_> = tri_io::Reader::new(&read("b.tri")[..]).map(Result::unwrap).collect();
    assert!(records.iter().all(|record| record.back == [0; 3] && record.normals.is_some()));
    assert!(records.iter().any(|record| record.front == [255, 0, 255]), "the lamp is clamped");
}
