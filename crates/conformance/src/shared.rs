//! Reference data that is no part of the repository.

use std::path::{Path, PathBuf};

/// Finds a file or folder in the folder `shared` that lies beside the checkout, or beside
/// one of the folders above it; `None` where there is no such data.
///
/// Its files have no licence of ours: they are read where they lie, and never copied.
///
/// # Examples
/// ```
/// assert!(conformance::shared::find("no such file").is_none());
/// ```
#[must_use]
pub fn find(name: &str) -> Option<PathBuf> {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .map(|folder| folder.join("shared").join(name))
        .find(|path| path.exists())
}
