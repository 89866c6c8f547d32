//! A scene that was lit before, with its light.

use std::fs;
use std::path::Path;

use scene::{Scene, Solution};

use crate::open::{Source, format_of};
use crate::{Diagnostic, Error, ErrorKind, Format};

/// What a lit file holds.
#[derive(Clone, Debug)]
pub struct Lit {
    /// Each element as a triangle of its own, seen from its lit side.
    pub scene: Scene,
    /// The light of the elements: corners as the file has them, their mean for the element.
    pub solution: Solution,
    /// Display light per exitance, as the file's colours were made.
    pub exposure: f64,
    /// What was odd about the file.
    pub diagnostics: Vec<Diagnostic>,
}

/// Opens a .glb that `radiosity solve` wrote: [`open`](crate::open) reads such a file as a scene to
/// be lit again, and passes over the light.
///
/// # Errors
/// A file that cannot be read, is no glTF, or has no light; a build without the feature `gltf`.
pub fn open_lit(path: &Path) -> Result<Lit, Error> {
    let shown = path.to_string_lossy();
    let name = path.file_name().map_or(shown.clone(), |name| name.to_string_lossy());
    if !matches!(format_of(&name), Ok(Format::Glb | Format::Gltf)) {
        let message = "expected a .glb that `radiosity solve` wrote";
        return Err(Error::new(ErrorKind::UnknownFormat, &name, message));
    }
    let bytes = fs::read(path).map_err(|cause| {
        Error::new(ErrorKind::Io, &shown, format!("cannot be read: {cause}")).because(cause)
    })?;
    read(&Source { name: &name, bytes: &bytes, folder: path.parent() })
}

#[cfg(feature = "gltf")]
fn read(source: &Source<'_>) -> Result<Lit, Error> {
    crate::gltf::read_lit(source)
}

#[cfg(not(feature = "gltf"))]
fn read(source: &Source<'_>) -> Result<Lit, Error> {
    Err(crate::open::left_out("gltf", source, Format::Glb))
}
