//! A laboratory: one octree with 3D-DDA, its techniques as switches, each measured on and off.
//!
//! Kept apart from accel, so that what did not pay need not stay there.

mod build;
mod compare;
mod instructions;
mod layout;
mod lookup;
mod overlap;
mod specimens;
mod switches;
mod table;
#[cfg(test)]
mod tests;
mod triangles;
mod walk;

pub use compare::{Comparison, Measured, compare};
pub use instructions::{Counted, answer_uncounted, count};
pub use switches::{
    Data, Effect, Layout, Lookup, Reject, Stop, Switches, TECHNIQUES, Technique, VARIANTS, Variant,
};
pub use table::techniques_markdown;
