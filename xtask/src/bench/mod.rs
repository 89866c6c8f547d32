//! `cargo xtask bench`: a matrix of solves, measured, checked, and made into a report.
//!
//! Every run is a process of its own that times itself, started as a user starts it; its time
//! counts only if its result is right. Runs are kept as they are made, a line each, in
//! `docs/bench/<date>-<host>/records.jsonl`; charts, page and `report.html` beside it are drawn from
//! that alone. What is interrupted goes on where it was.

mod against;
mod amdahl;
mod cell;
mod chart;
mod check;
mod fit;
mod group;
mod host;
mod html;
mod markdown;
mod matrix;
mod others;
mod record;
mod rounds;
mod scene;
mod section;
mod threads;

#[cfg(test)]
mod sample;

use std::fs;
use std::io::Write;
use std::num::NonZero;
use std::path::{Path, PathBuf};

use crate::precision::numbers::percent;
use crate::precision::{self, Machine, Program};
use crate::share::share;
use cell::{Accel, Cell, Method};
use host::Host;
use matrix::{Asked, Study};
use record::{Book, Outcome};
use scene::Scene;
use threads::Threads;

/// Where records and reports are kept.
const FOLDER: &str = "docs/bench";

/// Where glances go: `--quick`, and runs that are only held against others.
const PASSING: &str = "out/bench";

/// The files that are drawn beside charts.
const PAGE: &str = "README.md";
const REPORT: &str = "report.html";

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Numbers of threads, both ends of a range included: `1..24`, `1,2,4`; 1 is always among
    /// them. Studies of other things take the most that has a core for each [default: 1 to the
    /// machine's cores]
    #[arg(long, value_name = "LIST")]
    threads: Option<Threads>,

    /// Only these questions
    #[arg(long = "study", value_name = "LIST", value_enum, value_delimiter = ',')]
    studies: Vec<Study>,

    /// Only these scenes
    #[arg(long, value_name = "LIST", value_enum, value_delimiter = ',')]
    scenes: Vec<Scene>,

    /// Elements of fixed meshes, about, in place of those of each study
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    elements: Vec<NonZero<usize>>,

    /// Ways to find the light, in place of those of each study
    #[arg(long, value_name = "LIST", value_enum, value_delimiter = ',')]
    methods: Vec<Method>,

    /// How shooters follow each other, passed on to the program: `auto,single,multi:4`
    /// [default: as the program does]
    #[arg(long = "schedule", value_name = "LIST", value_delimiter = ',')]
    schedules: Vec<String>,

    /// How loops are shared out, passed on to the program: `tasks,static,dynamic:1,guided:1`
    /// [default: these in the study of threads, elsewhere as the program does]
    #[arg(long = "loop", value_name = "LIST", value_delimiter = ',')]
    loops: Vec<String>,

    /// What finds occluders [default: both in the study of occluders, elsewhere as the program
    /// does]
    #[arg(long, value_name = "LIST", value_enum, value_delimiter = ',')]
    accel: Vec<Accel>,

    /// Runs of each cell
    #[arg(long, value_name = "N", default_value = "5")]
    repeat: NonZero<usize>,

    /// Two scenes with coarse meshes, in less than two minutes, into out/bench
    #[arg(long)]
    quick: bool,

    /// Run nothing: list the cells, a command line each
    #[arg(long)]
    list: bool,

    /// Run nothing: draw again what the folder of --out holds, or every folder of docs/bench
    #[arg(long, conflicts_with_all = ["list", "quick", "against", "fresh", "threads"])]
    draw: bool,

    /// Keep records there [default: docs/bench/DATE-HOST]
    #[arg(long, value_name = "FOLDER")]
    out: Option<PathBuf>,

    /// Call this machine so [default: as it calls itself]
    #[arg(long, value_name = "NAME")]
    host: Option<String>,

    /// Leave out the records that the folder holds, instead of going on with them
    #[arg(long)]
    fresh: bool,

    /// Say what became faster or slower than in these records, a folder; without other flags, runs
    /// the cells that they have. Fails where something became slower
    #[arg(long, value_name = "RECORD")]
    against: Option<PathBuf>,

    /// What --against lets pass, as 0.1 or 10%, beyond the noise
    #[arg(long, value_name = "SHARE", default_value = "5%", value_parser = share)]
    threshold: f64,
}

