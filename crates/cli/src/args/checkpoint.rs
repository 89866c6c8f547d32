//! Flags for work that may be cut off.

#[cfg(feature = "checkpoint")]
use std::path::PathBuf;
#[cfg(feature = "checkpoint")]
use std::time::Duration;

/// None of them without the feature `checkpoint`.
#[cfg(not(feature = "checkpoint"))]
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct CheckpointArgs {}

#[cfg(feature = "checkpoint")]
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Work that may be cut off")]
pub(crate) struct CheckpointArgs {
    /// Keep the state of the work in this file, for --resume. A crash, a kill or the end of
    /// --max-time then cost no more than what was done since. The file stays when the work is done
    #[arg(long, value_name = "FILE")]
    pub(crate) checkpoint: Option<PathBuf>,

    /// How often --checkpoint is written, as 500ms, 60s, 10m or 1h [default: 30s]
    #[arg(long, value_name = "TIME", value_parser = super::time, requires = "checkpoint")]
    pub(crate) every: Option<Duration>,

    /// Go on from a file of --checkpoint, to the same bytes as if nothing had cut the work off.
    /// Scene and settings must be the same; threads, limits of time and outputs need not. May be
    /// the file of --checkpoint, too
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
}
