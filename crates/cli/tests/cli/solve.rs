//! Scenes in, light out: files, messages, exit codes.

use crate::support::{box_tri, folder_with, radiosity};

#[test]
fn solves_into_every_format_with_a_report() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let run = radiosity(
        folder.path(),
        &[
            "solve",
            "box.tri",
            "--elements",
            "600",
            "--threads",
            "2",
            "-o",
            "a.csv",
            "-o",
            "a.tri",
            "-o",
            "a.ply",
            "-o",
            "a.vtu",
            #[cfg(feature = "gltf")]
            "--output=a.glb",
            #[cfg(feature = "png")]
            "--output=a.png",
            #[cfg(feature = "exr")]
            "--output=a.exr",
            #[cfg(any(feature = "exr", feature = "png"))]
            "--size=64x48",
            "--report",
            "a.json",
        ],
    );
    assert_eq!(run.code(), 0, "{}", run.stderr());
    assert_eq!(run.stdout(), "", "messages go to stderr");
    let files = [
        "a.csv",
        "a.tri",
        "a.ply",
        "a.vtu",
        #[cfg(feature = "gltf")]
        "a.glb",
        #[cfg(feature = "png")]
        "a.png",
        #[cfg(feature = "exr")]
        "a.exr",
        "a.json",
    ];
    for file in files {
        assert!(folder.path().join(file).metadata().unwrap().len() > 100, "{file}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1 + files.len());
    let report = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    let report: serde_json::Value = serde_json::from_str(&report).unwrap();
    assert_eq!(report["schema"], 2);
    assert_eq!(report["scene"]["triangles"], 12);
    assert_eq!(report["solve"]["stopped"], "converged");
    assert!(report["energy"]["imbalance"].as_f64().unwrap() < 1e-12);
    assert!(report["curve"].as_array().unwrap().len() > 5);
    // Emitted: 4 square units at 100·255.
    assert_eq!(report["energy"]["emitted"][0], 4.0 * 25_500.0);
    let csv = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    assert_eq!(csv.lines().count(), 13);
    assert!(csv.starts_with("triangle,area,B_r,B_g,B_b\n0,2,"));
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let mut texts = Vec::new();
    for threads in ["1", "2", "3", "8", "24"] {
        let out = format!("{threads}.csv");
        let args =
            ["solve", "box.tri", "--elements", "1500", "--threads", threads, "-o", out.as_str()];
        assert_eq!(radiosity(folder.path(), &args).code(), 0);
        texts.push(std::fs::read(folder.path().join(out)).unwrap());
    }
    assert!(texts.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn each_knob_changes_the_result() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let solve = |extra: &[&str]| {
        let mut args = vec!["solve", "box.tri", "--elements", "100", "-o", "-"];
        args.extend(extra);
        let run = radiosity(folder.path(), &args);
        assert_eq!(run.code(), 0, "{extra:?} {}", run.stderr());
        run.stdout()
    };
    let plain = solve(&[]);
    for extra in [
        &["--light", "0.5"][..],
        &["--reflect", "0.25"],
        &["--sides", "both"],
        &["--sides", "paired"],
        &["--elements", "200"],
        &["--converge", "10%"],
    ] {
        let args: Vec<&str> = if extra[0] == "--elements" { vec![] } else { extra.to_vec() };
        if args.is_empty() {
            let run =
                radiosity(folder.path(), &["solve", "box.tri", "--elements", "200", "-o", "-"]);
            assert_ne!(run.stdout(), plain);
        } else {
            assert_ne!(solve(&args), plain, "{extra:?}");
        }
    }
    // A box is convex: nothing blocks, whatever looks for it.
    for accel in ["octree", "bvh", "none"] {
        assert_eq!(solve(&["--accel", accel]), plain, "{accel}");
    }
}

#[cfg(all(feature = "gltf", feature = "png"))]
#[test]
fn without_arguments_it_solves_the_bundled_box() {
    let folder = tempfile::tempdir().unwrap();
    let run = radiosity(folder.path(), &[]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    for file in ["cornell.glb", "cornell.png", "cornell.csv", "cornell.json"] {
        assert!(folder.path().join("out").join(file).is_file(), "{file}");
        assert!(run.stderr().contains(file));
    }
    assert!(run.stderr().contains("energy: absorbed"));
}

#[test]
fn bad_files_fail_with_place_and_expectation() {
    let cases: &[(&str, &[u8], &str)] = &[
        ("cut.tri", b"Triangle\n1 2 3 0 0 0\n0 0 0\n1 0 0\n", "end of file"),
        ("nan.tri", b"Triangle\n1 2 3 0 0 0\n0 0 0\n1 nan 0\n0 1 0\n", "nan.tri:4:3"),
        ("colour.tri", b"Triangle\n1 2 300 0 0 0\n0 0 0\n1 0 0\n0 1 0\n", "colour.tri:2:5"),
        #[cfg(feature = "obj")]
        ("index.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 9\n", "index.obj:3"),
        #[cfg(feature = "gltf")]
        ("cut.glb", b"glTF\x02\0\0\0", "cut.glb"),
        ("what.xyz", b"", "what.xyz"),
        #[cfg(feature = "gltf")]
        ("gone.gltf", b"{}", "gone.gltf"),
    ];
    for &(name, contents, expected) in cases {
        let (folder, _) = folder_with(name, contents);
        let run = radiosity(folder.path(), &["solve", name, "-o", "a.csv"]);
        assert_eq!(run.code(), 1, "{name}: {}", run.stderr());
        let message = run.stderr();
        assert_eq!(message.lines().count(), 1, "{message}");
        assert!(message.contains(expected), "{message}");
        assert!(!folder.path().join("a.csv").exists(), "{name}: no output after a failure");
    }
    let folder = tempfile::tempdir().unwrap();
    let run = radiosity(folder.path(), &["solve", "absent.tri", "-o", "a.csv"]);
    assert_eq!(run.code(), 1);
    assert!(run.stderr().contains("absent.tri"), "{}", run.stderr());
}

#[test]
fn wrong_command_lines_exit_with_2_before_any_work() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for args in [
        &["solve", "box.tri"][..],
        &["solve", "box.tri", "-o", "a.txt"],
        &["solve", "box.tri", "-o", "a.csv", "--elements", "x"],
        &["solve", "box.tri", "-o", "a.csv", "--converge", "7"],
        &["solve", "box.tri", "-o", "a.png", "--camera", "none such"],
        &["solve", "box.tri", "-o", "a.csv", "--no-such-flag"],
        &["solve", "box.tri", "-o", "box.tri"],
        &["solve", "box.tri", "-o", "a.csv", "-o", "./a.csv"],
        &["solve", "box.tri", "-o", "a.csv", "--report", "a.csv"],
        &["solve", "box.tri", "-o", "-", "-o", "-"],
        &["solve", "box.tri", "-o", "a.csv", "--report", "box.mtl"],
        &["solve", "box.tri", "-o", "a.csv", "--elements", "0"],
        &["convert", "box.tri", "box.csv"],
        &["convert", "box.tri", "box.tri"],
        &["compare", "a.csv"],
        &["no-such-command"],
    ] {
        let run = radiosity(folder.path(), args);
        assert_eq!(run.code(), 2, "{args:?} {}", run.stderr());
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

#[test]
fn a_missing_folder_is_found_before_the_work() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = ["solve", "box.tri", "-o", "no/such/a.csv", "--elements", "1000000"];
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 1);
    assert!(run.stderr().contains("there is no folder no/such"), "{}", run.stderr());
}

#[test]
fn a_file_that_cannot_be_replaced_keeps_its_contents() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let taken = folder.path().join("a.csv");
    std::fs::create_dir(&taken).unwrap();
    let run = radiosity(folder.path(), &["solve", "box.tri", "-o", "a.csv"]);
    assert_eq!(run.code(), 1);
    assert!(run.stderr().contains("is a folder"), "{}", run.stderr());
}

#[test]
fn dark_empty_and_endless_scenes_behave_as_stated() {
    // Nothing in it: an empty table, exit 0.
    let (folder, _) = folder_with("empty.tri", b"");
    let run = radiosity(folder.path(), &["solve", "empty.tri", "-o", "-"]);
    assert_eq!((run.code(), run.stdout().as_str()), (0, "triangle,area,B_r,B_g,B_b\n"));

    // No lights: exactly dark, a warning, exit 0.
    let dark = box_tri().replace("255 255 255", "0 0 0");
    let (folder, _) = folder_with("dark.tri", dark.as_bytes());
    let run = radiosity(folder.path(), &["solve", "dark.tri", "-o", "-"]);
    assert_eq!(run.code(), 0);
    assert!(run.stderr().contains("nothing emits"), "{}", run.stderr());
    assert!(run.stdout().lines().skip(1).all(|l| l.ends_with(",0,0,0")), "{}", run.stdout());

    // All lights, nothing reflects: every row is its emittance.
    let lights = box_tri().replace("200 150 100 0 0 0", "0 0 0 255 255 255");
    let (folder, _) = folder_with("lights.tri", lights.as_bytes());
    let run = radiosity(folder.path(), &["solve", "lights.tri", "--reflect", "0", "-o", "-"]);
    assert_eq!(run.code(), 0);
    let bright = |l: &str| l.ends_with(",25500,25500,25500");
    assert!(run.stdout().lines().skip(1).all(bright), "{}", run.stdout());

    // One triangle: its light escapes.
    let one = "Triangle 255 255 255 255 255 255 0 0 0 1 0 0 0 1 0";
    let (folder, _) = folder_with("one.tri", one.as_bytes());
    let run = radiosity(folder.path(), &["solve", "one.tri", "--converge", "0", "-o", "-"]);
    assert_eq!(run.code(), 0);
    assert!(run.stdout().contains("0,0.5,25500,25500,25500"), "{}", run.stdout());
    assert!(run.stderr().contains("escaped 100.0 %"), "{}", run.stderr());

    // Closed, lit and perfectly reflecting: no solution, and no file.
    let white =
        box_tri().replace("200 150 100", "255 255 255").replace("100 100 100", "255 255 255");
    let (folder, _) = folder_with("white.tri", white.as_bytes());
    let run = radiosity(folder.path(), &["solve", "white.tri", "--reflect", "1", "-o", "a.csv"]);
    assert_eq!(run.code(), 1);
    assert!(run.stderr().contains("nothing absorbs"), "{}", run.stderr());
    assert!(!folder.path().join("a.csv").exists());
}

#[test]
fn wrong_winding_is_reported() {
    // One wall shows its back to the inside.
    let mut records: Vec<String> =
        box_tri().split_inclusive("Triangle\n").skip(1).map(str::to_owned).collect();
    let mut lines: Vec<String> = records[0].lines().map(str::to_owned).collect();
    lines.swap(1, 2);
    records[0] = lines.join("\n") + "\n";
    let text = "Triangle\n".to_owned() + &records.concat();
    let (folder, _) = folder_with("wrong.tri", text.as_bytes());
    let run = radiosity(folder.path(), &["solve", "wrong.tri", "--elements", "100", "-o", "a.csv"]);
    assert_eq!(run.code(), 0);
    assert!(run.stderr().contains("wrong side:"), "{}", run.stderr());
}

#[test]
fn compare_measures_and_judges() {
    let (folder, _) = folder_with("a.csv", b"triangle,area,B_r,B_g,B_b\n0,1,1,2,3\n1,3,1,1,1\n");
    std::fs::write(
        folder.path().join("b.csv"),
        "triangle,area,B_r,B_g,B_b\n0,1,1,1,3\n1,3,1,1,1\n",
    )
    .unwrap();
    let run = radiosity(folder.path(), &["compare", "a.csv", "b.csv"]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    // Green: E1 = 1·1 / (1·1 + 3·1) = 0.25; E2 = √(1/4) = 0.5; Einf = 1 / (4/4) = 1.
    let line = |name: &str| {
        let text = run.stdout();
        let line = text.lines().find(|l| l.starts_with(name)).unwrap();
        line.split_whitespace().skip(1).map(|x| x.parse().unwrap()).collect::<Vec<f64>>()
    };
    assert_eq!(line("E1"), [0.0, 0.25, 0.0, 0.25]);
    assert_eq!(line("E2"), [0.0, 0.5, 0.0, 0.5]);
    assert_eq!(line("Einf"), [0.0, 1.0, 0.0, 1.0]);
    let run = radiosity(folder.path(), &["compare", "a.csv", "b.csv", "--at-most", "20%"]);
    assert_eq!(run.code(), 1);
}

#[test]
fn convert_keeps_the_light() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    // Power leaving all surfaces, red: does not depend on the order of the triangles, which
    // .glb groups by material. Another order breaks ties between equal edges another way, so
    // the elements are others of the same size: half a per cent at 600 of them.
    let power = |scene: &str| -> f64 {
        let args = ["solve", scene, "--elements", "600", "-o", "-"];
        let run = radiosity(folder.path(), &args);
        assert_eq!(run.code(), 0, "{scene}: {}", run.stderr());
        let rows = run.stdout();
        let numbers =
            rows.lines().skip(1).map(|l| l.split(',').map(|x| x.parse().unwrap()).collect());
        numbers.map(|n: Vec<f64>| n[1] * n[2]).sum()
    };
    let expected = power("box.tri");
    let files = [
        ("again.tri", 1e-12),
        #[cfg(feature = "gltf")]
        ("box.glb", 5e-3),
    ];
    for (file, bound) in files {
        let run = radiosity(folder.path(), &["convert", "box.tri", file]);
        assert_eq!(run.code(), 0, "{}", run.stderr());
        let error = power(file) / expected - 1.0;
        assert!(error.abs() <= bound, "{file}: {error}");
    }
}

#[test]
fn copies_of_a_surface_take_its_light_once() {
    // Each triangle twice: the same light as once, and rows for the copies.
    let once = box_tri();
    let (folder, _) = folder_with("once.tri", once.as_bytes());
    std::fs::write(folder.path().join("twice.tri"), once.repeat(2)).unwrap();
    let rows = |scene: &str| {
        let run = radiosity(folder.path(), &["solve", scene, "--elements", "100", "-o", "-"]);
        assert_eq!(run.code(), 0, "{}", run.stderr());
        run.stdout().lines().skip(1).map(str::to_owned).collect::<Vec<_>>()
    };
    let (once, twice) = (rows("once.tri"), rows("twice.tri"));
    assert_eq!(twice.len(), 24);
    assert_eq!(once, twice[..12]);
}

#[test]
fn one_triangle_far_away_is_warned_of() {
    let far = box_tri() + "Triangle 9 9 9 0 0 0 1e6 0 0 1000001 0 0 1e6 1 0";
    let (folder, _) = folder_with("far.tri", far.as_bytes());
    let run = radiosity(folder.path(), &["solve", "far.tri", "--elements", "100", "-o", "a.csv"]);
    assert!(run.stderr().contains("take out what lies far away"), "{}", run.stderr());
}

#[cfg(unix)]
#[test]
fn links_stay_links_and_modes_stay() {
    use std::os::unix::fs::PermissionsExt;
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let target = folder.path().join("target.csv");
    std::fs::write(&target, "old").unwrap();
    std::fs::set_permissions(&target, std::fs::Permissions::from_mode(0o600)).unwrap();
    let link = folder.path().join("link.csv");
    std::os::unix::fs::symlink("target.csv", &link).unwrap();
    let args = ["solve", "box.tri", "--elements", "100", "-o", "link.csv"];
    assert_eq!(radiosity(folder.path(), &args).code(), 0);
    assert!(link.symlink_metadata().unwrap().is_symlink());
    assert!(std::fs::read_to_string(&target).unwrap().starts_with("triangle,"));
    assert_eq!(target.metadata().unwrap().permissions().mode() & 0o777, 0o600);
}

#[cfg(feature = "verify")]
#[test]
fn verify_prints_a_row_per_case() {
    let folder = tempfile::tempdir().unwrap();
    let run = radiosity(folder.path(), &["verify", "--only", "B-3"]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let text = run.stdout();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].starts_with("case") && lines[1].contains("0.138531606"), "{text}");
    assert!(lines[2].starts_with("1 of 1 passed"), "{text}");
    assert_eq!(radiosity(folder.path(), &["verify", "--only", "no such"]).code(), 2);
}

#[cfg(feature = "gltf")]
#[test]
fn factors_of_tri_files_are_refused_for_others() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    assert_eq!(radiosity(folder.path(), &["convert", "box.tri", "box.glb"]).code(), 0);
    for flag in ["--light", "--reflect"] {
        let args = ["solve", "box.glb", flag, "0.3", "--elements", "20", "-o", "-"];
        let run = radiosity(folder.path(), &args);
        assert_eq!(run.code(), 2, "{}", run.stderr());
        assert!(run.stderr().contains("are for .tri files"), "{}", run.stderr());
        // They are the factors of what is written, too.
        let again = ["convert", "box.glb", "again.tri", flag, "0.9"];
        assert_eq!(radiosity(folder.path(), &again).code(), 0);
    }
}
