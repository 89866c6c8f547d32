//! The command line resolved: defaults filled in, contradictions refused. Pure.

#[cfg(feature = "form-factors")]
mod form_factors;
mod goal;
mod keeping;

use std::path::{Path, PathBuf};

use output::{Exposure, Format};
use radiosity_core::{Correction, Exchange, MeshConfig, Schedule, Split};
use radiosity_par::Loop;
use scene_import::SidesRule;

use crate::absent;
use crate::args::{
    AccelArg, Every, NeedArg, PictureArgs, ReadArgs, ShootingArgs, SidesArg, SolveArgs, SplitArg,
    WorkArgs,
};
use crate::failure::Failure;
#[cfg(feature = "form-factors")]
pub(crate) use form_factors::{FormFactors, TableTarget, form_factors};
pub(crate) use goal::{DEFAULT_CONVERGE, DEFAULT_ERROR};
pub(crate) use goal::{Goal, Limits};
pub(crate) use keeping::Keeping;

/// Elements asked for when the command line does not say.
const DEFAULT_ELEMENTS: usize = 10_000;

/// What is written beside the formats of `output`.
const PAGES: &str = if cfg!(feature = "html") { ", or .html" } else { "" };

/// Ids are 32 bits wide, and a forest has up to two nodes per element.
pub(crate) const MOST_ELEMENTS: usize = 1 << 30;

/// What `solve` will do.
#[derive(Clone, Debug)]
pub(crate) struct Solve {
    /// `None` for the bundled scene.
    pub(crate) scene: Option<PathBuf>,
    pub(crate) outputs: Vec<Target>,
    pub(crate) report: Option<PathBuf>,
    pub(crate) probe: Option<PathBuf>,
    /// How often the light on its way is written, too.
    pub(crate) snapshot: Option<Every>,
    /// The port that the solve can be watched on, 0 for any.
    pub(crate) live: Option<u16>,
    pub(crate) keeping: Keeping,
    pub(crate) goal: Goal,
    pub(crate) limits: Limits,
    pub(crate) work: Work,
    pub(crate) shooting: Shooting,
    pub(crate) read: Read,
    pub(crate) picture: PictureArgs,
}

/// Where a solution goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Target {
    /// CSV on stdout.
    Stdout,
    /// A file, its format known to be one of ours.
    File(PathBuf),
    /// A table of the probes.
    Probes(PathBuf),
    /// A page to look at the light.
    #[cfg(feature = "html")]
    Page(PathBuf),
}

impl Target {
    /// Whether it is a GLB.
    pub(crate) fn is_glb(&self) -> bool {
        matches!(self, Self::File(path) if Format::from_path(path).ok() == Some(Format::Glb))
    }
}

/// How finely, with what, on how many threads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Work {
    pub(crate) elements: Option<usize>,
    pub(crate) accel: AccelArg,
    /// `None` for as many as pay.
    pub(crate) threads: Option<usize>,
    /// Whether nothing is left out.
    pub(crate) everything: bool,
}

/// Who shoots with whom, how threads share the work, and where elements are split.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shooting {
    pub(crate) schedule: Schedule,
    pub(crate) overshoot: bool,
    pub(crate) ambient: bool,
    pub(crate) correction: Correction,
    pub(crate) sharing: Loop,
    pub(crate) split: Split,
    pub(crate) least_area: f64,
    pub(crate) most_depth: Option<u32>,
}

/// How the scene is read, and who exchanges light with whom.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Read {
    pub(crate) options: scene_import::Options,
    pub(crate) exchange: Exchange,
}

