//! View3D's .vs3: numbered vertices, and on them surfaces with an emissivity.
//!
//! View3D computes view factors between surfaces (G. N. Walton, "Calculation of Obstructed
//! View Factors by Adaptive Integration", NISTIR 6925, 2002). Its surfaces lie on the side
//! from which their corners run counter-clockwise, and none of them shines by itself.

mod records;
mod subtract;
mod words;

use glam::DVec3;
use scene::{GroupId, Material, Rgb, Sides};

use crate::assembler::Assembler;
use crate::open::Source;
use crate::{DiagnosticKind, Error, ErrorKind, Format, Imported, Options};
use records::{Kind, Records, Surface};

/// The group of all that blocks without radiating.
const OBSTRUCTIONS: &str = "obstructions";

/// How far, in diameters of a surface, a point may lie off its plane or edge and still count
/// as on it: what View3D allows, and more than decimals of six digits are off.
const FLAT: f64 = 1e-5;

/// How many surfaces may be parts of one surface, and how many pieces they may leave of it,
/// before the file counts as hostile: the work is the product of the two.
const MAX_PARTS: usize = 1024;
const MAX_PIECES: usize = 16_384;

/// Reads a View3D scene.
pub(crate) fn read(source: &Source<'_>, options: &Options) -> Result<Imported, Error> {
    let text = String::from_utf8_lossy(source.bytes);
    let Records { surfaces, warnings, .. } = records::parse(source.name, &text)?;
    let mut assembler = Assembler::new(source.name, options.sides, source.bytes.len());
    let place = |line: u64| format!("{}:{line}", source.name);
    for (line, kind) in warnings {
        assembler.warn(kind, None, place(line));
    }
    for surface in &surfaces {
        let broken = |what: &str| DiagnosticKind::BrokenRule { what: what.to_owned() };
        if !is_convex(surface) {
            let what = "the four corners are not those of a flat convex quadrilateral";
            assembler.warn(broken(what), None, place(surface.line));
        } else if surface.base.is_some_and(|base| !is_part_of(surface, &surfaces[base])) {
            let what = "the surface does not lie in the plane of its base: both count in full";
            assembler.warn(broken(what), None, place(surface.line));
        } else if surface.kind == Kind::Radiating
            && surface.base.is_some_and(|base| faces_away(surface, &surfaces[base]))
        {
            let what = "the surface faces away from its base";
            assembler.warn(broken(what), None, place(surface.line));
        } else if surface.kind == Kind::Masking {
            let what =
                "what a masking surface and its base exchange; the place blocks and is black";
            let kind = DiagnosticKind::Ignored { what: what.to_owned() };
            assembler.warn(kind, None, place(surface.line));
        }
    }
    let pieces = pieces(source.name, &surfaces)?;
    let mut groups: Vec<GroupId> = Vec::with_capacity(surfaces.len());
    let mut obstructions = None;
    let mut lines = Vec::new();
    for (surface, pieces) in surfaces.iter().zip(pieces) {
        let group = match (surface.kind, surface.combine) {
            (Kind::Radiating, Some(earlier)) => groups[earlier],
            (Kind::Radiating, None) => assembler.new_group(&surface.name)?,
            _ => match obstructions {
                Some(group) => group,
                None => *obstructions.insert(assembler.new_group(OBSTRUCTIONS)?),
            },
        };
        groups.push(group);
        let material = assembler.material(material(surface), place(surface.line))?;
        for piece in pieces {
            for k in 1..piece.len() - 1 {
                assembler.triangle([piece[0], piece[k], piece[k + 1]], material, group)?;
                lines.push(surface.line);
            }
        }
    }
    Ok(assembler.finish(Format::Vs3, |id| place(lines[id.index()])))
}

fn material(surface: &Surface) -> Material {
    let (name, reflectance) = match surface.kind {
        Kind::Radiating => (format!("emissivity {}", surface.emissivity), 1.0 - surface.emissivity),
        _ => ("black".to_owned(), 0.0),
    };
    Material {
        name,
        reflectance: Rgb::splat(reflectance),
        emittance: Rgb::ZERO,
        sides: Sides::Front,
    }
}

/// What is left of each surface where the surfaces that are parts of it are taken out, as
/// convex polygons.
fn pieces(file: &str, surfaces: &[Surface]) -> Result<Vec<Vec<Vec<DVec3>>>, Error> {
    let mut parts = vec![0; surfaces.len()];
    let mut pieces: Vec<_> = surfaces.iter().map(|s| vec![s.corners.clone()]).collect();
    for index in 0..surfaces.len() {
        let surface = &surfaces[index];
        let Some(base) = surface.base else { continue };
        let (normal, reversed) = (normal(&surfaces[base]), faces_away(surface, &surfaces[base]));
        // A null surface faces its base; here it stands in for a part of it.
        if reversed && surface.kind != Kind::Radiating {
            for piece in &mut pieces[index] {
                piece.reverse();
            }
        }
        if !is_part_of(surface, &surfaces[base]) {
            continue;
        }
        let mut outline = surface.corners.clone();
        if reversed {
            outline.reverse();
        }
        let near = FLAT * diameter(&surfaces[base]);
        pieces[base] = subtract::subtract(&pieces[base], &outline, normal, near);
        parts[base] += 1;
        if parts[base] > MAX_PARTS || pieces[base].len() > MAX_PIECES {
            let message = format!(
                "expected at most {MAX_PARTS} parts of one surface, which leave at most \
                 {MAX_PIECES} pieces of it"
            );
            return Err(Error::new(ErrorKind::TooLarge, file, message).at(surface.line, 1));
        }
    }
    Ok(pieces)
}

/// Whether a surface can be taken out of another: both are flat and convex, and lie in one
/// plane.
fn is_part_of(surface: &Surface, base: &Surface) -> bool {
    let (normal, origin) = (normal(base), base.corners[0]);
    let near = FLAT * diameter(base);
    is_convex(surface)
        && is_convex(base)
        && surface.corners.iter().all(|&p| (p - origin).dot(normal).abs() <= near)
}

/// Whether the corners are those of a flat convex polygon. A surface without area, or so
/// large that products of its coordinates are not finite, is left to other warnings.
fn is_convex(surface: &Surface) -> bool {
    let corners = &surface.corners;
    let (normal, near) = (normal(surface), FLAT * diameter(surface));
    if corners.len() < 4 {
        return true;
    }
    if normal == DVec3::ZERO {
        // The two halves of a bow tie cancel, but each has an area.
        let half = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        return half == DVec3::ZERO || half.is_nan();
    }
    (0..4).all(|k| {
        let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 4]);
        // How far the third corner lies inside the edge of the first two. The normal is square to
        // the diagonals, so that what is not flat shows along the edges.
        let inside = normal.cross(b - a).normalize_or_zero().dot(c - a);
        inside >= -near && (b - a).dot(normal).abs() <= near
    })
}

fn faces_away(surface: &Surface, base: &Surface) -> bool {
    normal(surface).dot(normal(base)) < 0.0
}

/// The unit normal of a surface's front; zero if it has no area.
fn normal(surface: &Surface) -> DVec3 {
    let corners = &surface.corners;
    // The diagonals of a quadrilateral; of a triangle, two of its edges.
    let (first, second) = (corners[2] - corners[0], corners[corners.len() - 1] - corners[1]);
    first.cross(second).normalize_or_zero()
}

fn diameter(surface: &Surface) -> f64 {
    let [first, second] = [surface.corners[0], surface.corners[1]];
    surface.corners.iter().map(|&p| p.distance(first).max(p.distance(second))).fold(0.0, f64::max)
}
