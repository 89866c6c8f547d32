//! What is solved, and what the solution is held against.

use std::path::Path;

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

/// A scene with a path-traced reference, both in the folder `shared` beside the checkout.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(crate) enum Subject {
    /// room.tri, one-sided
    Room,
    /// blocks.tri, one-sided
    Blocks,
    /// cornell.obj, one-sided
    Cornell,
    /// room.tri, with the exchange of an older program
    Paired,
}

/// Where the data lie, from the workspace's root. They are not part of the repository.
const SHARED: &str = "../shared";

impl Subject {
    pub(super) const ALL: [Self; 4] = [Self::Room, Self::Blocks, Self::Cornell, Self::Paired];

    /// How it is called in titles.
    pub(crate) fn title(self) -> &'static str {
        match self {
            Self::Room => "Room",
            Self::Blocks => "Blocks",
            Self::Cornell => "Cornell box",
            Self::Paired => "Room, paired sides",
        }
    }

    /// The name of the block on the page and of the files.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Room => "room",
            Self::Blocks => "blocks",
            Self::Cornell => "cornell",
            Self::Paired => "paired",
        }
    }

    pub(super) fn file_name(self, extension: &str) -> String {
        format!("{}.{extension}", self.name())
    }

    /// The scene's path from the root.
    pub(crate) fn scene(self) -> String {
        let file = match self {
            Self::Room | Self::Paired => "room.tri",
            Self::Blocks => "blocks.tri",
            Self::Cornell => "cornell.obj",
        };
        format!("{SHARED}/scenes/{file}")
    }

    /// The reference's path from the root.
    pub(crate) fn reference(self) -> String {
        format!("{SHARED}/reference/{}", self.reference_name())
    }

    pub(super) fn reference_name(self) -> &'static str {
        match self {
            Self::Room => "room_onesided.csv",
            Self::Blocks => "blocks_onesided.csv",
            Self::Cornell => "cornell.csv",
            Self::Paired => "room_paired.csv",
        }
    }

    /// The sides that the reference was computed with.
    pub(super) fn sides(self) -> &'static str {
        match self {
            Self::Room | Self::Blocks | Self::Cornell => "front",
            Self::Paired => "paired",
        }
    }

    /// Whether scene and reference are there; says so where they are not.
    pub(super) fn is_there(self, root: &Path) -> bool {
        let missing = [self.scene(), self.reference()].into_iter().find(|p| !root.join(p).exists());
        if let Some(path) = &missing {
            println!("{}: skipped, since {path} is not there", self.name());
        }
        missing.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_on_the_command_line_in_json_and_of_files_are_one() {
        for subject in Subject::ALL {
            let typed = subject.to_possible_value().unwrap();
            assert_eq!(typed.get_name(), subject.name());
            assert_eq!(serde_json::to_value(subject).unwrap(), subject.name());
        }
        assert_eq!(Subject::Room.file_name("svg"), "room.svg");
    }

    #[test]
    fn without_the_data_a_subject_is_skipped() {
        assert!(!Subject::Room.is_there(Path::new("/nonexistent/checkout")));
    }
}
