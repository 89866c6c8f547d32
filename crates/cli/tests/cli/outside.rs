//! Scenes that name files outside their folder.

use std::fs;

use crate::support::radiosity;

/// A triangle whose library lies beside the scene's folder.
const OBJ: &str = "mtllib ../wall.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wall\nf 1 2 3\n";

#[test]
fn every_command_that_reads_a_scene_stays_in_its_folder_until_told() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("scene")).unwrap();
    fs::write(folder.path().join("scene/a.obj"), OBJ).unwrap();
    fs::write(folder.path().join("wall.mtl"), "newmtl wall\nKd 0.25\nKe 1\n").unwrap();
    let commands: &[&[&str]] = &[
        &["solve", "scene/a.obj", "--elements", "4", "-o", "a.csv"],
        &["plan", "scene/a.obj"],
        &["convert", "scene/a.obj", "a.tri"],
        #[cfg(feature = "form-factors")]
        &["form-factors", "scene/a.obj", "-o", "F.csv"],
    ];
    for command in commands {
        let run = radiosity(folder.path(), command);
        let lines = run.stderr() + &run.stdout();
        let line = lines.lines().find(|line| line.contains("--allow-outside"));
        let line = line.unwrap_or_else(|| panic!("{command:?}: {lines}"));
        assert!(line.contains("a.obj:1") && line.contains("../wall.mtl"), "{line}");
        let run = radiosity(folder.path(), &[*command, &["--allow-outside"]].concat());
        assert_eq!(run.code(), 0, "{command:?}: {}", run.stderr());
        assert!(!run.stderr().contains("outside"), "{command:?}: {}", run.stderr());
    }
    let tri = fs::read_to_string(folder.path().join("a.tri")).unwrap();
    // 0.25 of the 0.5 that 255 stands for, and a lamp.
    assert!(tri.contains("128 128 128 255 255 255"), "{tri}");
}
