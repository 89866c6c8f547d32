//! The command line as it is typed.

mod checkpoint;
#[cfg(feature = "form-factors")]
mod form_factors;
mod help;
mod live;
#[cfg(feature = "manual")]
mod manual;
mod picture;
mod probe_grid;
mod shooting;
mod snapshot;
mod terminal;
#[cfg(feature = "html")]
mod view;

use std::path::PathBuf;
use std::time::Duration;

use clap::{Parser, Subcommand, ValueEnum};

pub(crate) use checkpoint::CheckpointArgs;
#[cfg(feature = "form-factors")]
pub(crate) use form_factors::{BetweenArg, FormFactorsArgs};
pub(crate) use help::CONVERTED;
pub(crate) use live::LiveArgs;
#[cfg(feature = "manual")]
pub(crate) use manual::{CompletionsArgs, ManArgs};
pub(crate) use picture::PictureArgs;
pub(crate) use probe_grid::ProbeGridArgs;
pub(crate) use shooting::{ShootingArgs, SplitArg};
pub(crate) use snapshot::Every;
pub(crate) use terminal::{ColorArg, LogArg, TerminalArgs};
#[cfg(feature = "html")]
pub(crate) use view::ViewArgs;

/// Turns a triangle scene into its diffuse global illumination.
#[cfg_attr(
    feature = "gltf",
    doc = "\n\nWithout a command, solves the bundled Cornell box and writes out/cornell.glb, .csv, .json and, \
           where it can, .png."
)]
#[derive(Debug, Parser)]
#[command(name = "radiosity", version, max_term_width = 100)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,

    #[command(flatten)]
    pub(crate) terminal: TerminalArgs,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// Light a scene and write it out
    Solve(Box<SolveArgs>),
    /// Say what a scene file holds, what looks wrong in it, and what a solve would leave out, and why
    Plan(PlanArgs),
    /// Write the form factors between groups or triangles: the share of the light leaving one
    /// that arrives at the other
    #[cfg(feature = "form-factors")]
    FormFactors(FormFactorsArgs),
    /// Rewrite a scene file in another format, unlit
    Convert(ConvertArgs),
    /// Measure how far two solutions (.csv) are apart
    Compare(CompareArgs),
    /// Make places for `solve --probe`: a grid over a floor or a work plane
    ProbeGrid(ProbeGridArgs),
    /// Check known answers on this machine: closed forms, known solutions, the bundled scenes
    #[cfg(feature = "verify")]
    Verify(VerifyArgs),
    /// Print what a shell needs to complete the command line
    #[cfg(feature = "manual")]
    Completions(CompletionsArgs),
    /// Write manual pages
    #[cfg(feature = "manual")]
    Man(ManArgs),
    /// Make a page of a lit scene: walk about, ask points, read how wrong the light can be
    #[cfg(feature = "html")]
    View(ViewArgs),
}

/// How a scene file is read.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct ReadArgs {
    /// Sides that emit, receive and reflect: as the scene says, all fronts, all both sides,
    /// or `paired` (surfaces exchange light front to front and back to back, sharing one
    /// exitance: the rule of an older program, for comparison)
    #[arg(long, value_enum, default_value_t = SidesArg::Scene)]
    pub(crate) sides: SidesArg,

    /// Factor on the light of emitters (.tri only)
    #[arg(long, value_name = "X", default_value_t = 1.0)]
    pub(crate) light: f64,

    /// Reflectance of a surface whose front colour is 255 (.tri only)
    #[arg(long, value_name = "X", default_value_t = 0.5)]
    pub(crate) reflect: f64,

    #[command(flatten)]
    pub(crate) beside: BesideArgs,
}

/// Which files a scene may name: nothing to say where no format names any.
#[derive(Clone, Debug, Default, clap::Args)]
pub(crate) struct BesideArgs {
    /// Read the files that the scene names (buffers, textures, material libraries) wherever they lie;
    /// else only in its own folder and below. For scenes whose maker you trust
    #[cfg(any(feature = "obj", feature = "gltf"))]
    #[arg(long)]
    allow_outside: bool,
}

