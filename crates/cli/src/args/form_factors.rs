//! What `radiosity form-factors` is told.

use std::path::PathBuf;

use clap::ValueEnum;

use super::{BesideArgs, SidesArg, help, share};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Examples:
  radiosity form-factors room.tri -o F.csv                     between all triangles
  radiosity form-factors hall.obj -o F.csv --between groups    between named groups
  radiosity form-factors room.tri -o F.npz --close --report F.json

Formats by extension:
  .csv  i,j,F,error: a line for each form factor that is not 0; F is the share of the light
        leaving i that arrives at j, and error how far F may be from the truth
  .npy  all N x N form factors for NumPy, with the rows' names in a .names.csv beside it
  .npz  for scipy.sparse.load_npz, with the further arrays error, area and name

A surface with two sides has two rows; the one of its back is named NAME:back. Rows of a
closed scene sum to 1; in an open scene the rest leaves it, or meets backs.

Exit codes: 0 done, 1 failed, 2 wrong command line.")]
pub(crate) struct FormFactorsArgs {
    #[arg(value_name = "SCENE", help = help::SCENE)]
    pub(crate) scene: PathBuf,

    /// Where to write, as often as you like; the extension names the format, `-` is CSV on
    /// stdout
    #[arg(short, long, value_name = "F.csv", required = true)]
    pub(crate) output: Vec<PathBuf>,

    /// Error asked of the form factor between two triangles, as a share of it, or of 1 / N of N
    /// triangles if something may stand in between and that is more; so each row is right to
    /// twice this share: 1e-10 to 1
    #[arg(long, value_name = "X", default_value = "1e-3", value_parser = share)]
    pub(crate) tolerance: f64,

    /// What the rows are [default: groups if the file names more than one, else triangles]
    #[arg(long, value_enum, value_name = "WHAT")]
    pub(crate) between: Option<BetweenArg>,

    /// Bring the rows of a closed scene to a sum of exactly 1, keeping reciprocity
    #[arg(long)]
    pub(crate) close: bool,

    /// Write what was found as JSON
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,

    /// Threads; 0 for as many as the machine has. The result does not depend on it
    #[arg(long, value_name = "N", default_value_t = 0)]
    pub(crate) threads: usize,

    /// Sides that light leaves and arrives at: as the scene says, all fronts, or all both
    /// sides
    #[arg(long, value_enum, default_value_t = SidesArg::Scene, hide_possible_values = true)]
    pub(crate) sides: SidesArg,

    #[command(flatten)]
    pub(crate) beside: BesideArgs,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum BetweenArg {
    Groups,
    Triangles,
}
