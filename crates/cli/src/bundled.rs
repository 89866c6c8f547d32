//! The scene inside the program: the Cornell box.

use scene_import::{Imported, Options};

use crate::failure::Failure;

/// What the bundled scene is called in messages and reports.
pub(crate) const NAME: &str = "cornell.glb";

/// The file `cargo xtask scenes` writes.
const BYTES: &[u8] = include_bytes!("../../../scenes/cornell.glb");

/// Opens the bundled scene.
pub(crate) fn open(options: &Options) -> Result<Imported, Failure> {
    Ok(scene_import::open_bytes(NAME, BYTES, options)?)
}
