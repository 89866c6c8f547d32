//! `cargo xtask package`: each crate as it would be published, built from nothing but its package.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::ci;

/// Files that each package must hold.
const NEEDED: [&str; 4] = ["Cargo.toml", "LICENSE-APACHE", "LICENSE-MIT", "README.md"];

/// Bytes of a package that are no mistake yet; the largest, with the bundled scenes, has a sixth.
/// crates.io takes ten times as much.
const MOST_BYTES: u64 = 1 << 20;

/// Packages every crate that is published, checks what is in it, and has cargo build it.
pub(crate) fn run(root: &Path) -> Result<(), String> {
    let metadata = ci::metadata(root)?;
    let crates = in_order(&metadata)?;
    for package in &crates {
        links_stay_inside(package)?;
    }
    let names: Vec<&str> = crates.iter().map(|package| name(package)).collect();
    let flags = names.iter().map(|name| format!("--package {name} ")).collect::<String>();
    // What is not committed yet is packaged, too: the check is of what is there.
    ci::cargo(root, &format!("package --locked --allow-dirty {flags}"))?;
    let target = metadata["target_directory"].as_str().unwrap_or_default();
    for package in &crates {
        let files = files(root, name(package))?;
        let version = package["version"].as_str().unwrap_or_default();
        let path = Path::new(target).join(format!("package/{}-{version}.crate", name(package)));
        let bytes = fs::metadata(&path).map_err(|e| format!("{}: {e}", path.display()))?.len();
        println!("\n{} {version}: {} files, {bytes} bytes packed", name(package), files.len());
        println!("  {}", files.join(" "));
        check(name(package), &files, bytes)?;
    }
    println!("\nto be published in this order: {}", names.join(", "));
    Ok(())
}

fn name(package: &Value) -> &str {
    package["name"].as_str().unwrap_or_default()
}

/// The crates that are published, each after those that it needs.
pub(crate) fn in_order(metadata: &Value) -> Result<Vec<&Value>, String> {
    let packages = metadata["packages"].as_array().into_iter().flatten();
    // `publish = false` is a list of no registries here.
    let (mut left, kept): (Vec<&Value>, Vec<&Value>) =
        packages.partition(|package| package["publish"].is_null());
    let kept: BTreeSet<&str> = kept.into_iter().map(name).collect();
    let mut ordered: Vec<&Value> = Vec::new();
    while !left.is_empty() {
        let waiting: BTreeSet<&str> = left.iter().map(|package| name(package)).collect();
        let (ready, rest): (Vec<&Value>, Vec<&Value>) = left
            .into_iter()
            .partition(|package| needs(package).all(|needed| !waiting.contains(needed)));
        if let Some((package, needed)) = ready
            .iter()
            .flat_map(|package| needs(package).map(move |needed| (package, needed)))
            .find(|(_, needed)| kept.contains(needed))
        {
            return Err(format!("{} needs {needed}, which is not published", name(package)));
        }
        if ready.is_empty() {
            return Err(format!("these need each other: {waiting:?}"));
        }
        ordered.extend(ready);
        left = rest;
    }
    Ok(ordered)
}

/// What a package's library or program needs; tests are not published.
fn needs(package: &Value) -> impl Iterator<Item = &str> {
    let all = package["dependencies"].as_array().into_iter().flatten();
    all.filter(|dependency| dependency["kind"] != "dev").map(name)
}

/// A README is read where there is no checkout around it.
fn links_stay_inside(package: &Value) -> Result<(), String> {
    let manifest = Path::new(package["manifest_path"].as_str().unwrap_or_default());
    let readme = manifest.with_file_name("README.md");
    let text = fs::read_to_string(&readme).map_err(|e| format!("{}: {e}", readme.display()))?;
    match text.lines().position(|line| line.contains("](../")) {
        Some(line) => {
            let place = format!("{}:{}", readme.display(), line + 1);
            Err(format!("{place}: expected no link that leaves the package"))
        }
        None => Ok(()),
    }
}

