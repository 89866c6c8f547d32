//! Why a case cannot be run.

use std::error::Error as StdError;
use std::fmt;

/// What failed, and where; Display is one line.
#[derive(Debug)]
pub struct Error {
    place: String,
    message: String,
    source: Option<Box<dyn StdError + Send + Sync>>,
}

impl Error {
    pub(crate) fn new(place: impl Into<String>, message: impl Into<String>) -> Self {
        Self { place: place.into(), message: message.into(), source: None }
    }

    pub(crate) fn caused(
        place: impl Into<String>,
        source: impl StdError + Send + Sync + 'static,
    ) -> Self {
        Self { place: place.into(), message: source.to_string(), source: Some(Box::new(source)) }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.message)
    }
}

impl StdError for Error {
    fn source(&self) -> Option<&(dyn StdError + 'static)> {
        self.source.as_deref().map(|cause| cause as _)
    }
}
