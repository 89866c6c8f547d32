//! The scenes inside the program; the first choice is the Cornell box.

#[cfg(feature = "verify")]
use scene::Scene;
use scene_import::{Imported, Options};

#[cfg(not(feature = "gltf"))]
use crate::absent;
use crate::failure::Failure;

/// A scene's bytes: build.rs knows where they lie.
#[cfg(any(feature = "gltf", feature = "verify"))]
macro_rules! bytes {
    ($name:literal) => {
        include_bytes!(concat!(env!("RADIOSITY_SCENES"), "/", $name))
    };
}

/// What the bundled scene is called in messages and reports.
pub(crate) const NAME: &str = "cornell.glb";

/// The scene that the program solves where none is named, as `cargo xtask scenes` writes it.
#[cfg(feature = "gltf")]
const CORNELL: &[u8] = bytes!("cornell.glb");

/// All that this build reads, for `verify`.
#[cfg(feature = "verify")]
const FILES: &[(&str, &[u8])] = &[
    #[cfg(feature = "gltf")]
    (NAME, CORNELL),
    #[cfg(feature = "gltf")]
    ("gallery.glb", bytes!("gallery.glb")),
    ("room.tri", bytes!("room.tri")),
    ("blocks.tri", bytes!("blocks.tri")),
    ("hall.tri", bytes!("hall.tri")),
    ("church.tri", bytes!("church.tri")),
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
