//! The program as a user meets it: files, messages, exit codes.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

#[cfg(feature = "config")]
mod config;
mod features;
mod log;
#[cfg(feature = "manual")]
mod manual;
mod mistakes;
#[cfg(feature = "obj")]
mod outside;
mod plan;
#[cfg(feature = "obj")]
mod probe_grid;
mod solve;
mod statement;
mod stopping;
mod support;
#[cfg(unix)]
mod terminal;
