//! Places on input triangles and in the open, and the light there: what probes read and write.

use std::io::{self, Read, Write};

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

/// A place in the open, as on a work plane, and the direction that it looks in.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FreePlace {
    /// Where, in the scene's units.
    pub position: [f64; 3],
    /// Normal of the area that is lit, of unit length.
    pub normal: [f64; 3],
}

/// The places of a file: all of one kind.
#[derive(Clone, Debug, PartialEq)]
pub enum Places {
    /// On surfaces.
    Surface(Vec<Place>),
    /// In the open.
    Free(Vec<FreePlace>),
}

/// Reads the columns `triangle`, `u`, `v` and, where present, `area`, or else `x`, `y`, `z`, `nx`,
/// `ny`, `nz`, by the names in the first line; other columns are passed over. A normal may have any
/// length above 0.
///
/// # Errors
/// As [`super::read`]; `u` or `v` below 0, or above 1 in sum; a normal without length.
///
/// # Examples
/// ```
/// use output::csv::{FreePlace, Place, Places, read_places};
///
/// let places = read_places("triangle,u,v\n7,0.25,0.5\n".as_bytes())?;
/// assert_eq!(places, Places::Surface(vec![Place { triangle: 7, uv: [0.25, 0.5], area: None }]));
/// let places = read_places("x,y,z,nx,ny,nz\n1,2,0.8,0,0,2\n".as_bytes())?;
/// let up = FreePlace { position: [1.0, 2.0, 0.8], normal: [0.0, 0.0, 1.0] };
/// assert_eq!(places, Places::Free(vec![up]));
/// # Ok::<(), output::Error>(())
/// ```
pub fn read_places(source: impl Read) -> Result<Places, Error> {
    read::places(source)
}

/// Writes places as [`read_places`] reads them, one row each in their order. Every number reads
/// back to the same bits.
///
/// # Errors
/// What the sink answers.
pub fn write_places(out: &mut dyn Write, places: &Places) -> Result<(), Error> {
    table(out, places, &[])
}

/// Writes places with the light there: `B_r,B_g,B_b`, what leaves a surface, and `E_r,E_g,E_b`, what
/// arrives, both in W·m⁻²; in the open the latter alone. `area` is there if all places have one.
///
/// # Errors
/// What the sink answers.
pub fn write_probes(
    out: &mut dyn Write,
    places: &Places,
    exitance: &[Rgb],
    irradiance: &[Rgb],
) -> Result<(), Error> {
    let (leaves, arrives) = (("B_r,B_g,B_b", exitance), ("E_r,E_g,E_b", irradiance));
    match places {
        Places::Surface(_) => table(out, places, &[leaves, arrives]),
        Places::Free(_) => table(out, places, &[arrives]),
    }
}

/// Columns for the places, then three for each light.
fn table(out: &mut dyn Write, places: &Places, lights: &[(&str, &[Rgb])]) -> Result<(), Error> {
    let mut names = match places {
        Places::Surface(all) if has_areas(all) => "triangle,u,v,area".to_owned(),
        Places::Surface(_) => "triangle,u,v".to_owned(),
        Places::Free(_) => "x,y,z,nx,ny,nz".to_owned(),
    };
    for (channels, _) in lights {
        names = names + "," + channels;
    }
    let mut buffer = FloatBuffer::new();
    let mut row = |out: &mut dyn Write, first: Option<u32>, own: &[f64], index: usize| {
        let light = lights.iter().filter_map(|(_, light)| light.get(index)).flat_map(|l| &l.0);
        let mut comma = "";
        if let Some(triangle) = first {
            write!(out, "{triangle}")?;
            comma = ",";
        }
        for value in own.iter().chain(light) {
            write!(out, "{comma}{}", write_f64(*value, &mut buffer))?;
            comma = ",";
        }
        writeln!(out)
    };
    let mut text = || {
        writeln!(out, "{names}")?;
        match places {
            Places::Surface(all) => {
                let with_area = has_areas(all);
                for (i, place) in all.iter().enumerate() {
                    let area = place.area.filter(|_| with_area);
                    let own: Vec<f64> = place.uv.into_iter().chain(area).collect();
                    row(out, Some(place.triangle), &own, i)?;
                }
            }
            Places::Free(all) => {
                for (i, place) in all.iter().enumerate() {
                    row(out, None, &[place.position, place.normal].concat(), i)?;
                }
            }
        }
        Ok(())
    };
    text().map_err(|e: io::Error| Error::write(e))
}

fn has_areas(places: &[Place]) -> bool {
    places.iter().all(|p| p.area.is_some())
}
