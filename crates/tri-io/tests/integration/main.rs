//! The crate from outside: texts in, records and errors out, and back.

#![allow(clippy::unwrap_used, clippy::print_stdout)] // helpers of tests are tests too

mod decimal;
mod float;
mod parse;
mod roundtrip;
mod shared_scenes;
mod support;
