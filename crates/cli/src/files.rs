//! Checks on the files to write, before any work is lost on them.

use std::path::{Path, PathBuf};

use crate::failure::Failure;
use crate::similar;

/// Refuses a path that is a folder, or lies in a folder that is not there.
pub(crate) fn check(path: &Path) -> Result<(), Failure> {
    let shown = path.display();
    if path.is_dir() {
        return Err(Failure::Failed(format!("{shown}: is a folder, expected a file")));
    }
    let folder = folder(path);
    if folder.is_dir() {
        return Ok(());
    }
    let missing = folder.display();
    Err(Failure::Failed(format!("{shown}: there is no folder {missing}; make it first")))
}

/// Refuses a path to read that is a folder, or not there.
pub(crate) fn check_read(path: &Path) -> Result<(), Failure> {
    let shown = path.display();
    if path.is_dir() {
        return Err(Failure::Failed(format!("{shown}: is a folder, expected a file")));
    }
    // What is there and may not be looked at says so when it is read.
    if !matches!(path.try_exists(), Ok(false)) {
        return Ok(());
    }
    let beside = folder(path).read_dir().into_iter().flatten().flatten();
    let names: Vec<_> = beside.map(|entry| entry.file_name()).collect();
    let names = names.iter().filter_map(|name| name.to_str());
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let meant = similar::meant(&name, names);
    Err(Failure::Failed(format!("{shown}: there is no such file{meant}")))
}

/// The folder that a file is in.
fn folder(path: &Path) -> &Path {
    path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Refuses to write two things into one file, or anything into the scene's own.
pub(crate) fn check_apart(scene: Option<&Path>, outputs: &[&Path]) -> Result<(), Failure> {
    let place = |path: &Path| -> PathBuf {
        let folder = folder(path);
        let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
        let whole = folder.join(path.file_name().unwrap_or_default());
        whole.canonicalize().unwrap_or(whole)
    };
    for (i, path) in outputs.iter().enumerate() {
        let shown = path.display();
        if path.as_os_str() == "-" {
            return Err(Failure::Usage(
                "--report -: expected a file name; stdout is for -o -".into(),
            ));
        }
        if scene.is_some_and(|scene| place(scene) == place(path)) {
            return Err(Failure::Usage(format!("{shown}: is what is read; name another file")));
        }
        let special = std::fs::metadata(path).is_ok_and(|m| !m.is_file());
        if !special && outputs[..i].iter().any(|other| place(other) == place(path)) {
            return Err(Failure::Usage(format!(
                "{shown}: named twice; one would replace the other"
            )));
        }
    }
    Ok(())
}
