//! One row per input triangle: the form in which solutions are compared.

mod places;
mod read;
mod write;

pub use places::{FreePlace, Place, Places, read_places, write_places, write_probes};
pub use read::read;
pub use write::{rows, write};

use scene::Rgb;

/// A row: the light that leaves one input triangle, or one part of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The input triangle, counted from 0 in file order.
    pub triangle: u32,
    /// Where on the triangle a b c, if the row speaks of a place: a + u (b − a) + v (c − a).
    pub uv: Option<[f64; 2]>,
    /// Area, in squared scene units.
    pub area: f64,
    /// Area mean of the front's exitance.
    pub exitance: Rgb,
    /// Standard error of the exitance, where a sampling method made it.
    pub se: Option<Rgb>,
    /// It emits: left out of error sums, which its own light would swamp.
    pub emits: bool,
    /// Coplanar with another triangle, so that which one is lit is a matter of taste.
    pub ambiguous: bool,
}
