//! `cargo xtask precision`: how much time the program needs for how little error.
//!
//! Every scene that has a reference is solved in several ways, each several times, by the
//! release program as a user starts it. What was measured is kept as JSON in `docs/precision`;
//! the diagrams beside it and the tables of `docs/precision.md` are drawn from that alone.

pub(crate) mod blocks;
mod diagram;
mod measurement;
pub(crate) mod numbers;
mod page;
mod plan;
mod program;
pub(crate) mod statistics;
mod subject;

#[cfg(test)]
pub(crate) mod sample;

use std::fs;
use std::path::Path;

pub(crate) use measurement::{Errors, Machine, Measurement, Stated, Work};
use plan::Plan;
pub(crate) use program::{Program, Said};
pub(crate) use subject::Subject;

/// Where measurements and diagrams are kept, and the page that shows them.
const FOLDER: &str = "docs/precision";
const PAGE: &str = "docs/precision.md";

/// Where `--quick` writes: a glance, not a measurement.
const QUICK_FOLDER: &str = "out/precision";

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Only these
    #[arg(long, value_enum, value_delimiter = ',')]
    scenes: Vec<Subject>,

    /// Coarse settings, one run each, into out/precision
    #[arg(long)]
    quick: bool,

    /// Threads of the program; 0 for as many as the machine has
    #[arg(long, value_name = "N", default_value_t = 0)]
    threads: usize,

    /// Run nothing: draw again what docs/precision holds
    #[arg(long, conflicts_with_all = ["quick", "scenes", "threads"])]
    draw: bool,
}

/// Measures and draws, or draws alone.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    if arguments.draw {
        return draw(root);
    }
    let subjects: Vec<_> = arguments.subjects().filter(|s| s.is_there(root)).collect();
    if subjects.is_empty() {
        return Ok(());
    }
    let program = Program::build(root, "precision")?;
    let plan = if arguments.quick { Plan::quick() } else { Plan::full() };
    let folder = root.join(if arguments.quick { QUICK_FOLDER } else { FOLDER });
    for subject in subjects {
        let measurement = plan.measure(&program, subject, arguments.threads)?;
        measurement.write(&folder.join(subject.file_name("json")))?;
        if arguments.quick {
            write(&folder.join(subject.file_name("svg")), &diagram::of(&measurement).svg()?)?;
            println!("\n{}", page::scene_block(&measurement, QUICK_FOLDER));
        }
    }
    if arguments.quick { Ok(()) } else { draw(root) }
}

impl Arguments {
    /// What is asked for, once each; all where nothing is.
    fn subjects(&self) -> impl Iterator<Item = Subject> {
        let asked = |s: &Subject| self.scenes.is_empty() || self.scenes.contains(s);
        Subject::ALL.into_iter().filter(asked)
    }
}

/// Draws every measurement that is kept, and renews the page's tables.
fn draw(root: &Path) -> Result<(), String> {
    for (name, text) in drawn(root)? {
        write(&root.join(&name), &text)?;
        println!("{name}: {} bytes", text.len());
    }
    Ok(())
}

/// The files that follow from the kept measurements: path from the root, and text.
fn drawn(root: &Path) -> Result<Vec<(String, String)>, String> {
    let measurements = measurements(root)?;
    let mut files = Vec::new();
    for measurement in &measurements {
        let name = format!("{FOLDER}/{}", measurement.subject.file_name("svg"));
        files.push((name, diagram::of(measurement).svg()?));
    }
    let path = root.join(PAGE);
    let page = fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    files.push((PAGE.to_owned(), page::renewed(&page, &measurements)?));
    Ok(files)
}

/// The kept measurements, in the order of the subjects.
pub(crate) fn measurements(root: &Path) -> Result<Vec<Measurement>, String> {
    let paths = Subject::ALL.map(|s| root.join(FOLDER).join(s.file_name("json")));
    paths.iter().filter(|path| path.exists()).map(|path| Measurement::read(path)).collect()
}

/// Writes a text, and the folder it lies in.
pub(crate) fn write(path: &Path, text: &str) -> Result<(), String> {
    let failed = |e: std::io::Error| format!("{}: {e}", path.display());
    if let Some(folder) = path.parent() {
        fs::create_dir_all(folder).map_err(failed)?;
    }
    fs::write(path, text).map_err(failed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The committed diagrams and tables follow from the committed measurements.
    #[test]
    fn diagrams_and_tables_are_current() {
        let root = crate::root();
        for (name, text) in drawn(&root).unwrap() {
            let found = fs::read_to_string(root.join(&name)).unwrap_or_default();
            assert!(found == text, "{name}: run `cargo xtask precision --draw`");
        }
    }
}
