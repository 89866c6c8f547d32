//! The scenes that are measured, by name.

use std::fmt;
use std::fs::File;
use std::path::{Path, PathBuf};

use glam::DVec3;

use crate::{Triangle, Workload, refine, soup, terrain};

/// The names of the scenes.
pub const SCENES: [&str; 7] =
    ["room", "hall", "church", "church-1m", "church-refined", "soup-1m", "terrain-1m"];

/// Triangles of the scenes that are made or refined to size.
const MILLION: usize = 1_000_000;

/// Folders with `.tri` files, sought in the ancestors of this crate's folder in turn: the bundled
/// scenes, and those beside the checkout.
const BUNDLED: &str = "scenes";
const BESIDE: &str = "shared/scenes";

/// A scene could not be had.
#[derive(Debug)]
pub enum SceneError {
    /// No scene has this name.
    Unknown(String),
    /// The file is in none of the folders.
    Absent(PathBuf),
    /// The file cannot be read.
    Unreadable(PathBuf, String),
}

impl fmt::Display for SceneError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unknown(name) => {
                write!(f, "no scene `{name}`; there are {} and files *.tri", SCENES.join(", "))
            }
            Self::Absent(file) => write!(f, "no {} beside the checkout", file.display()),
            Self::Unreadable(file, error) => write!(f, "{}:{error}", file.display()),
        }
    }
}

impl std::error::Error for SceneError {}

/// Makes the workload of a scene with about `count` segments of each kind.
///
/// `name` is one of [`SCENES`] or the path of a `.tri` file:
/// - `room` and `church` are the files beside the checkout, `hall` the bundled one;
/// - `church-1m` is the church cut into a million triangles;
/// - `church-refined` has the church's own triangles as occluders and the million as receivers,
///   as in a solver that refines elements and leaves the occluders whole;
/// - `soup-1m` and `terrain-1m` are made by [`soup`] and [`terrain`].
///
/// # Errors
/// The name is unknown, or the file is absent or not readable.
pub fn workload(name: &str, count: usize) -> Result<Workload, SceneError> {
    let whole = |triangles: Vec<Triangle>| {
        let receivers = triangles.clone();
        Workload::new(triangles, &receivers, count)
    };
    Ok(match name {
        "room" | "church" => whole(read_beside(name, BESIDE)?),
        "hall" => whole(read_beside(name, BUNDLED)?),
        "church-1m" => whole(refine(&read_beside("church", BESIDE)?, MILLION)),
        "church-refined" => {
            let church = read_beside("church", BESIDE)?;
            let receivers = refine(&church, MILLION);
            Workload::new(church, &receivers, count)
        }
        "soup-1m" => whole(soup(MILLION)),
        "terrain-1m" => whole(terrain(MILLION)),
        _ if name.ends_with(".tri") => whole(read(Path::new(name))?),
        _ => return Err(SceneError::Unknown(name.to_owned())),
    })
}

fn read_beside(name: &str, folder: &str) -> Result<Vec<Triangle>, SceneError> {
    let file = Path::new(folder).join(name).with_extension("tri");
    let found = Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .map(|ancestor| ancestor.join(&file))
        .find(|path| path.is_file());
    read(&found.ok_or(SceneError::Absent(file))?)
}

fn read(path: &Path) -> Result<Vec<Triangle>, SceneError> {
    let unreadable = |error: String| SceneError::Unreadable(path.to_owned(), error);
    let file = File::open(path).map_err(|error| unreadable(format!(" {error}")))?;
    tri_io::Reader::new(file)
        .map(|record| {
            let record = record.map_err(|error| unreadable(error.to_string()))?;
            Ok(record.vertices.map(DVec3::from_array))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bundled_hall_has_segments() {
        let workload = workload("hall", 2000).unwrap();
        assert_eq!(workload.occluders.len(), 4310);
        assert_eq!(workload.random.len(), 2000);
        assert_eq!(workload.shooting.iter().map(|b| b.targets.len()).sum::<usize>(), 2000);
    }

    #[test]
    fn what_is_not_there_is_named() {
        let error = workload("attic", 1).unwrap_err().to_string();
        assert!(error.starts_with("no scene `attic`; there are room, hall,"), "{error}");
        let error = workload("no/attic.tri", 1).unwrap_err().to_string();
        assert!(error.starts_with("no/attic.tri: "), "{error}");
    }
}
