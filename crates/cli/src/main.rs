//! The `radiosity` program: from a scene file to a lit scene with a report.
//!
//! Raw flags (`args`) become checked settings (`settings`, pure), which a command runs
//! (`commands`). `pipeline` is the way of the light, one call per arrow.

mod absent;
mod args;
mod bundled;
mod checkpoint;
mod commands;
mod failure;
mod files;
mod interrupt;
mod live;
mod memory;
#[cfg(feature = "html")]
mod page;
mod pipeline;
mod prepared;
mod report;
mod screen;
mod settings;
mod snapshot;
mod stages;

use std::process::ExitCode;

use clap::Parser;

use args::{Args, Command};
use failure::Failure;

fn main() -> ExitCode {
    let result = match Args::try_parse() {
        Ok(args) => run(args),
        // Help and the version are among the errors.
        Err(error) => Err(absent::of(&error).unwrap_or_else(|| error.exit())),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            screen::error(&failure.to_string());
            ExitCode::from(match failure {
                Failure::Usage(_) => 2,
                Failure::Failed(_) => 1,
            })
        }
    }
}

/// Runs a command with its flags resolved.
fn run(args: Args) -> Result<(), Failure> {
    match args.command {
        None => commands::solve::bundled(),
        Some(Command::Solve(args)) => settings::solve(*args).and_then(|s| commands::solve::run(&s)),
        Some(Command::Plan(args)) => commands::plan::run(&args),
        Some(Command::Convert(args)) => commands::convert::run(&args),
        #[cfg(feature = "form-factors")]
        Some(Command::FormFactors(args)) => {
            settings::form_factors(args).and_then(|s| commands::form_factors::run(&s))
        }
        Some(Command::Compare(args)) => commands::compare::run(&args),
        Some(Command::ProbeGrid(args)) => commands::probe_grid::run(&args),
        #[cfg(feature = "verify")]
        Some(Command::Verify(args)) => commands::verify::run(&args),
        #[cfg(feature = "html")]
        Some(Command::View(args)) => commands::view::run(&args),
    }
}
