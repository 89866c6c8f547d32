//! Work that is cut off: it goes on to the same bytes, and from nothing but its own checkpoint.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

mod alike;
mod kill;
mod refuse;
#[path = "../cli/support.rs"]
mod support;

use std::path::Path;

/// The outputs that hold the light.
const OUTPUTS: [&str; 4] = ["lit.csv", "lit.tri", "lit.ply", "lit.glb"];

/// `solve box.tri` with these flags, into [`OUTPUTS`].
fn solve<'a>(flags: &'a str, more: &[&'a str]) -> Vec<&'a str> {
    let outputs = OUTPUTS.iter().flat_map(|name| ["-o", name]);
    let flags = flags.split_whitespace();
    ["solve", "box.tri"]
        .into_iter()
        .chain(outputs)
        .chain(flags)
        .chain(more.iter().copied())
        .collect()
}

/// What the outputs hold.
fn outputs(folder: &Path) -> Vec<Vec<u8>> {
    OUTPUTS.iter().map(|name| std::fs::read(folder.join(name)).unwrap()).collect()
}
