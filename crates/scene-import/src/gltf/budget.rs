//! How much a file may ask for, measured by its size.
//!
//! A node costs a few bytes and can show a mesh of any size once more, and an accessor
//! without a buffer stands for any number of zeros: without a limit, a small file could
//! fill the memory.

use crate::{Error, ErrorKind};

/// Triangles any file may have, besides one for each of its bytes. With all that is kept of them
/// they take some 50 MB; a small file that shows one chair ten thousand times is rarer than a small
/// file that wants to do harm.
const FREE_TRIANGLES: usize = 1 << 17;

/// Accessor entries any file may have read, besides one for each of its bytes. Instances
/// of a mesh read it again.
const FREE_ENTRIES: usize = 1 << 26;

/// What a file may still ask for.
pub(super) struct Budget<'a> {
    file: &'a str,
    triangles: usize,
    entries: usize,
}

impl<'a> Budget<'a> {
    /// The allowance of a file that is, with the files of its buffers, this many bytes long.
    pub(super) fn new(file: &'a str, bytes: usize) -> Self {
        let triangles = FREE_TRIANGLES.saturating_add(bytes);
        Self { file, triangles, entries: FREE_ENTRIES.saturating_add(bytes) }
    }

    /// The name of the file.
    pub(super) fn file(&self) -> &str {
        self.file
    }

    /// Takes the triangles of a primitive from the allowance. One without any counts as one, as the
    /// way to it takes memory, too.
    pub(super) fn triangles(&mut self, count: usize, place: &str) -> Result<(), Error> {
        let error = || self.error(place, "triangles");
        self.triangles = self.triangles.checked_sub(count.max(1)).ok_or_else(error)?;
        Ok(())
    }

    /// Takes accessor entries from the allowance.
    pub(super) fn entries(&mut self, count: usize, place: &str) -> Result<(), Error> {
        let error = || self.error(place, "vertices");
        self.entries = self.entries.checked_sub(count).ok_or_else(error)?;
        Ok(())
    }

    fn error(&self, place: &str, what: &str) -> Error {
        let message =
            format!("{place}: expected a number of {what} that the file's size can justify");
        Error::new(ErrorKind::TooLarge, self.file, message)
    }
}
