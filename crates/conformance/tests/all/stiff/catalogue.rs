//! Every case of the catalogue is a test of its name.

use std::fs;
use std::path::{Path, PathBuf};

use conformance::shared;
use serde_json::Value;

/// Cases in the catalogue.
const CASES: usize = 31;

/// The name of a case's test: its id in small letters, with `_` for all that no name may hold.
fn function(id: &str) -> String {
    let allowed = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '_' };
    id.chars().map(allowed).collect()
}

/// The text of every test source of the workspace.
fn tests(folder: &Path, found: &mut Vec<String>) {
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            tests(&path, found);
        } else if path.extension().is_some_and(|e| e == "rs") {
            found.push(fs::read_to_string(path).unwrap());
        }
    }
}

/// Whether a function of this name is a test that runs.
fn is_run(text: &str, name: &str) -> bool {
    let start = format!("\nfn {name}(");
    text.match_indices(&start).any(|(at, _)| {
        let attributes = text[..at].lines().rev().take_while(|line| line.starts_with("#["));
        let attributes: Vec<_> = attributes.collect();
        attributes.contains(&"#[test]") && !attributes.iter().any(|a| a.starts_with("#[ignore"))
    })
}

#[test]
fn every_case_is_a_test_of_its_name() {
    let Some(path) = shared::find("cases/stiff_cases.json") else {
        println!("skipped: no shared/cases/stiff_cases.json beside the checkout");
        return;
    };
    let cases: Value = serde_json::from_slice(&fs::read(path).unwrap()).unwrap();
    let ids: Vec<_> = cases.as_array().unwrap().iter().map(|c| c["id"].as_str().unwrap()).collect();
    assert_eq!(ids.len(), CASES);
    let mut sources = Vec::new();
    let crates = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    for member in fs::read_dir(crates).unwrap() {
        let folder = member.unwrap().path().join("tests");
        if folder.is_dir() {
            tests(&folder, &mut sources);
        }
    }
    let missing: Vec<_> = ids
        .into_iter()
        .filter(|id| !sources.iter().any(|text| is_run(text, &function(id))))
        .collect();
    assert!(missing.is_empty(), "no test that runs: {missing:?}");
}

#[test]
fn a_name_is_made_of_an_id() {
    assert_eq!(function("emission_1e30_1e-30"), "emission_1e30_1e_30");
    let text =
        "\n#[test]\nfn one() {}\n\n#[test]\n#[ignore = \"x\"]\nfn two() {}\n\nfn three() {}\n";
    assert_eq!(
        ["one", "two", "three", "four"].map(|n| is_run(text, n)),
        [true, false, false, false]
    );
}
