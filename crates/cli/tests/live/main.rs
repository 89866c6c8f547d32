//! A solve that is watched: who may, what they see, and that the work does not care.

#![expect(clippy::print_stdout, reason = "tests say that they are skipped")]
#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

#[path = "../../../viewer/tests/integration/browser.rs"]
#[expect(dead_code, reason = "the viewer's own tests need more of it")]
mod browser;
mod page;
mod reader;
mod served;
#[path = "../cli/support.rs"]
#[expect(dead_code, reason = "the command line's own tests need more of it")]
mod support;
mod watched;
