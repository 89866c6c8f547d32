//! Two solutions compared: numbers, and pictures of the difference.

use crate::support::{box_tri, folder_with, radiosity};

#[test]
fn a_difference_is_drawn_beside_what_it_is_of() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    for (name, light) in [("a.csv", "1.1"), ("b.csv", "1")] {
        let args = ["solve", "box.tri", "--elements", "100", "--light", light, "-o", name];
        assert_eq!(radiosity(folder.path(), &args).code(), 0);
    }
    let compare = |flags: &[&str]| {
        let args = [&["compare", "a.csv", "b.csv"], flags].concat();
        let run = radiosity(folder.path(), &args);
        (run.code(), run.stdout() + &run.stderr())
    };
    let (_, plain) = compare(&[]);
    let drawn = ["--picture", "d.png", "--scene", "box.tri", "--size", "60x40"];
    let (code, said) = compare(&drawn);
    assert_eq!(code, 0, "{said}");
    assert!(said.starts_with(plain.trim_end()), "{said}");
    // A tenth more light everywhere is a tenth of the mean or more where it is bright; the lamp, which
    // differs by far more, is left out.
    assert!(said.contains("d.png: A, B, and their difference to ±20.0 %"), "{said}");
    let png = std::fs::read(folder.path().join("d.png")).unwrap();
    // Width and height stand in the first chunk: three panels of 60, two gaps of 4 pixels.
    let side = |at: usize| u32::from_be_bytes(png[at..at + 4].try_into().unwrap());
    assert_eq!(side(16), 3 * 60 + 2 * 4);
    assert!(side(20) > 40);
    let (code, _) = compare(&[&drawn[..], &["--range", "5%"]].concat());
    assert_eq!(code, 0);
    assert_ne!(std::fs::read(folder.path().join("d.png")).unwrap(), png);

    for (flags, code, message) in [
        (&["--picture", "d.png"][..], 2, "--scene"),
        (&["--size", "9x9"], 2, "are for --picture"),
        (&["--picture", "d.jpg", "--scene", "box.tri"], 2, "ends in .png"),
        (&["--picture", "d.png", "--scene", "box.tri", "--range", "0"], 2, "above 0"),
        (
            &["--picture", "d.png", "--scene", "box.tri", "--camera", "no"],
            2,
            "the scene has no camera",
        ),
    ] {
        let (got, said) = compare(flags);
        assert!(got == code && said.contains(message), "{flags:?}: {said}");
    }
    // Another scene: a triangle is missing.
    let text = box_tri();
    let short = &text[..text.rfind("Triangle").unwrap()];
    std::fs::write(folder.path().join("short.tri"), short).unwrap();
    let (code, said) = compare(&["--picture", "e.png", "--scene", "short.tri"]);
    assert!(
        code == 1 && said.contains("12 rows, expected one for each of the scene's 11"),
        "{said}"
    );
    assert!(!folder.path().join("e.png").exists());
}
