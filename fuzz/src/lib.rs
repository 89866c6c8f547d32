//! What must hold of a file, whatever its bytes, and work whose checkpoints are tried.

mod work;

use std::path::Path;

use scene_import::{Error, Imported, Options};

pub use work::Work;

/// Opens bytes as a file of this name, and looks at what comes of it.
///
/// # Panics
/// If something does not hold: that is a finding.
pub fn scene(name: &str, bytes: &[u8]) {
    look_at(scene_import::open_bytes(name, bytes, &Options::default()));
}

/// The same for a file with others beside it.
///
/// # Panics
/// As [`scene`].
pub fn scene_at(path: &Path) {
    look_at(scene_import::open(path, &Options::default()));
}

fn look_at(result: Result<Imported, Error>) {
    match result {
        Ok(Imported { scene, diagnostics, summary }) => {
            assert_eq!(summary.triangles, scene.triangles().len());
            for id in scene.ids() {
                assert!(scene.corners(id).iter().all(|corner| corner.is_finite()));
                let material = scene.material_of(id);
                assert!(material.reflectance.0.iter().all(|c| (0.0..=1.0).contains(c)));
                assert!(material.emittance.0.iter().all(|c| c.is_finite() && *c >= 0.0));
            }
            for diagnostic in diagnostics {
                assert!(!diagnostic.to_string().is_empty());
            }
        }
        // A message is one line, whatever names and words stand in the file.
        Err(error) => one_line(&error.to_string()),
    }
}

/// Makes sure of a message that is one line.
///
/// # Panics
/// If it is not.
pub fn one_line(message: &str) {
    assert!(!message.is_empty() && !message.contains(['\n', '\r']), "{message:?}");
}
