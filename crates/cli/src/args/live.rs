//! Flags to watch a solve.

/// None of them without the feature `live`.
#[cfg(not(feature = "live"))]
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct LiveArgs {}

#[cfg(feature = "live")]
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Watching")]
pub(crate) struct LiveArgs {
    /// Serve the viewer while the work goes on, on this machine alone: the address, which holds a
    /// secret, is said at the start. The page shows the light filling in, and can stop the work as
    /// Ctrl-C does. It changes no byte of the result
    #[arg(long)]
    live: bool,

    /// Port of --live [default: one that is free]
    #[arg(long, value_name = "PORT", requires = "live")]
    live_port: Option<u16>,
}

impl LiveArgs {
    /// The port to serve on, 0 for any, if a solve is to be watched.
    pub(crate) fn port(&self) -> Option<u16> {
        #[cfg(feature = "live")]
        return self.live.then(|| self.live_port.unwrap_or(0));
        #[cfg(not(feature = "live"))]
        None
    }
}
