//! Scenes opened from small files that the tests make, and from the shared models.

#[cfg(feature = "gltf")]
mod appearance;
#[cfg(feature = "gltf")]
mod document;
mod errors;
#[cfg(feature = "gltf")]
mod extras;
#[cfg(feature = "gltf")]
mod glb;
#[cfg(feature = "gltf")]
mod gltf;
#[cfg(feature = "gltf")]
mod hostile;
mod lint;
#[cfg(feature = "obj")]
mod obj;
#[cfg(all(feature = "gltf", feature = "obj"))]
mod outside;
mod shared_scenes;
mod tri;
mod tri_records;
mod vs3;

use scene_import::{Imported, Options, open_bytes};

/// Opens bytes with the default options.
fn import(name: &str, bytes: impl AsRef<[u8]>) -> Imported {
    open_bytes(name, bytes.as_ref(), &Options::default()).expect("the test's file is sound")
}

/// The failure of opening bytes, as text.
fn failure(name: &str, bytes: impl AsRef<[u8]>) -> String {
    let error = open_bytes(name, bytes.as_ref(), &Options::default()).expect_err("must fail");
    let text = error.to_string();
    assert!(!text.contains('\n'), "an error is one line: {text}");
    text
}

/// The warnings as text.
fn warnings(imported: &Imported) -> Vec<String> {
    imported.diagnostics.iter().map(ToString::to_string).collect()
}
