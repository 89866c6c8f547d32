//! Corners that agree become one vertex, in the order they are first met.

use std::collections::HashMap;

use glam::DVec3;
use scene::{Face, Scene, Solution, SolutionElement, TriangleId};

use crate::{Error, ErrorKind};

/// A scene farther from the origin than this many of its own diagonals loses shape when
/// its coordinates are narrowed to f32: their spacing there is 2⁻²² of a diagonal, below
/// which a fine element would fold.
const MAX_OFFSET_DIAGONALS: f64 = 4.0;
/// A scene smaller than this falls into the subnormal f32 range, where the spacing no
/// longer shrinks with the numbers.
const MIN_DIAGONAL: f64 = 1e-30;

/// A vertex of the welded mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Corner {
    pub(crate) position: DVec3,
    pub(crate) light: [f32; 3],
    /// Zero where the format has none.
    pub(crate) normal: [f32; 3],
    /// Zero where vertices may be shared between materials.
    pub(crate) material: u32,
}

/// Vertices without repetition, and the corners of the faces.
#[derive(Debug, Default)]
pub(crate) struct Welded {
    pub(crate) vertices: Vec<Corner>,
    pub(crate) faces: Vec<[u32; 3]>,
    known: HashMap<Key, u32>,
}

type Key = ([u64; 3], [u32; 3], [u32; 3], u32);

impl Welded {
    /// Adds a face; exitance differs across a crease, so a position may come several times.
    pub(crate) fn push(&mut self, corners: [Corner; 3]) -> Result<(), Error> {
        let mut face = [0; 3];
        for (slot, corner) in face.iter_mut().zip(corners) {
            let next = u32::try_from(self.vertices.len())
                .map_err(|_| Error::new(ErrorKind::TooLarge("more than 2^32 vertices")))?;
            *slot = *self.known.entry(key(&corner)).or_insert(next);
            if *slot == next {
                self.vertices.push(corner);
            }
        }
        self.faces.push(face);
        Ok(())
    }
}

fn key(corner: &Corner) -> Key {
    // Adding 0 makes the two zeros one.
    let narrow = |v: [f32; 3]| v.map(|c| (c + 0.0).to_bits());
    let position = corner.position.to_array().map(|c| (c + 0.0).to_bits());
    (position, narrow(corner.light), narrow(corner.normal), corner.material)
}

/// The corners of an element, all with one normal.
pub(crate) fn corners(
    solution: &Solution,
    element: &SolutionElement,
    normal: [f32; 3],
) -> [Corner; 3] {
    let positions = solution.corners(element);
    [0, 1, 2].map(|i| Corner {
        position: positions[i],
        light: element.corner_exitance[i].0.map(|c| c as f32),
        normal,
        material: 0,
    })
}

/// The unit normal of the side that an element lies on, or zero without area. Taken from
/// the input triangle, so that all its elements have the same bits.
pub(crate) fn normal(scene: &Scene, triangle: TriangleId, face: Face) -> DVec3 {
    let [a, b, c] = scene.corners(triangle);
    let front = (b - a).cross(c - a).normalize_or_zero();
    match face {
        Face::Front => front,
        Face::Back => -front,
    }
}

/// The smallest and largest coordinates of the solution's elements.
pub(crate) fn bounds(solution: &Solution) -> Option<(DVec3, DVec3)> {
    let mut points = solution.elements.iter().flat_map(|e| solution.corners(e));
    let first = points.next()?;
    Some(points.fold((first, first), |(low, high), p| (low.min(p), high.max(p))))
}

/// Whether f32 coordinates would lose the scene's shape.
pub(crate) fn far_from_origin((low, high): (DVec3, DVec3)) -> bool {
    let largest = low.abs().max(high.abs()).max_element();
    let diagonal = (high - low).length();
    largest > MAX_OFFSET_DIAGONALS * diagonal
        || diagonal < MIN_DIAGONAL && largest > 0.0
        || largest > f64::from(f32::MAX)
}
