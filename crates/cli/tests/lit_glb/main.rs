//! From GLB to GLB: the scene's own document comes back, lit, and other programs can read it.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

mod back;
mod file;
mod kept;
mod light;
mod model;
mod outside;
