//! Says where the bundled scenes lie: in a checkout beside the crates, in a package within it.
//!
//! The links in `scenes/`, which a package holds as files, are not followed in a checkout: some
//! systems have none.

use std::env;
use std::path::Path;

fn main() {
    let package = env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default();
    let package = Path::new(&package);
    let checkout = package.join("../../scenes");
    let scenes =
        if checkout.join("cornell.glb").is_file() { checkout } else { package.join("scenes") };
    println!("cargo::rustc-env=RADIOSITY_SCENES={}", scenes.display());
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed={}", scenes.display());
}
