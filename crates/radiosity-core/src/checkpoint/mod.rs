//! The state of a solve between two steps as bytes, and back.
//!
//! Kept is what cannot be computed again without shooting: how many elements each level was grown
//! to and where, the light of the last finished level, and the state of the shots of the present
//! one. Meshes are grown anew, which takes no ray; they are the same to the bit, and a digest says
//! so. The ladder adds its part to that of the shots.
//!
//! Nothing here knows of files. Who keeps the bytes adds a checksum, and what they belong to.

mod digest;
mod record;

use std::fmt;
use std::io::{self, Write};

pub(crate) use digest::digest;
pub(crate) use record::{Loose, Reader, Record, record, tags};

use crate::refine::Climbed;
use crate::shooting::Progress;

/// A layer's part of what is kept.
pub(crate) trait Part {
    /// Appends it.
    fn write(&self, out: &mut dyn Write) -> io::Result<()>;
}

/// The state of a solve between two steps, for the moment that an observer looks at it.
#[derive(Clone, Copy)]
pub struct Kept<'a> {
    part: &'a dyn Part,
    inner: Option<&'a Kept<'a>>,
}

impl fmt::Debug for Kept<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Kept").finish_non_exhaustive()
    }
}

impl<'a> Kept<'a> {
    /// The innermost part.
    pub(crate) fn new(part: &'a dyn Part) -> Self {
        Self { part, inner: None }
    }

    /// The same inside another layer.
    pub(crate) fn within(&'a self, part: &'a dyn Part) -> Self {
        Self { part, inner: Some(self) }
    }

    /// Writes it, for [`Checkpoint::read`]: at most about 100 bytes an element, in many small
    /// pieces.
    ///
    /// # Errors
    /// What `out` answers.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        self.part.write(out)?;
        self.inner.map_or(Ok(()), |inner| inner.write(out))
    }
}

/// A state that was kept, read again: [`crate::resume`] goes on from it.
#[derive(Debug)]
pub struct Checkpoint {
    pub(crate) climbed: Climbed,
    pub(crate) progress: Progress,
}

impl Checkpoint {
    /// Reads what [`Kept::write`] wrote while [`crate::refine()`] was at work.
    ///
    /// # Errors
    /// If the bytes are none of its, too few, too many, or not numbers.
    pub fn read(bytes: &[u8]) -> Result<Self, Inconsistent> {
        let mut from = Reader::new(bytes);
        let climbed = Climbed::read(&mut from)?;
        let progress = Progress::read(&mut from)?;
        from.end()?;
        Ok(Self { climbed, progress })
    }

    /// Elements of the last finished level; 0 on the first.
    #[must_use]
    pub fn finished_elements(&self) -> usize {
        self.climbed.finished_elements()
    }
}

/// What in a kept state contradicts itself, or the scene and settings that it is to go on with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inconsistent(pub(crate) &'static str);

impl fmt::Display for Inconsistent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

impl std::error::Error for Inconsistent {}
