//! `cargo xtask scenes`: the bundled scenes, written from code.
//!
//! The scenes are committed, so that nobody needs this to use them; the code is what they mean.
//! Their bytes are the same on every machine, and `--check` compares them.

mod arches;
mod blocks;
mod church;
mod cornell;
mod gallery;
mod glb;
mod hall;
mod mesh;
mod obj_text;
mod png;
mod room;
mod shapes;
mod tri_text;

#[cfg(test)]
mod checks;

use std::fs;
use std::path::Path;

/// A bundled file.
struct File {
    name: &'static str,
    bytes: Vec<u8>,
}

/// Writes every scene into `folder`.
pub(crate) fn write(folder: &Path) -> Result<(), String> {
    fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for File { name, bytes } in files() {
        let path = folder.join(name);
        fs::write(&path, &bytes).map_err(|e| format!("{}: {e}", path.display()))?;
        println!("{name}: {} bytes", bytes.len());
    }
    Ok(())
}

/// Fails when a file in `folder` is not what the code writes.
pub(crate) fn check(folder: &Path) -> Result<(), String> {
    let mut stale = Vec::new();
    for File { name, bytes } in files() {
        match fs::read(folder.join(name)) {
            Ok(found) if found == bytes => {}
            Ok(_) => stale.push(format!("scenes/{name}: differs from what the code writes")),
            Err(error) => stale.push(format!("scenes/{name}: {error}")),
        }
    }
    if stale.is_empty() {
        return Ok(());
    }
    stale.push("run `cargo xtask scenes` and commit the result".to_owned());
    Err(stale.join("\n"))
}

fn files() -> Vec<File> {
    let text = |name, text: String| File { name, bytes: text.into_bytes() };
    vec![
        text("cornell.obj", obj_text::obj()),
        text("cornell.mtl", obj_text::mtl()),
        File { name: "cornell.glb", bytes: cornell::glb() },
        text("blocks.tri", blocks::model().to_tri()),
        text("room.tri", room::model().to_tri()),
        text("hall.tri", hall::model().to_tri()),
        text("church.tri", church::model().to_tri()),
        File { name: "gallery.glb", bytes: gallery::glb() },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_committed_scenes_are_current() {
        if let Err(message) = check(&crate::root().join("scenes")) {
            panic!("{message}");
        }
    }

    #[test]
    fn a_missing_or_changed_scene_is_named() {
        let folder = std::env::temp_dir().join(format!("xtask-scenes-{}", std::process::id()));
        write(&folder).unwrap();
        assert_eq!(check(&folder), Ok(()));
        fs::write(folder.join("room.tri"), "Triangle").unwrap();
        fs::remove_file(folder.join("hall.tri")).unwrap();
        let message = check(&folder).unwrap_err();
        fs::remove_dir_all(&folder).unwrap();
        let lines: Vec<_> = message.lines().collect();
        assert_eq!(lines.len(), 3, "{message}");
        assert_eq!(lines[0], "scenes/room.tri: differs from what the code writes");
        assert!(lines[1].starts_with("scenes/hall.tri: "), "{message}");
    }
}
