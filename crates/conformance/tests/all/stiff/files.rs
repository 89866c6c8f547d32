//! Files at the edges: a million triangles, none, one, nothing but lamps, and broken ones.

use std::io::Write;
use std::path::Path;

use accel::{Bvh, BvhConfig};
use conformance::{Engine, Solved, solve};
use radiosity_core::{
    Census, Mesh, MeshConfig, Sequential, Shooting, ShootingConfig, StopReason, StopRule,
};
use scene_import::{DiagnosticKind, Imported, Options, open_bytes};
use tri_io::{TriRecord, Writer};

use crate::BALANCED;

const GREY: [u8; 3] = [128; 3];
const BLACK: [u8; 3] = [0; 3];
const LAMP: [u8; 3] = [255; 3];

fn record(front: [u8; 3], back: [u8; 3], vertices: [[f64; 3]; 3]) -> TriRecord {
    TriRecord { front, back, vertices, normals: None }
}

fn open(records: &[TriRecord]) -> Imported {
    let mut writer = Writer::new(Vec::new());
    records.iter().for_each(|r| writer.write(r).unwrap());
    open_bytes("t.tri", &writer.finish().unwrap(), &Options::default()).unwrap()
}

fn solved(records: &[TriRecord], elements: usize) -> Solved {
    let config = ShootingConfig::until(1e-3);
    let solved = solve(&open(records).scene, elements, config, Engine::FIRST).unwrap();
    assert!(solved.ledger.imbalance() < BALANCED, "{:e}", solved.ledger.imbalance());
    solved
}

/// An n × n grid of unit squares on the floor, and one lamp of one triangle above it.
fn write_floor(path: &Path, n: u32) -> u64 {
    let file = std::io::BufWriter::new(std::fs::File::create(path).unwrap());
    let mut writer = Writer::new(file);
    let mut count = 0;
    for i in 0..n {
        for j in 0..n {
            let p = |di: u32, dj: u32| [f64::from(i + di), f64::from(j + dj), 0.0];
            for vertices in [[p(0, 0), p(1, 0), p(1, 1)], [p(0, 0), p(1, 1), p(0, 1)]] {
                writer.write(&record(GREY, BLACK, vertices)).unwrap();
                count += 1;
            }
        }
    }
    let (half, up) = (f64::from(n) / 2.0, f64::from(n) / 10.0);
    let lamp = [[half, half, up], [half, half + 9.0, up], [half + 9.0, half, up]];
    writer.write(&record(BLACK, LAMP, lamp)).unwrap();
    writer.finish().unwrap().flush().unwrap();
    count + 1
}

#[test]
fn a_million_triangles() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("floor.tri");
    let count = write_floor(&path, 707);
    let imported = scene_import::open(&path, &Options::default()).unwrap();
    assert_eq!(imported.summary.triangles as u64, count);
    assert_eq!((imported.summary.emitters, imported.diagnostics.len()), (1, 0));
    let scene = imported.scene;
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(0));
    assert_eq!(mesh.elements().len() as u64, count);
    // No census: 32 rays for each of a million patches would say only where light escaped.
    let census = Census::default();
    let stop = StopRule { unshot: 0.0, max_shots: Some(1) };
    let config = ShootingConfig { stop, ..ShootingConfig::until(0.0) };
    let mut shooting = Shooting::new(&mesh, &bvh, &census, &Sequential, config);
    assert_eq!(shooting.run(&mut ()), StopReason::ShotLimit);
    let ledger = shooting.ledger();
    assert!(ledger.imbalance() < BALANCED, "{:e}", ledger.imbalance());
    // The lamp hangs over the middle at a tenth of the floor's side: from a point, a disk of
    // radius 5 h takes 1 − 1/26 of its light, and the square that surrounds it up to 1.5 %
    // more.
    let reached = 1.0 - ledger.escaped[0] / ledger.emitted[0];
    println!("{count} triangles, {:?}: {reached:.4} of the light arrives", shooting.report());
    assert!((0.96..0.98).contains(&reached), "{reached}");
}

