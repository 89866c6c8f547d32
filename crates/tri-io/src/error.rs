//! Why a text is not a `.tri` file, and where.

use std::{fmt, io};

/// What stopped a [`Reader`](crate::Reader), and the line and column where it stands.
///
/// The message is one line without a file name, which the caller knows and puts before it.
///
/// # Examples
/// ```
/// let text = "Triangle\n1 2 300 0 0 0\n";
/// let error = tri_io::Reader::new(text.as_bytes()).next().unwrap().unwrap_err();
/// assert_eq!(error.to_string(), "2:5: expected an integer from 0 to 255, found \"300\"");
/// assert_eq!((error.line(), error.column()), (2, 5));
/// ```
#[derive(Debug)]
pub struct Error {
    kind: ErrorKind,
    line: u64,
    column: u64,
}

/// What went wrong.
#[derive(Debug)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The source of bytes failed; the place is the one reached.
    Io(io::Error),
    /// The text goes on differently than a record does.
    Unexpected {
        /// What may stand at this place.
        expected: Expected,
        /// What stands there.
        found: Found,
    },
}

/// What a record needs at some place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Expected {
    /// The word `Triangle`, or the end of the file.
    Keyword,
    /// A colour component.
    Channel,
    /// A number that an `f64` can hold.
    Number,
    /// The n-th (from 1) of the 9 numbers of the vertices, or of the 18 with normals.
    Coordinate(u8),
    /// A number that is not absurdly long.
    ShortNumber,
}

/// What stands where something else is expected.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Found {
    /// A word; a long one is cut and ends in `…`, and bytes that are not UTF-8 are replaced.
    Word(String),
    /// Nothing more.
    EndOfFile,
}

impl Error {
    pub(crate) fn new(kind: ErrorKind, (line, column): (u64, u64)) -> Self {
        Self { kind, line, column }
    }

    /// What went wrong.
    #[must_use]
    pub fn kind(&self) -> &ErrorKind {
        &self.kind
    }

    /// The line, counted from 1.
    #[must_use]
    pub fn line(&self) -> u64 {
        self.line
    }

    /// The column, counted in bytes from 1.
    #[must_use]
    pub fn column(&self) -> u64 {
        self.column
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: ", self.line, self.column)?;
        match &self.kind {
            ErrorKind::Io(error) => write!(f, "cannot read on: {error}"),
            ErrorKind::Unexpected { expected, found } => {
                write!(f, "expected {expected}, found {found}")
            }
        }
    }
}

impl fmt::Display for Expected {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Keyword => f.write_str("`Triangle`"),
            Self::Channel => f.write_str("an integer from 0 to 255"),
            Self::Number => f.write_str("a finite number"),
            Self::Coordinate(index @ 0..=9) => write!(f, "number {index} of 9 (18 with normals)"),
            Self::Coordinate(index) => write!(f, "number {index} of 18 (vertices with normals)"),
            Self::ShortNumber => {
                write!(f, "a number of at most {} bytes", crate::lexer::MAX_WORD)
            }
        }
    }
}

impl fmt::Display for Found {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Word(word) => write!(f, "{word:?}"),
            Self::EndOfFile => f.write_str("end of file"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match &self.kind {
            ErrorKind::Io(error) => Some(error),
            ErrorKind::Unexpected { .. } => None,
        }
    }
}
