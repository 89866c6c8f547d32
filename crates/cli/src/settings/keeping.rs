//! Where the state of the work is kept, and where it goes on from.

#[cfg(feature = "checkpoint")]
use std::path::Path;
use std::path::PathBuf;
use std::time::Duration;

use crate::args::CheckpointArgs;
use crate::failure::Failure;

/// How often a checkpoint is written when the command line does not say.
#[cfg(feature = "checkpoint")]
const DEFAULT_EVERY: Duration = Duration::from_secs(30);

/// Where the state of the work is kept, and where it goes on from.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Keeping {
    pub(crate) checkpoint: Option<PathBuf>,
    pub(crate) every: Duration,
    pub(crate) resume: Option<PathBuf>,
}

/// Nothing is kept without the feature `checkpoint`.
#[cfg(not(feature = "checkpoint"))]
pub(super) fn keeping(_: CheckpointArgs) -> Result<Keeping, Failure> {
    Ok(Keeping::default())
}

/// Resolves the flags for work that may be cut off.
#[cfg(feature = "checkpoint")]
pub(super) fn keeping(args: CheckpointArgs) -> Result<Keeping, Failure> {
    let CheckpointArgs { checkpoint, every, resume } = args;
    for (flag, path) in [("--checkpoint", &checkpoint), ("--resume", &resume)] {
        if path.as_deref() == Some(Path::new("-")) {
            return Err(Failure::Usage(format!(
                "{flag} -: expected a file name, such as {flag} light.ckpt"
            )));
        }
    }
    Ok(Keeping { checkpoint, every: every.unwrap_or(DEFAULT_EVERY), resume })
}