#[test]
fn a_lone_triangle_does_not_light_itself() {
    // Tilted in many ways: the height of its own points over its own plane is a rounding.
    for k in 0..100u32 {
        let f = |i: u32| (f64::from(k * k + 7 * i) * 0.618_033_988_749_895).fract();
        let vertices = [[f(0), f(1), f(2)], [f(3), f(5), f(8)], [f(13), f(21), f(35)]];
        let solved = solved(&[record(GREY, LAMP, vertices)], 8);
        for element in &solved.solution.elements {
            assert_eq!(element.exitance.0, [25_500.0; 3], "{k}: {vertices:?}");
        }
    }
}

#[test]
fn nothing_but_lamps() {
    // Two lamps face each other: E1 + ρF·B2 on both, so B = E / (1 − ρF), and all alike.
    let lower = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    let upper = [[0., 0., 1.], [0., 1., 1.], [1., 0., 1.]];
    let solved = solved(&[record(GREY, LAMP, lower), record(GREY, LAMP, upper)], 64);
    assert_eq!(solved.reason, StopReason::Converged);
    let mean = |first: usize| {
        let half = &solved.solution.elements[first * 32..][..32];
        half.iter().map(|e| e.exitance[0]).sum::<f64>() / 32.0 / 25_500.0
    };
    let (b, other) = (mean(0), mean(1));
    assert!((b / other - 1.0).abs() < 2e-3, "{b} {other}");
    assert!(b > 1.0 && b < 1.0 / (1.0 - 0.251), "{b}");
}

#[test]
fn no_triangle_at_all() {
    let imported = open_bytes("empty.tri", b"", &Options::default()).unwrap();
    assert_eq!(imported.scene.triangles().len(), 0);
    let config = ShootingConfig::until(1e-3);
    for engine in Engine::all() {
        let solved = solve(&imported.scene, 100, config, engine).unwrap();
        assert_eq!((solved.reason, solved.shots), (StopReason::NoLight, 0));
        assert!(solved.solution.elements.is_empty());
    }
}

#[test]
fn broken_files_name_the_place() {
    let whole = "Triangle\n1 2 3 0 0 0\n0 0 0\n1 0 0\n0 1 0\n";
    let error = |text: &str| {
        let error = open_bytes("broken.tri", text.as_bytes(), &Options::default()).unwrap_err();
        error.to_string()
    };
    assert_eq!(
        error(&whole[..whole.len() - 4]),
        "broken.tri:5:3: expected number 8 of 9 (18 with normals), found end of file"
    );
    let nan = whole.replace("0 1 0", "0 NaN 0");
    assert_eq!(error(&nan), "broken.tri:5:3: expected a finite number, found \"NaN\"");
    let wide = whole.replace("1 2 3", "1 2 300");
    assert_eq!(error(&wide), "broken.tri:2:5: expected an integer from 0 to 255, found \"300\"");
}

const TRI: &str = "Triangle\n1 2 3 0 0 0\n0 0 0\n1 0 0\n0 1 0\n";
const VS3: &str = "V 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\nS 1 1 2 3 0 0 0 0.5 wall\n";
const OBJ: &str = "mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl m\nf 1 2 3\n";
const MTL: &str = "newmtl m\nKd 0.5 0.5 0.5\nKe 0 0 3\n";
const RIGHT: [f32; 9] = [0., 0., 0., 1., 0., 0., 0., 1., 0.];
const GLTF: &str = r#""pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0},
"emissiveFactor":[0,0,1]"#;
const EXTRAS: &str =
    r#""extras":{"radiosity":{"reflectance":[0.5,0.5,0.5],"emittance":[0,0,3],"sides":"front"}}"#;

/// The one error of a file: a line that begins with the place.
fn refused(opened: Result<Imported, scene_import::Error>, place: &str) {
    let error = opened.unwrap_err().to_string();
    println!("{error}");
    assert!(error.starts_with(&format!("{place}: expected ")), "{place}: {error}");
    assert!(error.lines().count() == 1 && error.contains(", found "), "{error}");
}

fn text(name: &str, text: &str) -> Result<Imported, scene_import::Error> {
    open_bytes(name, text.as_bytes(), &Options::default())
}

