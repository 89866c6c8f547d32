//! The scenes in the folder `shared/` beside the checkout, where there is one.

use std::path::{Path, PathBuf};

use glam::DVec3;

use super::Triangle;

/// Reads `shared/scenes/<name>.tri`; prints a line and returns `None` if it is not there.
pub(crate) fn scene(name: &str) -> Option<Vec<Triangle>> {
    let file = Path::new("shared/scenes").join(name).with_extension("tri");
    let found: Option<PathBuf> = Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .map(|folder| folder.join(&file))
        .find(|path| path.is_file());
    let Some(path) = found else {
        println!("skipped: no {} beside the checkout", file.display());
        return None;
    };
    let text = std::fs::read_to_string(path).expect("a scene file is readable text");
    Some(parse(&text))
}

/// Records are the word `Triangle`, six colours, and three vertices of three numbers, or of six
/// with a normal.
fn parse(text: &str) -> Vec<Triangle> {
    text.split("Triangle")
        .skip(1)
        .map(|record| {
            let numbers: Vec<f64> = record
                .split_whitespace()
                .map(|token| token.parse().expect("a number in a scene file"))
                .collect();
            let stride = match numbers.len() {
                15 => 3,
                24 => 6,
                n => panic!("a record has {n} numbers, expected 15 or 24"),
            };
            [0, 1, 2].map(|v| DVec3::from_slice(&numbers[6 + v * stride..]))
        })
        .collect()
}
