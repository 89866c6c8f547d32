//! Why the program ends without a result, in one line.

use std::fmt;

use crate::absent;

/// What went wrong, and with which exit code.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line asks for something impossible: exit code 2.
    Usage(String),
    /// A file or a scene does not allow it: exit code 1.
    Failed(String),
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(message) | Self::Failed(message) => f.write_str(message),
        }
    }
}

macro_rules! failed_from {
    ($($error:ty),*) => {$(
        impl From<$error> for Failure {
            fn from(error: $error) -> Self {
                Self::Failed(error.to_string())
            }
        }
    )*};
}

failed_from!(radiosity_par::Error);

/// A format that this build leaves out is no fault of the file.
impl From<scene_import::Error> for Failure {
    fn from(error: scene_import::Error) -> Self {
        match error.kind() {
            scene_import::ErrorKind::FeatureOff => Self::Usage(error.to_string()),
            _ => Self::Failed(error.to_string()),
        }
    }
}

impl From<output::Error> for Failure {
    fn from(error: output::Error) -> Self {
        absent::format(&error).unwrap_or_else(|| Self::Failed(error.to_string()))
    }
}
