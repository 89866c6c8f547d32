//! What is measured: scenes that need little, the bundled ones, and ways to solve them.

use std::path::{Path, PathBuf};

use super::scenes;

/// Where a scene comes from.
pub(super) enum Source {
    /// Text that is written before.
    Made(fn() -> String),
    /// A file of the workspace.
    Bundled(&'static str),
}

/// A scene with a way to solve it.
pub(super) struct Case {
    /// Its name in the table.
    pub(super) name: &'static str,
    pub(super) source: Source,
    pub(super) flags: &'static str,
}

const FIXED: &str = "--elements 8000 --no-statement";
const STATED: &str = "--error 1%";

/// Each scene on a mesh of a fixed number of elements, and refined; the largest on a fixed mesh alone.
pub(super) fn all() -> Vec<Case> {
    let made =
        |name, make| [FIXED, STATED].map(|flags| Case { name, source: Source::Made(make), flags });
    let bundled = |name, file, ways: [&'static str; 2]| {
        ways.map(|flags| Case { name, source: Source::Bundled(file), flags })
    };
    let large = |name, file| {
        let flags = "--elements 4000 --converge 5% --no-statement";
        [Case { name, source: Source::Bundled(file), flags }]
    };
    let pairs = [
        made("convex box", scenes::convex),
        made("open plane", scenes::plane),
        made("grey room", scenes::grey),
        made("two rooms", scenes::two_rooms),
        made("99 % black", scenes::black),
        made("lamp behind a wall", scenes::behind),
        made("small obstacle", scenes::obstacle),
        bundled("Cornell box", "cornell.obj", [FIXED, STATED]),
        bundled("gallery", "gallery.glb", [FIXED, "--error 5%"]),
        bundled("blocks", "blocks.tri", [FIXED, "--error 5%"]),
        bundled("room", "room.tri", [FIXED, "--error 10%"]),
    ];
    let singles = [large("hall", "hall.tri"), large("church", "church.tri")];
    pairs.into_iter().flatten().chain(singles.into_iter().flatten()).collect()
}

impl Case {
    /// The scene's file; one that is made is written into `folder`.
    pub(super) fn file(&self, root: &Path, folder: &Path) -> Result<PathBuf, String> {
        match self.source {
            Source::Bundled(name) => Ok(root.join("scenes").join(name)),
            Source::Made(make) => {
                let path = folder.join(format!("{}.tri", self.name.replace([' ', '%'], "-")));
                std::fs::write(&path, make()).map_err(|e| format!("{}: {e}", path.display()))?;
                Ok(path)
            }
        }
    }
}
