//! `radiosity form-factors` as a user meets it: tables, messages, exit codes.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// Opposite faces of a cube, and faces that meet (Howell C-11 and C-14 with all sides 1).
const OPPOSITE: f64 = 0.199_824_895_698_387_4;
const BESIDE: f64 = 0.200_043_776_075_403_2;

const NAMES: [&str; 6] = ["floor, old", "ceiling", "south", "north", "west", "the \"red\" one"];

/// The unit cube seen from inside, a named group a face; `faces` of them.
fn cube_obj(faces: usize) -> String {
    let mut text = String::new();
    for i in 0..8 {
        text += &format!("v {} {} {}\n", i & 1, i >> 1 & 1, i >> 2);
    }
    let corners =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    for (name, corners) in NAMES.iter().zip(corners).take(faces) {
        let [a, b, c, d] = corners.map(|i| i + 1);
        text += &format!("g {name}\nf {a} {b} {c}\nf {a} {c} {d}\n");
    }
    text
}

/// The same as one list of triangles.
fn cube_tri() -> String {
    let p = |i: usize| format!("{} {} {}\n", i & 1, i >> 1 & 1, i >> 2);
    let corners =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let mut text = String::new();
    for [a, b, c, d] in corners {
        for t in [[a, b, c], [a, c, d]] {
            text += &format!("Triangle\n100 100 100 0 0 0\n{}", t.map(p).concat());
        }
    }
    text
}

struct Run {
    code: i32,
    stdout: String,
    stderr: String,
}

/// Runs `radiosity form-factors` in a folder.
fn form_factors(folder: &Path, args: &str) -> Run {
    let output = Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .current_dir(folder)
        .arg("form-factors")
        .args(args.split_whitespace())
        .output()
        .unwrap();
    Run {
        code: output.status.code().unwrap(),
        stdout: String::from_utf8(output.stdout).unwrap(),
        stderr: String::from_utf8(output.stderr).unwrap(),
    }
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.obj"), cube_obj(6)).unwrap();
    std::fs::write(folder.path().join("bin.obj"), cube_obj(5)).unwrap();
    std::fs::write(folder.path().join("cube.tri"), cube_tri()).unwrap();
    folder
}

/// The fields of a CSV line, quotes taken off.
fn fields(line: &str) -> Vec<String> {
    let (mut fields, mut quoted) = (vec![String::new()], false);
    let mut characters = line.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                fields.last_mut().unwrap().push('"');
                characters.next();
            }
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    fields
}

/// F and error by the names of both surfaces.
fn table(csv: &str) -> BTreeMap<(String, String), (f64, f64)> {
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("i,j,F,error"));
    let entry = |line: &str| {
        let [i, j, value, error] = <[String; 4]>::try_from(fields(line)).unwrap();
        ((i, j), (value.parse().unwrap(), error.parse().unwrap()))
    };
    lines.map(entry).collect()
}

fn row_sums(table: &BTreeMap<(String, String), (f64, f64)>) -> BTreeMap<&str, f64> {
    let mut sums = BTreeMap::new();
    table.iter().for_each(|((i, _), (value, _))| *sums.entry(i.as_str()).or_default() += value);
    sums
}

#[test]
fn named_groups_are_the_rows_where_a_file_has_them() {
    let folder = folder();
    let run = form_factors(folder.path(), "cube.obj -o F.csv --report F.json");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("form factors between 6 groups of 12 triangles"), "{}", run.stderr);
    assert!(run.stderr.contains("66 pairs of triangles, 60 of them"), "{}", run.stderr);
    let csv = std::fs::read_to_string(folder.path().join("F.csv")).unwrap();
    assert!(csv.contains("\"the \"\"red\"\" one\",\"floor, old\","), "{csv}");
    let table = table(&csv);
    assert_eq!(table.len(), 30, "no face sees itself");
    for ((i, j), (value, error)) in &table {
        let [a, b] = [i, j].map(|name| NAMES.iter().position(|n| n == name).unwrap());
        let exact = if a / 2 == b / 2 { OPPOSITE } else { BESIDE };
        let off = (value - exact).abs();
        assert!(off <= 1e-3 * exact && off <= *error, "{i} → {j}: {value} ± {error}");
    }
    let report = std::fs::read(folder.path().join("F.json")).unwrap();
    let report: Value = serde_json::from_slice(&report).unwrap();
    assert_eq!((&report["schema"], &report["settings"]["between"]), (&1.into(), &"groups".into()));
    assert_eq!((&report["matrix"]["rows"], &report["matrix"]["stored"]), (&6.into(), &30.into()));
    let sums = row_sums(&table);
    let worst = sums.values().map(|sum| (sum - 1.0).abs()).fold(0.0, f64::max);
    let reported = report["raw"]["closure_defect"].as_f64().unwrap();
    assert!((reported - worst).abs() < 1e-14 && reported < 1e-3, "{reported} {worst}");
    assert!(report["closed"].is_null());
}

#[test]
fn triangles_are_the_rows_otherwise() {
    let folder = folder();
    let run = form_factors(folder.path(), "cube.tri -o - --tolerance 1e-6");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("between 12 triangles (the file has one group)"), "{}", run.stderr);
    let of_tri = table(&run.stdout);
    assert_eq!(of_tri.len(), 120);
    assert!(run.stdout.contains("\n0,2,"), "triangles are plain numbers");
    for (name, sum) in row_sums(&of_tri) {
        assert!((sum - 1.0).abs() < 1e-5, "{name}: {sum}");
    }
    // The same scene by another reader.
    let run = form_factors(folder.path(), "cube.obj -o - --between triangles --tolerance 1e-6");
    assert_eq!(table(&run.stdout), of_tri);
}

