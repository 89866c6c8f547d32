//! Wavefront OBJ with its material libraries.
//!
//! A [`survey`] goes over the text first, and tobj reads the numbers after it. The survey is
//! there for what tobj does not tell or take: the line of each face and of each mistake,
//! the names of materials that are missing, lines joined by a backslash, and `l` elements,
//! which tobj takes for polygons. It hands tobj vertices and faces alone, so that tobj makes
//! one mesh of them and the faces keep the order of the file.

mod material;
mod mtl;
mod survey;
mod tokens;

use glam::DVec3;
use scene::TriangleId;

use crate::assembler::Assembler;
use crate::beside::Beside;
use crate::open::Source;
use crate::shortened::shortened;
use crate::{DiagnosticKind, Error, ErrorKind, Format, Imported, Options};
use material::Materials;
use survey::Survey;

/// Reads an OBJ scene. A polygon becomes the fan (v0 v1 v2), (v0 v2 v3) …
pub(crate) fn read(source: &Source<'_>, options: &Options) -> Result<Imported, Error> {
    let text = String::from_utf8_lossy(source.bytes);
    let survey = survey::survey(source.name, &text)?;
    let mesh = mesh(source.name, &survey)?;
    let mut assembler = Assembler::new(source.name, options.sides, source.bytes.len());
    for (line, kind) in &survey.warnings {
        assembler.warn(kind.clone(), None, format!("{}:{line}", source.name));
    }
    let beside = Beside::new(source.folder, options.allow_outside);
    let mut materials = Materials::load(source, beside, &survey, &mut assembler)?;
    let groups: Vec<_> =
        survey.groups.iter().map(|name| assembler.group(name)).collect::<Result<_, _>>()?;
    // The face of each triangle, to tell its place.
    let mut origins: Vec<u32> = Vec::with_capacity(mesh.indices.len());
    let mut start = 0;
    for (number, face) in survey.faces.iter().enumerate() {
        // tobj leaves the list out where all faces are triangles.
        let arity = mesh.face_arities.get(number).map_or(3, |&n| n as usize);
        for second in start + 1..start + arity - 1 {
            let fan = [start, second, second + 1];
            let corners = fan.map(|i| {
                let at = 3 * mesh.indices[i] as usize;
                DVec3::from_slice(&mesh.positions[at..at + 3])
            });
            let uv = face.has_uv.then(|| {
                fan.map(|i| {
                    let at = 2 * mesh.texcoord_indices[i] as usize;
                    [mesh.texcoords[at], mesh.texcoords[at + 1]]
                })
            });
            let material = materials.of(face, uv, &mut assembler)?;
            assembler.triangle(corners, material, groups[face.group as usize])?;
            origins.push(number as u32);
        }
        start += arity;
    }
    Ok(assembler.finish(Format::Obj, |id| place(source.name, &survey, &origins, id)))
}

fn place(file: &str, survey: &Survey, origins: &[u32], id: TriangleId) -> String {
    let face = &survey.faces[origins[id.index()] as usize];
    let group = shortened(&survey.groups[face.group as usize]);
    format!("{file}:{}: group {group}, face {}", face.line, face.number_in_group)
}

/// Has tobj read what the survey prepared.
fn mesh(file: &str, survey: &Survey) -> Result<tobj::Mesh, Error> {
    let options = tobj::LoadOptions {
        single_index: false,
        triangulate: false,
        ignore_points: true,
        ignore_lines: true,
    };
    let unread = |message: String| Error::new(ErrorKind::Syntax, file, message);
    let no_library = |_: &std::path::Path| Err(tobj::LoadError::OpenFileFailed);
    let (models, _) = tobj::load_obj_buf(&mut survey.text.as_bytes(), &options, no_library)
        .map_err(|cause| unread(format!("expected an OBJ file: {cause}")).because(cause))?;
    let mesh = models.into_iter().next().map(|model| model.mesh).unwrap_or_default();
    let corners: usize = survey.faces.iter().map(|face| face.corners as usize).sum();
    if mesh.indices.len() != corners {
        return Err(unread(format!(
            "expected {corners} face corners, read {}",
            mesh.indices.len()
        )));
    }
    Ok(mesh)
}

/// A warning kept until the scene is being assembled.
type Warning = (u32, DiagnosticKind);
