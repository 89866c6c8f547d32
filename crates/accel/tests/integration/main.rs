//! Tests of the structures against each other and against an independent f64 reference.

#![allow(clippy::print_stdout, reason = "tests report what they counted")]

mod agree;
mod batch;
mod config;
mod degenerate;
mod nearest;
mod proofs;
mod support;
mod validate;
mod watertight;
mod widths;
