//! `radiosity verify`: known answers, checked on this machine.

use std::time::Instant;

use conformance::verify::{Check, checks, scene_checks};

use crate::args::VerifyArgs;
use crate::bundled;
use crate::failure::Failure;
use crate::screen::{result, seconds};

/// Runs every check, prints a row each, and fails if one fails.
pub(crate) fn run(args: &VerifyArgs) -> Result<(), Failure> {
    let mut all = checks();
    for (name, scene) in bundled::scenes()? {
        all.extend(scene_checks(name, scene));
    }
    if let Some(part) = &args.only {
        all.retain(|check| check.name.contains(part.as_str()));
        if all.is_empty() {
            return Err(Failure::Usage(format!(
                "--only {part:?}: no case has that in its name; `radiosity verify` lists all"
            )));
        }
    }
    let width = all.iter().map(|c| c.name.chars().count()).max().unwrap_or(0);
    result(&format!(
        "{:width$}  {:>14} {:>14} {:>9} {:>9} {:>9}",
        "case", "exact", "ours", "error", "bound", "time"
    ))?;
    let clock = Instant::now();
    let mut failed = 0;
    for check in &all {
        failed += usize::from(!row(check, width)?);
    }
    result(&format!(
        "{} of {} passed in {}",
        all.len() - failed,
        all.len(),
        seconds(clock.elapsed().as_secs_f64())
    ))?;
    match failed {
        0 => Ok(()),
        n => Err(Failure::Failed(format!("{n} of {} cases failed", all.len()))),
    }
}

/// Runs and prints one check; whether it passed.
fn row(check: &Check, width: usize) -> Result<bool, Failure> {
    let clock = Instant::now();
    let o = check.run();
    let time = seconds(clock.elapsed().as_secs_f64());
    let verdict = if o.passed() { "" } else { "  FAILED" };
    result(&format!(
        "{:width$}  {:>14} {:>14} {:>9.1e} {:>9.1e} {time:>9}{verdict}",
        check.name,
        number(o.exact),
        number(o.ours),
        o.error,
        o.bound,
    ))?;
    Ok(o.passed())
}

/// Nine digits, without an exponent where that is short.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".into(),
        a if (1e-3..1e6).contains(&a) => format!("{x:.9}"),
        _ => format!("{x:.7e}"),
    }
}