/// Lists, draws, or measures.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    if arguments.draw {
        return draw_kept(root, arguments.out.as_deref());
    }
    let before = arguments.against.as_deref().map(Book::read).transpose()?;
    let machine = Machine::this();
    let cells = match &before {
        Some(before) if arguments.asks_for_nothing() => cells_of(before),
        _ => arguments.asked().cells(root, machine.cores),
    };
    say_threads(&cells, &machine);
    let rounds = arguments.repeat.get();
    println!("{} cells, {rounds} runs of each", cells.len());
    if arguments.list {
        let mut out = std::io::stdout().lock();
        for cell in &cells {
            let (scene, settings) = (cell.scene.path(root), cell.settings().join(" "));
            let at_once = if cell.programs > 1 { " (at once)" } else { "" };
            let line = format!("{} × radiosity solve {scene} {settings}{at_once}", cell.programs);
            // Who has read enough closes the pipe.
            if writeln!(out, "{line}").is_err() {
                break;
            }
        }
        return Ok(());
    }
    let program = Program::build(root, "bench")?;
    let host = Host::this(root, &program, arguments.host.as_deref())?;
    let folder = arguments.folder(root, &host);
    let mut book = Book::open(&folder, host, arguments.fresh)?;
    println!("records: {}, {} runs there already", folder.display(), book.records.len());
    rounds::run(&mut book, &program, root, &cells, rounds)?;
    draw(&folder, &book)?;
    if let Some(before) = &before {
        let compared = against::compare(before, &book, arguments.threshold);
        println!("{}", compared.text);
        if compared.regressions > 0 {
            return Err(format!("slower by more than {}", percent(arguments.threshold)));
        }
    }
    let refused = book.records.iter().filter(|r| matches!(r.outcome, Outcome::Refused(_))).count();
    if refused > 0 { Err(format!("{refused} runs do not count")) } else { Ok(()) }
}

/// What an earlier matrix was made of.
fn cells_of(book: &Book) -> Vec<Cell> {
    let mut cells: Vec<Cell> = Vec::new();
    for record in &book.records {
        if !cells.contains(&record.cell) {
            cells.push(record.cell.clone());
        }
    }
    cells
}

/// Says which numbers of threads there are, and which of them have to share cores.
fn say_threads(cells: &[Cell], machine: &Machine) {
    let mut threads: Vec<usize> = cells.iter().map(|cell| cell.threads).collect();
    threads.sort_unstable();
    threads.dedup();
    let words =
        |threads: &[usize]| threads.iter().map(usize::to_string).collect::<Vec<_>>().join(", ");
    println!("threads: {}, of {} cores of {}", words(&threads), machine.cores, machine.cpu);
    threads.retain(|threads| *threads > machine.cores);
    if !threads.is_empty() {
        println!(
            "warning: {} threads have no core for each: they show whether threads get into each \
             other's way, not how the program scales",
            words(&threads)
        );
    }
}

impl Arguments {
    /// Whether the matrix is left to the records that are compared with.
    fn asks_for_nothing(&self) -> bool {
        let Asked { studies, scenes, elements, methods, schedules, loops, accels, threads, quick } =
            self.asked();
        studies.is_empty()
            && scenes.is_empty()
            && elements.is_empty()
            && methods.is_empty()
            && schedules.is_empty()
            && loops.is_empty()
            && accels.is_empty()
            && threads.is_none()
            && !quick
    }

    fn asked(&self) -> Asked {
        Asked {
            studies: self.studies.clone(),
            scenes: self.scenes.clone(),
            elements: self.elements.iter().map(|n| n.get()).collect(),
            methods: self.methods.clone(),
            schedules: self.schedules.clone(),
            loops: self.loops.clone(),
            accels: self.accel.clone(),
            threads: self.threads.clone(),
            quick: self.quick,
        }
    }

    /// Where records are kept. A folder for each program where they are held against others: those
    /// of one day are of several.
    fn folder(&self, root: &Path, host: &Host) -> PathBuf {
        match &self.out {
            Some(out) => out.clone(),
            None if self.quick || self.against.is_some() => {
                root.join(PASSING).join(format!("{}-{}", host.revision, host.program))
            }
            None => root.join(FOLDER).join(host.folder()),
        }
    }
}

/// Draws what a folder holds, or what each folder of docs/bench does.
fn draw_kept(root: &Path, out: Option<&Path>) -> Result<(), String> {
    let folders = match out {
        Some(folder) => vec![folder.to_owned()],
        None => kept(root)?,
    };
    folders.iter().try_for_each(|folder| draw(folder, &Book::read(folder)?))
}

