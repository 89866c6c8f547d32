//! Pages as a browser meets them, and lit files as they are read back.

#![expect(clippy::print_stdout, reason = "tests say that they are skipped")]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

mod browser;
mod built;
mod common;
mod escape;
mod look;
mod point;