/// Resolves the flags of `solve`.
pub(crate) fn solve(args: SolveArgs) -> Result<Solve, Failure> {
    let outputs = args.output.into_iter().map(target).collect::<Result<Vec<_>, _>>()?;
    if outputs.is_empty() && args.report.is_none() {
        let message = "nothing to write: name at least one file with -o, such as -o lit.glb";
        return Err(Failure::Usage(message.into()));
    }
    check_exposure(args.picture.exposure)?;
    if outputs.iter().filter(|t| **t == Target::Stdout).count() > 1 {
        return Err(Failure::Usage(
            "-o -: stdout takes one table, and is named twice; leave one out".into(),
        ));
    }
    args.report.as_deref().map(check_report).transpose()?;
    let wants_probes = outputs.iter().any(|t| matches!(t, Target::Probes(_)));
    match (&args.probe, wants_probes) {
        (Some(_), false) => {
            let message = "--probe: name where the exitance goes, as -o places.probe.csv";
            return Err(Failure::Usage(message.into()));
        }
        (None, true) => {
            let message = "-o NAME.probe.csv: name the places with --probe POINTS.csv";
            return Err(Failure::Usage(message.into()));
        }
        _ => {}
    }
    let fixed = args.work.elements.is_some() || args.converge.is_some();
    if args.no_statement && !fixed {
        let message = "--no-statement: refining needs the statement; fix the work with --elements";
        return Err(Failure::Usage(message.into()));
    }
    if args.snapshot.is_some() && !outputs.iter().any(|t| matches!(t, Target::File(_))) {
        let message = "--snapshot: name a file that its own stand beside, such as -o lit.glb";
        return Err(Failure::Usage(message.into()));
    }
    if args.error == Some(0.0) {
        return Err(Failure::Usage("--error: expected more than 0, such as 1%".into()));
    }
    if args.max_elements.is_some_and(|n| !(1..=MOST_ELEMENTS).contains(&n)) {
        return Err(Failure::Usage(format!("--max-elements: expected 1 to {MOST_ELEMENTS}")));
    }
    let goal = if fixed {
        Goal::Mesh {
            elements: args.work.elements,
            converge: args.converge.unwrap_or(DEFAULT_CONVERGE),
            stated: !args.no_statement,
        }
    } else {
        Goal::Error(args.error.unwrap_or(DEFAULT_ERROR))
    };
    Ok(Solve {
        scene: args.scene,
        outputs,
        report: args.report,
        probe: args.probe,
        snapshot: args.snapshot,
        live: args.live.port(),
        keeping: keeping::keeping(args.keeping)?,
        goal,
        limits: Limits {
            time: args.max_time,
            elements: args.max_elements,
            memory: args.max_memory,
        },
        work: work(&args.work)?,
        shooting: shooting(&args.shooting, fixed)?,
        read: read(&args.read)?,
        picture: args.picture,
    })
}

/// Refuses more stops than mean anything.
pub(crate) fn check_exposure(stops: f64) -> Result<(), Failure> {
    if stops.is_finite() && stops.abs() <= 64.0 {
        return Ok(());
    }
    Err(Failure::Usage("--exposure: expected a number of stops from -64 to 64".into()))
}

/// Refuses a report that is not named as one, unless it goes to a device.
pub(crate) fn check_report(report: &Path) -> Result<(), Failure> {
    let named = report.extension().is_some_and(|e| e == "json");
    if named || std::fs::metadata(report).is_ok_and(|m| !m.is_file()) {
        return Ok(());
    }
    let shown = report.display();
    Err(Failure::Usage(format!("--report {shown}: expected a name that ends in .json")))
}

/// Resolves the flags that say how much work is done.
pub(crate) fn work(args: &WorkArgs) -> Result<Work, Failure> {
    if args.elements.is_some_and(|n| !(1..=MOST_ELEMENTS).contains(&n)) {
        return Err(Failure::Usage(format!("--elements: expected 1 to {MOST_ELEMENTS}")));
    }
    Ok(Work {
        elements: args.elements,
        accel: args.accel,
        threads: args.threads.map(threads).transpose()?,
        everything: args.need == NeedArg::Everything,
    })
}

/// Resolves the flags that say how light is shot; `fixed` if the mesh does not follow it.
fn shooting(args: &ShootingArgs, fixed: bool) -> Result<Shooting, Failure> {
    if !(args.min_area.is_finite() && args.min_area >= 0.0) {
        let message = "--min-area: expected an area, at least 0";
        return Err(Failure::Usage(message.into()));
    }
    if fixed && args.split == SplitArg::Centroid {
        let message = "--split centroid: is for --error; --elements and --converge fix the mesh";
        return Err(Failure::Usage(message.into()));
    }
    Ok(Shooting {
        schedule: args.schedule,
        overshoot: !args.no_overshoot,
        ambient: args.ambient,
        correction: if args.no_corrections { Correction::Never } else { Correction::Auto },
        sharing: args.sharing,
        split: args.split.into(),
        least_area: args.min_area,
        most_depth: args.max_depth,
    })
}

