//! A small scene, and a short way to run the program on it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A closed box of side 2 with one bright face, as .tri text.
pub(crate) fn box_tri() -> String {
    let p = |i: usize| format!("{} {} {}\n", 2 * (i & 1), 2 * (i >> 1 & 1), 2 * (i >> 2));
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    let mut text = String::new();
    for (i, [a, b, c, d]) in faces.into_iter().enumerate() {
        let colours = if i == 1 { "100 100 100 255 255 255" } else { "200 150 100 0 0 0" };
        for t in [[a, b, c], [a, c, d]] {
            text += &format!("Triangle\n{colours}\n{}", t.map(p).concat());
        }
    }
    text
}

pub(crate) struct Run {
    output: Output,
}

impl Run {
    pub(crate) fn code(&self) -> i32 {
        self.output.status.code().unwrap()
    }

    pub(crate) fn stdout(&self) -> String {
        String::from_utf8(self.output.stdout.clone()).unwrap()
    }

    pub(crate) fn stderr(&self) -> String {
        String::from_utf8(self.output.stderr.clone()).unwrap()
    }
}

/// Runs the program in a folder.
pub(crate) fn radiosity(folder: &Path, args: &[&str]) -> Run {
    let output =
        Command::new(env!("CARGO_BIN_EXE_radiosity")).current_dir(folder).args(args).output();
    Run { output: output.unwrap() }
}

pub(crate) fn folder_with(name: &str, contents: &[u8]) -> (tempfile::TempDir, PathBuf) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, contents).unwrap();
    (folder, path)
}
