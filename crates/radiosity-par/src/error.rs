//! Why a pool could not start, and why a text names no loop.

use std::fmt;

/// The operating system refused the threads.
#[derive(Debug)]
pub struct Error {
    threads: usize,
    source: rayon::ThreadPoolBuildError,
}

impl Error {
    pub(crate) fn new(threads: usize, source: rayon::ThreadPoolBuildError) -> Self {
        Self { threads, source }
    }

    /// How many threads were asked for.
    #[must_use]
    pub fn threads(&self) -> usize {
        self.threads
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "cannot start {} threads: {}", self.threads, self.source)
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.source)
    }
}

/// The text names no [`Loop`](crate::Loop).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ParseLoopError {
    text: String,
}

impl ParseLoopError {
    pub(crate) fn new(text: &str) -> Self {
        Self { text: text.to_owned() }
    }

    /// The text as it was given.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }
}

impl fmt::Display for ParseLoopError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Debug escapes line ends, so that the message stays on one line.
        write!(
            f,
            "no loop is called {:?}: expected static, dynamic:N, guided:N or tasks, with a whole \
             number N of at least 1",
            self.text
        )
    }
}

impl std::error::Error for ParseLoopError {}
