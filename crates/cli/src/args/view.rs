//! Flags of `view`.

use std::path::PathBuf;

/// From a lit file to a page.
#[derive(Debug, clap::Args)]
#[command(after_help = "\
A .glb holds light at corners, and no means of elements: the page then says so. `solve -o NAME.html`
writes the same page with everything that the solve knew.")]
pub(crate) struct ViewArgs {
    /// Lit scene: a .glb that `solve` wrote
    #[arg(value_name = "LIT.glb")]
    pub(crate) solution: PathBuf,

    /// Page to write, a .html
    #[arg(short, long, value_name = "OUT.html")]
    pub(crate) output: PathBuf,

    /// What `solve --report` wrote of the same run: the page then shows the stated error, the curve
    /// and the plan
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,

    /// Brighten by this many stops (doublings), relative to the colours of the file
    #[arg(long, value_name = "STOPS", default_value_t = 0.0, allow_negative_numbers = true)]
    pub(crate) exposure: f64,
}
