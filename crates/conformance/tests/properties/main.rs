//! Laws of form factors and of light, on shapes and scenes that no one thought of.
//!
//! The cases are drawn from a fixed seed, so every run sees the same ones; a failure is made
//! small and printed, and nothing is written beside the sources.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

mod draw;
mod enclosures;
mod factors;
mod invariance;
mod light;
mod plan;
mod rooms;

use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

/// A runner of so many cases, always the same.
fn runner(cases: u32) -> TestRunner {
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}
