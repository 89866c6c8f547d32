//! The scenes inside the program; the first choice is the Cornell box.

#[cfg(feature = "verify")]
use scene::Scene;
use scene_import::{Imported, Options};

#[cfg(not(feature = "gltf"))]
use crate::absent;
use crate::failure::Failure;

/// What the bundled scene is called in messages and reports.
pub(crate) const NAME: &str = "cornell.glb";

/// The scene that the program solves where none is named, as `cargo xtask scenes` writes it.
#[cfg(feature = "gltf")]
const CORNELL: &[u8] = include_bytes!("../../../scenes/cornell.glb");

/// All that this build reads, for `verify`.
#[cfg(feature = "verify")]
const FILES: &[(&str, &[u8])] = &[
    #[cfg(feature = "gltf")]
    (NAME, CORNELL),
    #[cfg(feature = "gltf")]
    ("gallery.glb", include_bytes!("../../../scenes/gallery.glb")),
    ("room.tri", include_bytes!("../../../scenes/room.tri")),
    ("blocks.tri", include_bytes!("../../../scenes/blocks.tri")),
    ("hall.tri", include_bytes!("../../../scenes/hall.tri")),
    ("church.tri", include_bytes!("../../../scenes/church.tri")),
];

/// Refuses where this build cannot read the bundled scene.
pub(crate) fn check() -> Result<(), Failure> {
    #[cfg(not(feature = "gltf"))]
    return Err(unreadable());
    #[cfg(feature = "gltf")]
    Ok(())
}

#[cfg(not(feature = "gltf"))]
fn unreadable() -> Failure {
    absent::refused("no scene is named, and the bundled one is a .glb", "gltf")
}

/// Opens the bundled scene.
#[cfg(feature = "gltf")]
pub(crate) fn open(options: &Options) -> Result<Imported, Failure> {
    Ok(scene_import::open_bytes(NAME, CORNELL, options)?)
}

/// Says that this build has none.
#[cfg(not(feature = "gltf"))]
pub(crate) fn open(_: &Options) -> Result<Imported, Failure> {
    Err(unreadable())
}

/// All of them, by name.
#[cfg(feature = "verify")]
pub(crate) fn scenes() -> Result<Vec<(&'static str, Scene)>, Failure> {
    let open = |(name, bytes): &(&'static str, &[u8])| {
        Ok((*name, scene_import::open_bytes(name, bytes, &Options::default())?.scene))
    };
    FILES.iter().map(open).collect()
}
