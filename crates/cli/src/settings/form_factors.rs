//! The flags of `form-factors` resolved.

use std::path::PathBuf;

use form_factor::REFERENCE;
use output::matrix::Format;
use radiosity_core::matrix::Between;
use scene_import::SidesRule;

use super::threads;
use crate::args::{BetweenArg, FormFactorsArgs, SidesArg};
use crate::failure::Failure;

/// What `form-factors` will do.
#[derive(Clone, Debug)]
pub(crate) struct FormFactors {
    pub(crate) scene: PathBuf,
    pub(crate) outputs: Vec<TableTarget>,
    pub(crate) report: Option<PathBuf>,
    pub(crate) tolerance: f64,
    /// `None` to follow the scene.
    pub(crate) between: Option<Between>,
    pub(crate) close: bool,
    pub(crate) threads: usize,
    pub(crate) options: scene_import::Options,
}

/// Where form factors go.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum TableTarget {
    /// CSV on stdout.
    Stdout,
    /// A file, its format known to be one of ours.
    File(PathBuf, Format),
}

/// Resolves the flags of `form-factors`.
pub(crate) fn form_factors(args: FormFactorsArgs) -> Result<FormFactors, Failure> {
    let outputs = args.output.into_iter().map(table).collect::<Result<Vec<_>, _>>()?;
    if outputs.iter().filter(|t| **t == TableTarget::Stdout).count() > 1 {
        return Err(Failure::Usage(
            "-o -: stdout takes one table, and is named twice; leave one out".into(),
        ));
    }
    if args.tolerance < REFERENCE {
        let message = format!("--tolerance: expected {REFERENCE:e} to 1");
        return Err(Failure::Usage(message));
    }
    let sides = match args.sides {
        SidesArg::Scene => SidesRule::Scene,
        SidesArg::Front => SidesRule::Front,
        SidesArg::Both => SidesRule::Both,
        SidesArg::Paired => {
            let message = "--sides: expected scene, front or both; paired surfaces share their \
                           light, not their form factors";
            return Err(Failure::Usage(message.into()));
        }
    };
    Ok(FormFactors {
        scene: args.scene,
        outputs,
        report: args.report,
        tolerance: args.tolerance,
        between: args.between.map(|between| match between {
            BetweenArg::Groups => Between::Groups,
            BetweenArg::Triangles => Between::Triangles,
        }),
        close: args.close,
        threads: threads(args.threads)?,
        options: scene_import::Options {
            sides,
            allow_outside: args.beside.allow_outside(),
            ..scene_import::Options::default()
        },
    })
}

fn table(path: PathBuf) -> Result<TableTarget, Failure> {
    if path.as_os_str() == "-" {
        return Ok(TableTarget::Stdout);
    }
    let format = Format::from_path(&path).map_err(|e| Failure::Usage(format!("-o {e}")))?;
    Ok(TableTarget::File(path, format))
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::args::{Args, Command};

    fn resolve(line: &str) -> Result<FormFactors, Failure> {
        let words = line.split_whitespace();
        let args = Args::try_parse_from(["radiosity", "form-factors"].into_iter().chain(words));
        match args.map_err(|e| Failure::Usage(e.to_string()))?.command {
            Some(Command::FormFactors(args)) => form_factors(args),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn the_flags_are_understood() {
        let s = resolve("a.tri -o F.csv -o - -o F.NPZ").unwrap();
        let file = |name: &str, format| TableTarget::File(name.into(), format);
        let expected =
            [file("F.csv", Format::Csv), TableTarget::Stdout, file("F.NPZ", Format::Npz)];
        assert_eq!(s.outputs, expected);
        assert_eq!((s.tolerance, s.between, s.close), (1e-3, None, false));
        let s = resolve("a.tri -o F.npy --between groups --tolerance 1% --sides both").unwrap();
        assert_eq!((s.tolerance, s.between), (0.01, Some(Between::Groups)));
        assert_eq!(s.options.sides, SidesRule::Both);
    }

    #[test]
    fn contradictions_are_refused() {
        for line in [
            "a.tri",
            "-o F.csv",
            "a.tri -o F.txt",
            "a.tri -o - -o -",
            "a.tri -o F.csv --tolerance 0",
            "a.tri -o F.csv --tolerance 1e-11",
            "a.tri -o F.csv --tolerance 2",
            "a.tri -o F.csv --sides paired",
            "a.tri -o F.csv --threads 100000",
            "a.tri -o F.csv --between walls",
        ] {
            assert!(matches!(resolve(line), Err(Failure::Usage(_))), "{line}");
        }
    }
}
