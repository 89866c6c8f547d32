//! `cargo xtask instructions`: how many instructions each kernel takes, beside a baseline.
//!
//! Every kernel of `kernel-bench` runs by itself under valgrind's callgrind, which counts inside one
//! function. The baseline is `docs/performance/instructions.json`; the table of the page beside it
//! is written from that alone.

mod baseline;
mod callgrind;
mod compare;
mod page;
mod percent;
mod toolchain;

use std::path::{Path, PathBuf};
use std::process::Command;

use crate::built;
use crate::precision;
use baseline::{Baseline, Counted};
use compare::Comparison;
use percent::Percent;
use toolchain::Toolchain;

/// Where the baseline and the page that shows it are kept.
const FOLDER: &str = "docs/performance";
const DATA: &str = "instructions.json";
const PAGE: &str = "instructions.md";

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Only kernels whose names begin so
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    kernels: Vec<String>,

    /// How many more instructions than the baseline's are too many, as 0.02 or 2%
    ///
    /// Counts of unchanged code repeat to 0.06 %, what the places of stack and heap do. Thirty times
    /// that leaves room for a compiler that inlines a little differently in one part after a
    /// change in another.
    #[arg(long, value_name = "SHARE", default_value = "2%")]
    threshold: Percent,

    /// Make what is counted the new baseline, and renew the page
    #[arg(long, conflicts_with_all = ["kernels", "list"])]
    write: bool,

    /// Count nothing: print the names of the kernels
    #[arg(long)]
    list: bool,
}

/// Counts and compares, or writes a new baseline.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    if arguments.list {
        let names = kernels(&program(root)?, &arguments.kernels)?;
        names.iter().for_each(|name| println!("{name}"));
        return Ok(());
    }
    let Some(toolchain) = Toolchain::here(root)? else {
        if arguments.write {
            return Err("a baseline is counted by valgrind, and there is none here".into());
        }
        println!("skipped: instructions are counted by valgrind, and there is none here");
        return Ok(());
    };
    let program = program(root)?;
    let kernels = kernels(&program, &arguments.kernels)?;
    let folder = root.join(FOLDER);
    if arguments.write {
        let counted = Baseline { toolchain, kernels: callgrind::count(&program, &kernels)? };
        return write(&folder, &counted);
    }
    // Read first: a baseline that cannot be read is known at once.
    let baseline = Baseline::read(&folder.join(DATA))?;
    let counted = callgrind::count(&program, &kernels)?;
    let wanted = |kernel: &Counted| begins(&kernel.name, &arguments.kernels);
    let before: Vec<_> = baseline.kernels.iter().filter(|k| wanted(k)).cloned().collect();
    let comparison = Comparison::of(&before, &counted, arguments.threshold);
    print!("{comparison}");
    let verdict = comparison.verdict(&toolchain.differences(&baseline.toolchain));
    verdict.notes.iter().for_each(|note| println!("{note}"));
    verdict.failure.map_or(Ok(()), Err)
}

/// Counts every kernel and compares, with nothing chosen: a job of `cargo xtask ci`.
pub(crate) fn check(root: &Path) -> Result<(), String> {
    let (kernels, threshold) = (Vec::new(), Percent::DEFAULT);
    run(root, &Arguments { kernels, threshold, write: false, list: false })
}

fn program(root: &Path) -> Result<PathBuf, String> {
    built::program(root, "kernel-bench", "kernels")
}

/// The kernels that this machine can run, of those asked for.
fn kernels(program: &Path, asked: &[String]) -> Result<Vec<String>, String> {
    let failed = |e: String| format!("{} --list: {e}", program.display());
    let output = Command::new(program).arg("--list").output().map_err(|e| failed(e.to_string()))?;
    if !output.status.success() {
        return Err(failed(output.status.to_string()));
    }
    chosen(&String::from_utf8_lossy(&output.stdout), asked)
}

/// The names in a list, a line each, that begin with one of those asked for; all where nothing is.
fn chosen(list: &str, asked: &[String]) -> Result<Vec<String>, String> {
    if let Some(unknown) = asked.iter().find(|a| !list.lines().any(|name| name.starts_with(*a))) {
        return Err(format!("no kernel begins with `{unknown}`; `--list` names all"));
    }
    Ok(list.lines().filter(|name| begins(name, asked)).map(str::to_owned).collect())
}

fn begins(name: &str, asked: &[String]) -> bool {
    asked.is_empty() || asked.iter().any(|a| name.starts_with(a.as_str()))
}

/// Keeps a baseline, and renews the page.
fn write(folder: &Path, baseline: &Baseline) -> Result<(), String> {
    let page = drawn(folder, baseline)?;
    for (name, text) in [(DATA, baseline.text()?), (PAGE, page)] {
        let path = folder.join(name);
        precision::write(&path, &text)?;
        println!("{}: {} bytes", path.display(), text.len());
    }
    Ok(())
}

/// The page, renewed from a baseline.
fn drawn(folder: &Path, baseline: &Baseline) -> Result<String, String> {
    let path = folder.join(PAGE);
    let failed = |e: String| format!("{}: {e}", path.display());
    let text = std::fs::read_to_string(&path).map_err(|e| failed(e.to_string()))?;
    page::renewed(&text, baseline).map_err(failed)
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
        let words = std::iter::once("instructions").chain(line.split_whitespace());
        Line::try_parse_from(words).map(|line| line.arguments).map_err(|e| e.to_string())
    }

    #[test]
    fn the_job_takes_what_nothing_chosen_means() {
        let bare = parsed("").unwrap();
        assert!(bare.kernels.is_empty() && !bare.write && !bare.list);
        assert_eq!(bare.threshold, Percent::DEFAULT);
        let some = parsed("--kernels accel,tri-io/parse --threshold 0.5%").unwrap();
        assert_eq!(some.kernels, ["accel", "tri-io/parse"]);
        assert_eq!(some.threshold.to_string(), "0.5 %");
        // A baseline of some kernels would forget the others.
        assert!(parsed("--write --kernels accel").is_err() && parsed("--threshold -1").is_err());
    }

    #[test]
    fn kernels_are_chosen_by_the_beginning_of_their_names() {
        let list = "accel/bvh-batch\naccel/bvh-batch-8\ntri-io/parse\n";
        let chosen = |asked: &[&str]| {
            chosen(list, &asked.iter().map(|a| (*a).to_owned()).collect::<Vec<_>>())
        };
        assert_eq!(chosen(&[]).unwrap().len(), 3);
        assert_eq!(chosen(&["tri-io", "accel/bvh-batch-8"]).unwrap().len(), 2);
        let refused = chosen(&["tri-io", "mesh"]).unwrap_err();
        assert_eq!(refused, "no kernel begins with `mesh`; `--list` names all");
    }

    /// The table of the committed page follows from the committed baseline.
    #[test]
    fn the_page_is_current() {
        let folder = crate::root().join(FOLDER);
        let baseline = Baseline::read(&folder.join(DATA)).unwrap();
        let found = std::fs::read_to_string(folder.join(PAGE)).unwrap();
        let expected = drawn(&folder, &baseline).unwrap();
        assert!(found == expected, "{PAGE}: run `cargo xtask instructions --write`");
    }
}
