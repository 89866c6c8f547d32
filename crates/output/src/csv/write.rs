//! A solution as rows, and rows as text.

use std::io::Write;

use scene::{Scene, Solution, TriangleId};
use tri_io::{FloatBuffer, write_f64};

use super::Row;
use crate::Error;
use crate::check::{Width, check};

/// The rows of a solution, one per input triangle in file order, emitters marked.
///
/// # Errors
/// A solution that does not belong to the scene, or exitance that is not finite.
pub fn rows(scene: &Scene, solution: &Solution) -> Result<Vec<Row>, Error> {
    check(scene, solution, Width::Double)?;
    let exitance = solution.triangle_exitance(scene);
    let row = |(id, exitance): (TriangleId, _)| Row {
        triangle: id.0,
        uv: None,
        area: scene.area(id),
        exitance,
        se: None,
        emits: scene.material_of(id).emits(),
        ambiguous: false,
    };
    Ok(scene.ids().zip(exitance).map(row).collect())
}

/// Writes `triangle,area,B_r,B_g,B_b`, one row per input triangle in file order; every
/// number reads back to the same bits.
///
/// # Errors
/// As [`rows`], and what the sink answers.
pub fn write(out: &mut dyn Write, scene: &Scene, solution: &Solution) -> Result<(), Error> {
    let rows = rows(scene, solution)?;
    let mut buffer = FloatBuffer::new();
    let mut text = || {
        writeln!(out, "triangle,area,B_r,B_g,B_b")?;
        for row in &rows {
            write!(out, "{}", row.triangle)?;
            for value in [row.area].iter().chain(&row.exitance.0) {
                write!(out, ",{}", write_f64(*value, &mut buffer))?;
            }
            writeln!(out)?;
        }
        Ok(())
    };
    text().map_err(|e: std::io::Error| Error::write(e))
}
