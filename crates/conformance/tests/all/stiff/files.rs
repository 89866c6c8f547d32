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

/// Refused, with the line: what no file may say.
fn refused(name: &str, text: &str, line: u64) {
    let error = open_bytes(name, text.as_bytes(), &Options::default()).unwrap_err();
    println!("{error}");
    assert_eq!(error.line(), Some(line), "{error}");
    assert!(error.to_string().starts_with(&format!("{name}:{line}:")), "{error}");
}

#[test]
fn nan_inf_denormal() {
    let tri = |corner: &str| format!("Triangle\n1 2 3 0 0 0\n0 0 0\n1 0 0\n{corner}\n");
    for word in ["nan", "NaN", "inf", "-inf", "infinity", "1e999"] {
        refused("t.tri", &tri(&format!("0 {word} 0")), 5);
    }
    for colours in
        ["-1 0 0 0 0 0", "nan 0 0 0 0 0", "0 0 0 0 0 -1", "0 0 0 256 0 0", "0.5 0 0 0 0 0"]
    {
        refused("t.tri", &tri("0 1 0").replace("1 2 3 0 0 0", colours), 2);
    }
    let obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for index in ["4", "0", "-4", "99999999999999999999", "x", "nan"] {
        refused("t.obj", &obj.replace("1 2 3", &format!("1 2 {index}")), 4);
    }
    // Lengths that f64 can hardly tell from 0 count as 0: the triangle stays, is warned about,
    // and takes no part.
    let cube = "Triangle\n255 255 255 255 255 255\n0 0 0\n1 0 0\n0 1 0\n";
    for tiny in ["1e-320", "-4.9e-324", "1e-310"] {
        let text =
            format!("{cube}Triangle\n255 255 255 255 255 255\n0 0 0\n{tiny} 0 0\n0 {tiny} 0\n");
        let imported = open_bytes("t.tri", text.as_bytes(), &Options::default()).unwrap();
        let kinds: Vec<_> =
            imported.diagnostics.iter().map(|d| (d.place.as_str(), &d.kind)).collect();
        assert_eq!(kinds, [("t.tri:6", &DiagnosticKind::Degenerate)]);
        let config = ShootingConfig::until(1e-3);
        let solved = solve(&imported.scene, 16, config, Engine::FIRST).unwrap();
        assert!(
            solved.solution.elements.iter().all(|e| e.triangle.0 == 0 && e.exitance[0] == 25_500.0)
        );
    }
    // A denormal among sound coordinates is no more than a rounding.
    let imported = open_bytes("t.tri", tri("1e-320 1 0").as_bytes(), &Options::default()).unwrap();
    assert!(imported.diagnostics.is_empty());
}

/// OBJ knows `nan` and any reflectance: they are repaired, and every repair is a warning that
/// names its place.
#[test]
fn obj_numbers_that_no_scene_holds_are_warned_about() {
    let folder = tempfile::tempdir().unwrap();
    let open = |vertex: &str, material: &str| {
        let text = format!("mtllib t.mtl\nv 0 0 0\nv 1 0 0\nv {vertex} 1 0\nusemtl m\nf 1 2 3\n");
        std::fs::write(folder.path().join("t.obj"), text).unwrap();
        std::fs::write(folder.path().join("t.mtl"), format!("newmtl m\n{material}\n")).unwrap();
        scene_import::open(&folder.path().join("t.obj"), &Options::default())
    };
    assert!(open("0", "Kd .5 .5 .5").unwrap().diagnostics.is_empty());
    for (vertex, material) in [
        ("nan", "Kd .5 .5 .5"),
        ("inf", "Kd .5 .5 .5"),
        ("0", "Kd 1.2 .5 .5"),
        ("0", "Kd -.1 .5 .5"),
        ("0", "Kd nan .5 .5"),
        ("0", "Kd .5 .5 .5\nKe -1 0 0"),
        ("0", "Kd .5 .5 .5\nKe inf 0 0"),
    ] {
        match open(vertex, material) {
            Ok(imported) => {
                println!("{vertex}, {material}: {}", imported.diagnostics[0]);
                assert_eq!(imported.diagnostics.len(), 1);
                let corners = imported.scene.ids().map(|id| imported.scene.corners(id));
                assert!(corners.flatten().all(|p| p.is_finite()));
            }
            Err(error) => println!("{vertex}, {material}: {error}"),
        }
    }
}
