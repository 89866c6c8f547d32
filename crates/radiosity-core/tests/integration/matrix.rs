//! Form factors stored, closed and solved, against exact solutions and stiff scenes.
//!
//! Data that is no part of the repository lies in a folder `shared` beside the checkout;
//! tests that need it say so and pass where it is absent.

#![expect(clippy::print_stdout, reason = "figures are worth reading beside a verdict")]

mod endless;
mod exact;
mod extremes;
mod iterations;
mod repair;
mod rooms;
mod shared;
