//! Binary glTF 2.0 with the light in the vertices: a document of our own making, or the scene's
//! own with its nodes, names, materials, textures and animations.

mod buffer;
mod container;
mod document;
pub(crate) mod lit;

use std::io::Write;

use scene::{Scene, Solution};

use crate::{Error, Options};

/// Writes a GLB container. Its header states its length, so it is built in memory first.
pub(crate) fn write(
    out: &mut dyn Write,
    scene: &Scene,
    solution: &Solution,
    options: &Options,
) -> Result<(), Error> {
    let scale = options.exposure.scale_for(scene, solution);
    if let Some(document) = &options.document {
        return lit::write(out, document, scene, solution, scale);
    }
    let geometry = buffer::build(scene, solution, scale)?;
    let document = document::build(scene, &geometry, scale)?;
    container::write(out, &document, &geometry.sections())
}
