//! `cargo xtask tidy`: the house rules that a program can check.
//!
//! The same checks run as tests of this crate, so nobody has to remember the command.

mod edges;
mod formats;
mod links;
mod manifest;
mod sources;

use std::fs;
use std::path::{Path, PathBuf};

/// A rule that is broken: where, and what is expected there. One line.
type Complaint = String;

/// Fails with every complaint about the workspace at `root`.
pub(crate) fn run(root: &Path) -> Result<(), String> {
    let files = files(root).map_err(|e| format!("{}: {e}", root.display()))?;
    let mut complaints = Vec::new();
    for path in &files {
        let name = path.strip_prefix(root).unwrap_or(path).display().to_string();
        // A file that other work removes meanwhile, or a binary one, has no text to check.
        let Ok(text) = fs::read_to_string(path) else { continue };
        match path.extension().and_then(|extension| extension.to_str()) {
            Some("rs") => complaints.extend(sources::check(&name, &text)),
            Some("md") => complaints.extend(links::check(&name, &text, |to| {
                path.parent().is_some_and(|folder| folder.join(to).exists())
            })),
            _ => {}
        }
    }
    complaints.extend(formats::check(root));
    for folder in members(root).map_err(|e| format!("{}: {e}", root.display()))? {
        let path = folder.join("Cargo.toml");
        let name = path.strip_prefix(root).unwrap_or(&path).display().to_string();
        let text = fs::read_to_string(&path).map_err(|e| format!("{name}: {e}"))?;
        complaints.extend(manifest::check(&name, &text));
        complaints.extend(edges::check(&name, &text));
        if !folder.join("README.md").exists() {
            complaints.push(format!("{name}: the crate has no README.md beside it"));
        }
    }
    if complaints.is_empty() { Ok(()) } else { Err(complaints.join("\n")) }
}

/// What a manifest depends on, by name, for tests too.
#[cfg(test)]
pub(crate) fn dependencies_of(manifest: &str) -> Vec<String> {
    manifest::dependencies(manifest).into_iter().map(|dependency| dependency.name).collect()
}

/// The folders of the workspace's members: each of crates/, and xtask.
fn members(root: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = vec![root.join("xtask")];
    for entry in fs::read_dir(root.join("crates"))? {
        let path = entry?.path();
        if path.join("Cargo.toml").exists() {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

/// Every file below `folder` but those that a build makes; sorted, so that complaints are, too.
fn files(folder: &Path) -> std::io::Result<Vec<PathBuf>> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let made = name.starts_with('.') || name.starts_with("target");
        let made = made || name == "out" || name == "node_modules";
        if path.is_dir() && !made {
            found.extend(files(&path)?);
        } else if path.is_file() {
            found.push(path);
        }
    }
    found.sort();
    Ok(found)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_workspace_is_tidy() {
        if let Err(complaints) = run(&crate::root()) {
            panic!("{complaints}");
        }
    }

    #[test]
    fn the_workspace_is_found() {
        let root = crate::root();
        let members = members(&root).unwrap();
        assert!(members.contains(&root.join("crates/tri-io")));
        let files = files(&root).unwrap();
        assert!(files.contains(&root.join("xtask/src/tidy/mod.rs")));
        assert!(!files.iter().any(|path| path.starts_with(root.join("target"))));
    }
}