impl Default for Shooting {
    fn default() -> Self {
        Self {
            schedule: Schedule::Auto,
            overshoot: true,
            ambient: false,
            correction: Correction::Auto,
            sharing: Loop::Tasks,
            split: Split::LongestEdge,
            least_area: 0.0,
            most_depth: None,
        }
    }
}

/// Resolves the number of threads.
fn threads(threads: usize) -> Result<usize, Failure> {
    const MOST: usize = 4096;
    if threads > MOST {
        return Err(Failure::Usage(format!(
            "--threads: expected at most {MOST}, or 0 for as many as the machine has"
        )));
    }
    Ok(threads)
}

impl Work {
    /// The mesh asked for.
    pub(crate) fn mesh(&self, triangles: usize) -> MeshConfig {
        let default = DEFAULT_ELEMENTS.max(2 * triangles);
        MeshConfig::with_elements(self.elements.unwrap_or(default))
    }
}

/// Resolves the flags that say how a file is read.
pub(crate) fn read(args: &ReadArgs) -> Result<Read, Failure> {
    if !(args.light.is_finite() && args.light >= 0.0) {
        return Err(Failure::Usage("--light: expected a finite number, at least 0".into()));
    }
    if !(0.0..=1.0).contains(&args.reflect) {
        return Err(Failure::Usage("--reflect: expected a number from 0 to 1".into()));
    }
    let (sides, exchange) = match args.sides {
        SidesArg::Scene => (SidesRule::Scene, Exchange::OneSided),
        SidesArg::Front => (SidesRule::Front, Exchange::OneSided),
        SidesArg::Both => (SidesRule::Both, Exchange::OneSided),
        SidesArg::Paired => (SidesRule::Front, Exchange::Paired),
    };
    let options = scene_import::Options {
        tri_light: args.light,
        tri_reflect: args.reflect,
        sides,
        keep_document: false,
        allow_outside: args.beside.allow_outside(),
    };
    Ok(Read { options, exchange })
}

fn target(path: PathBuf) -> Result<Target, Failure> {
    if path.as_os_str() == "-" {
        return Ok(Target::Stdout);
    }
    if path.to_string_lossy().to_ascii_lowercase().ends_with(".probe.csv") {
        return Ok(Target::Probes(path));
    }
    if path.extension().is_some_and(|e| e.eq_ignore_ascii_case("html")) {
        #[cfg(feature = "html")]
        return Ok(Target::Page(path));
        #[cfg(not(feature = "html"))]
        return Err(absent::refused(&path.display().to_string(), "html"));
    }
    Format::from_path(&path).map_err(|e| {
        absent::format(&e).unwrap_or_else(|| Failure::Usage(format!("-o {e}{PAGES}")))
    })?;
    Ok(Target::File(path))
}

/// How pictures and display colours are made.
pub(crate) fn output_options(
    picture: &PictureArgs,
    scene: &scene::Scene,
) -> Result<output::Options, Failure> {
    let camera = match picture.camera() {
        None => None,
        Some(name) => Some(find_camera(name, scene)?),
    };
    let exposure =
        if picture.exposure == 0.0 { Exposure::Auto } else { Exposure::Stops(picture.exposure) };
    Ok(output::Options { camera, exposure, size: picture.size(), ..output::Options::default() })
}

