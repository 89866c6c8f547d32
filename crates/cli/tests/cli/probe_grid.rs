//! A grid of illuminance below a lamp, against its closed form.

use std::f64::consts::{PI, TAU};

use crate::support::{folder_with, radiosity};

/// A lamp of 1 × 2 at height 2 over a black floor of 4 × 4 about the origin, z up.
const SCENE: &str = "mtllib lamp.mtl
v -2 -2 0
v 2 -2 0
v 2 2 0
v -2 2 0
v -.5 -1 2
v -.5 1 2
v .5 1 2
v .5 -1 2
g floor
usemtl black
f 1 2 3 4
g lamp
usemtl lamp
f 5 6 7 8
";

/// Its radiance in red; the exitance is π times that.
const RADIANCE: f64 = 3.0;

/// What the solver asks of one form factor, and prints in its report as `tolerance`.
const TOLERANCE: f64 = 0.01;

fn scene() -> tempfile::TempDir {
    let (folder, _) = folder_with("lamp.obj", SCENE.as_bytes());
    let materials = format!("newmtl black\nKd 0 0 0\nnewmtl lamp\nKd 0 0 0\nKe {RADIANCE} 1 0\n");
    std::fs::write(folder.path().join("lamp.mtl"), materials).unwrap();
    folder
}

/// The form factor from a point to a parallel rectangle that reaches from one corner to the other, at
/// distance c: four of the catalogue's (Howell, B-3), with signs.
fn form_factor(low: [f64; 2], high: [f64; 2], c: f64) -> f64 {
    let corner = |x: f64, y: f64| {
        let (x, y) = (x / c, y / c);
        let (x2, y2) = (x.hypot(1.0), y.hypot(1.0));
        (x / x2 * (y / x2).atan() + y / y2 * (x / y2).atan()) / TAU
    };
    corner(high[0], high[1]) - corner(low[0], high[1]) - corner(high[0], low[1])
        + corner(low[0], low[1])
}

#[test]
fn a_work_plane_is_lit_as_the_closed_form_says() {
    let folder = scene();
    let grid = |height: &str, out: &str| {
        let args = [
            "probe-grid",
            "lamp.obj",
            "--group",
            "floor",
            "--spacing",
            "0.5",
            "--height",
            height,
            "-o",
            out,
        ];
        radiosity(folder.path(), &args)
    };
    for height in ["0", "0.8"] {
        let run = grid(height, "desk.csv");
        assert_eq!(run.code(), 0, "{}", run.stderr());
        assert!(run.stderr().contains("desk.csv: 64 places"), "{}", run.stderr());
        let solve = ["solve", "lamp.obj", "--elements", "200", "--probe", "desk.csv"];
        let run = radiosity(folder.path(), &[&solve[..], &["-o", "desk.probe.csv"]].concat());
        assert_eq!(run.code(), 0, "{}", run.stderr());
        assert!(run.stderr().contains("at the probes"), "{}", run.stderr());
        let text = std::fs::read_to_string(folder.path().join("desk.probe.csv")).unwrap();
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("x,y,z,nx,ny,nz,E_r,E_g,E_b"));
        let rows: Vec<Vec<f64>> =
            lines.map(|l| l.split(',').map(|n| n.parse().unwrap()).collect()).collect();
        assert_eq!(rows.len(), 64);
        for row in rows {
            let [x, y, z] = [row[0], row[1], row[2]];
            assert_eq!((z, &row[3..6]), (height.parse().unwrap(), &[0.0, 0.0, 1.0][..]));
            let seen = form_factor([-0.5 - x, -1.0 - y], [0.5 - x, 1.0 - y], 2.0 - z);
            let expected = PI * RADIANCE * seen;
            assert!((row[6] / expected - 1.0).abs() < TOLERANCE, "{row:?}, expected {expected}");
            assert!((row[7] * RADIANCE / row[6] - 1.0).abs() < 1e-12 && row[8] == 0.0, "{row:?}");
        }
    }
    // The same places on stdout.
    let stdout = grid("0.8", "-").stdout();
    assert_eq!(stdout, std::fs::read_to_string(folder.path().join("desk.csv")).unwrap());
}

#[test]
fn a_place_on_a_black_floor_says_what_arrives() {
    let folder = scene();
    std::fs::write(folder.path().join("p.csv"), "triangle,u,v\n0,0,0.5\n").unwrap();
    let args = ["solve", "lamp.obj", "--elements", "50", "--probe", "p.csv", "-o", "p.probe.csv"];
    assert_eq!(radiosity(folder.path(), &args).code(), 0);
    let text = std::fs::read_to_string(folder.path().join("p.probe.csv")).unwrap();
    let row: Vec<f64> =
        text.lines().nth(1).unwrap().split(',').map(|n| n.parse().unwrap()).collect();
    let expected = PI * RADIANCE * form_factor([-0.5, -1.0], [0.5, 1.0], 2.0);
    assert_eq!(row[3..6], [0.0; 3], "nothing leaves it");
    assert!((row[6] / expected - 1.0).abs() < TOLERANCE, "{row:?}, expected {expected}");
}

#[test]
fn what_cannot_be_a_grid_is_refused_in_one_line() {
    let folder = scene();
    for (flags, code, message) in [
        (["--group", "roof", "--spacing", "1"], 2, "has \"floor\", \"lamp\""),
        (["--group", "floor", "--spacing", "0"], 2, "expected a length above 0"),
        (["--group", "floor", "--spacing", "1e-9"], 1, "places, expected at most"),
    ] {
        let args = [&["probe-grid", "lamp.obj", "-o", "p.csv"], &flags[..]].concat();
        let run = radiosity(folder.path(), &args);
        assert_eq!(run.code(), code, "{}", run.stderr());
        assert!(run.stderr().contains(message), "{}", run.stderr());
        assert!(!folder.path().join("p.csv").exists());
    }
    std::fs::write(folder.path().join("p.csv"), "x,y,z,nx,ny,nz\n0,0,1,0,0,0\n").unwrap();
    let args = ["solve", "lamp.obj", "--probe", "p.csv", "-o", "p.probe.csv"];
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 1);
    assert!(run.stderr().contains("p.csv:2:11: nz: expected a normal"), "{}", run.stderr());
}
