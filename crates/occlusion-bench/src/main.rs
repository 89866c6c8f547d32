//! `cargo run --release -p occlusion-bench`: the tables.
#![forbid(unsafe_code)]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "this program prints a table")]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use occlusion_bench::techniques::{answer_uncounted, compare, count, techniques_markdown};
use occlusion_bench::{
    CONTENDERS, Contender, EmbreeLibrary, Kind, LIBRARY_VARIABLE, Limits, SCENES, SceneError,
    Structures, csv, markdown, measure, workload,
};

/// Measures accel's structures, obvhs and Embree on the same segments, on one thread.
#[derive(Parser)]
#[command(version, args_conflicts_with_subcommands = true)]
struct Args {
    #[command(subcommand)]
    command: Option<Other>,
    /// Scenes, by name or as paths of .tri files.
    #[arg(long, value_delimiter = ',', default_values_t = SCENES.map(str::to_owned))]
    scenes: Vec<String>,
    /// Structures, by the beginning of their names; all, if none is given.
    #[arg(long, value_delimiter = ',')]
    structures: Vec<String>,
    /// Segments of each kind.
    #[arg(long, default_value_t = 1_000_000)]
    segments: usize,
    /// Rounds of all structures, at most.
    #[arg(long, default_value_t = 15)]
    runs: usize,
    /// Seconds after which no new round begins, for each scene and kind of segments.
    #[arg(long, default_value_t = 60.0)]
    seconds: f64,
    /// Seconds for the repeated builds of each structure.
    #[arg(long, default_value_t = 3.0)]
    build_seconds: f64,
    /// Leaves out the random segments.
    #[arg(long)]
    no_random: bool,
    /// Writes all rows there as comma-separated values.
    #[arg(long)]
    csv: Option<PathBuf>,
    /// Writes all rows there as one Markdown table.
    #[arg(long)]
    markdown: Option<PathBuf>,
}

#[derive(Subcommand)]
enum Other {
    /// Measures the techniques of an octree with 3D-DDA, each on and off.
    Techniques(Techniques),
}

#[derive(clap::Args)]
struct Techniques {
    /// Scenes, by name or as paths of .tri files.
    #[arg(long, value_delimiter = ',', default_values_t = ["room", "hall", "church"].map(str::to_owned))]
    scenes: Vec<String>,
    /// Segments, from sources to the vertices that face them.
    #[arg(long, default_value_t = 50_000)]
    segments: usize,
    /// Seconds after which no new round begins, for each scene.
    #[arg(long, default_value_t = 20.0)]
    seconds: f64,
    /// Counts instructions too, with valgrind's callgrind.
    #[arg(long)]
    instructions: bool,
    /// Builds and asks this variant alone, once and without a clock, for a profiler.
    #[arg(long)]
    only: Option<String>,
    /// Writes the tables there, too.
    #[arg(long)]
    markdown: Option<PathBuf>,
}

fn main() -> ExitCode {
    let args = Args::parse();
    let result = match &args.command {
        Some(Other::Techniques(args)) => techniques(args),
        None => run(&args),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(args: &Args) -> Result<(), String> {
    let contenders = chosen(&args.structures)?;
    let library = EmbreeLibrary::load()
        .inspect_err(|error| {
            println!(
                "{error} (put the path of libembree4 from `pip download embreex` or Debian's \
                 libembree4 into {LIBRARY_VARIABLE}); going on without it"
            );
        })
        .ok();
    let limits = Limits { runs: args.runs, seconds: args.seconds };
    let mut all = Vec::new();
    for scene in &args.scenes {
        let workload = match workload(scene, args.segments) {
            Ok(workload) => workload,
            Err(error @ SceneError::Absent(_)) => {
                println!("{scene} is skipped: {error}");
                continue;
            }
            Err(error) => return Err(error.to_string()),
        };
        let triangles = &workload.occluders;
        let structures =
            Structures::build(&contenders, triangles, library.as_ref(), args.build_seconds);
        for kind in [Kind::Shooting, Kind::Random] {
            if kind == Kind::Random && args.no_random {
                continue;
            }
            let rows = measure(scene, &workload, kind, &contenders, &structures, &limits);
            if let Some(row) = rows.first() {
                let share = 100.0 * row.blocked as f64 / row.segments.max(1) as f64;
                println!(
                    "\n{scene}: {} segments, {share:.0} % blocked, {} rounds\n",
                    row.segments, row.runs
                );
                print!("{}", markdown(&rows));
            }
            all.extend(rows);
        }
    }
    write(args.csv.as_deref(), &csv(&all))?;
    write(args.markdown.as_deref(), &markdown(&all))
}

/// Segments asked under callgrind, which is some fifty times as slow.
const COUNTED: usize = 10_000;

fn techniques(args: &Techniques) -> Result<(), String> {
    let limits = Limits { runs: usize::MAX, seconds: args.seconds };
    let mut all = Vec::new();
    for scene in &args.scenes {
        let workload = match workload(scene, args.segments) {
            Ok(workload) => workload,
            Err(error @ SceneError::Absent(_)) => {
                println!("{scene} is skipped: {error}");
                continue;
            }
            Err(error) => return Err(error.to_string()),
        };
        if let Some(name) = &args.only {
            answer_uncounted(name, &workload)?;
            continue;
        }
        let comparison = compare(scene, &workload, &limits);
        println!("{scene}: {} segments, {} rounds", comparison.segments, comparison.rounds);
        let counted = if args.instructions {
            let program = std::env::current_exe().map_err(|error| error.to_string())?;
            count(&program, scene, &workload, COUNTED)?
        } else {
            Vec::new()
        };
        all.push((comparison, counted));
    }
    if args.only.is_some() {
        return Ok(());
    }
    let text = techniques_markdown(&all);
    print!("\n{text}");
    write(args.markdown.as_deref(), &text)
}

/// The contenders whose names begin with one of `names`.
fn chosen(names: &[String]) -> Result<Vec<Contender>, String> {
    for name in names {
        if !CONTENDERS.iter().any(|contender| contender.name.starts_with(name.as_str())) {
            let known = CONTENDERS.map(|contender| contender.name).join(", ");
            return Err(format!("no structure begins with `{name}`; there are {known}"));
        }
    }
    let wanted = |contender: &&Contender| {
        names.is_empty() || names.iter().any(|name| contender.name.starts_with(name.as_str()))
    };
    Ok(CONTENDERS.iter().filter(wanted).copied().collect())
}

fn write(path: Option<&Path>, text: &str) -> Result<(), String> {
    let Some(path) = path else { return Ok(()) };
    std::fs::write(path, text).map_err(|error| format!("{}: {error}", path.display()))
}
