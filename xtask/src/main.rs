//! Development tasks behind `cargo xtask`.

#![allow(clippy::print_stdout, clippy::print_stderr, reason = "xtask is a terminal program")]

mod bench;
mod built;
mod ci;
mod dependencies;
#[cfg(test)]
mod examples;
mod figure;
mod instructions;
mod needs;
mod numerics;
mod package;
mod precision;
mod progress;
mod scenes;
mod share;
mod tidy;

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Development tasks of this workspace.
#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    task: Task,
}

#[derive(Subcommand)]
enum Task {
    /// Run what a change must pass, or one job of it.
    Ci {
        job: Option<ci::Job>,
        /// With `semver`: the commit to compare with [default: the last tag]
        #[arg(long, value_name = "REV")]
        baseline_rev: Option<String>,
    },
    /// Package each crate as it would be published, and say what is in it.
    Package,
    /// Check the house rules: edges between crates, manifests, sources, links.
    Tidy,
    /// Write the bundled scenes into scenes/.
    Scenes {
        /// Write nothing; fail when a committed scene differs.
        #[arg(long)]
        check: bool,
    },
    /// Measure error against time on the scenes with a reference, and draw it into
    /// docs/precision.
    Precision(precision::Arguments),
    /// Measure a matrix of solves, check them, and make a report into docs/bench.
    Bench(Box<bench::Arguments>),
    /// Measure estimators and sweeps, and draw the figures of docs/numerics.md.
    Numerics(numerics::Arguments),
    /// Measure what leaving out pays, scene by scene, and draw the tables of docs/plan.md.
    Needs(needs::Arguments),
    /// Measure how right a solve is about the time that it still takes, for docs/progress.md.
    Progress(progress::Arguments),
    /// Count the crates from outside that each of ours needs, and compare them with the table of
    /// docs/performance.
    Dependencies(dependencies::Arguments),
    /// Count the instructions of every kernel with valgrind, and compare them with the baseline of
    /// docs/performance.
    Instructions(instructions::Arguments),
}

fn main() -> ExitCode {
    let root = root();
    let result = match Arguments::parse().task {
        Task::Ci { job, baseline_rev } => ci::run(&root, job, baseline_rev.as_deref()),
        Task::Package => package::run(&root),
        Task::Tidy => tidy::run(&root),
        Task::Scenes { check: true } => scenes::check(&root.join("scenes")),
        Task::Scenes { check: false } => scenes::write(&root.join("scenes")),
        Task::Precision(arguments) => precision::run(&root, &arguments),
        Task::Bench(arguments) => bench::run(&root, &arguments),
        Task::Numerics(arguments) => numerics::run(&root, &arguments),
        Task::Needs(arguments) => needs::run(&root, &arguments),
        Task::Progress(arguments) => progress::run(&root, &arguments),
        Task::Dependencies(arguments) => dependencies::run(&root, &arguments),
        Task::Instructions(arguments) => instructions::run(&root, &arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// The workspace's root folder.
fn root() -> PathBuf {
    let manifest = Path::new(env!("CARGO_MANIFEST_DIR"));
    manifest.parent().expect("xtask lies in the workspace's root").to_path_buf()
}
