//! Why a file could not be opened.

use std::error::Error as StdError;
use std::fmt;

use crate::shortened::OneLine;

/// A failure, its file and, where text is read, the line and column of it.
///
/// Display is one line that already tells the cause; `source` keeps the cause itself.
#[derive(Debug)]
pub struct Error {
    kind: ErrorKind,
    file: String,
    line: Option<u64>,
    column: Option<u64>,
    message: String,
    source: Option<Box<dyn StdError + Send + Sync>>,
}

/// The kinds of failure.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A file cannot be read.
    Io,
    /// The extension is none of tri, vs3, obj, gltf, glb.
    UnknownFormat,
    /// This build lacks the feature that reads the format.
    FeatureOff,
    /// The file is not what its extension says, or has a word in its text where another is
    /// expected: a number that no surface can have included.
    Syntax,
    /// The file is well formed, but its parts contradict each other, or it holds a number
    /// that no surface can have.
    Invalid,
    /// The file asks for far more than its size can justify.
    TooLarge,
}

impl Error {
    pub(crate) fn new(kind: ErrorKind, file: &str, message: impl Into<String>) -> Self {
        let message = message.into();
        Self { kind, file: file.to_owned(), line: None, column: None, message, source: None }
    }

    pub(crate) fn at(mut self, line: u64, column: u64) -> Self {
        (self.line, self.column) = (Some(line), Some(column));
        self
    }

    pub(crate) fn because(mut self, source: impl StdError + Send + Sync + 'static) -> Self {
        self.source = Some(Box::new(source));
        self
    }

    /// The kind of failure.
    #[must_use]
    pub fn kind(&self) -> ErrorKind {
        self.kind
    }

    /// The file it happened in: the scene's, or one that the scene names.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The line, counted from 1, in files that are text.
    #[must_use]
    pub fn line(&self) -> Option<u64> {
        self.line
    }

    /// The column in bytes, counted from 1, in files that are text.
    #[must_use]
    pub fn column(&self) -> Option<u64> {
        self.column
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", OneLine(&self.file))?;
        for number in [self.line, self.column].into_iter().flatten() {
            write!(f, ":{number}")?;
        }
        write!(f, ": {}", OneLine(&self.message))
    }
}

impl StdError for Error {
    fn source(&self) -> Option<&(dyn StdError + 'static)> {
        self.source.as_deref().map(|cause| cause as _)
    }
}