#[test]
fn the_threads_change_no_byte() {
    let folder = folder();
    let of =
        |threads| form_factors(folder.path(), &format!("cube.tri -o - --threads {threads}")).stdout;
    assert_eq!(of(1), of(3));
}

#[test]
fn arrays_hold_what_the_csv_says() {
    let folder = folder();
    let run = form_factors(folder.path(), "cube.obj -o F.csv -o F.npy -o F.npz");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("written: F.csv, F.npy, F.names.csv, F.npz"), "{}", run.stderr);
    let read = |name: &str| std::fs::read(folder.path().join(name)).unwrap();
    let text = |name: &str| String::from_utf8(read(name)).unwrap();
    let names: Vec<String> =
        text("F.names.csv").lines().skip(1).map(|l| fields(l)[1].clone()).collect();
    assert_eq!(names, NAMES);
    assert!(text("F.names.csv").starts_with("row,name,area\n0,\"floor, old\",1\n"));
    let table = table(&text("F.csv"));
    let npy = read("F.npy");
    let header = String::from_utf8_lossy(&npy[10..128]).into_owned();
    assert!(header.contains("'<f8'") && header.contains("(6,6,)"), "{header}");
    let values: Vec<f64> =
        npy[128..].chunks(8).map(|b| f64::from_le_bytes(b.try_into().unwrap())).collect();
    assert_eq!(values.len(), 36);
    for (k, value) in values.iter().enumerate() {
        let key = (NAMES[k / 6].to_owned(), NAMES[k % 6].to_owned());
        assert_eq!(*value, table.get(&key).map_or(0.0, |(value, _)| *value));
    }
    let npz = read("F.npz");
    for member in ["indices.npy", "indptr.npy", "format.npy", "shape.npy", "data.npy"] {
        assert!(npz.windows(member.len()).any(|w| w == member.as_bytes()), "{member}");
    }
}

#[test]
fn closing_is_for_closed_scenes() {
    let folder = folder();
    let run = form_factors(folder.path(), "cube.tri -o - --close --report F.json --tolerance 1e-2");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("closed: rows off by"), "{}", run.stderr);
    for (name, sum) in row_sums(&table(&run.stdout)) {
        assert!((sum - 1.0).abs() <= 1e-14, "{name}: {sum}");
    }
    let report = std::fs::read(folder.path().join("F.json")).unwrap();
    let closed = &serde_json::from_slice::<Value>(&report).unwrap()["closed"];
    assert!(closed["before"].as_f64().unwrap() > closed["after"].as_f64().unwrap());
    let change = closed["change"].as_f64().unwrap();
    assert!(change > 0.0 && change < 1e-2, "{closed}");

    let run = form_factors(folder.path(), "bin.obj -o open.csv --close");
    assert_eq!(run.code, 1);
    let last = run.stderr.lines().last().unwrap();
    assert!(last.starts_with("radiosity: error: --close: row "), "{last}");
    assert!(last.contains("only closed scenes can be closed"), "{last}");
    assert!(!folder.path().join("open.csv").exists());
    // As it is, it can be written: a fifth of the light leaves by the missing face.
    let run = form_factors(folder.path(), "bin.obj -o -");
    assert_eq!(run.code, 0);
    for (name, sum) in row_sums(&table(&run.stdout)) {
        // The west wall, the fifth face, lies opposite to the missing one.
        let missing = if name == "west" { OPPOSITE } else { BESIDE };
        assert!((sum - (1.0 - missing)).abs() < 1e-3, "{name}: {sum}");
    }
}

#[test]
fn two_sides_are_two_rows() {
    let folder = folder();
    let run = form_factors(folder.path(), "cube.obj -o - --sides both");
    assert_eq!(run.code, 0, "{}", run.stderr);
    assert!(run.stderr.contains("between 12 groups of 24 triangles"), "{}", run.stderr);
    // From outside, a cube's faces see nothing.
    assert_eq!(table(&run.stdout).len(), 30);
    assert!(run.stderr.contains(":back"), "the rows that sum to 0 are named: {}", run.stderr);
}

#[test]
fn what_cannot_be_done_is_said_in_one_line() {
    let folder = folder();
    std::fs::write(folder.path().join("empty.tri"), "").unwrap();
    for (args, code, message) in [
        ("cube.tri", 2, "--output"),
        ("cube.tri -o F.txt", 2, "expected a file name that ends in .csv, .npy or .npz"),
        ("cube.tri -o F.csv -o F.csv", 2, "named twice"),
        ("cube.tri -o F.npy -o F.names.csv", 2, "F.names.csv: named twice"),
        ("cube.tri -o F.csv --tolerance 1e-12", 2, "--tolerance"),
        ("cube.tri -o F.csv --sides paired", 2, "--sides"),
        ("cube.tri -o F.csv --threads 5000", 2, "--threads"),
        ("cube.tri -o nowhere/F.csv", 1, "there is no folder nowhere"),
        ("nothing.tri -o F.csv", 1, "nothing.tri"),
        ("empty.tri -o F.csv", 1, "no surface with area"),
    ] {
        let run = form_factors(folder.path(), args);
        assert_eq!(run.code, code, "{args}: {}", run.stderr);
        assert!(run.stderr.contains(message), "{args}: {}", run.stderr);
        assert!(!folder.path().join("F.csv").exists(), "{args}");
    }
}