/// The folders of docs/bench.
fn kept(root: &Path) -> Result<Vec<PathBuf>, String> {
    let folder = root.join(FOLDER);
    let failed = |e: std::io::Error| format!("{}: {e}", folder.display());
    let mut folders = Vec::new();
    for entry in fs::read_dir(&folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        if path.join(record::HOST).exists() {
            folders.push(path);
        }
    }
    folders.sort();
    Ok(folders)
}

/// Writes everything that follows from the records, and takes away charts that no longer do.
fn draw(folder: &Path, book: &Book) -> Result<(), String> {
    let files = drawn(book)?;
    let failed = |e: std::io::Error| format!("{}: {e}", folder.display());
    for entry in fs::read_dir(folder).map_err(failed)? {
        let path = entry.map_err(failed)?.path();
        let is_chart = path.extension().is_some_and(|extension| extension == "svg");
        let current = files.iter().any(|(name, _)| path.file_name() == Some(name.as_ref()));
        if is_chart && !current {
            fs::remove_file(&path).map_err(failed)?;
        }
    }
    for (name, text) in &files {
        precision::write(&folder.join(name), text)?;
    }
    println!("{}: {} files", folder.join(REPORT).display(), files.len());
    Ok(())
}

/// The files that follow from records: name in their folder, and text.
fn drawn(book: &Book) -> Result<Vec<(String, String)>, String> {
    let title = format!("Benchmarks on {}, {}", book.host.host, book.host.date);
    let head = section::head(&book.host, &book.records);
    let sections = section::all(&book.host, &book.records)?;
    let mut files = vec![
        (PAGE.to_owned(), markdown::page(&title, &head, &sections)),
        (REPORT.to_owned(), html::page(&title, &head, &sections)),
    ];
    let charts = sections.into_iter().flat_map(|section| section.charts);
    files.extend(charts.map(|chart| (chart.file, chart.svg)));
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
        let line = "--threads 1..3 --loop static,dynamic:1 --schedule multi:4 --scenes blocks,room \
                    --elements 500,1000 --methods plain,mesh --accel octree --study threads";
        let asked = parsed(line).unwrap().asked();
        assert_eq!(asked.threads.as_ref().unwrap().to_string(), "1, 2, 3");
        assert_eq!(asked.loops, ["static", "dynamic:1"]);
        assert_eq!(asked.schedules, ["multi:4"]);
        assert_eq!(asked.scenes, [Scene::Blocks, Scene::Room]);
        assert_eq!(asked.elements, [500, 1000]);
        assert_eq!(asked.methods, [Method::Plain, Method::Mesh]);
        assert_eq!((asked.accels, asked.studies), (vec![Accel::Octree], vec![Study::Threads]));
    }

    #[test]
    fn what_cannot_be_run_is_refused() {
        for line in [
            "--threads 0",
            "--threads 4..1",
            "--repeat 0",
            "--elements 0",
            "--scenes sofa",
            "--threshold -1",
            "--threshold x%",
            "--draw --quick",
        ] {
            assert!(parsed(line).is_err(), "{line}");
        }
        assert_eq!(parsed("--threshold 10%").unwrap().threshold, 0.1);
    }

    #[test]
    fn records_to_compare_with_say_what_to_run() {
        assert!(parsed("--against a --repeat 3 --threshold 0.1").unwrap().asks_for_nothing());
        for axis in ["--quick", "--threads 2", "--scenes room", "--accel bvh", "--study growth"] {
            assert!(!parsed(&format!("--against a {axis}")).unwrap().asks_for_nothing(), "{axis}");
        }
    }

    #[test]
    fn glances_lie_apart() {
        let (root, host) = (Path::new("/r"), sample::host());
        let folder = |line: &str| parsed(line).unwrap().folder(root, &host);
        assert_eq!(folder(""), Path::new("/r/docs/bench/2026-01-31-some-host"));
        for line in ["--quick", "--against a"] {
            assert_eq!(folder(line), Path::new("/r/out/bench/0123abc-89abcdef"), "{line}");
        }
        assert_eq!(folder("--quick --out here"), Path::new("here"));
    }

    /// The committed reports follow from the committed records, and none is left over from earlier
    /// ones.
    #[test]
    fn reports_are_current() {
        for folder in kept(&crate::root()).unwrap() {
            let files = drawn(&Book::read(&folder).unwrap()).unwrap();
            for (name, text) in &files {
                let found = fs::read_to_string(folder.join(name)).unwrap_or_default();
                assert!(found == *text, "{name}: run `cargo xtask bench --draw`");
            }
            // Those drawn, the list and the machine.
            let there = fs::read_dir(&folder).unwrap().count();
            assert_eq!(there, files.len() + 2, "{}", folder.display());
        }
    }
}
