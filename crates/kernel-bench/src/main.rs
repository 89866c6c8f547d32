#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![allow(clippy::print_stdout, clippy::print_stderr, reason = "this program prints names")]

mod count;
mod form_factors;
mod kernel;
mod light;

mod mesh;
mod occlusion;
mod random;
mod scenes;
mod text;

use std::process::ExitCode;

use clap::Parser;
use kernel::{KERNELS, Kernel};

/// Runs one kernel on a fixed input, for a program that counts what it does.
#[derive(Parser)]
#[command(version)]
struct Args {
    /// Prints the names of the kernels that this machine can run, a line each.
    #[arg(long)]
    list: bool,
    /// The kernel to run.
    #[arg(required_unless_present = "list", conflicts_with = "list")]
    kernel: Option<String>,
}

fn main() -> ExitCode {
    let args = Args::parse();
    if args.list {
        let here = KERNELS.iter().filter(|kernel| kernel.runs_here());
        here.for_each(|kernel| println!("{}", kernel.name));
        return ExitCode::SUCCESS;
    }
    match found(&args.kernel.unwrap_or_default()) {
        Ok(kernel) => {
            println!("{}: {}", kernel.name, (kernel.run)());
            ExitCode::SUCCESS
        }
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}

fn found(name: &str) -> Result<&'static Kernel, String> {
    let kernel = KERNELS.iter().find(|kernel| kernel.name == name);
    let kernel =
        kernel.ok_or_else(|| format!("no kernel is called `{name}`; `--list` names all"))?;
    if kernel.runs_here() { Ok(kernel) } else { Err(format!("`{name}` needs AVX2")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kernel_is_found_by_its_whole_name() {
        assert_eq!(found("tri-io/parse").map(|kernel| kernel.name), Ok("tri-io/parse"));
        assert!(found("tri-io").is_err() && found("").is_err());
    }

    #[test]
    fn one_kernel_is_run_or_all_are_listed() {
        let parsed = |words: &[&str]| Args::try_parse_from(words).is_ok();
        assert!(parsed(&["kernels", "tri-io/parse"]) && parsed(&["kernels", "--list"]));
        assert!(!parsed(&["kernels"]) && !parsed(&["kernels", "tri-io/parse", "--list"]));
    }
}
