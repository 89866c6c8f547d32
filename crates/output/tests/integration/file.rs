//! Whole files or none.

use std::fs;
use std::path::Path;

use output::{ErrorKind, Exposure, Options, write_file};
use scene::Rgb;

use crate::common::square;

fn names(folder: &Path) -> Vec<String> {
    let name =
        |entry: std::io::Result<fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
    let mut names: Vec<String> = fs::read_dir(folder).unwrap().map(name).collect();
    names.sort();
    names
}

#[test]
fn every_extension_writes_its_format_and_says_how_much() {
    let folder = tempfile::tempdir().unwrap();
    let (scene, solution) = square(Rgb::splat(1.0));
    let starts: &[(&str, &[u8])] = &[
        #[cfg(feature = "png")]
        ("a.PNG", b"\x89PNG"),
        ("a.csv", b"triangle,"),
        #[cfg(feature = "exr")]
        ("a.exr", b"\x76\x2f\x31\x01"),
        #[cfg(feature = "glb")]
        ("a.glb", b"glTF"),
        ("a.ply", b"ply\n"),
        ("a.tri", b"Triangle"),
        ("a.vtu", b"<?xml "),
    ];
    for (name, start) in starts {
        let path = folder.path().join(name);
        let written = write_file(&path, &scene, &solution, &Options::default()).unwrap();
        let bytes = fs::read(&path).unwrap();
        assert!(bytes.starts_with(start), "{name}");
        assert_eq!((written.path, written.bytes), (path, bytes.len() as u64));
    }
    assert!(names(folder.path()).iter().eq(starts.iter().map(|(name, _)| name)));
}

/// Formats whose features are off, as such; [`output::Format`] knows them all the same.
#[test]
fn what_this_build_leaves_out_is_named() {
    let lit = square(Rgb::splat(1.0));
    for (format, feature, on) in [
        (output::Format::Glb, "glb", cfg!(feature = "glb")),
        (output::Format::Png, "png", cfg!(feature = "png")),
        (output::Format::Exr, "exr", cfg!(feature = "exr")),
    ] {
        let path = format!("a.{feature}");
        let found = output::Format::from_path(path.as_ref());
        let written = output::write(format, &mut Vec::new(), &lit.0, &lit.1, &Options::default());
        if on {
            assert!(found.is_ok() && written.is_ok(), "{feature}");
            continue;
        }
        let (found, written) = (found.unwrap_err(), written.unwrap_err());
        assert_eq!((found.kind(), found.kind()), (written.kind(), &ErrorKind::FeatureOff(feature)));
        let message = format!("this program was built without the feature `{feature}`: ");
        assert!(found.to_string().starts_with(&format!("{path}: {message}")), "{found}");
    }
}

#[test]
fn a_failure_leaves_the_old_file_and_nothing_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("lit.csv");
    fs::write(&path, "old").unwrap();
    let (scene, mut solution) = square(Rgb::splat(1.0));
    solution.elements[1].exitance.0[1] = f64::NAN;
    let error = write_file(&path, &scene, &solution, &Options::default()).unwrap_err();
    assert_eq!(error.kind(), &ErrorKind::Exitance { element: 1 });
    assert_eq!(error.path(), Some(path.as_path()));
    assert!(error.to_string().starts_with(&format!("{}: element 1: ", path.display())));
    assert_eq!(fs::read_to_string(&path).unwrap(), "old");
    assert_eq!(names(folder.path()), ["lit.csv"]);
}

#[test]
fn a_target_that_cannot_be_replaced_leaves_nothing_behind() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("taken.ply");
    fs::create_dir(&path).unwrap();
    let (scene, solution) = square(Rgb::splat(1.0));
    let error = write_file(&path, &scene, &solution, &Options::default()).unwrap_err();
    assert_eq!(error.kind(), &ErrorKind::Write);
    assert!(std::error::Error::source(&error).is_some());
    assert_eq!(names(folder.path()), ["taken.ply"]);
    let missing = folder.path().join("no/such/a.csv");
    let error = write_file(&missing, &scene, &solution, &Options::default()).unwrap_err();
    assert_eq!((error.kind(), error.path()), (&ErrorKind::Write, Some(missing.as_path())));
}

#[cfg(unix)]
#[test]
fn the_file_is_as_readable_as_any_new_one() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let (scene, solution) = square(Rgb::splat(1.0));
    let path = folder.path().join("a.csv");
    write_file(&path, &scene, &solution, &Options::default()).unwrap();
    let plain = folder.path().join("plain");
    fs::write(&plain, "").unwrap();
    let mode = |path: &Path| fs::metadata(path).unwrap().permissions().mode();
    assert_eq!(mode(&path), mode(&plain));
}

#[test]
fn an_unknown_extension_names_the_known_ones() {
    let (scene, solution) = square(Rgb::splat(1.0));
    for (name, what) in
        [("a.jpg", "unknown file name extension \".jpg\""), ("lit", "no file name extension")]
    {
        let error = write_file(name.as_ref(), &scene, &solution, &Options::default()).unwrap_err();
        let expected = format!("{name}: {what}, expected {}", output::Format::extensions());
        assert_eq!(error.to_string(), expected);
    }
}

#[test]
fn garbage_is_refused_before_a_byte_is_written() {
    let good = square(Rgb::splat(1.0));
    let mut far = good.clone();
    far.1.elements[0].triangle.0 = 7;
    let mut loose = good.clone();
    loose.1.elements[0].vertices[2].0 = 99;
    let mut lost = good.clone();
    lost.1.vertices[3].x = f64::INFINITY;
    let mut bright = good.clone();
    bright.1.elements[0].corner_exitance[2].0[0] = 1e39; // beyond f32
    let plain = Options::default;
    let cases = [
        (&far, "csv", plain(), "element 0: names a triangle that is not there"),
        (&loose, "ply", plain(), "element 0: names a vertex that is not there"),
        (&lost, "ply", plain(), "solution vertex 3: a coordinate is not finite"),
        #[cfg(feature = "glb")]
        (&lost, "glb", plain(), "solution vertex 3: a coordinate is not finite"),
        (&bright, "ply", plain(), "element 0: exitance is not finite, or too large"),
        (&good, "ply", Options { size: (0, 9), ..plain() }, "expected a picture of 1 to 32768"),
        (&good, "ply", Options { samples: 17, ..plain() }, "expected 1 to 16 samples"),
        (
            &good,
            "ply",
            Options { exposure: Exposure::Scale(-1.0), ..plain() },
            "expected an exposure scale that is above 0",
        ),
        (
            &good,
            "ply",
            Options { exposure: Exposure::Stops(f64::NAN), ..plain() },
            "expected an exposure within 64 stops",
        ),
    ];
    for ((scene, solution), extension, options, message) in cases {
        let format = output::Format::from_path(format!("a.{extension}").as_ref()).unwrap();
        let mut bytes = Vec::new();
        let error = output::write(format, &mut bytes, scene, solution, &options).unwrap_err();
        assert!(error.to_string().starts_with(message), "{error}");
        assert!(bytes.is_empty());
    }
    // Text has no such limit.
    let mut bytes = Vec::new();
    output::write(output::Format::Csv, &mut bytes, &bright.0, &bright.1, &plain()).unwrap();
}
