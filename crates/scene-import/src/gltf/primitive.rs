//! From a primitive to triangles of the scene.

use glam::{DMat3, DMat4, DVec3};
use gltf::mesh::{Mode, Semantic};
use scene::GroupId;

use super::accessor;
use super::budget::Budget;
use super::document::Parsed;
use super::surface::Surfaces;
use crate::assembler::Assembler;
use crate::{DiagnosticKind, Error};

/// Where a primitive stands.
pub(super) struct Place<'a> {
    /// The way to it in the file.
    pub(super) path: &'a str,
    /// The mesh it is part of.
    pub(super) mesh: usize,
    pub(super) world: DMat4,
    pub(super) group: GroupId,
}

/// What a primitive became.
pub(super) struct Added {
    /// The vertices of each triangle, in the order of the file.
    pub(super) corners: Vec<[usize; 3]>,
    /// Whether the node mirrors, so that the second and the third change places.
    pub(super) mirrored: bool,
}

/// Adds the triangles of a primitive.
pub(super) fn add(
    primitive: &gltf::Primitive<'_>,
    place: &Place<'_>,
    parsed: &Parsed,
    surfaces: &mut Surfaces<'_>,
    budget: &mut Budget<'_>,
    assembler: &mut Assembler<'_>,
) -> Result<Added, Error> {
    let none = || Added { corners: Vec::new(), mirrored: false };
    let mut ignore =
        |what: String| assembler.warn(DiagnosticKind::Ignored { what }, None, place.path);
    let Some(mode) = Assembly::of(primitive.mode()) else {
        ignore(format!("primitive of {:?}", primitive.mode()));
        return budget.triangles(0, place.path).map(|()| none());
    };
    if primitive.morph_targets().len() > 0 {
        ignore("morph targets: the mesh stands as modelled".to_owned());
    }
    let Some(positions) = primitive.get(&Semantic::Positions) else {
        return budget.triangles(0, place.path).map(|()| none());
    };
    let positions: Vec<[f64; 3]> = accessor::read(&positions, parsed, budget)?;
    let order = match primitive.indices() {
        Some(indices) => Some(accessor::read_indices(&indices, parsed, budget)?),
        None => None,
    };
    let length = order.as_ref().map_or(positions.len(), Vec::len);
    let (count, left_over) = mode.triangles(length);
    if left_over > 0 {
        ignore(format!("{left_over} vertices that make no triangle"));
    }
    budget.triangles(count, place.path)?;
    let vertex = |i: usize| order.as_ref().map_or(i, |order| order[i] as usize);
    let mut triangles = Vec::with_capacity(count);
    for number in 0..count {
        let corners = mode.corners(number).map(vertex);
        if let Some(wrong) = corners.into_iter().find(|&i| i >= positions.len()) {
            let (path, vertices) = (place.path, positions.len());
            let message =
                format!("{path}.indices: expected indices below {vertices}, found {wrong}");
            return Err(budget.invalid(&message));
        }
        triangles.push(corners);
    }
    let materials =
        surfaces.materials(primitive, place.mesh, place.path, &triangles, budget, assembler)?;
    // A mirroring transform turns counter-clockwise into clockwise.
    let mirrored = DMat3::from_mat4(place.world).determinant() < 0.0;
    for (&[a, b, c], material) in triangles.iter().zip(materials) {
        let corners = if mirrored { [a, c, b] } else { [a, b, c] };
        let corners = corners.map(|i| place.world.transform_point3(DVec3::from(positions[i])));
        assembler.triangle(corners, material, place.group)?;
    }
    Ok(Added { corners: triangles, mirrored })
}

/// How a list of vertices makes triangles.
#[derive(Clone, Copy)]
enum Assembly {
    List,
    Strip,
    Fan,
}

impl Assembly {
    /// `None` for points and lines.
    fn of(mode: Mode) -> Option<Self> {
        match mode {
            Mode::Triangles => Some(Self::List),
            Mode::TriangleStrip => Some(Self::Strip),
            Mode::TriangleFan => Some(Self::Fan),
            _ => None,
        }
    }

    /// How many triangles so many vertices make, and how many vertices are left over.
    fn triangles(self, vertices: usize) -> (usize, usize) {
        match self {
            Self::List => (vertices / 3, vertices % 3),
            Self::Strip | Self::Fan if vertices < 3 => (0, vertices),
            Self::Strip | Self::Fan => (vertices - 2, 0),
        }
    }

    /// The vertices of triangle `i`.
    ///
    /// # References
    /// glTF 2.0, section 3.7.2.1: topology types.
    fn corners(self, i: usize) -> [usize; 3] {
        match self {
            Self::List => [3 * i, 3 * i + 1, 3 * i + 2],
            // Every other triangle of a strip runs the other way round.
            Self::Strip => [i, i + 1 + i % 2, i + 2 - i % 2],
            Self::Fan => [i + 1, i + 2, 0],
        }
    }
}
