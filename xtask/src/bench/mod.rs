//! `cargo xtask bench`: how the run time of a solve falls with the number of threads.
//!
//! Every scene is solved with every number of threads by the release program as a user starts
//! it, and every solution must be the same to the last byte. What was measured is kept as
//! `docs/performance/scaling.json`; the diagrams beside it and the tables of
//! `docs/performance/scaling.md` are drawn from that alone.

mod amdahl;
mod diagram;
mod measurement;
mod others;
mod page;
mod rounds;
mod scene;
mod threads;

#[cfg(test)]
mod sample;

use std::fs;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use crate::precision::{self, Machine, Program};
use measurement::Measurement;
use rounds::Plan;
use scene::Scene;
use threads::Threads;

/// Where the measurement, its diagrams and the page that shows them are kept.
const FOLDER: &str = "docs/performance";
const DATA: &str = "scaling.json";
const PAGE: &str = "scaling.md";

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Numbers of threads, both ends of a range included: `1..24`, `1,2,4`; 1 is always among
    /// them [default: 1 to the machine's cores]
    #[arg(long, value_name = "LIST")]
    threads: Option<Threads>,

    /// How loops are shared out, passed on to the program: `static,dynamic:1,guided:1,tasks`
    /// [default: as the program does]
    #[arg(long = "loop", value_name = "LIST", value_delimiter = ',')]
    loops: Vec<String>,

    /// How shooters follow each other, passed on to the program: `single,multi:4`
    /// [default: as the program does]
    #[arg(long = "schedule", value_name = "LIST", value_delimiter = ',')]
    schedules: Vec<String>,

    /// Only these
    #[arg(long = "scene", value_name = "NAME", value_enum, value_delimiter = ',')]
    scenes: Vec<Scene>,

    /// Rounds: runs of each configuration
    #[arg(long, value_name = "N", default_value = "5")]
    runs: NonZero<usize>,

    /// Elements of each mesh, about
    #[arg(long, value_name = "N", default_value = "20000")]
    elements: NonZero<usize>,

    /// Run nothing: draw again what the folder holds
    #[arg(
        long,
        conflicts_with_all = ["threads", "loops", "schedules", "scenes", "runs", "elements"]
    )]
    draw: bool,

    /// Write there [default: docs/performance]
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,
}

/// Measures and draws, or draws alone.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    let folder = arguments.out.clone().unwrap_or_else(|| root.join(FOLDER));
    if !arguments.draw {
        measure(root, arguments)?.write(&folder.join(DATA))?;
    }
    let path = folder.join(DATA);
    let measurement = Measurement::read(&path)?;
    for (name, text) in drawn(&folder, &measurement)? {
        let path = folder.join(name);
        precision::write(&path, &text)?;
        println!("{}: {} bytes", path.display(), text.len());
    }
    Ok(())
}

/// Runs everything that is asked for.
fn measure(root: &Path, arguments: &Arguments) -> Result<Measurement, String> {
    let machine = Machine::this();
    let threads = arguments.threads.clone().unwrap_or_else(|| Threads::up_to(machine.cores));
    println!("threads: {threads}, of {} cores of {}", machine.cores, machine.cpu);
    let elements = arguments.elements.get();
    let plan = Plan {
        elements,
        modes: rounds::modes(&arguments.loops, &arguments.schedules),
        threads,
        runs: arguments.runs.get(),
    };
    let program = Program::build(root, "bench")?;
    let scenes = arguments.scenes().map(|scene| plan.measure(&program, root, scene, machine.cores));
    Ok(Measurement { scenes: scenes.collect::<Result<_, _>>()?, machine, elements })
}

impl Arguments {
    /// What is asked for, once each; all where nothing is.
    fn scenes(&self) -> impl Iterator<Item = Scene> {
        let asked = |s: &Scene| self.scenes.is_empty() || self.scenes.contains(s);
        Scene::ALL.into_iter().filter(asked)
    }
}

/// The files that follow from a measurement: name in its folder, and text.
fn drawn(folder: &Path, measurement: &Measurement) -> Result<Vec<(String, String)>, String> {
    let mut files = Vec::new();
    for solved in &measurement.scenes {
        let figure = diagram::of(solved, &measurement.machine);
        files.push((solved.scene.diagram_name(), figure.svg()?));
    }
    let path = folder.join(PAGE);
    let text = if path.exists() {
        fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?
    } else {
        page::EMPTY.to_owned()
    };
    let page = page::renewed(&text, measurement).map_err(|e| format!("{}: {e}", path.display()))?;
    files.push((PAGE.to_owned(), page));
    Ok(files)
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Line {
        #[command(flatten)]
        arguments: Arguments,
    }

    fn parsed(line: &str) -> Result<Arguments, String> {
        let words = std::iter::once("bench").chain(line.split_whitespace());
        Line::try_parse_from(words).map(|line| line.arguments).map_err(|e| e.to_string())
    }

    #[test]
    fn lists_are_split_and_ranges_resolved() {
        let line = "--threads 1..3 --loop static,dynamic:1 --schedule multi:4 --scene blocks,room";
        let arguments = parsed(line).unwrap();
        assert_eq!(arguments.threads.as_ref().unwrap().to_string(), "1, 2, 3");
        assert_eq!(arguments.loops, ["static", "dynamic:1"]);
        assert_eq!(arguments.schedules, ["multi:4"]);
        assert_eq!(arguments.scenes().collect::<Vec<_>>(), [Scene::Room, Scene::Blocks]);
        let bare = parsed("").unwrap();
        assert_eq!((bare.runs.get(), bare.elements.get()), (5, 20_000));
        assert_eq!(bare.scenes().count(), Scene::ALL.len());
    }

    #[test]
    fn what_cannot_be_run_is_refused() {
        for line in ["--threads 0", "--threads 4..1", "--runs 0", "--elements 0", "--scene sofa"] {
            assert!(parsed(line).is_err(), "{line}");
        }
        for flag in ["--threads 2", "--loop static", "--scene room", "--runs 3"] {
            assert!(parsed(&format!("--draw {flag}")).is_err(), "{flag}");
        }
        assert!(parsed("--draw --out some/folder").unwrap().draw);
    }

    /// The committed diagrams and tables follow from the committed measurement, and none is left
    /// over from an earlier one.
    #[test]
    fn diagrams_and_tables_are_current() {
        let folder = crate::root().join(FOLDER);
        let measurement = Measurement::read(&folder.join(DATA)).unwrap();
        let files = drawn(&folder, &measurement).unwrap();
        for (name, text) in &files {
            let found = fs::read_to_string(folder.join(name)).unwrap_or_default();
            assert!(found == *text, "{name}: run `cargo xtask bench --draw`");
        }
        for scene in Scene::ALL {
            let name = scene.diagram_name();
            let expected = files.iter().any(|(drawn, _)| *drawn == name);
            assert_eq!(folder.join(&name).exists(), expected, "{name}");
        }
    }

    /// Elsewhere than in docs there is no page yet.
    #[test]
    fn a_folder_without_a_page_gets_one() {
        let files = drawn(Path::new("/nonexistent"), &sample::measurement()).unwrap();
        let (name, page) = files.last().unwrap();
        assert_eq!(name, PAGE);
        assert!(page.contains("### Room") && page.contains("serial share"), "{page}");
    }
}
