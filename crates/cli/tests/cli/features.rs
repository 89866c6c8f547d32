//! What a build leaves out is refused in one line, and names the feature.

use crate::support::{box_tri, folder_with, radiosity};

#[test]
fn what_is_left_out_is_named_and_the_rest_works() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for file in ["a.obj", "a.gltf", "a.glb"] {
        std::fs::write(folder.path().join(file), "").unwrap();
    }
    let cases: &[(&str, bool, &[&str])] = &[
        (
            "checkpoint",
            cfg!(feature = "checkpoint"),
            &["solve", "--checkpoint", "a", "-o", "a.csv"],
        ),
        ("checkpoint", cfg!(feature = "checkpoint"), &["solve", "--resume", "a", "-o", "a.csv"]),
        ("config", cfg!(feature = "config"), &["solve", "--config", "a.toml"]),
        ("manual", cfg!(feature = "manual"), &["completions", "no such"]),
        ("manual", cfg!(feature = "manual"), &["man", "-o", "no such"]),
        ("form-factors", cfg!(feature = "form-factors"), &["form-factors", "box.tri", "-o", "-"]),
        ("gltf", cfg!(feature = "gltf"), &["solve", "a.gltf", "-o", "a.csv"]),
        ("gltf", cfg!(feature = "gltf"), &["plan", "a.glb"]),
        ("gltf", cfg!(feature = "gltf"), &["solve", "box.tri", "--elements", "20", "-o", "a.glb"]),
        ("gltf", cfg!(feature = "gltf"), &["convert", "box.tri", "b.glb"]),
        ("gltf", cfg!(feature = "gltf"), &["solve", "--elements", "20", "-o", "a.csv"]),
        ("html", cfg!(feature = "html"), &["solve", "box.tri", "--elements", "20", "-o", "a.html"]),
        ("html", cfg!(feature = "html"), &["view", "a.glb", "-o", "a.html"]),
        (
            "live",
            cfg!(feature = "live"),
            &["solve", "box.tri", "--elements", "20", "--live", "-o", "a.csv"],
        ),
        ("obj", cfg!(feature = "obj"), &["solve", "a.obj", "-o", "a.csv"]),
        ("png", cfg!(feature = "png"), &["solve", "box.tri", "--elements", "20", "-o", "a.png"]),
        (
            "png",
            cfg!(any(feature = "exr", feature = "png")),
            &["solve", "box.tri", "--size", "9x9", "-o", "-"],
        ),
        ("exr", cfg!(feature = "exr"), &["solve", "box.tri", "--elements", "20", "-o", "a.exr"]),
        ("verify", cfg!(feature = "verify"), &["verify", "--only", "no such"]),
    ];
    for (feature, on, args) in cases {
        let run = radiosity(folder.path(), args);
        let said = run.stderr();
        let message = format!("this program was built without the feature `{feature}`");
        assert_eq!(said.contains(&message), !on, "{args:?}: {said}");
        if !on {
            assert_eq!((run.code(), said.lines().count()), (2, 1), "{args:?}: {said}");
        }
    }
    let plain = [
        "solve",
        "box.tri",
        "--elements",
        "20",
        "-o",
        "b.csv",
        "-o",
        "b.ply",
        "-o",
        "b.tri",
        "-o",
        "b.vtu",
    ];
    assert_eq!(radiosity(folder.path(), &plain).code(), 0);
}

/// Without a command the program solves the bundled scene, if it can read it.
#[cfg(not(feature = "gltf"))]
#[test]
fn without_arguments_it_says_that_the_bundled_box_cannot_be_read() {
    let folder = tempfile::tempdir().unwrap();
    let run = radiosity(folder.path(), &[]);
    assert_eq!(run.code(), 2, "{}", run.stderr());
    assert!(run.stderr().contains("the bundled one is a .glb"), "{}", run.stderr());
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}
