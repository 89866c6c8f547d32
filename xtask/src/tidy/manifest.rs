//! Manifests: where versions and metadata come from, and a reader for their dependency tables.

use super::Complaint;

/// What every member takes over from the workspace.
const INHERITED: [&str; 4] = ["version", "edition", "rust-version", "license"];

/// For whom a dependency is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Normal,
    Dev,
    Build,
}

/// One entry of a dependency table.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Dependency {
    pub(super) kind: Kind,
    pub(super) name: String,
    pub(super) from_workspace: bool,
}

/// Metadata and lints are inherited, and versions stand in the root manifest alone.
pub(super) fn check(file: &str, text: &str) -> Vec<Complaint> {
    let has = |section: &str, wanted: &str| {
        entries(text).any(|(in_section, key, value)| {
            in_section == section && format!("{key} = {value}") == wanted
        })
    };
    let mut complaints = Vec::new();
    for key in INHERITED {
        if !has("package", &format!("{key}.workspace = true")) {
            complaints.push(format!("{file}: [package] needs `{key}.workspace = true`"));
        }
    }
    // A crate is published like the others, or says that it is not.
    if !has("package", "publish.workspace = true") && !has("package", "publish = false") {
        complaints.push(format!(
            "{file}: [package] needs `publish.workspace = true` or `publish = false`"
        ));
    }
    if !has("lints", "workspace = true") {
        complaints.push(format!("{file}: [lints] needs `workspace = true`"));
    }
    for dependency in dependencies(text).iter().filter(|d| !d.from_workspace) {
        complaints.push(format!(
            "{file}: `{0}` must be `{0}.workspace = true`, its version in [workspace.dependencies]",
            dependency.name
        ));
    }
    complaints
}

/// Every dependency of a manifest, in its order.
pub(super) fn dependencies(text: &str) -> Vec<Dependency> {
    let mut found: Vec<Dependency> = Vec::new();
    for (section, key, value) in entries(text) {
        let Some((kind, table)) = dependency_table(section) else { continue };
        // `name.workspace = true`, `name = { workspace = true, … }`, or a table of its own.
        let (name, key) = match table {
            Some(name) => (name, key),
            None => key.split_once('.').unwrap_or((key, "")),
        };
        let inherits = if key.is_empty() {
            value.trim_start_matches('{').split(',').any(|part| is_true(part, "workspace"))
        } else {
            key == "workspace" && value == "true"
        };
        match found.iter_mut().find(|known| known.kind == kind && known.name == name) {
            Some(known) => known.from_workspace |= inherits,
            None => {
                let name = name.to_owned();
                found.push(Dependency { kind, name, from_workspace: inherits });
            }
        }
    }
    found
}

fn is_true(part: &str, key: &str) -> bool {
    part.trim()
        .trim_end_matches('}')
        .split_once('=')
        .is_some_and(|(left, right)| left.trim() == key && right.trim() == "true")
}

/// The kind of dependencies in a section, and the crate's name where it has its own table.
fn dependency_table(section: &str) -> Option<(Kind, Option<&str>)> {
    let section = match section.strip_prefix("target.") {
        Some(rest) => rest.rsplit_once("'.").or_else(|| rest.rsplit_once("\".")).map(|(_, s)| s)?,
        None => section,
    };
    let (table, name) = match section.split_once('.') {
        Some((table, name)) => (table, Some(name)),
        None => (section, None),
    };
    let kind = match table {
        "dependencies" => Kind::Normal,
        "dev-dependencies" => Kind::Dev,
        "build-dependencies" => Kind::Build,
        _ => return None,
    };
    Some((kind, name))
}

/// Section, key and value of each line. Lines that go on with an array have no key of their own.
fn entries(text: &str) -> impl Iterator<Item = (&str, &str, &str)> {
    let mut section = "";
    text.lines().filter_map(move |line| {
        let line = line.split(" #").next().unwrap_or(line).trim();
        if let Some(header) = line.strip_prefix('[')
            && !line.contains('=')
        {
            section = header.trim_matches(['[', ']']);
            return None;
        }
        let (key, value) = line.split_once('=')?;
        (!line.starts_with('#')).then(|| (section, key.trim(), value.trim()))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "\
[package]
name = \"x\"
version.workspace = true
edition.workspace = true
rust-version.workspace = true
license.workspace = true
publish.workspace = true

[dependencies]
glam.workspace = true # vectors
gltf = { workspace = true, optional = true, features = [
    \"utils\",
] }

[dev-dependencies.criterion]
workspace = true

[target.'cfg(unix)'.build-dependencies]
libc.workspace = true

[lints]
workspace = true
";

    #[test]
    fn every_form_of_inheriting_is_read() {
        assert_eq!(check("x", GOOD), Vec::<String>::new());
        let found: Vec<_> = dependencies(GOOD).into_iter().map(|d| (d.kind, d.name)).collect();
        let expected = [
            (Kind::Normal, "glam"),
            (Kind::Normal, "gltf"),
            (Kind::Dev, "criterion"),
            (Kind::Build, "libc"),
        ];
        assert_eq!(found, expected.map(|(kind, name)| (kind, name.to_owned())));
    }

    #[test]
    fn a_version_outside_the_root_manifest_is_refused() {
        for line in ["glam = \"0.34\"", "glam = { version = \"0.34\" }", "glam.path = \"../glam\""]
        {
            let text = GOOD.replace("glam.workspace = true # vectors", line);
            let complaints = check("x/Cargo.toml", &text);
            assert_eq!(complaints.len(), 1, "{line}: {complaints:?}");
            assert!(complaints[0].starts_with("x/Cargo.toml: `glam` must be"), "{complaints:?}");
        }
    }

    #[test]
    fn metadata_that_is_not_inherited_is_refused() {
        for key in INHERITED {
            let text = GOOD.replace(&format!("\n{key}.workspace = true"), "");
            assert_eq!(check("x", &text), [format!("x: [package] needs `{key}.workspace = true`")]);
        }
        let text = GOOD.replace("[lints]\nworkspace = true", "");
        assert_eq!(check("x", &text), ["x: [lints] needs `workspace = true`"]);
    }
}