/// The files in a package.
fn files(root: &Path, name: &str) -> Result<Vec<String>, String> {
    let arguments = format!("package --list --locked --allow-dirty --package {name}");
    let output = ci::cargo_command(root, &arguments)
        .output()
        .map_err(|e| format!("cargo {arguments}: {e}"))?;
    if !output.status.success() {
        return Err(String::from_utf8_lossy(&output.stderr).into_owned());
    }
    Ok(String::from_utf8_lossy(&output.stdout).lines().map(|l| l.replace('\\', "/")).collect())
}

/// Whether a package holds what it must, and little else.
fn check(name: &str, files: &[String], bytes: u64) -> Result<(), String> {
    if let Some(needed) = NEEDED.iter().find(|needed| !files.iter().any(|file| file == *needed)) {
        return Err(format!("{name}: the package has no {needed}"));
    }
    let below = |folder: &str| files.iter().find(|file| file.starts_with(folder));
    if let Some(file) = below("tests/").or_else(|| below("benches/")) {
        return Err(format!("{name}: the package has {file}, which only a checkout can run"));
    }
    if bytes > MOST_BYTES {
        return Err(format!(
            "{name}: the package has {bytes} bytes, expected at most {MOST_BYTES}"
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn names(packages: Value) -> Result<Vec<String>, String> {
        let metadata = json!({ "packages": packages });
        Ok(in_order(&metadata)?.into_iter().map(|p| name(p).to_owned()).collect())
    }

    #[test]
    fn crates_come_after_what_they_need() {
        let needs = |name: &str, kind: Value| json!({ "name": name, "kind": kind });
        let cli = json!({ "name": "cli", "publish": null,
            "dependencies": [needs("core", json!(null)), needs("serde", json!(null))] });
        let core = json!({ "name": "core", "publish": null,
            "dependencies": [needs("bench", json!("dev"))] });
        let bench = json!({ "name": "bench", "publish": [], "dependencies": [] });
        let ordered = names(json!([cli, core, bench])).unwrap();
        assert_eq!(ordered, ["core", "cli"]);
        let hidden = json!({ "name": "core", "publish": [], "dependencies": [] });
        assert_eq!(
            names(json!([cli, hidden])).unwrap_err(),
            "cli needs core, which is not published"
        );
        let circle =
            json!({ "name": "a", "publish": null, "dependencies": [needs("a", json!(null))] });
        assert!(names(json!([circle])).unwrap_err().contains("need each other"));
    }

    #[test]
    fn the_crates_of_this_workspace_can_be_published() {
        let metadata = ci::metadata(&crate::root()).unwrap();
        let ordered = in_order(&metadata).unwrap();
        assert_eq!(ordered.last().map(|package| name(package)), Some("radiosity"));
        for package in ordered {
            links_stay_inside(package).unwrap();
            let list = |key: &str| package[key].as_array().map_or(0, Vec::len);
            assert!((1..=5).contains(&list("keywords")), "{}", name(package));
            assert!((1..=5).contains(&list("categories")), "{}", name(package));
            assert!(package["description"].is_string() && package["readme"].is_string());
        }
    }

    #[test]
    fn what_lacks_or_is_too_much_is_told() {
        let files =
            |more: &str| NEEDED.iter().chain([&more]).map(|f| (*f).to_owned()).collect::<Vec<_>>();
        assert_eq!(check("a", &files("src/lib.rs"), 1000), Ok(()));
        assert!(check("a", &files("src/lib.rs")[1..], 1000).unwrap_err().contains("no Cargo.toml"));
        assert!(check("a", &files("tests/a.rs"), 1000).unwrap_err().contains("tests/a.rs"));
        assert!(check("a", &files("src/lib.rs"), 2 << 20).unwrap_err().contains("bytes"));
    }
}
