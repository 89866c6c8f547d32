//! The bundled page is what its sources are built into, and brings its licence along.

use std::path::Path;

const PAGE: &str = include_str!("../../assets/page.html");

/// `build.js` writes the checksum of the sources into the page.
#[test]
fn the_page_is_built_from_the_sources_beside_it() {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("web/src");
    let mut files: Vec<_> =
        std::fs::read_dir(sources).unwrap().map(|f| f.unwrap().path()).collect();
    files.sort();
    let mut sum = crc32fast::Hasher::new();
    for file in &files {
        sum.update(&std::fs::read(file).unwrap());
    }
    let expected = format!("sources {}.", sum.finalize());
    assert!(
        PAGE.contains(&expected),
        "{expected} run `npm ci && npm run build` in crates/viewer/web"
    );
}

#[test]
fn what_is_bundled_brings_its_licence() {
    let licence = include_str!("../../assets/LICENSE-three.txt");
    assert!(licence.starts_with("The MIT License"), "{licence}");
    let notice = licence.lines().find(|line| line.starts_with("Copyright")).unwrap();
    assert!(PAGE.contains(notice) && PAGE.contains("Permission is hereby granted"));
}
