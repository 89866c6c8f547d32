//! Why nothing was written, read or compared: one line, with the path where there is one.

use std::fmt;
use std::path::{Path, PathBuf};

use crate::Format;

type Source = Box<dyn std::error::Error + Send + Sync>;

/// What went wrong, in which file.
#[derive(Debug)]
pub struct Error {
    kind: ErrorKind,
    path: Option<PathBuf>,
    source: Option<Source>,
}

/// What was wrong.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// No format goes by this file name extension.
    UnknownExtension(Option<String>),
    /// This build lacks the feature that writes the format: the feature, named as the extension is.
    FeatureOff(&'static str),
    /// An element whose exitance is not finite, or too large for the format.
    Exitance {
        /// Its index in the solution.
        element: usize,
    },
    /// An element that does not belong to the scene it came with.
    Element {
        /// Its index in the solution.
        element: usize,
        /// What it names wrongly.
        what: &'static str,
    },
    /// A vertex with a coordinate that is not finite, or too large for the format.
    Vertex {
        /// Its index in the solution.
        vertex: usize,
    },
    /// A camera that looks nowhere: its name.
    Camera(String),
    /// An option outside its range, and the range.
    Option(&'static str),
    /// More than the format can count.
    TooLarge(&'static str),
    /// A glTF document that light cannot be put into: where, and what was expected.
    Document(String),
    /// Text that is not the expected CSV.
    Text {
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What stands there and what was expected.
        message: String,
    },
    /// Two solutions of different length.
    RowCount {
        /// Rows of the compared solution.
        ours: usize,
        /// Rows of the reference.
        reference: usize,
    },
    /// Rows, counted from 0, that belong to different triangles.
    RowTriangle {
        /// The row, from 0.
        row: usize,
        /// The triangle of the compared solution.
        ours: u32,
        /// The triangle of the reference.
        reference: u32,
    },
    /// Rows that should speak of the same place on a triangle do not.
    RowPlace {
        /// The row, from 0.
        row: usize,
        /// u and v of the compared solution.
        ours: [f64; 2],
        /// u and v of the reference.
        reference: [f64; 2],
    },
    /// Rows, counted from 0, whose triangles differ in area.
    RowArea {
        /// The row, from 0.
        row: usize,
        /// The area in the compared solution.
        ours: f64,
        /// The area in the reference.
        reference: f64,
    },
    /// A row, counted from 0, with a value that is not finite or an area below 0.
    RowValue {
        /// The row, from 0.
        row: usize,
    },
    /// Every row emits or is ambiguous, so nothing is left to compare.
    NoRows,
    /// The file could not be read.
    Read,
    /// The file could not be written.
    Write,
}

impl Error {
    pub(crate) fn new(kind: ErrorKind) -> Self {
        Self { kind, path: None, source: None }
    }

    pub(crate) fn caused(kind: ErrorKind, source: impl Into<Source>) -> Self {
        Self { kind, path: None, source: Some(source.into()) }
    }

    pub(crate) fn write(source: impl Into<Source>) -> Self {
        Self::caused(ErrorKind::Write, source)
    }

    /// The same error, in the file it was met in.
    #[must_use]
    pub fn at(mut self, path: impl Into<PathBuf>) -> Self {
        self.path = Some(path.into());
        self
    }

    /// What was wrong.
    #[must_use]
    pub fn kind(&self) -> &ErrorKind {
        &self.kind
    }

    /// The file, where one was involved.
    #[must_use]
    pub fn path(&self) -> Option<&Path> {
        self.path.as_deref()
    }
}

/// A failed write, for writers of other formats than ours.
impl From<std::io::Error> for Error {
    fn from(source: std::io::Error) -> Self {
        Self::write(source)
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(path) = &self.path {
            // A line and column follow the path without a space, as compilers write them.
            let joint = if matches!(self.kind, ErrorKind::Text { .. }) { ":" } else { ": " };
            write!(f, "{}{joint}", path.display())?;
        }
        write!(f, "{}", self.kind)?;
        match &self.source {
            Some(source) => write!(f, ": {source}"),
            None => Ok(()),
        }
    }
}

impl fmt::Display for ErrorKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnknownExtension(None) => {
                write!(f, "no file name extension, expected {}", Format::extensions())
            }
            Self::UnknownExtension(Some(e)) => {
                write!(f, "unknown file name extension \".{e}\", expected {}", Format::extensions())
            }
            Self::FeatureOff(name) => write!(
                f,
                "this program was built without the feature `{name}`: it writes no .{name}"
            ),
            Self::Exitance { element } => {
                write!(f, "element {element}: exitance is not finite, or too large for the format")
            }
            Self::Element { element, what } => {
                write!(f, "element {element}: names a {what} that is not there")
            }
            Self::Vertex { vertex } => {
                let what = "a coordinate is not finite, or too large for the format";
                write!(f, "solution vertex {vertex}: {what}")
            }
            Self::Camera(name) => write!(
                f,
                "camera {name:?}: expected finite coordinates, a target apart from the eye \
                 and a field of view between 0 and 180 degrees"
            ),
            Self::Option(range) => write!(f, "expected {range}"),
            Self::TooLarge(what) => write!(f, "too large for the format: {what}"),
            Self::Document(what) => write!(f, "the scene's glTF document: {what}"),
            Self::Text { line, column, message } => write!(f, "{line}:{column}: {message}"),
            Self::RowCount { ours, reference } => {
                write!(f, "{ours} rows against {reference} in the reference")
            }
            Self::RowTriangle { row, ours, reference } => {
                write!(f, "row {row}: triangle {ours} against {reference} in the reference")
            }
            Self::RowPlace { row, ours, reference } => {
                write!(f, "row {row}: u, v {ours:?} against {reference:?} in the reference")
            }
            Self::RowArea { row, ours, reference } => {
                write!(f, "row {row}: area {ours} against {reference} in the reference")
            }
            Self::RowValue { row } => {
                write!(f, "row {row}: expected finite values and an area of at least 0")
            }
            Self::NoRows => write!(f, "nothing to compare: every row emits or is ambiguous"),
            Self::Read => write!(f, "cannot be read"),
            Self::Write => write!(f, "cannot be written"),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        self.source.as_ref().map(|s| &**s as _)
    }
}
