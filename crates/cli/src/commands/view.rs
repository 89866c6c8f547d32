//! `radiosity view`: a page of a scene that was lit before.

use std::path::Path;

use serde_json::Value;
use viewer::{Means, Shown};

use crate::args::ViewArgs;
use crate::failure::Failure;
use crate::page;
use crate::report::SCHEMA;
use crate::screen::{self, count, say};
use crate::{files, settings};

/// Reads the light, and the report if there is one, and writes the page.
pub(crate) fn run(args: &ViewArgs) -> Result<(), Failure> {
    let (solution, output) = (args.solution.as_path(), args.output.as_path());
    if !page::is_page(output) {
        let message = format!("{}: expected a name that ends in .html", output.display());
        return Err(Failure::Usage(message));
    }
    settings::check_exposure(args.exposure)?;
    files::check_apart(Some(solution), &[output])?;
    if let Some(report) = &args.report {
        files::check_apart(Some(report), &[output])?;
    }
    files::check(output)?;
    let lit = scene_import::open_lit(solution)?;
    screen::diagnostics(&lit.diagnostics);
    let report = args.report.as_deref().map(read_report).transpose()?.unwrap_or_default();
    let elements = lit.solution.elements.len();
    say(&format!("{}: {} lit elements", solution.display(), count(elements as u64)));
    let format = report.pointer("/scene/format").and_then(Value::as_str).unwrap_or_default();
    let view = page::view(&lit.scene, None);
    let shown = Shown {
        scene: &lit.scene,
        solution: &lit.solution,
        unit: page::unit(format),
        exposure: lit.exposure * args.exposure.exp2(),
        view: view.as_ref(),
        means: Means::OfCorners,
    };
    page::write(output, &solution.display().to_string(), &shown, &report)?;
    say(&format!("written: {}", output.display()));
    Ok(())
}

fn read(path: &Path) -> Result<Vec<u8>, Failure> {
    std::fs::read(path).map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))
}

/// A report of `solve`, in the form that the page reads.
fn read_report(path: &Path) -> Result<Value, Failure> {
    let fail = |what: String| Failure::Failed(format!("{}: {what}", path.display()));
    let expected = format!("expected what `solve --report` wrote, schema {SCHEMA}");
    let report: Value =
        serde_json::from_slice(&read(path)?).map_err(|e| fail(format!("{e}; {expected}")))?;
    let parts =
        ["scene", "settings", "mesh", "plan", "solve", "error", "energy", "seconds", "curve"];
    let whole = parts.iter().all(|part| report.get(part).is_some());
    if report.get("schema").and_then(Value::as_u64) != Some(u64::from(SCHEMA)) || !whole {
        return Err(fail(expected));
    }
    Ok(report)
}
