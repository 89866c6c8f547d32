//! Pages as a user gets them: from a solve, and from a file that was lit before.

#![expect(clippy::print_stdout, reason = "tests say that they are skipped")]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

#[path = "../../../viewer/tests/integration/browser.rs"]
#[expect(dead_code, reason = "the crate's own tests need more of it")]
mod browser;
#[path = "../cli/support.rs"]
#[expect(dead_code, reason = "the command line's own tests need more of it")]
mod support;
mod view;
