//! The same cases through every part of the workspace.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]
#![expect(clippy::print_stdout, reason = "tests say what they measured and what they left out")]

mod case_files;
mod cie171;
mod closed_forms;
mod exact_cases;
mod form_factors;
mod laws;
mod reference;
mod same_bits;
mod scenes;
mod statement;
mod stiff;
mod tilted;
mod verified;

/// Largest share of the emitted power that a ledger may lose or make: rounding of f64 sums
/// of a million terms, far below any error that a bug would make.
const BALANCED: f64 = 1e-12;
