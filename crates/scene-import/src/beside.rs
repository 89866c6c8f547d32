//! The files that a scene file names, found in its folder and read from there.

use std::collections::HashMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

/// Half a sentence about a reference that is not followed.
const OUTSIDE: &str = "it lies outside the scene's folder, and only --allow-outside reads it";

/// The folder of a scene, and what was read from it so far.
pub(crate) struct Beside<'a> {
    /// `None` for a scene that must stand alone.
    folder: Option<&'a Path>,
    allow_outside: bool,
    /// The length of each file that was read: a file counts once, however often it is named.
    lengths: HashMap<PathBuf, usize>,
}

impl<'a> Beside<'a> {
    pub(crate) fn new(folder: Option<&'a Path>, allow_outside: bool) -> Self {
        Self { folder, allow_outside, lengths: HashMap::new() }
    }

    /// The file that a reference means, free of links; the error is half a sentence.
    ///
    /// A scene that nobody vouches for must not look into other folders: neither by `..`, nor by
    /// the name of a root, a drive or a server, nor by a link that lies in its own folder.
    pub(crate) fn find(&self, reference: &str) -> Result<PathBuf, String> {
        let folder = self.folder.ok_or("the scene was opened without its folder")?;
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        // Material libraries written on Windows separate folders by backslashes.
        let reference = reference.replace('\\', "/");
        if !self.allow_outside && leads_out(&reference) {
            return Err(OUTSIDE.to_owned());
        }
        let canonical = |path: &Path| path.canonicalize().map_err(|cause| cause.to_string());
        let path = canonical(&folder.join(reference))?;
        if !self.allow_outside && !path.starts_with(canonical(folder)?) {
            return Err(OUTSIDE.to_owned());
        }
        Ok(path)
    }

    /// Reads a file that was found; the error is half a sentence.
    pub(crate) fn read_found(&mut self, path: &Path) -> Result<Vec<u8>, String> {
        // A device such as /dev/zero never ends, and a pipe may never begin.
        let metadata = fs::metadata(path).map_err(|cause| cause.to_string())?;
        if !metadata.is_file() {
            return Err("it is not a plain file".to_owned());
        }
        let bytes = fs::read(path).map_err(|cause| cause.to_string())?;
        self.lengths.insert(path.to_owned(), bytes.len());
        Ok(bytes)
    }

    /// Finds and reads; the error is half a sentence.
    pub(crate) fn read(&mut self, reference: &str) -> Result<Vec<u8>, String> {
        self.read_found(&self.find(reference)?)
    }

    /// Bytes of all files that were read, each counted once.
    pub(crate) fn bytes(&self) -> usize {
        self.lengths.values().fold(0, |sum, length| sum.saturating_add(*length))
    }
}

/// Whether a reference leaves the folder by its words alone, on any system: what is a drive on one
/// is a folder's name on another, and a scene is not to depend on that.
fn leads_out(reference: &str) -> bool {
    let drive = matches!(reference.as_bytes(), [letter, b':', ..] if letter.is_ascii_alphabetic());
    // This holds //server/share and //?/C:/, too.
    if drive || reference.starts_with('/') {
        return true;
    }
    let mut depth = 0_usize;
    for component in Path::new(reference).components() {
        match component {
            Component::Normal(_) => depth += 1,
            Component::CurDir => {}
            Component::ParentDir if depth > 0 => depth -= 1,
            Component::ParentDir | Component::RootDir | Component::Prefix(_) => return true,
        }
    }
    false
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_lead_out_are_told() {
        for inside in ["a.png", "./a.png", "b/../a.png", "b/c/../../a.png", "..a", "b..", "ab:c"] {
            assert!(!leads_out(inside), "{inside}");
        }
        for outside in [
            "..",
            "../a.png",
            "b/../../a.png",
            "./../a.png",
            "/etc/passwd",
            "//server/share/a.png",
            "//?/C:/a.png",
            "C:/a.png",
            "c:a.png",
        ] {
            assert!(leads_out(outside), "{outside}");
        }
    }
}
