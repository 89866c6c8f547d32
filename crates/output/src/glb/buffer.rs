//! The binary half: five sections of little-endian numbers, and where each primitive's
//! share of them lies.

use std::collections::BTreeMap;

use glam::DVec3;
use scene::{Face, Scene, Solution, SolutionElement};

use crate::tone::curve;
use crate::weld::{Corner, Welded, bounds, corners, far_from_origin, normal};
use crate::{Error, ErrorKind};

/// What the vertices and faces of all primitives hold, by section.
#[derive(Debug, Default)]
pub(crate) struct Geometry {
    /// Subtracted from every position before it was narrowed; zero near the origin.
    pub(crate) centre: DVec3,
    /// In the order of group, then material, front before back.
    pub(crate) primitives: Vec<Primitive>,
    /// In the order of [`SECTIONS`].
    bytes: [Vec<u8>; SECTIONS.len()],
}

/// What a section holds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Section {
    /// The attribute's name; none for indices.
    pub(crate) attribute: Option<&'static str>,
    /// Bytes per entry: a multiple of four, so that every section stays aligned.
    pub(crate) stride: usize,
}

pub(crate) const SECTIONS: [Section; 5] = [
    Section { attribute: Some("POSITION"), stride: 12 },
    Section { attribute: Some("NORMAL"), stride: 12 },
    Section { attribute: Some("COLOR_0"), stride: 8 },
    Section { attribute: Some("_RADIOSITY"), stride: 12 },
    Section { attribute: None, stride: 4 },
];

/// The faces of one group in one material, seen from one side.
#[derive(Debug)]
pub(crate) struct Primitive {
    pub(crate) group: u32,
    pub(crate) material: u32,
    pub(crate) face: Face,
    /// First vertex, and how many.
    pub(crate) vertices: (usize, usize),
    /// First index, and how many.
    pub(crate) indices: (usize, usize),
    pub(crate) low: [f32; 3],
    pub(crate) high: [f32; 3],
}

impl Geometry {
    /// The sections as they follow each other in the file.
    pub(crate) fn sections(&self) -> [&[u8]; SECTIONS.len()] {
        self.bytes.each_ref().map(Vec::as_slice)
    }

    fn push(&mut self, (group, material, face): Share, mesh: &Welded, scale: f64) {
        let [positions, normals, colours, light, indices] = &mut self.bytes;
        let first_vertex = positions.len() / SECTIONS[0].stride;
        let first_index = indices.len() / SECTIONS[4].stride;
        let mut low = [f32::INFINITY; 3];
        let mut high = [f32::NEG_INFINITY; 3];
        for vertex in &mesh.vertices {
            let position = (vertex.position - self.centre).to_array().map(|c| c as f32);
            for axis in 0..3 {
                low[axis] = low[axis].min(position[axis]);
                high[axis] = high[axis].max(position[axis]);
            }
            positions.extend(position.iter().flat_map(|c| c.to_le_bytes()));
            normals.extend(vertex.normal.iter().flat_map(|c| c.to_le_bytes()));
            colours.extend(colour(vertex, scale).iter().flat_map(|c| c.to_le_bytes()));
            light.extend(vertex.light.iter().flat_map(|c| c.to_le_bytes()));
        }
        indices.extend(mesh.faces.iter().flatten().flat_map(|i| i.to_le_bytes()));
        self.primitives.push(Primitive {
            group,
            material,
            face,
            vertices: (first_vertex, mesh.vertices.len()),
            indices: (first_index, 3 * mesh.faces.len()),
            low,
            high,
        });
    }
}

/// The group, material and side that make a primitive.
type Share = (u32, u32, Face);

/// Sorts the elements by group, material and side, and welds each share on its own.
pub(crate) fn build(scene: &Scene, solution: &Solution, scale: f64) -> Result<Geometry, Error> {
    let mut geometry = Geometry { centre: centre(solution)?, ..Geometry::default() };
    let mut shares: BTreeMap<_, (Share, Vec<&SolutionElement>)> = BTreeMap::new();
    for element in &solution.elements {
        let triangle = &scene.triangles()[element.triangle.index()];
        let share = (triangle.group.0, triangle.material.0, element.face);
        let order = (share.0, share.1, share.2 == Face::Back);
        shares.entry(order).or_insert((share, Vec::new())).1.push(element);
    }
    for (share, elements) in shares.into_values() {
        let mut mesh = Welded::default();
        for element in elements {
            let normal = normal(scene, element.triangle, element.face);
            // Without area there is no normal, which the format demands, and nothing to see.
            if normal != DVec3::ZERO {
                mesh.push(corners(solution, element, normal.to_array().map(|c| c as f32)))?;
            }
        }
        if !mesh.faces.is_empty() {
            geometry.push(share, &mesh, scale);
        }
    }
    Ok(geometry)
}

/// The middle of a scene too far from the origin for f32, else the origin.
fn centre(solution: &Solution) -> Result<DVec3, Error> {
    let Some((low, high)) = bounds(solution).filter(|b| far_from_origin(*b)) else {
        return Ok(DVec3::ZERO);
    };
    if (high - low).max_element() > f64::from(f32::MAX) {
        return Err(Error::new(ErrorKind::TooLarge("a scene wider than f32 can hold")));
    }
    let centre = 0.5 * low + 0.5 * high;
    // Readers narrow it, too.
    if centre.abs().max_element() > f64::from(f32::MAX) {
        return Err(Error::new(ErrorKind::TooLarge("a scene farther out than f32 can hold")));
    }
    Ok(centre)
}

/// Tone-mapped display light; `COLOR_0` is linear, so no sRGB transfer. Eight bits would
/// show steps in the dark.
fn colour(vertex: &Corner, scale: f64) -> [u16; 4] {
    let full = f64::from(u16::MAX);
    let [r, g, b] = vertex.light.map(|c| (full * curve(f64::from(c) * scale)).round() as u16);
    [r, g, b, u16::MAX]
}
