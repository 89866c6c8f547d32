//! The faces of one primitive, seen from one side, with the light in their vertices.

use std::collections::HashMap;

use scene::{Face, Scene, Shape, Solution, SolutionElement, TriangleId};

use super::accessor::FLOAT;
use super::attribute::{Attribute, Name};
use super::material::Look;
use super::place;
use crate::tone::curve;
use crate::{Error, ErrorKind};

/// The solution as a document shows it.
pub(super) struct Light<'a> {
    pub(super) scene: &'a Scene,
    pub(super) solution: &'a Solution,
    /// From exitance to display light.
    pub(super) scale: f64,
}

/// What becomes of a primitive on one side of its triangles.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Faces {
    pub(super) face: Face,
    /// The attributes of the vertices; the light alone where the triangles stay whole.
    pub(super) columns: Vec<Column>,
    /// How many vertices there are.
    pub(super) vertices: usize,
    /// Three to a face; none for the indices that are there.
    pub(super) indices: Option<Vec<u32>>,
    /// Whether the attributes replace those that are there, or join them.
    pub(super) replaces: bool,
}

/// One attribute of all vertices.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Column {
    pub(super) name: Name,
    /// The number that glTF has for the component's type, whether it is normalised, the shape.
    pub(super) spelling: (u32, bool, &'static str),
    pub(super) stride: usize,
    pub(super) bytes: Vec<u8>,
}

impl Column {
    /// The two that carry the light: display colours, and exitance.
    pub(super) fn light() -> [Self; 2] {
        const UNSIGNED_SHORT: u32 = 5123;
        let column = |name: &str, spelling, stride| Self {
            name: Name::Own(name.to_owned()),
            spelling,
            stride,
            bytes: Vec::new(),
        };
        [
            column("COLOR_0", (UNSIGNED_SHORT, true, "VEC4"), 8),
            column("_RADIOSITY", (FLOAT, false, "VEC3"), 12),
        ]
    }
}

impl Light<'_> {
    /// The elements of a shape, on both sides.
    pub(super) fn elements(&self, shape: &Shape) -> &[SolutionElement] {
        let all = &self.solution.elements;
        let first = shape.first.index();
        let start = all.partition_point(|e| e.triangle.index() < first);
        let rest = &all[start..];
        &rest[..rest.partition_point(|e| e.triangle.index() < first + shape.corners.len())]
    }

    /// The bytes of `COLOR_0` and `_RADIOSITY` for exitance on a triangle.
    pub(super) fn bytes(
        &self,
        triangle: TriangleId,
        exitance: [f64; 3],
        look: &Look,
    ) -> ([u8; 8], [u8; 12]) {
        let reflectance = self.scene.material_of(triangle).reflectance.0;
        let narrow = exitance.map(|c| c as f32);
        let mut colour = [0; 8];
        colour[6..].copy_from_slice(&u16::MAX.to_le_bytes());
        let mut light = [0; 12];
        for channel in 0..3 {
            let shown = curve(f64::from(narrow[channel]) * self.scale);
            let shown = look.tint(shown, reflectance[channel]);
            let shown = (shown * f64::from(u16::MAX)).round() as u16;
            colour[2 * channel..][..2].copy_from_slice(&shown.to_le_bytes());
            light[4 * channel..][..4].copy_from_slice(&(narrow[channel] + 0.0).to_le_bytes());
        }
        (colour, light)
    }

    /// The elements of a shape on one side as faces; none where there are none.
    pub(super) fn faces(
        &self,
        shape: &Shape,
        face: Face,
        attributes: &[Attribute],
        look: &Look,
    ) -> Result<Option<Faces>, Error> {
        let mut weld = Weld::new(attributes);
        let mut indices = Vec::new();
        for element in self.elements(shape).iter().filter(|e| e.face == face) {
            if self.scene.area(element.triangle) == 0.0 {
                continue;
            }
            let corners = ordered(shape, element.triangle);
            let triangle = self.scene.corners(element.triangle);
            let mut made = [0; 3];
            for (i, point) in self.solution.corners(element).into_iter().enumerate() {
                let shares = place::shares(triangle, point);
                let exitance = element.corner_exitance[i].0;
                let light = self.bytes(element.triangle, exitance, look);
                made[i] = weld.vertex(corners, shares, face, light)?;
            }
            // The document winds the triangles of a node that mirrors the other way round.
            let [a, b, c] = made;
            indices.extend(if shape.mirrored { [a, c, b] } else { [a, b, c] });
        }
        Ok((!indices.is_empty()).then(|| weld.finish(face, indices)))
    }
}

/// The document's vertices of a triangle, in the scene's order.
pub(super) fn ordered(shape: &Shape, triangle: TriangleId) -> [u32; 3] {
    let [a, b, c] = shape.corners[triangle.index() - shape.first.index()];
    if shape.mirrored { [a, c, b] } else { [a, b, c] }
}

/// Vertices without repetition, in the order they are first met.
struct Weld<'a> {
    attributes: &'a [Attribute],
    columns: Vec<Column>,
    /// A vertex by all its bytes; looked up and never walked.
    known: HashMap<Vec<u8>, u32>,
    record: Vec<u8>,
}

impl<'a> Weld<'a> {
    fn new(attributes: &'a [Attribute]) -> Self {
        let column = |attribute: &Attribute| Column {
            name: attribute.name.clone(),
            spelling: attribute.spelling(),
            stride: attribute.stride(),
            bytes: Vec::new(),
        };
        let columns = attributes.iter().map(column).chain(Column::light()).collect();
        Self { attributes, columns, known: HashMap::new(), record: Vec::new() }
    }

    fn vertex(
        &mut self,
        corners: [u32; 3],
        shares: [f64; 3],
        face: Face,
        (colour, light): ([u8; 8], [u8; 12]),
    ) -> Result<u32, Error> {
        self.record.clear();
        for attribute in self.attributes {
            attribute.write(&mut self.record, corners, shares, face == Face::Back);
        }
        self.record.extend(colour);
        self.record.extend(light);
        if let Some(&known) = self.known.get(&self.record) {
            return Ok(known);
        }
        let next = u32::try_from(self.known.len())
            .map_err(|_| Error::new(ErrorKind::TooLarge("more than 2^32 vertices")))?;
        let mut rest = self.record.as_slice();
        for column in &mut self.columns {
            let (mine, others) = rest.split_at(column.stride);
            column.bytes.extend_from_slice(mine);
            rest = others;
        }
        self.known.insert(self.record.clone(), next);
        Ok(next)
    }

    fn finish(self, face: Face, indices: Vec<u32>) -> Faces {
        let vertices = self.known.len();
        Faces { face, columns: self.columns, vertices, indices: Some(indices), replaces: true }
    }
}
