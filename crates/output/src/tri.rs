//! The report's records, one per element: colours a screen can show, and normals.

use std::io::Write;

use scene::{Scene, Solution};
use tri_io::{TriRecord, Writer};

use crate::Error;
use crate::weld::normal;

/// Full white in the units of a .tri solution.
const WHITE: f64 = 255.0;

/// Writes each element with its exitance, clamped to 0–255 and rounded, in front, and
/// black behind.
pub(crate) fn write(out: &mut dyn Write, scene: &Scene, solution: &Solution) -> Result<(), Error> {
    let mut writer = Writer::new(out);
    for element in &solution.elements {
        let normal = normal(scene, element.triangle, element.face).to_array();
        let record = TriRecord {
            front: element.exitance.0.map(|c| c.clamp(0.0, WHITE).round() as u8),
            back: [0; 3],
            vertices: solution.corners(element).map(|p| p.to_array()),
            normals: Some([normal; 3]),
        };
        writer.write(&record).map_err(Error::write)?;
    }
    writer.finish().map(drop).map_err(Error::write)
}
