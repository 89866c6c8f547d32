//! The programs in `examples` folders: each runs without arguments, says something and succeeds.
//!
//! Measurements, whose first lines say `--release`, are left to those who want their numbers.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::SystemTime;

use crate::tidy::dependencies_of;

/// The crates that others take; each has programs that show how.
const LIBRARIES: [&str; 9] = [
    "tri-io",
    "scene",
    "scene-import",
    "accel",
    "form-factor",
    "radiosity-core",
    "radiosity-par",
    "output",
    "viewer",
];

/// A program that shows how a crate is used.
struct Example {
    /// Of its crate, in `crates`.
    folder: &'static str,
    name: String,
    text: String,
}

#[test]
fn every_example_runs_and_succeeds() {
    let root = crate::root();
    let folder = scratch();
    for example in examples(&root) {
        let package = package(example.folder);
        let command = format!("cargo run -p {package} --example {}", example.name);
        let output = example.run(&root, &folder);
        let [out, error] = [&output.stdout, &output.stderr].map(|b| String::from_utf8_lossy(b));
        assert!(output.status.success(), "{command}: {}\n{out}{error}", output.status);
        assert!(!out.trim().is_empty(), "{command}: prints nothing");
        println!("{command}\n{out}");
    }
    fs::remove_dir_all(folder).expect("what was made can be removed");
}

#[test]
fn every_library_has_examples_that_say_how_to_run_them() {
    let root = crate::root();
    let examples = examples(&root);
    for folder in LIBRARIES {
        let package = package(folder);
        let readme = fs::read_to_string(root.join("crates").join(folder).join("README.md"))
            .expect("each crate has a README");
        let own: Vec<_> = examples.iter().filter(|example| example.folder == folder).collect();
        assert!(!own.is_empty(), "{package} has no example");
        for Example { name, text, .. } in own {
            let command = format!("//! `cargo run -p {package} --example {name}");
            assert!(text.contains(&command), "{package}: {name} does not say `{command}…`");
            let link = format!("(examples/{name}.rs)");
            assert!(readme.contains(&link), "{package}: the README has no link to {link}");
        }
    }
}

/// All examples but measurements.
fn examples(root: &Path) -> Vec<Example> {
    let mut found = Vec::new();
    for folder in LIBRARIES {
        let examples = root.join("crates").join(folder).join("examples");
        let mut files: Vec<PathBuf> = fs::read_dir(&examples)
            .unwrap_or_else(|e| panic!("{}: {e}", examples.display()))
            .map(|entry| entry.expect("a folder can be read to its end").path())
            .collect();
        files.sort();
        for file in files {
            let name = file.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            let text = fs::read_to_string(&file).expect("an example is a file of text");
            let head = text.lines().take_while(|line| line.starts_with("//!"));
            if !head.clone().any(|line| line.contains("`cargo run --release")) {
                found.push(Example { folder, name, text });
            }
        }
    }
    found
}

/// The package in a folder: its name has a prefix that keeps it apart on crates.io.
fn package(folder: &str) -> String {
    if folder.starts_with("radiosity-") { folder.into() } else { format!("radiosity-{folder}") }
}

/// A folder for what examples write: those that take no path write where temporary files go.
fn scratch() -> PathBuf {
    let folder = std::env::temp_dir().join(format!("examples-{}", std::process::id()));
    fs::create_dir_all(&folder).expect("the folder for temporary files takes another one");
    folder
}

impl Example {
    fn run(&self, root: &Path, folder: &Path) -> Output {
        let built = profile_folder().join("examples").join(&self.name);
        let built = built.with_extension(std::env::consts::EXE_EXTENSION);
        let mut command = if self.is_current(root, &built) {
            Command::new(built)
        } else {
            self.build_and_run(root)
        };
        // Where `std::env::temp_dir` looks, on Unix and on Windows.
        command.current_dir(folder).env("TMPDIR", folder).env("TMP", folder);
        command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"))
    }

    /// Whether it has been built since any of its sources changed, as `cargo test --workspace` does
    /// before it runs a test. Building again from within a test would choose other features, and so
    /// build much anew.
    fn is_current(&self, root: &Path, built: &Path) -> bool {
        let Ok(built) = fs::metadata(built).and_then(|file| file.modified()) else { return false };
        let mut packages = BTreeSet::new();
        reach(root, self.folder, &mut packages);
        let folders = packages.iter().map(|package| root.join("crates").join(package));
        let example = root.join(format!("crates/{}/examples/{}.rs", self.folder, self.name));
        let sources = folders.map(|folder| folder.join("src")).chain([example]);
        sources.map(|source| newest(&source)).all(|source| source < built)
    }

    /// By cargo, in the folder and the profile of this test.
    fn build_and_run(&self, root: &Path) -> Command {
        let profile = profile_folder();
        let target = profile.parent().expect("a profile's folder lies in the target folder");
        let name = profile.file_name().unwrap_or_default().to_string_lossy();
        let mut command = Command::new(std::env::var_os("CARGO").unwrap_or("cargo".into()));
        let package = package(self.folder);
        command.args(["run", "--quiet", "--locked", "--package", &package, "--example"]);
        command.arg(&self.name).arg("--manifest-path").arg(root.join("Cargo.toml"));
        command.args(["--profile", if name == "debug" { "dev" } else { &name }]);
        command.env("CARGO_TARGET_DIR", target);
        command
    }
}

/// A crate and all of ours that it depends on.
fn reach(root: &Path, package: &str, reached: &mut BTreeSet<String>) {
    let manifest = root.join("crates").join(package).join("Cargo.toml");
    let Ok(text) = fs::read_to_string(manifest) else { return };
    if reached.insert(package.to_owned()) {
        dependencies_of(&text).iter().for_each(|name| reach(root, name, reached));
    }
}

/// When a file, or the newest file below a folder, was changed.
fn newest(path: &Path) -> SystemTime {
    let changed = || fs::metadata(path)?.modified();
    match fs::read_dir(path) {
        Err(_) => changed().unwrap_or(SystemTime::UNIX_EPOCH),
        Ok(entries) => {
            let paths = entries.filter_map(Result::ok).map(|entry| entry.path());
            paths.map(|path| newest(&path)).max().unwrap_or(SystemTime::UNIX_EPOCH)
        }
    }
}

/// The folder of this build: the test lies in `deps` below it.
fn profile_folder() -> PathBuf {
    let test = std::env::current_exe().expect("a running program has a path");
    test.ancestors().nth(2).expect("a test lies in target/PROFILE/deps").to_path_buf()
}