fn find_camera(name: &str, scene: &scene::Scene) -> Result<scene::Camera, Failure> {
    scene.cameras().iter().find(|c| c.name == name).cloned().ok_or_else(|| {
        let known: Vec<_> = scene.cameras().iter().map(|c| format!("{:?}", c.name)).collect();
        Failure::Usage(match known.as_slice() {
            [] => format!("--camera {name:?}: the scene has no camera; leave the flag out"),
            known => format!("--camera {name:?}: the scene has {}", known.join(", ")),
        })
    })
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use radiosity_core::Asked;

    use super::*;
    use crate::args::{Args, Command};

    fn resolve(line: &str) -> Result<Solve, Failure> {
        let words = line.split_whitespace();
        let args = Args::try_parse_from(["radiosity", "solve"].into_iter().chain(words));
        match args.map_err(|e| Failure::Usage(e.to_string()))?.command {
            Some(Command::Solve(args)) => solve(*args),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn defaults_follow_the_scene() {
        let s = resolve("room.tri -o a.csv -o -").unwrap();
        assert_eq!(s.outputs, [Target::File("a.csv".into()), Target::Stdout]);
        assert_eq!(s.work.mesh(12).elements, 10_000);
        assert_eq!(s.work.mesh(9_506).elements, 19_012);
        assert_eq!(s.goal, Goal::Error(0.01));
        let s = resolve("-o a.csv --elements 5 --converge 2%").unwrap();
        assert_eq!((s.scene, s.work.elements, s.goal.converge()), (None, Some(5), 0.02));
        assert_eq!(s.goal.asked(12), Asked::Elements(5));
        let s = resolve("-o a.csv --converge 1% --no-statement").unwrap();
        assert_eq!(s.goal.asked(12), Asked::Unstated(10_000));
        let s = resolve("-o a.csv --elements 1000 --max-memory 1MB --snapshot every:9").unwrap();
        assert_eq!((s.limits.memory, s.snapshot), (Some(1_000_000), Some(Every::Shots(9))));
    }

    #[cfg(feature = "checkpoint")]
    #[test]
    fn checkpoints_have_a_file_and_a_time() {
        let keeping = |line| resolve(line).unwrap().keeping;
        let s = keeping("-o a.csv --checkpoint a.ckpt");
        assert_eq!((s.checkpoint, s.every.as_secs(), s.resume), (Some("a.ckpt".into()), 30, None));
        let s = keeping("-o a.csv --checkpoint a.ckpt --every 2m --resume a.ckpt");
        assert_eq!((s.checkpoint, s.every.as_secs()), (s.resume, 120));
        assert_eq!(keeping("-o a.csv --resume b.ckpt").resume, Some("b.ckpt".into()));
    }

    #[test]
    fn sides_choose_the_reading_and_the_exchange() {
        let paired = resolve("-o a.csv --sides paired").unwrap().read;
        assert_eq!((paired.options.sides, paired.exchange), (SidesRule::Front, Exchange::Paired));
        let both = resolve("-o a.csv --sides both").unwrap().read;
        assert_eq!((both.options.sides, both.exchange), (SidesRule::Both, Exchange::OneSided));
    }

    #[test]
    fn contradictions_are_refused() {
        for line in [
            "room.tri",
            "-o a.txt",
            "-o a.csv --reflect 1.5",
            "-o a.csv --light -1",
            "-o a.csv --light nan",
            "-o a.csv --elements 9999999999",
            "-o a.csv --threads 100000",
            "-o a.csv --exposure inf",
            "-o a.csv --converge 2",
            "-o a.csv --error 0",
            "-o a.csv --error 1% --elements 100",
            "-o a.csv --error 1% --converge 1%",
            "-o a.csv --no-statement",
            "-o a.csv --elements 100 --max-elements 100",
            "-o a.csv --max-elements 0",
            "-o a.csv --max-time 0",
            "-o a.csv --probe points.csv",
            "-o - --snapshot 1s",
            "-o a.csv --snapshot 5",
            "-o a.probe.csv",
            "-o a.csv --every 30s",
            "-o a.csv --resume a.ckpt --every 30s",
            "-o a.csv --checkpoint a.ckpt --every 0",
            "-o a.csv --checkpoint -",
            "-o a.csv --resume -",
            "-o a.csv --live-port 80",
            "-o a.csv --live --live-port 99999",
            "--live",
        ] {
            assert!(matches!(resolve(line), Err(Failure::Usage(_))), "{line}");
        }
    }
}
