//! The outputs against closed forms and independent parsers.

#![allow(clippy::unwrap_used, reason = "a helper that panics fails the test that called it")]
#![allow(clippy::print_stdout, reason = "tests say which data they did not find")]

#[cfg(any(feature = "exr", feature = "png"))]
mod camera;
mod common;
mod compare;
mod csv;
#[cfg(feature = "exr")]
mod exr;
mod file;
#[cfg(feature = "glb")]
mod glb;
#[cfg(feature = "png")]
mod picture;
mod ply;
mod tri;
mod unlit;
mod vtu;
