//! The scenes inside the program; the first choice is the Cornell box.

use scene::Scene;
use scene_import::{Imported, Options};

use crate::failure::Failure;

/// What the bundled scene is called in messages and reports.
pub(crate) const NAME: &str = "cornell.glb";

/// The files that `cargo xtask scenes` writes.
const FILES: [(&str, &[u8]); 6] = [
    (NAME, include_bytes!("../../../scenes/cornell.glb")),
    ("gallery.glb", include_bytes!("../../../scenes/gallery.glb")),
    ("room.tri", include_bytes!("../../../scenes/room.tri")),
    ("blocks.tri", include_bytes!("../../../scenes/blocks.tri")),
    ("hall.tri", include_bytes!("../../../scenes/hall.tri")),
    ("church.tri", include_bytes!("../../../scenes/church.tri")),
];

/// Opens the bundled scene.
pub(crate) fn open(options: &Options) -> Result<Imported, Failure> {
    let (name, bytes) = FILES[0];
    Ok(scene_import::open_bytes(name, bytes, options)?)
}

/// All of them, by name.
pub(crate) fn scenes() -> Result<Vec<(&'static str, Scene)>, Failure> {
    let open = |(name, bytes): &(&'static str, &[u8])| {
        Ok((*name, scene_import::open_bytes(name, bytes, &Options::default())?.scene))
    };
    FILES.iter().map(open).collect()
}
