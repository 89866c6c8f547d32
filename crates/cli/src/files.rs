//! Checks on the files to write, before any work is lost on them.

use std::path::Path;

use crate::failure::Failure;

/// Refuses a path that is a folder, or lies in a folder that is not there.
pub(crate) fn check(path: &Path) -> Result<(), Failure> {
    let shown = path.display();
    if path.is_dir() {
        return Err(Failure::Failed(format!("{shown}: is a folder, expected a file")));
    }
    let folder = path.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if folder.is_dir() {
        return Ok(());
    }
    let missing = folder.display();
    Err(Failure::Failed(format!("{shown}: there is no folder {missing}; make it first")))
}
