//! Places on input triangles, and the light there: what probes read and write.

use std::io::{Read, Write};

use scene::Rgb;
use tri_io::{FloatBuffer, write_f64};

use super::read;
use crate::Error;

/// How far u + v may exceed 1: coordinates are often written with six digits.
pub(super) const PLACE_SLACK: f64 = 1e-5;

/// A place on an input triangle a b c: a + u (b − a) + v (c − a).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place {
    /// The input triangle, counted from 0 in file order.
    pub triangle: u32,
    /// Barycentric coordinates of b and c.
    pub uv: [f64; 2],
    /// The area that the place stands for, if it was given: it is passed on.
    pub area: Option<f64>,
}

/// Reads the columns `triangle`, `u`, `v` and, where present, `area`, by the names in the
/// first line; other columns are passed over.
///
/// # Errors
/// As [`super::read`]; `u` or `v` below 0, or above 1 in sum.
///
/// # Examples
/// ```
/// let places = output::csv::read_places("triangle,u,v\n7,0.25,0.5\n".as_bytes())?;
/// assert_eq!((places[0].triangle, places[0].uv), (7, [0.25, 0.5]));
/// # Ok::<(), output::Error>(())
/// ```
pub fn read_places(source: impl Read) -> Result<Vec<Place>, Error> {
    read::places(source)
}

/// Writes `triangle,u,v,area,B_r,B_g,B_b`, one row per place in their order; without `area`
/// unless all have one. Every number reads back to the same bits.
///
/// # Errors
/// What the sink answers.
pub fn write_places(out: &mut dyn Write, places: &[Place], exitance: &[Rgb]) -> Result<(), Error> {
    let with_area = places.iter().all(|p| p.area.is_some());
    let mut buffer = FloatBuffer::new();
    let mut text = || {
        let area = if with_area { "area," } else { "" };
        writeln!(out, "triangle,u,v,{area}B_r,B_g,B_b")?;
        for (place, light) in places.iter().zip(exitance) {
            write!(out, "{}", place.triangle)?;
            let area = place.area.filter(|_| with_area);
            for value in place.uv.into_iter().chain(area).chain(light.0) {
                write!(out, ",{}", write_f64(value, &mut buffer))?;
            }
            writeln!(out)?;
        }
        Ok(())
    };
    text().map_err(|e: std::io::Error| Error::write(e))
}
