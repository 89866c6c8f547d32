//! The `radiosity` program: from a scene file to a lit scene with a report.
//!
//! Raw flags (`args`, read by `command_line`) become checked settings (`settings`, pure), which a command runs
//! (`commands`). `pipeline` is the way of the light, one call per arrow.

mod absent;
mod args;
mod bundled;
mod checkpoint;
mod command_line;
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
mod progress;
mod report;
mod screen;
mod settings;
mod similar;
mod snapshot;
mod stages;

use std::ffi::OsString;
use std::process::ExitCode;
use std::time::Instant;

use args::{Args, Command, TerminalArgs};
use failure::Failure;

fn main() -> ExitCode {
    let start = Instant::now();
    let words: Vec<OsString> = std::env::args_os().collect();
    let result = command_line::read(&words).and_then(|line| {
        let (args, place) = line.split();
        screen::open(args.terminal, start);
        run(args).map_err(place)
    });
    let Err(failure) = result else { return ExitCode::SUCCESS };
    screen::open(TerminalArgs::glance(&words), start);
    let code = match failure {
        Failure::Usage(_) => 2,
        Failure::Failed(_) => 1,
    };
    screen::error(&failure.to_string(), code);
    ExitCode::from(code)
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
        #[cfg(feature = "manual")]
        Some(Command::Completions(args)) => commands::completions::run(&args),
        #[cfg(feature = "manual")]
        Some(Command::Man(args)) => commands::man::run(&args),
        #[cfg(feature = "html")]
        Some(Command::View(args)) => commands::view::run(&args),
    }
}
