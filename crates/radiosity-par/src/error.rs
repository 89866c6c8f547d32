//! Why a pool could not start.

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
