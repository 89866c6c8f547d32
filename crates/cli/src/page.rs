//! What the page of a lit scene is told beside its light: unit, exposure, where one stands.

use std::path::Path;

use scene::{Camera, Scene, Solution};
use scene_import::Imported;
use serde_json::Value;
use viewer::{Means, Page, Shown};

use crate::failure::Failure;
use crate::report::Report;

/// Whether a file is named as a page.
pub(crate) fn is_page(path: &Path) -> bool {
    path.extension().is_some_and(|e| e.eq_ignore_ascii_case("html"))
}

/// The unit of exitance in scenes of a format, as the report names formats.
pub(crate) fn unit(format: &str) -> &'static str {
    if format == scene_import::Format::Tri.to_string() {
        "display units, 255 is white"
    } else {
        "W/m²"
    }
}

/// Where one stands first: at the camera that was named, at the scene's first, or where most is seen.
pub(crate) fn view(scene: &Scene, named: Option<&Camera>) -> Option<Camera> {
    named.or(scene.cameras().first()).cloned().or_else(|| automatic(scene))
}

#[cfg(feature = "png")]
fn automatic(scene: &Scene) -> Option<Camera> {
    Some(output::camera::automatic(scene))
}

/// The page stands far enough to see all.
#[cfg(not(feature = "png"))]
fn automatic(_: &Scene) -> Option<Camera> {
    None
}

/// Writes a page, all of it or not at all.
pub(crate) fn write(
    path: &Path,
    title: &str,
    shown: &Shown<'_>,
    report: &Value,
) -> Result<(), Failure> {
    let page = Page::new(title, shown, report)
        .map_err(|e| Failure::Failed(format!("{}: {e}", path.display())))?;
    output::replace_file(path, |out| Ok(page.write(out)?))?;
    Ok(())
}

/// Writes the page of a solve.
pub(crate) fn write_solved(
    path: &Path,
    imported: &Imported,
    solution: &Solution,
    options: &output::Options,
    report: &Report,
) -> Result<(), Failure> {
    let scene = &imported.scene;
    let view = view(scene, options.camera.as_ref());
    let shown = Shown {
        scene,
        solution,
        unit: unit(&imported.summary.format.to_string()),
        exposure: options.exposure.scale_for(scene, solution),
        view: view.as_ref(),
        means: Means::OfElements,
    };
    write(path, report.file(), &shown, &report.value())
}
