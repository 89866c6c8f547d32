//! Bytes as an OBJ scene, its material library and a texture.

#![no_main]

use std::fs;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use radiosity_fuzz::scene_at;
use tempfile::TempDir;

/// Parts the OBJ from the library, and that from the texture: a byte that no UTF-8 text has.
const BORDER: u8 = 0xff;

/// Where the files of this process lie.
static FOLDER: LazyLock<TempDir> =
    LazyLock::new(|| tempfile::tempdir().expect("the machine has a folder for such files"));

fuzz_target!(|bytes: &[u8]| {
    let mut parts = bytes.splitn(3, |&byte| byte == BORDER);
    for name in ["a.obj", "a.mtl", "a.png"] {
        fs::write(FOLDER.path().join(name), parts.next().unwrap_or_default())
            .expect("the folder takes files");
    }
    scene_at(&FOLDER.path().join("a.obj"));
});