impl BesideArgs {
    /// Whether files outside the scene's folder are read.
    pub(crate) fn allow_outside(&self) -> bool {
        #[cfg(any(feature = "obj", feature = "gltf"))]
        let allow = self.allow_outside;
        #[cfg(not(any(feature = "obj", feature = "gltf")))]
        let allow = false;
        allow
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum SidesArg {
    Scene,
    Front,
    Both,
    Paired,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum AccelArg {
    /// What the plan finds the fastest: bvh, or none where nothing can block
    Auto,
    /// Octree walked by 3D-DDA
    Octree,
    /// Bounding volume hierarchy
    Bvh,
    /// Nothing blocks: right for convex scenes alone
    None,
}

/// How finely and how long.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct WorkArgs {
    /// Split the scene into about this many elements, instead of refining [default with
    /// --converge: 10000, or twice the scene's triangles]
    #[arg(long, value_name = "N")]
    pub(crate) elements: Option<usize>,

    /// Which structure finds what blocks the light
    #[arg(long, value_enum, default_value_t = AccelArg::Auto)]
    pub(crate) accel: AccelArg,

    /// Threads; 0 for as many as the machine has [default: as many as pay]. The result does not
    /// depend on it
    #[arg(long, value_name = "N")]
    pub(crate) threads: Option<usize>,

    /// What the scene needs, which `radiosity plan` explains, or `everything`, whatever it needs: for
    /// comparison
    #[arg(long, value_enum, default_value_t = NeedArg::Auto)]
    pub(crate) need: NeedArg,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum NeedArg {
    /// What the scene does not need is left out
    Auto,
    /// Nothing is left out
    Everything,
}

#[derive(Debug, clap::Args)]
#[command(after_help = help::solve())]
pub(crate) struct SolveArgs {
    #[arg(value_name = "SCENE", help = help::SCENE_OR_BUNDLED)]
    pub(crate) scene: Option<PathBuf>,

    /// Where to write, as often as you like; the extension names the format, `-` is CSV on
    /// stdout
    #[arg(short, long, value_name = "OUT")]
    pub(crate) output: Vec<PathBuf>,

    /// Take flags from this file, each by its long name; what is typed wins (docs/config.md)
    #[cfg(feature = "config")]
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) config: Option<PathBuf>,

    /// Write everything measured as JSON (docs/report.md says what each field is)
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,

    /// Refine until the stated error (E1 of the triangles' exitance) is at most this
    /// [default: 1%, unless --elements or --converge fixes the work]
    #[arg(long, value_name = "X", value_parser = share, conflicts_with_all = ["elements", "converge"])]
    pub(crate) error: Option<f64>,

    /// Stop the solve after this time, as 500ms, 60s, 10m or 1h, write what was reached and state
    /// how wrong that is. Late by some hundredths of a second, but for the splitting of a mesh: 4 s
    /// for a million elements. Ctrl-C does the same at any time, and a second one ends the program
    #[arg(long, value_name = "TIME", value_parser = time)]
    pub(crate) max_time: Option<Duration>,

    /// Refine to no more than this many elements
    #[arg(long, value_name = "N", conflicts_with_all = ["elements", "converge"])]
    pub(crate) max_elements: Option<usize>,

    /// Take no more memory than this, as 500MB or 4GiB: refine to fewer elements, or make fewer
    /// than --elements. Foreseen before each level, and on Linux compared with what is taken
    #[arg(long, value_name = "SIZE", value_parser = memory)]
    pub(crate) max_memory: Option<u64>,

    /// Write the light on its way beside each output, as lit.00001.glb beside lit.glb: every so
    /// many shots, or this long after the one before. While refining, a level begins in the dark
    /// on a finer mesh; for a film, fix the mesh with --elements --no-statement
    #[arg(long, value_name = "every:N|TIME", value_parser = snapshot::every)]
    pub(crate) snapshot: Option<Every>,

    /// Shoot until at most this share of the emitted power is unshot, as 1e-3 or 0.1%, on a
    /// mesh of --elements [default: 1e-3 if --elements is given]
    #[arg(long, value_name = "X", value_parser = share)]
    pub(crate) converge: Option<f64>,

    /// With --elements or --converge: solve that one mesh alone. Saves about a sixth of the
    /// time; the report then states no error
    #[arg(long, conflicts_with = "error")]
    pub(crate) no_statement: bool,

    /// Places to report the light at, written to -o NAME.probe.csv: a CSV with the columns
    /// triangle,u,v (input triangle from 0, and barycentric: a + u (b - a) + v (c - a)), or
    /// x,y,z,nx,ny,nz for places in the open, which `radiosity probe-grid` makes. With a column
    /// `area`, the mean over the part of the triangle of that area around the place. Written is the
    /// exitance of the surface, B, and the irradiance, E: the power that arrives per area
    #[arg(long, value_name = "POINTS.csv")]
    pub(crate) probe: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) work: WorkArgs,

    #[command(flatten)]
    pub(crate) shooting: ShootingArgs,

    #[command(flatten)]
    pub(crate) read: ReadArgs,

    #[command(flatten)]
    pub(crate) keeping: CheckpointArgs,

    #[command(flatten)]
    pub(crate) live: LiveArgs,

    #[command(flatten)]
    pub(crate) picture: PictureArgs,
}

#[derive(Debug, clap::Args)]
pub(crate) struct PlanArgs {
    #[arg(value_name = "SCENE", help = help::SCENE)]
    pub(crate) scene: PathBuf,

