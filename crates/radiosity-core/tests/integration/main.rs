//! The solver against closed forms, and the mesh against its promises.

#![expect(clippy::unwrap_used, reason = "a test that cannot go on may panic")]

mod adaptive;
mod ambient;
mod balance;
mod cut;
mod furnace;
mod graded;
mod limits;
mod matrix;
mod mesh;
mod models;
mod overlap;
mod plan;
mod plates;
mod probes;
mod refine;
mod resume;
mod stiff;
mod stops;
