//! `cargo xtask numerics`: the figures of `docs/numerics.md`.
//!
//! Two examples print what they measure as CSV, which is kept in `docs/numerics`; a third
//! figure follows from the measurements of `cargo xtask precision`.

mod estimators;
mod stated;
mod sweeps;
mod table;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::figure::Figure;
use crate::precision::{self, Machine};
use table::Table;

/// Where tables and figures are kept.
const FOLDER: &str = "docs/numerics";

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Run nothing: draw again what docs/numerics and docs/precision hold
    #[arg(long)]
    draw: bool,
}

/// An example that prints CSV, and the figure of it.
struct Source {
    package: &'static str,
    /// Of the example, its table and its figure.
    name: &'static str,
    figure: fn(&Table) -> Result<Figure, String>,
}

const SOURCES: [Source; 2] = [
    Source { package: "form-factor", name: "estimators", figure: estimators::figure },
    Source { package: "conformance", name: "sweeps", figure: sweeps::figure },
];

/// Measures and draws, or draws alone.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    if !arguments.draw {
        for source in &SOURCES {
            let text = format!("# {}\n{}", Machine::this().cpu, source.measure(root)?);
            precision::write(&root.join(source.file("csv")), &text)?;
        }
    }
    for (name, text) in drawn(root)? {
        precision::write(&root.join(&name), &text)?;
        println!("{name}: {} bytes", text.len());
    }
    Ok(())
}

/// The figures that follow from what is kept: path from the root, and text.
fn drawn(root: &Path) -> Result<Vec<(String, String)>, String> {
    let mut files = Vec::new();
    for source in &SOURCES {
        let path = root.join(source.file("csv"));
        if !path.exists() {
            println!("{}: skipped, since it is not there", source.file("csv"));
            continue;
        }
        let failed = |e: String| format!("{}: {e}", path.display());
        let text = fs::read_to_string(&path).map_err(|e| failed(e.to_string()))?;
        let figure = Table::parse(&text).and_then(|table| (source.figure)(&table));
        files.push((source.file("svg"), figure.map_err(failed)?.svg()?));
    }
    let measurements = precision::measurements(root)?;
    if measurements.is_empty() {
        println!("{FOLDER}/stated.svg: skipped, since docs/precision holds no measurement");
    } else {
        let figure = stated::figure(&measurements);
        files.push((format!("{FOLDER}/stated.svg"), figure.svg()?));
    }
    Ok(files)
}

impl Source {
    /// A file's path from the root.
    fn file(&self, extension: &str) -> String {
        format!("{FOLDER}/{}.{extension}", self.name)
    }

    /// Runs the example, and gives what it prints.
    fn measure(&self, root: &Path) -> Result<String, String> {
        let cargo = std::env::var("CARGO").unwrap_or_else(|_| "cargo".into());
        let words = format!("run --release --package {} --example {}", self.package, self.name);
        println!("$ cargo {words}");
        let mut command = Command::new(cargo);
        command.current_dir(root).args(words.split(' ')).stderr(Stdio::inherit());
        let output = command.output().map_err(|e| format!("cargo {words}: {e}"))?;
        if !output.status.success() {
            return Err(format!("failed: cargo {words}"));
        }
        String::from_utf8(output.stdout).map_err(|e| format!("cargo {words}: {e}"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The committed figures follow from the committed tables.
    #[test]
    fn figures_are_current() {
        let root = crate::root();
        for (name, text) in drawn(&root).unwrap() {
            let found = fs::read_to_string(root.join(&name)).unwrap_or_default();
            assert!(found == text, "{name}: run `cargo xtask numerics --draw`");
        }
    }
}
