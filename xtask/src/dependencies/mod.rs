//! `cargo xtask dependencies`: how many crates from outside each of ours needs, with and without its
//! features.
//!
//! Cargo says which they are; the table of the committed page is compared with that.

mod page;
mod tree;

use std::path::{Path, PathBuf};

use tree::Counts;

/// The page that shows them.
const PAGE: &str = "docs/performance/dependencies.md";

#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Renew the page's table
    #[arg(long)]
    write: bool,
}

/// Counts and compares, or renews the page.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    let path = root.join(PAGE);
    let (found, expected) = pages(root, &path)?;
    if arguments.write {
        crate::precision::write(&path, &expected)?;
        println!("{}: {} bytes", path.display(), expected.len());
        return Ok(());
    }
    if found == expected {
        return Ok(());
    }
    Err(page::differences(&found, &expected))
}

/// The page as it is, and as it should be.
fn pages(root: &Path, path: &PathBuf) -> Result<(String, String), String> {
    let failed = |e: String| format!("{}: {e}", path.display());
    let found = std::fs::read_to_string(path).map_err(|e| failed(e.to_string()))?;
    let counts = Counts::of_all(root)?;
    let expected = page::renewed(&found, &counts).map_err(failed)?;
    Ok((found, expected))
}

#[cfg(test)]
mod tests {
    use super::*;

    // Elsewhere cargo need not have fetched what Linux needs.
    #[cfg(target_os = "linux")]
    #[test]
    fn the_page_is_current() {
        if let Err(message) = run(&crate::root(), &Arguments { write: false }) {
            panic!("{message}");
        }
    }
}
