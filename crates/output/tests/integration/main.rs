//! The outputs against closed forms and independent parsers.

#![allow(clippy::unwrap_used, reason = "a helper that panics fails the test that called it")]
#![allow(clippy::print_stdout, reason = "tests say which data they did not find")]

mod camera;
mod common;
mod compare;
mod csv;
mod file;
mod glb;
mod picture;
mod ply;
mod tri;
mod unlit;
