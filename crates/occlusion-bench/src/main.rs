//! `cargo run --release -p occlusion-bench`: the tables.
#![forbid(unsafe_code)]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "this program prints a table")]

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Parser;
use occlusion_bench::{
    CONTENDERS, Contender, EmbreeLibrary, Kind, LIBRARY_VARIABLE, Limits, SCENES, SceneError,
    Structures, csv, markdown, measure, workload,
};

/// Measures accel's structures, obvhs and Embree on the same segments, on one thread.
#[derive(Parser)]
#[command(version)]
struct Args {
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

fn main() -> ExitCode {
    match run(&Args::parse()) {
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
