//! Which crate of the workspace may depend on which.
//!
//! The table is the architecture: a new edge is a decision, made here and explained in
//! `docs/architecture.md`.

use super::Complaint;
use super::manifest::{Dependency, Kind, dependencies};

/// A crate and the crates of this workspace that it may use.
struct Rule {
    member: &'static str,
    /// In the library or program; tests and benches may use these, too.
    normal: &'static [&'static str],
    /// In tests and benches besides.
    dev: &'static [&'static str],
}

/// The crates whose kernels are counted, and the scene that they share.
const COUNTED: &[&str] = &["tri-io", "scene", "accel", "form-factor", "radiosity-core"];

/// What the conformance cases may use.
const BELOW_THE_CASES: &[&str] = &[
    "tri-io",
    "scene",
    "scene-import",
    "accel",
    "form-factor",
    "radiosity-core",
    "radiosity-par",
    "output",
];

/// What the program may use: the cases, too, for `radiosity verify`.
const BELOW_THE_PROGRAM: &[&str] = &[
    "tri-io",
    "scene",
    "scene-import",
    "accel",
    "form-factor",
    "radiosity-core",
    "radiosity-par",
    "output",
    "viewer",
    "conformance",
];

/// Every member, from the bottom up.
const RULES: [Rule; 14] = [
    Rule { member: "tri-io", normal: &[], dev: &[] },
    Rule { member: "scene", normal: &[], dev: &[] },
    Rule { member: "accel", normal: &[], dev: &[] },
    Rule { member: "occlusion-bench", normal: &["accel", "tri-io"], dev: &[] },
    Rule { member: "scene-import", normal: &["scene", "tri-io"], dev: &[] },
    Rule { member: "form-factor", normal: &[], dev: &[] },
    Rule { member: "radiosity-core", normal: &["accel", "form-factor", "scene"], dev: &[] },
    Rule { member: "radiosity-par", normal: &["radiosity-core"], dev: &["accel", "scene"] },
    Rule { member: "output", normal: &["scene", "tri-io"], dev: &[] },
    Rule { member: "viewer", normal: &["scene"], dev: &["output"] },
    Rule { member: "kernel-bench", normal: COUNTED, dev: &[] },
    Rule { member: "conformance", normal: BELOW_THE_CASES, dev: &[] },
    Rule { member: "cli", normal: BELOW_THE_PROGRAM, dev: &[] },
    Rule { member: "xtask", normal: &[], dev: &[] },
];

/// Complains about every edge that the table does not allow.
pub(super) fn check(file: &str, text: &str) -> Vec<Complaint> {
    let Some(member) = name(text).map(key) else {
        return vec![format!("{file}: [package] has no `name = \"…\"`")];
    };
    let Some(rule) = RULES.iter().find(|rule| rule.member == member) else {
        return vec![format!(
            "{file}: `{member}` has no line in the table of xtask/src/tidy/edges.rs"
        )];
    };
    let in_house =
        |dependency: &Dependency| RULES.iter().any(|rule| rule.member == dependency.name);
    dependencies(text)
        .into_iter()
        .filter(|dependency| in_house(dependency) && !rule.allows(dependency))
        .map(|Dependency { kind, name, .. }| {
            let table = match kind {
                Kind::Normal => "dependencies",
                Kind::Dev => "dev-dependencies",
                Kind::Build => "build-dependencies",
            };
            format!(
                "{file}: the edge {member} → {name} in [{table}] is not allowed \
                 (the table is in xtask/src/tidy/edges.rs)"
            )
        })
        .collect()
}

impl Rule {
    fn allows(&self, dependency: &Dependency) -> bool {
        let name = dependency.name.as_str();
        match dependency.kind {
            Kind::Normal => self.normal.contains(&name),
            Kind::Dev => self.normal.contains(&name) || self.dev.contains(&name),
            // No build script of ours needs a crate of ours.
            Kind::Build => false,
        }
    }
}

/// What the other crates call a package: without the prefix that keeps it apart on crates.io.
fn key(package: &str) -> &str {
    let is_member = |key: &&str| RULES.iter().any(|rule| rule.member == *key);
    match package {
        "radiosity" => "cli",
        _ => package.strip_prefix("radiosity-").filter(is_member).unwrap_or(package),
    }
}

/// The package's name.
fn name(text: &str) -> Option<&str> {
    text.lines().find_map(|line| line.strip_prefix("name = \"")?.strip_suffix('"'))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn complaints(name: &str, dependencies: &str) -> Vec<String> {
        check("Cargo.toml", &format!("[package]\nname = \"{name}\"\n{dependencies}"))
    }

    #[test]
    fn allowed_edges_pass() {
        let two = "[dependencies]\nscene.workspace = true\naccel = { workspace = true }\n";
        assert_eq!(complaints("radiosity-core", two), Vec::<String>::new());
        let dev = "[dev-dependencies]\nscene.workspace = true\ncriterion.workspace = true\n";
        assert_eq!(complaints("radiosity-core", dev), Vec::<String>::new());
    }

    #[test]
    fn a_forbidden_edge_is_named() {
        let upwards = "[dependencies]\nradiosity-core.workspace = true\n";
        assert_eq!(
            complaints("accel", upwards),
            ["Cargo.toml: the edge accel → radiosity-core in [dependencies] is not allowed \
              (the table is in xtask/src/tidy/edges.rs)"]
        );
        for table in ["dev-dependencies", "build-dependencies", "target.'cfg(unix)'.dependencies"] {
            let edge = format!("[{table}]\ncli.workspace = true\n");
            assert_eq!(complaints("conformance", &edge).len(), 1, "{table}");
        }
        assert_eq!(complaints("xtask", "[dependencies.scene]\nworkspace = true\n").len(), 1);
    }

    #[test]
    fn an_unknown_member_is_refused() {
        let found = complaints("radiosity-gpu", "");
        assert!(found[0].contains("`radiosity-gpu` has no line in the table"), "{found:?}");
    }

    /// No chain of allowed edges leads back to where it starts.
    #[test]
    fn the_table_has_no_cycle() {
        fn reaches(from: &str, to: &str) -> bool {
            let rule = RULES.iter().find(|rule| rule.member == from).unwrap();
            rule.normal.iter().any(|next| *next == to || reaches(next, to))
        }
        for rule in &RULES {
            assert!(!reaches(rule.member, rule.member), "{}", rule.member);
        }
    }
}
