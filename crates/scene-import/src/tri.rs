//! .tri: triangles with an integer front and back colour.

use std::path::Path;

use glam::DVec3;
use scene::{Material, Rgb, Sides};
use tri_io::{Reader, TriRecord};

use crate::assembler::Assembler;
use crate::open::Source;
use crate::{DiagnosticKind, Error, ErrorKind, Format, Imported, Options, units};

/// Reads a .tri scene: one group, named after the file.
pub(crate) fn read(source: &Source<'_>, options: &Options) -> Result<Imported, Error> {
    let mut assembler = Assembler::new(source.name, options.sides, source.bytes.len());
    let stem = Path::new(source.name).file_stem().unwrap_or_default().to_string_lossy();
    let group = assembler.group(&stem)?;
    let mut lines = Vec::new();
    let mut reader = Reader::new(source.bytes);
    while let Some(record) = reader.next() {
        let record = record.map_err(|cause| syntax(source.name, cause))?;
        let line = reader.line();
        let place = format_args!("{}:{line}", source.name);
        let material = assembler.material(material(&record, options), place)?;
        let corners = record.vertices.map(DVec3::from);
        let triangle = assembler.triangle(corners, material, group)?;
        lines.push(line);
        if record.normals.is_some_and(|normals| points_to_back(corners, normals)) {
            let place = format!("{}:{line}", source.name);
            assembler.warn(DiagnosticKind::NormalDisagrees, Some(triangle), place);
        }
    }
    Ok(assembler.finish(Format::Tri, |id| format!("{}:{}", source.name, lines[id.index()])))
}

fn material(record: &TriRecord, options: &Options) -> Material {
    let [r, g, b] = record.front;
    let emittance = units::tri_emittance(record.back, options.tri_light);
    let name = match emittance {
        None => format!("{r} {g} {b}"),
        Some(_) => {
            let [er, eg, eb] = record.back;
            format!("{r} {g} {b} emitting {er} {eg} {eb}")
        }
    };
    Material {
        name,
        reflectance: units::tri_reflectance(record.front, options.tri_reflect),
        emittance: emittance.unwrap_or(Rgb::ZERO),
        sides: Sides::Front,
    }
}

/// Whether the stated normals, taken together, contradict the winding.
fn points_to_back([a, b, c]: [DVec3; 3], normals: [[f64; 3]; 3]) -> bool {
    let stated: DVec3 = normals.into_iter().map(DVec3::from).sum();
    (b - a).cross(c - a).dot(stated) < 0.0
}

fn syntax(file: &str, cause: tri_io::Error) -> Error {
    let (line, column) = (cause.line(), cause.column());
    let message = cause.to_string();
    // The place goes into its own fields and need not be said twice.
    let message =
        message.strip_prefix(&format!("{line}:{column}: ")).unwrap_or(&message).to_owned();
    Error::new(ErrorKind::Syntax, file, message).at(line, column).because(cause)
}
