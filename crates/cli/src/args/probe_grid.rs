//! Flags of `probe-grid`.

use std::path::PathBuf;

use super::{ReadArgs, help};

#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example, the illuminance 0.8 above a floor:
  radiosity probe-grid office.obj --group floor --spacing 0.5 --height 0.8 -o desk.csv
  radiosity solve office.obj --probe desk.csv -o desk.probe.csv

The plane of the group is divided into equal cells along the axes that it is nearest to, none
longer than the spacing; a place is the middle of a cell that lies over the group, looks along the
group's normal, and is written as x,y,z,nx,ny,nz, row by row.")]
pub(crate) struct ProbeGridArgs {
    #[arg(value_name = "SCENE", help = help::SCENE)]
    pub(crate) scene: PathBuf,

    /// Name of the group that the grid lies over; its triangles must be in one plane
    #[arg(long, value_name = "NAME")]
    pub(crate) group: String,

    /// Longest side of a cell, in the scene's units
    #[arg(long, value_name = "LENGTH", value_parser = length)]
    pub(crate) spacing: f64,

    /// How far in front of the group the grid lies, in the scene's units
    #[arg(long, value_name = "LENGTH", default_value_t = 0.0, value_parser = height)]
    pub(crate) height: f64,

    /// Where to write the places; `-` is stdout
    #[arg(short, long, value_name = "POINTS.csv")]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) read: ReadArgs,
}

/// A length above 0.
fn length(text: &str) -> Result<f64, String> {
    height(text).ok().filter(|x| *x > 0.0).ok_or_else(|| "expected a length above 0".into())
}

/// A length of at least 0.
fn height(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|x| x.is_finite() && *x >= 0.0);
    value.ok_or_else(|| "expected a length of at least 0".into())
}
