//! Memory grows with elements and triangles as docs/performance/memory.md says, and no faster.
//!
//! Skipped with a line where the system does not tell how large a program was.

#![expect(clippy::print_stdout, reason = "tests say what they saw, and that they are skipped")]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

#[path = "cli/support.rs"]
mod support;

use std::path::Path;

use serde_json::Value;

use support::{box_tri, folder_with, radiosity};

/// Bytes of an element of a fixed mesh, of a triangle that blocks, and of a triangle's own patch: the
/// upper bounds of docs/performance/memory.md.
const PER_ELEMENT: f64 = 450.0;
const PER_TRIANGLE: f64 = 800.0;
const PER_PIECE: f64 = 500.0;

/// The largest resident size of a solve, and its elements.
fn peak(folder: &Path, scene: &str, flags: &str) -> Option<[f64; 2]> {
    let mut args = vec!["solve", scene, "--no-statement", "--report", "r.json"];
    args.extend(flags.split(' '));
    let run = radiosity(folder, &args);
    assert_eq!(run.code(), 0, "{}{}", run.stdout(), run.stderr());
    let text = std::fs::read_to_string(folder.join("r.json")).unwrap();
    let report: Value = serde_json::from_str(&text).unwrap();
    let number = |value: &Value| value.as_f64();
    let found = number(&report["memory"]["peak"]).zip(number(&report["mesh"]["elements"]));
    if found.is_none() {
        println!("skipped: this system does not tell the size of a program");
    }
    found.map(|(peak, elements)| [peak, elements])
}

#[test]
fn an_element_takes_no_more_than_is_stated_and_a_million_less_than_a_gibibyte() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let of = |n: usize, need: &str| {
        let flags = format!("--elements {n} --converge 97% --need {need} --threads 2");
        peak(folder.path(), "box.tri", &flags)
    };
    for need in ["auto", "everything"] {
        let sizes = [100_000, 300_000, 1_000_000].map(|n| of(n, need));
        let [Some(few), Some(some), Some(many)] = sizes else { return };
        for [a, b] in [[few, some], [some, many]] {
            let each = (b[0] - a[0]) / (b[1] - a[1]);
            println!("{need}: {each:.0} bytes an element up to {}", b[1]);
            assert!(each < PER_ELEMENT, "{need}: {each}");
        }
        assert!(many[1] == 1e6 && many[0] < f64::from(1 << 30), "{need}: {many:?}");
    }
}

/// A plain of n × n squares below a lamp, with a fold in each square so that all may block.
fn plain(n: usize) -> String {
    let mut text = String::new();
    let mut quad = |colours: &str, [a, b, c, d]: [[f64; 3]; 4]| {
        for corners in [[a, b, c], [a, c, d]] {
            text += &format!("Triangle\n{colours}\n");
            corners.iter().for_each(|[x, y, z]| text += &format!("{x} {y} {z}\n"));
        }
    };
    let height = |i: usize, j: usize| ((i * 7 + j * 3) % 5) as f64 * 0.1;
    let at = |i: usize, j: usize| [i as f64, j as f64, height(i, j)];
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        quad("150 150 100 0 0 0", [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
    }
    let lamp = [[1.0, 1.0, 9.0], [1.0, 5.0, 9.0], [5.0, 5.0, 9.0], [5.0, 1.0, 9.0]];
    quad("255 255 255 255 255 255", lamp);
    text
}

#[test]
fn a_triangle_takes_no_more_than_is_stated() {
    let sizes = [60usize, 120].map(|n| {
        let (folder, _) = folder_with("plain.tri", plain(n).as_bytes());
        peak(folder.path(), "plain.tri", "--elements 1 --converge 99%")
    });
    let [Some(few), Some(many)] = sizes else { return };
    // One element and one patch each.
    let each = (many[0] - few[0]) / (many[1] - few[1]);
    println!("{each:.0} bytes a triangle with its patch and its element");
    assert!(each < PER_TRIANGLE + PER_PIECE + PER_ELEMENT, "{each}");
}
