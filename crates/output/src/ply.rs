//! Binary PLY: exitance per vertex for programs, colours for eyes.

use std::io::{self, Write};

use scene::{Rgb, Scene, Solution};

use crate::weld::{Welded, bounds, corners, far_from_origin};
use crate::{Error, Exposure};

/// Writes the elements as faces over welded vertices.
pub(crate) fn write(
    out: &mut dyn Write,
    scene: &Scene,
    solution: &Solution,
    exposure: Exposure,
) -> Result<(), Error> {
    let mut mesh = Welded::default();
    for element in &solution.elements {
        mesh.push(corners(solution, element, [0.0; 3]))?;
    }
    let scale = exposure.scale_for(scene, solution);
    let wide = bounds(solution).is_some_and(far_from_origin);
    let mut all = || {
        header(out, &mesh, wide, scale)?;
        vertices(out, &mesh, wide, scale)?;
        for (face, element) in mesh.faces.iter().zip(&solution.elements) {
            out.write_all(&[3])?;
            for index in face.iter().chain([&element.triangle.0]) {
                out.write_all(&index.to_le_bytes())?;
            }
        }
        Ok(())
    };
    all().map_err(|e: io::Error| Error::write(e))
}

fn header(out: &mut dyn Write, mesh: &Welded, wide: bool, scale: f64) -> io::Result<()> {
    let real = if wide { "double" } else { "float" };
    write!(
        out,
        "ply\n\
         format binary_little_endian 1.0\n\
         comment exitance is linear, per channel; triangle is the input triangle from 0\n\
         comment red green blue show exitance times {scale:e}, tone-mapped, as sRGB\n\
         element vertex {}\n\
         property {real} x\nproperty {real} y\nproperty {real} z\n\
         property float exitance_r\nproperty float exitance_g\nproperty float exitance_b\n\
         property uchar red\nproperty uchar green\nproperty uchar blue\n\
         element face {}\n\
         property list uchar uint vertex_indices\n\
         property uint triangle\n\
         end_header\n",
        mesh.vertices.len(),
        mesh.faces.len()
    )
}

fn vertices(out: &mut dyn Write, mesh: &Welded, wide: bool, scale: f64) -> io::Result<()> {
    for vertex in &mesh.vertices {
        for c in vertex.position.to_array() {
            if wide {
                out.write_all(&c.to_le_bytes())?;
            } else {
                out.write_all(&(c as f32).to_le_bytes())?;
            }
        }
        for c in vertex.light {
            out.write_all(&c.to_le_bytes())?;
        }
        out.write_all(&crate::tone::screen(Rgb(vertex.light.map(f64::from)), scale))?;
    }
    Ok(())
}
