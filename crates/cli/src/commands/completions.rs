//! `radiosity completions`: what a shell needs to complete the command line.

use clap::CommandFactory;

use crate::args::{Args, CompletionsArgs};
use crate::failure::Failure;
use crate::screen;

/// Prints the script on stdout.
pub(crate) fn run(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Args::command(), "radiosity", &mut script);
    screen::result(String::from_utf8_lossy(&script).trim_end())
}
