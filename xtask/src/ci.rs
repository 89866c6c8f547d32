//! `cargo xtask ci`: what a change must pass, the same here as on the server.

use std::path::Path;
use std::process::Command;

use clap::ValueEnum;
use serde_json::Value;

use crate::{instructions, package, scenes, tidy};

/// One job of the pipeline.
#[derive(Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Job {
    /// Every file is formatted.
    Fmt,
    /// No lint speaks up, in libraries, programs, tests and benches.
    Clippy,
    /// House rules: edges between crates, manifests, sources, links.
    Tidy,
    /// The bundled scenes are what the code writes.
    Scenes,
    /// All tests, and the examples in the documentation.
    Test,
    /// The documentation builds without a warning.
    Doc,
    /// Each crate compiles alone without features, and with each of them.
    Features,
    /// No kernel takes more instructions than its baseline; skipped without valgrind.
    Instructions,
    /// The fuzz targets compile; whoever fuzzes needs a nightly compiler and cargo-fuzz besides.
    Fuzz,
    /// Each crate can be published: `cargo xtask package`.
    Package,
    /// No public interface changed more than its version says; skipped without cargo-semver-checks.
    Semver,
}

/// Runs one job, or all of them in the order above: the quick ones first.
pub(crate) fn run(root: &Path, only: Option<Job>, baseline: Option<&str>) -> Result<(), String> {
    let jobs = Job::value_variants().iter().filter(|job| only.is_none_or(|only| only == **job));
    jobs.copied().try_for_each(|job| run_job(root, job, baseline))
}

fn run_job(root: &Path, job: Job, baseline: Option<&str>) -> Result<(), String> {
    match job {
        Job::Fmt => cargo(root, "fmt --all -- --check"),
        Job::Clippy => cargo(root, "clippy --workspace --all-targets --locked -- --deny warnings"),
        Job::Tidy => tidy::run(root),
        Job::Scenes => scenes::check(&root.join("scenes")),
        Job::Test => cargo(root, "test --workspace --locked"),
        Job::Doc => cargo(root, "doc --workspace --no-deps --locked"),
        Job::Features => {
            let each = |arguments: String| cargo(root, &arguments);
            feature_checks(&metadata(root)?).into_iter().try_for_each(each)
        }
        Job::Instructions => instructions::check(root),
        Job::Fuzz => cargo(root, "check --manifest-path fuzz/Cargo.toml --all-targets --locked"),
        Job::Package => package::run(root),
        Job::Semver => semver(root, baseline),
    }
}

/// Compares public interfaces with those of a commit, by default of the last tag.
fn semver(root: &Path, baseline: Option<&str>) -> Result<(), String> {
    let there = |mut command: Command| command.output().ok().filter(|o| o.status.success());
    if there(cargo_command(root, "semver-checks --version")).is_none() {
        println!("semver: skipped, as cargo-semver-checks is not installed");
        return Ok(());
    }
    let last_tag = || {
        let mut git = Command::new("git");
        git.current_dir(root).args(["describe", "--tags", "--abbrev=0"]);
        there(git).map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned())
    };
    let Some(baseline) = baseline.map(str::to_owned).or_else(last_tag) else {
        println!("semver: skipped, as there is no tag yet; --baseline-rev names another commit");
        return Ok(());
    };
    let metadata = metadata(root)?;
    let libraries = package::in_order(&metadata)?;
    let flags = libraries
        .iter()
        .filter(|package| has_library(package))
        .map(|package| format!(" --package {}", package["name"].as_str().unwrap_or_default()));
    let flags: String = flags.collect();
    cargo(root, &format!("semver-checks --baseline-rev {baseline}{flags}"))
}

fn has_library(package: &Value) -> bool {
    let targets = package["targets"].as_array().into_iter().flatten();
    targets.flat_map(|target| target["kind"].as_array().into_iter().flatten()).any(|k| k == "lib")
}

/// Runs cargo with words that contain no blanks, and shows the command first.
pub(crate) fn cargo(root: &Path, arguments: &str) -> Result<(), String> {
    println!("$ cargo {arguments}");
    let status = cargo_command(root, arguments)
        // Read by `cargo doc` alone; everywhere else it has no effect.
        .env("RUSTDOCFLAGS", "-D warnings")
        .status()
        .map_err(|e| format!("cargo {arguments}: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("failed: cargo {arguments}")) }
}

/// What cargo knows of the workspace's own crates.
pub(crate) fn metadata(root: &Path) -> Result<Value, String> {
    let arguments = "metadata --no-deps --format-version 1 --locked";
    let output =
        cargo_command(root, arguments).output().map_err(|e| format!("cargo {arguments}: {e}"))?;
    serde_json::from_slice(&output.stdout)
        .map_err(|e| format!("cargo {arguments}: {e}\n{}", String::from_utf8_lossy(&output.stderr)))
}

/// Cargo with words that contain no blanks.
pub(crate) fn cargo_command(root: &Path, arguments: &str) -> Command {
    let mut command = Command::new(std::env::var("CARGO").unwrap_or_else(|_| "cargo".into()));
    command.current_dir(root).args(arguments.split_whitespace());
    command
}

/// The features of a crate that it names itself.
pub(crate) fn features(package: &Value) -> Vec<&str> {
    let names = package["features"].as_object().into_iter().flat_map(|map| map.keys());
    names.map(String::as_str).filter(|name| *name != "default").collect()
}

/// A check of every crate by itself, without features, and one for each of its features.
fn feature_checks(metadata: &Value) -> Vec<String> {
    let mut checks = Vec::new();
    for package in metadata["packages"].as_array().into_iter().flatten() {
        let name = package["name"].as_str().unwrap_or_default();
        let alone = format!("check --package {name} --locked --no-default-features");
        // Tests too: what they need of a feature is behind it.
        checks.push(format!("{alone} --all-targets"));
        let each = |feature: &&str| format!("{alone} --features {feature}");
        checks.extend(features(package).iter().map(each));
    }
    checks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_crate_is_checked_alone_and_with_each_feature() {
        let metadata = serde_json::json!({ "packages": [
            { "name": "plain", "features": {} },
            { "name": "many", "features": { "default": ["obj"], "gltf": [], "obj": [] } },
        ] });
        let alone = "check --package many --locked --no-default-features";
        let expected = [
            "check --package plain --locked --no-default-features --all-targets".to_owned(),
            format!("{alone} --all-targets"),
            format!("{alone} --features gltf"),
            format!("{alone} --features obj"),
        ];
        assert_eq!(feature_checks(&metadata), expected);
    }
}