/// An OBJ file with its library.
fn obj(file: &str, library: &str) -> Result<Imported, scene_import::Error> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("t.obj"), file).unwrap();
    std::fs::write(folder.path().join("t.mtl"), library).unwrap();
    scene_import::open(&folder.path().join("t.obj"), &Options::default())
}

/// A glTF file of one triangle.
fn gltf(
    corners: [f32; 9],
    indices: [u8; 3],
    material: &str,
) -> Result<Imported, scene_import::Error> {
    let bytes = corners.into_iter().flat_map(f32::to_le_bytes).chain(indices);
    let data: String = bytes.map(|byte| format!("%{byte:02x}")).collect();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":39,"uri":"data:,{data}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":3}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}},
        {{"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}}],"materials":[{{{material}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"material":0}}]}}],"nodes":[{{"mesh":0}}]}}"#
    );
    text("t.gltf", &json)
}

/// Without their mistakes the files of the tests below are sound.
#[test]
fn the_files_to_break_are_sound() {
    let files = [
        text("t.tri", TRI),
        text("t.vs3", VS3),
        obj(OBJ, MTL),
        gltf(RIGHT, [0, 1, 2], GLTF),
        gltf(RIGHT, [0, 1, 2], EXTRAS),
    ];
    for file in files {
        let imported = file.unwrap();
        assert_eq!((imported.scene.triangles().len(), imported.diagnostics.len()), (1, 0));
    }
}

#[test]
fn rho_gt_1_or_negative() {
    // .tri states reflectance in steps of which there are 256.
    for (rho, column) in [("256 2 3", 1), ("1 -1 3", 3), ("1 2 nan", 5), ("1 2 1.2", 5)] {
        refused(text("t.tri", &TRI.replace("1 2 3", rho)), &format!("t.tri:2:{column}"));
    }
    for rho in ["1.2", "-0.1", "nan", "NaN", "inf"] {
        // An emissivity is 1 − ρ, and as far out of range.
        refused(text("t.vs3", &VS3.replace("0.5", rho)), "t.vs3:4:17");
        refused(obj(OBJ, &MTL.replace("0.5 0.5 0.5", &format!("0.5 {rho} 0.5"))), "t.mtl:2:8");
        refused(obj(OBJ, &MTL.replace("0.5 0.5 0.5", rho)), "t.mtl:2:4");
    }
    for rho in ["1.2", "-0.1"] {
        let wrong = |text: &str| text.replace("[0.5,0.5", &format!("[0.5,{rho}"));
        let base = "t.gltf: materials[0].pbrMetallicRoughness.baseColorFactor[1]";
        refused(gltf(RIGHT, [0, 1, 2], &wrong(GLTF)), base);
        let ours = "t.gltf: materials[0].extras.radiosity.reflectance[1]";
        refused(gltf(RIGHT, [0, 1, 2], &wrong(EXTRAS)), ours);
    }
    // JSON has no word for what is no number.
    for material in [GLTF, EXTRAS] {
        let error = gltf(RIGHT, [0, 1, 2], &material.replace("[0.5,0.5", "[0.5,NaN")).unwrap_err();
        assert!(error.line().is_some() && error.column().is_some(), "{error}");
    }
}

#[test]
fn nan_inf_denormal() {
    // Vertices.
    for word in ["nan", "NaN", "inf", "-inf", "infinity", "1e999"] {
        refused(text("t.tri", &TRI.replace("0 1 0", &format!("0 {word} 0"))), "t.tri:5:3");
        refused(text("t.vs3", &VS3.replace("0 1 0", &format!("0 {word} 0"))), "t.vs3:3:7");
        refused(obj(&OBJ.replace("0 1 0", &format!("0 {word} 0")), MTL), "t.obj:4:5");
        // A vertex that no face uses is a mistake as well.
        refused(obj(&format!("{OBJ}v {word} 0 0\n"), MTL), "t.obj:7:3");
    }
    for wild in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let corners = [0., 0., 0., 1., 0., 0., 0., wild, 0.];
        refused(gltf(corners, [0, 1, 2], GLTF), "t.gltf: accessors[0]");
    }
    // Emission.
    for (colour, column) in [("-1 0 0", 7), ("0 nan 0", 9), ("0 0 256", 11)] {
        let wrong = TRI.replace("3 0 0 0", &format!("3 {colour}"));
        refused(text("t.tri", &wrong), &format!("t.tri:2:{column}"));
    }
    for word in ["-1", "nan", "inf", "1e999"] {
        refused(obj(OBJ, &MTL.replace("0 0 3", &format!("0 {word} 3"))), "t.mtl:3:6");
    }
    let wrong = GLTF.replace("[0,0,1]", "[0,-1,1]");
    refused(gltf(RIGHT, [0, 1, 2], &wrong), "t.gltf: materials[0].emissiveFactor[1]");
    let wrong = EXTRAS.replace("[0,0,3]", "[0,-1,3]");
    refused(gltf(RIGHT, [0, 1, 2], &wrong), "t.gltf: materials[0].extras.radiosity.emittance[1]");
    for (material, zero) in [(GLTF, "[0,0,1]"), (EXTRAS, "[0,0,3]")] {
        let wrong = material.replace(zero, "[0,1e999,0]");
        let error = gltf(RIGHT, [0, 1, 2], &wrong).unwrap_err().to_string();
        assert!(error.starts_with("t.gltf:") && error.ends_with("number out of range"), "{error}");
    }
    // Indices.
    for index in ["4", "0", "-4", "99999999999999999999", "x", "nan"] {
        refused(obj(&OBJ.replace("1 2 3", &format!("1 2 {index}")), MTL), "t.obj:6:7");
    }
    for index in ["4", "-1", "99999999999999999999", "x", "nan"] {
        let wrong = VS3.replace("S 1 1 2 3", &format!("S 1 1 2 {index}"));
        refused(text("t.vs3", &wrong), "t.vs3:4:9");
    }
    for index in [3, 255] {
        let place = "t.gltf: nodes[0].mesh[0].primitives[0].indices";
        refused(gltf(RIGHT, [0, 1, index], GLTF), place);
    }
    denormal_lengths_are_none();
}