    /// Error that a solve would be asked for, unless --elements fixes the work
    #[arg(long, value_name = "X", value_parser = share, default_value = "1%", conflicts_with = "elements")]
    pub(crate) error: f64,

    /// Write the plan as JSON (docs/report.md says what each field is)
    #[arg(long, value_name = "FILE.json")]
    pub(crate) report: Option<PathBuf>,

    #[command(flatten)]
    pub(crate) work: WorkArgs,

    #[command(flatten)]
    pub(crate) read: ReadArgs,
}

#[derive(Debug, clap::Args)]
#[command(after_help = help::convert())]
pub(crate) struct ConvertArgs {
    #[arg(value_name = "IN", help = help::SCENE)]
    pub(crate) input: PathBuf,

    #[arg(value_name = "OUT", help = format!("File to write: {CONVERTED}"))]
    pub(crate) output: PathBuf,

    #[command(flatten)]
    pub(crate) read: ReadArgs,
}

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
}

#[cfg(feature = "verify")]
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Prints a row per case: what must come out, what came out, how far off that is, how far off it
may be, and the time. Exit code 1 if a case fails.")]
pub(crate) struct VerifyArgs {
    /// Only the cases with this in their name
    #[arg(long, value_name = "PART")]
    pub(crate) only: Option<String>,
}

/// A share: `1e-3` or `0.1%`.
fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.strip_suffix('%') {
        Some(number) => (number.trim_end(), 0.01),
        None => (text, 1.0),
    };
    match number.parse::<f64>() {
        Ok(x) if (0.0..=1.0).contains(&(x * unit)) => Ok(x * unit),
        _ => Err("expected a share from 0 to 1, such as 1e-3 or 0.1%".into()),
    }
}

/// A time: `500ms`, `60s`, `10m` or `1h`; a bare number is seconds.
fn time(text: &str) -> Result<Duration, String> {
    const UNITS: [(&str, f64); 4] = [("ms", 1e-3), ("s", 1.0), ("m", 60.0), ("h", 3600.0)];
    quantity(text, &UNITS)
        .and_then(|seconds| Duration::try_from_secs_f64(seconds).ok())
        .ok_or_else(|| "expected a time such as 500ms, 60s, 10m or 1h".into())
}

/// A size in bytes: `500MB` or `4GiB`; a bare number is bytes.
fn memory(text: &str) -> Result<u64, String> {
    const UNITS: [(&str, f64); 7] = [
        ("KiB", 1024.0),
        ("MiB", 1_048_576.0),
        ("GiB", 1_073_741_824.0),
        ("kB", 1e3),
        ("MB", 1e6),
        ("GB", 1e9),
        ("B", 1.0),
    ];
    // Beyond 2⁵³ bytes nothing is limited.
    quantity(text, &UNITS)
        .map(|bytes| bytes as u64)
        .ok_or_else(|| "expected a size such as 500MB or 4GiB".into())
}

/// A number above 0 with one of these units, or none.
fn quantity(text: &str, units: &[(&str, f64)]) -> Option<f64> {
    let with = |(name, size): &(&str, f64)| text.strip_suffix(name).map(|t| (t, *size));
    let (number, unit) = units.iter().find_map(with).unwrap_or((text, 1.0));
    let value = number.trim_end().parse::<f64>().ok()? * unit;
    (value > 0.0 && value.is_finite()).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_command_line_is_consistent() {
        use clap::CommandFactory;
        Args::command().debug_assert();
    }

    #[test]
    fn shares_and_sizes() {
        assert_eq!(share("1e-3"), Ok(1e-3));
        assert_eq!(share("0.1%"), Ok(0.1 * 0.01));
        assert!(["-1", "2", "nan", "x", "120%", ""].iter().all(|t| share(t).is_err()));
        assert_eq!(time("1.5m"), Ok(Duration::from_secs(90)));
        assert_eq!(time("250ms"), Ok(Duration::from_millis(250)));
        assert!(["-1s", "0", "x", "", "1d", "1e999s"].iter().all(|t| time(t).is_err()));
        assert_eq!(memory("4GiB"), Ok(4 << 30));
        assert_eq!(memory("500 MB"), Ok(500_000_000));
        assert!(["-1", "0", "lots", "4TB"].iter().all(|t| memory(t).is_err()));
    }
}
