//! What is solved.

use std::path::Path;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use crate::precision::Subject;

/// A scene that lies in the folder `shared` beside the checkout, or else among the bundled ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(super) enum Scene {
    Room,
    Blocks,
    Church,
    Cornell,
}

/// Where the scenes lie, from the workspace's root, the first choice first.
const FOLDERS: [&str; 2] = ["../shared/scenes", "scenes"];

impl Scene {
    pub(super) const ALL: [Self; 4] = [Self::Room, Self::Blocks, Self::Church, Self::Cornell];

    /// How it is called in titles.
    pub(super) fn title(self) -> &'static str {
        match self {
            Self::Room => "Room",
            Self::Blocks => "Blocks",
            Self::Church => "Church",
            Self::Cornell => "Cornell box",
        }
    }

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Room => "room",
            Self::Blocks => "blocks",
            Self::Church => "church",
            Self::Cornell => "cornell",
        }
    }

    /// Its path from the root: the shared file where it is there.
    pub(super) fn path(self, root: &Path) -> String {
        let extension = if self == Self::Cornell { "obj" } else { "tri" };
        let [shared, bundled] = FOLDERS.map(|f| format!("{f}/{}.{extension}", self.name()));
        if root.join(&shared).exists() { shared } else { bundled }
    }

    /// The path of its reference from the root, where scene and reference are there: bundled scenes
    /// are others.
    pub(super) fn reference(self, root: &Path) -> Option<String> {
        let subject = match self {
            Self::Room => Subject::Room,
            Self::Blocks => Subject::Blocks,
            Self::Cornell => Subject::Cornell,
            Self::Church => return None,
        };
        let paths = [subject.scene(), subject.reference()];
        let there = paths.iter().all(|path| root.join(path).exists());
        there.then(|| subject.reference())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_on_the_command_line_in_json_and_of_files_are_one() {
        for scene in Scene::ALL {
            assert_eq!(scene.to_possible_value().unwrap().get_name(), scene.name());
            assert_eq!(serde_json::to_value(scene).unwrap(), scene.name());
        }
    }

    #[test]
    fn without_the_shared_files_the_bundled_ones_serve() {
        let root = crate::root();
        for scene in Scene::ALL {
            let path = scene.path(Path::new("/nonexistent/checkout"));
            assert!(path.starts_with("scenes/") && root.join(&path).exists(), "{path}");
            assert_eq!(scene.reference(Path::new("/nonexistent/checkout")), None);
        }
    }
}
