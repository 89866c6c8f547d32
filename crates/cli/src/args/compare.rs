//! Flags of `compare`.

use std::path::PathBuf;

#[cfg(feature = "png")]
use super::PictureArgs;
use super::share;

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Both files have the columns triangle,area,B_r,B_g,B_b. B may also have se_r,se_g,se_b (its
standard error) and emits,ambiguous (1 leaves the row out).

  E1    sum of area * |A - B| over sum of area * B: the relative error of the power
  E2    root of: sum of area * (A - B)^2 over sum of area * B^2
  Einf  largest |A - B| over the area mean of B")]
pub(crate) struct CompareArgs {
    /// The solution to judge
    #[arg(value_name = "A")]
    pub(crate) ours: PathBuf,

    /// The reference
    #[arg(value_name = "B")]
    pub(crate) reference: PathBuf,

    /// Fail (exit code 1) if E1 of the worst channel is above this, as 0.03 or 3%
    #[arg(long, value_name = "X", value_parser = share)]
    pub(crate) at_most: Option<f64>,

    /// Draw A, B in the same exposure, and (A - B) / mean of B in false colour, side by side: blue
    /// where A is darker, red where it is brighter, grey where nothing is compared. Needs --scene
    #[cfg(feature = "png")]
    #[arg(long, value_name = "DIFF.png", requires = "scene")]
    pub(crate) picture: Option<PathBuf>,

    /// The scene that both are of, for --picture
    #[cfg(feature = "png")]
    #[arg(long, value_name = "SCENE", requires = "picture")]
    pub(crate) scene: Option<PathBuf>,

    /// The difference at the ends of the colours, as 0.05 or 5% [default: the largest, rounded up]
    #[cfg(feature = "png")]
    #[arg(long, value_name = "X", requires = "picture", value_parser = range)]
    pub(crate) range: Option<f64>,

    #[cfg(feature = "png")]
    #[command(flatten)]
    pub(crate) view: PictureArgs,
}

/// A share above 0, which may exceed 1.
#[cfg(feature = "png")]
fn range(text: &str) -> Result<f64, String> {
    super::quantity(text, &[("%", 0.01)])
        .ok_or_else(|| "expected a difference above 0, such as 0.05 or 5%".into())
}