/// Lengths that f64 can hardly tell from 0 count as 0: the triangle stays, is warned about,
/// and takes no part.
fn denormal_lengths_are_none() {
    let bright = TRI.replace("1 2 3 0 0 0", "255 255 255 255 255 255");
    for tiny in ["1e-320", "-4.9e-324", "1e-310"] {
        let small = bright.replace("1 0 0\n0 1 0", &format!("{tiny} 0 0\n0 {tiny} 0"));
        let imported = text("t.tri", &format!("{bright}{small}")).unwrap();
        let kinds: Vec<_> =
            imported.diagnostics.iter().map(|d| (d.place.as_str(), &d.kind)).collect();
        assert_eq!(kinds, [("t.tri:6", &DiagnosticKind::Degenerate)]);
        let config = ShootingConfig::until(1e-3);
        let solved = solve(&imported.scene, 16, config, Engine::FIRST).unwrap();
        let lit = |e: &scene::SolutionElement| e.triangle.0 == 0 && e.exitance[0] == 25_500.0;
        assert!(solved.solution.elements.iter().all(lit));
        // In the other formats likewise, but for glTF: f32 ends before.
        let length = format!("{tiny} 0 0");
        for imported in [
            obj(&OBJ.replace("v 1 0 0", &format!("v {length}")), MTL),
            text("t.vs3", &VS3.replace("V 2 1 0 0", &format!("V 2 {length}"))),
        ] {
            let diagnostics = imported.unwrap().diagnostics;
            let kinds: Vec<_> = diagnostics.iter().map(|d| &d.kind).collect();
            assert_eq!(kinds, [&DiagnosticKind::Degenerate]);
        }
    }
    // The smallest f32 is 1.4e-45; half an area of its square is still above 0 in f64.
    let least = f32::from_bits(1);
    let corners = [0., 0., 0., least, 0., 0., 0., least, 0.];
    assert!(gltf(corners, [0, 1, 2], GLTF).is_ok());
    // A denormal among sound coordinates is no more than a rounding.
    let imported = text("t.tri", &TRI.replace("0 1 0", "1e-320 1 0")).unwrap();
    assert!(imported.diagnostics.is_empty());
}
