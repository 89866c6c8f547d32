//! Which crates from outside cargo would build for one of ours.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::Value;

use crate::ci::{cargo_command, features, metadata};

/// Counted for one system, so that the table is the same on every other.
const TARGET: &str = "x86_64-unknown-linux-gnu";

/// The crates from outside that one of ours needs.
pub(super) struct Counts {
    /// Our crate.
    pub(super) name: String,
    /// Without any of its features.
    pub(super) plain: usize,
    /// With those that are on by default.
    pub(super) default: usize,
    /// Each feature alone, and which crates it adds to the plain ones.
    pub(super) features: Vec<(String, BTreeSet<String>)>,
}

impl Counts {
    /// Of every crate of the workspace, by name.
    pub(super) fn of_all(root: &Path) -> Result<Vec<Self>, String> {
        let metadata = metadata(root)?;
        let packages: Vec<_> = metadata["packages"].as_array().into_iter().flatten().collect();
        let names: Vec<&str> = packages.iter().filter_map(|p| p["name"].as_str()).collect();
        let outside = |package: &str, flags: &str| outside(root, &names, package, flags);
        let mut all = Vec::new();
        for package in &packages {
            all.push(Self::of(package, outside)?);
        }
        all.sort_by(|a, b| a.name.cmp(&b.name));
        Ok(all)
    }

    /// Of one crate; `outside` says which crates it needs with some flags of cargo.
    fn of(
        package: &Value,
        outside: impl Fn(&str, &str) -> Result<BTreeSet<String>, String>,
    ) -> Result<Self, String> {
        let name = package["name"].as_str().unwrap_or_default().to_owned();
        let plain = outside(&name, "--no-default-features")?;
        let features = features(package);
        let mut default = plain.len();
        let mut added = Vec::new();
        if !features.is_empty() {
            default = outside(&name, "")?.len();
            for feature in features {
                let flags = format!("--no-default-features --features {feature}");
                added.push((feature.to_owned(), &outside(&name, &flags)? - &plain));
            }
        }
        Ok(Self { name, plain: plain.len(), default, features: added })
    }
}

/// The crates that a package needs and the workspace has not, each version a crate of its own.
fn outside(
    root: &Path,
    ours: &[&str],
    package: &str,
    flags: &str,
) -> Result<BTreeSet<String>, String> {
    let arguments = format!(
        "tree --offline --locked --edges normal --prefix none --format {{p}} --target {TARGET} \
         --package {package} {flags}"
    );
    let output =
        cargo_command(root, &arguments).output().map_err(|e| format!("cargo {arguments}: {e}"))?;
    if !output.status.success() {
        let why = String::from_utf8_lossy(&output.stderr);
        return Err(format!("failed: cargo {arguments}\n{why}"));
    }
    Ok(crates(&String::from_utf8_lossy(&output.stdout), ours))
}

/// The names and versions in a tree, without those of the workspace.
fn crates(tree: &str, ours: &[&str]) -> BTreeSet<String> {
    let name_and_version = |line: &str| {
        let mut words = line.split_whitespace();
        let (name, version) = (words.next()?, words.next()?);
        (!ours.contains(&name)).then(|| format!("{name} {version}"))
    };
    tree.lines().filter_map(name_and_version).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crate_counts_once_and_ours_do_not() {
        let tree = "\
            cli v0.1.0 (/w/crates/cli)\nclap v4.5.0\nsyn v2.0.0\nclap_derive v4.5.0 (proc-macro)\n\
            syn v3.0.0\nscene v0.1.0 (/w/crates/scene)\nclap v4.5.0 (*)\n";
        let found: Vec<_> = crates(tree, &["cli", "scene"]).into_iter().collect();
        assert_eq!(found, ["clap v4.5.0", "clap_derive v4.5.0", "syn v2.0.0", "syn v3.0.0"]);
    }

    #[test]
    fn a_feature_adds_what_the_plain_crate_lacks() {
        let package = serde_json::json!({
            "name": "a",
            "features": { "default": ["one"], "one": [], "two": [] },
        });
        let outside = |_: &str, flags: &str| {
            let names = match flags.rsplit(' ').next() {
                Some("--no-default-features") => "x",
                Some("two") => "x y z",
                _ => "w x",
            };
            Ok(names.split(' ').map(str::to_owned).collect())
        };
        let counts = Counts::of(&package, outside).unwrap();
        assert_eq!((counts.plain, counts.default), (1, 2));
        let added: Vec<_> = counts.features.iter().map(|(f, a)| (f.as_str(), a.len())).collect();
        assert_eq!(added, [("one", 1), ("two", 2)]);
    }
}
