//! Failures: one line, with the place where there is one.

use std::error::Error as _;
use std::path::Path;

use scene_import::{ErrorKind, Options, open, open_bytes};

use crate::failure;

#[test]
fn the_extension_decides_and_is_asked_for() {
    for name in ["a", "a.stl", "tri", ""] {
        let error = open_bytes(name, b"", &Options::default()).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::UnknownFormat);
        assert_eq!(
            error.to_string(),
            format!("{name}: expected a file that ends in .tri, .vs3, .obj, .gltf or .glb")
        );
    }
}

#[test]
fn a_missing_file_is_named_with_its_path_and_cause() {
    let path = Path::new("no/such/folder/room.tri");
    let error = open(path, &Options::default()).unwrap_err();
    assert_eq!((error.kind(), error.line()), (ErrorKind::Io, None));
    assert!(error.to_string().starts_with("no/such/folder/room.tri: cannot be read: "));
    assert!(error.source().is_some_and(|cause| cause.is::<std::io::Error>()));
}

#[test]
fn a_mistake_in_tri_text_is_placed() {
    let text = "Triangle\n9 9 9 0 0 0\n0 0 x\n";
    let error = open_bytes("room.tri", text.as_bytes(), &Options::default()).unwrap_err();
    assert_eq!((error.line(), error.column()), (Some(3), Some(5)));
    assert!(error.to_string().starts_with("room.tri:3:5: expected "), "{error}");
    assert_eq!(failure("room.tri", text).matches("3:5").count(), 1, "the place is said once");
    assert!(error.source().is_some_and(|cause| cause.is::<tri_io::Error>()));
}

#[cfg(feature = "obj")]
#[test]
fn mistakes_in_obj_text_are_placed() {
    for (text, message) in [
        ("v 0 0", "a.obj:1:5: expected three coordinates, found \"0\""),
        ("v 0 0 0\nv 1 1 1e", "a.obj:2:7: expected a number, found \"1e\""),
        ("v 0 nan 0", "a.obj:1:5: expected a finite number, found \"nan\""),
        // No face uses the vertex.
        ("v 0 0 0\nv 0 0 -inf", "a.obj:2:7: expected a finite number, found \"-inf\""),
        ("v 1e999 0 0 1 1 1", "a.obj:1:3: expected a finite number, found \"1e999\""),
        ("v 0 0 0 nan", "a.obj:1:9: expected a finite number, found \"nan\""),
        ("vt 0.5 infinity", "a.obj:1:8: expected a finite number, found \"infinity\""),
        (
            "v 0 0 0 0",
            "a.obj:1:9: expected a weight other than 0 that leaves the coordinates finite, \
             found \"0\"",
        ),
        (
            "v 0 0 -10 1e-308",
            "a.obj:1:11: expected a weight other than 0 that leaves the coordinates finite, \
             found \"1e-308\"",
        ),
        (
            "v 0 0 0\nv 1 0 0\nf 1 2 9",
            "a.obj:3:7: expected a vertex index from 1 to 2 or from -2 to -1, found \"9\"",
        ),
        (
            "v 0 0 0\nf 1 1 -2",
            "a.obj:2:7: expected a vertex index from 1 to 1 or from -1 to -1, found \"-2\"",
        ),
        ("f 0 1 2", "a.obj:1:3: expected no vertex index, as there is no vertex yet, found \"0\""),
        (
            "v 0 0 0\nvt 0 0\nf 1/1 1/2 1/1",
            "a.obj:3:9: expected a texture coordinate index from 1 to 1 or from -1 to -1, found \"2\"",
        ),
        (
            "v 0 0 0\nf 1//1 1 1",
            "a.obj:2:6: expected no normal index, as there is no normal yet, found \"1\"",
        ),
        (
            "v 0 0 0\nf 1 1 1/1/1/1",
            "a.obj:2:7: expected a corner such as 1, 1/2, 1//3 or 1/2/3, found \"1/1/1/1\"",
        ),
        ("usemtl", "a.obj:1:1: expected a material's name after it, found \"usemtl\""),
    ] {
        assert_eq!(failure("a.obj", text), message);
    }
}

#[test]
fn a_format_left_out_of_the_build_is_named() {
    for (name, feature, format, on) in [
        ("a.obj", "obj", "OBJ", cfg!(feature = "obj")),
        ("a.gltf", "gltf", "glTF", cfg!(feature = "gltf")),
        ("a.glb", "gltf", "GLB", cfg!(feature = "gltf")),
    ] {
        let opened = open_bytes(name, b"", &Options::default());
        if on {
            let off = opened.is_err_and(|error| error.kind() == ErrorKind::FeatureOff);
            assert!(!off, "{name}");
            continue;
        }
        let error = opened.unwrap_err();
        assert_eq!(error.kind(), ErrorKind::FeatureOff);
        let message = format!("this program was built without the feature `{feature}`");
        assert_eq!(error.to_string(), format!("{name}: {message}: it reads no {format}"));
    }
}

#[cfg(feature = "gltf")]
#[test]
fn mistakes_in_gltf_are_placed() {
    assert_eq!(
        failure("a.gltf", "{\"asset\":{\"version\":\"2.0\"},\n\"nodes\": 3}"),
        "a.gltf:2:10: expected glTF JSON: invalid type: integer `3`, expected a sequence"
    );
    assert_eq!(
        failure("a.gltf", r#"{"asset":{"version":"2.0"},"scene":4}"#),
        "a.gltf: expected valid glTF: scene: Index out of bounds"
    );
    let lacking = r#"{"asset":{"version":"2.0"},"extensionsRequired":["EXT_x"]}"#;
    assert!(failure("a.gltf", lacking).contains("extensionsRequired[0]"));
    assert!(failure("a.glb", b"glTF").contains("expected a GLB header"));
    assert!(failure("a.glb", b"").starts_with("a.glb"));
}
