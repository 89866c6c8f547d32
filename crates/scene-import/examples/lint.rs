//! Says what is odd about a scene file of any of the formats, a line for each warning.
//!
//! `cargo run -p radiosity-scene-import --example lint [-- SCENE]...`
//!
//! Without arguments: all bundled scenes. Warnings alone are no failure; a file that cannot be read
//! is, with exit code 1, and so is a linter that misses what is wrong with a scene made to be wrong.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::path::{Path, PathBuf};

use scene_import::{DiagnosticKind, ErrorKind, Imported, Options, open, open_bytes};

/// The most warnings shown of one file.
const SHOWN: usize = 8;

/// A tetrahedron whose last face is wound the wrong way, once more its first face, and a line.
const WRONG: &str = "\
v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1
g body
f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3
f 1 3 2
g line
f 1 2 2
";

fn main() -> Result<(), Box<dyn Error>> {
    check_the_linter()?;
    let mut files: Vec<PathBuf> = std::env::args_os().skip(1).map(PathBuf::from).collect();
    if files.is_empty() {
        files = bundled()?;
    }
    let mut unreadable = 0;
    for file in &files {
        match open(file, &Options::default()) {
            Ok(imported) => show(file, &imported),
            // The others are linted all the same. What this build cannot read says nothing of the file.
            Err(error) => {
                println!("{error}");
                unreadable += u32::from(error.kind() != ErrorKind::FeatureOff);
            }
        }
    }
    match unreadable {
        0 => Ok(()),
        n => Err(format!("{n} of {} files cannot be read", files.len()).into()),
    }
}

fn show(file: &Path, imported: &Imported) {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    println!("{name}: {}", imported.summary);
    for diagnostic in imported.diagnostics.iter().take(SHOWN) {
        println!("  {diagnostic}");
    }
    match imported.diagnostics.len() {
        0 => println!("  nothing odd"),
        n if n > SHOWN => println!("  and {} more", n - SHOWN),
        _ => {}
    }
}

/// Every scene of the folder `scenes`, by name.
fn bundled() -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenes");
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder)? {
        let path = entry?.path();
        let extension = path.extension().unwrap_or_default().to_string_lossy().into_owned();
        files.extend(["tri", "obj", "glb"].contains(&extension.as_str()).then_some(path));
    }
    files.sort();
    Ok(files)
}

/// The scene made to be wrong has to be found so; nothing to do in a build without OBJ.
fn check_the_linter() -> Result<(), Box<dyn Error>> {
    let found = match open_bytes("wrong.obj", WRONG.as_bytes(), &Options::default()) {
        Ok(imported) => imported.diagnostics,
        Err(error) if error.kind() == ErrorKind::FeatureOff => return Ok(()),
        Err(error) => return Err(error.into()),
    };
    let count = |is: fn(&DiagnosticKind) -> bool| found.iter().filter(|d| is(&d.kind)).count();
    let counts = [
        count(|kind| matches!(kind, DiagnosticKind::ReversedWinding)),
        count(|kind| matches!(kind, DiagnosticKind::Duplicate { .. })),
        count(|kind| matches!(kind, DiagnosticKind::Degenerate)),
    ];
    if counts == [1, 1, 1] { Ok(()) } else { Err(format!("the linter found {found:?}").into()) }
}
