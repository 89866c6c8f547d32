//! Why a scene could not be built.

use std::fmt;

use crate::Rgb;

/// A value that no scene may hold, and what it belongs to.
#[derive(Clone, Debug, PartialEq)]
pub struct Error {
    kind: ErrorKind,
    place: String,
}

/// What was wrong.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A reflectance outside [0, 1], or not a number.
    Reflectance(Rgb),
    /// An emittance below 0, or not finite.
    Emittance(Rgb),
    /// A triangle names a vertex, material or group that was never added.
    UnknownId(&'static str, u32),
    /// A triangle uses a vertex with a coordinate that is not finite.
    NonFiniteVertex(u32),
    /// A triangle uses a vertex with a coordinate beyond [`crate::MOST_COORDINATE`].
    FarVertex(u32),
}

impl Error {
    pub(crate) fn new(kind: ErrorKind, place: String) -> Self {
        Self { kind, place }
    }

    /// What was wrong.
    #[must_use]
    pub fn kind(&self) -> &ErrorKind {
        &self.kind
    }

    /// The material's name or the triangle's number.
    #[must_use]
    pub fn place(&self) -> &str {
        &self.place
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let place = &self.place;
        match &self.kind {
            ErrorKind::Reflectance(Rgb(c)) => {
                write!(f, "material {place:?}: reflectance {c:?} is outside [0, 1]")
            }
            ErrorKind::Emittance(Rgb(c)) => {
                write!(f, "material {place:?}: emittance {c:?} is not finite and at least 0")
            }
            ErrorKind::UnknownId(what, id) => write!(f, "{place}: no {what} has number {id}"),
            ErrorKind::NonFiniteVertex(id) => {
                write!(f, "{place}: vertex {id} has a coordinate that is not finite")
            }
            ErrorKind::FarVertex(id) => write!(
                f,
                "{place}: vertex {id} has a coordinate beyond {:.0e}; use a larger unit of length",
                crate::MOST_COORDINATE
            ),
        }
    }
}

impl std::error::Error for Error {}
