//! What a solver made of a scene: exitance per element, per corner and per input triangle.

use glam::DVec3;

use crate::{Rgb, Scene, TriangleId, VertexId};

/// The side of an input triangle that an element lies on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Face {
    /// Vertices run counter-clockwise.
    #[default]
    Front,
    /// The other side of a two-sided surface; the element's vertices are already reversed,
    /// so that they run counter-clockwise seen from this side.
    Back,
}

/// A leaf of the subdivision, with the light that leaves it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolutionElement {
    /// Corners, in [`Solution::vertices`], counter-clockwise seen from the lit side.
    pub vertices: [VertexId; 3],
    /// The input triangle it is part of.
    pub triangle: TriangleId,
    /// The side of that triangle.
    pub face: Face,
    /// Area mean of the exitance, emittance included, W·m⁻² per channel.
    pub exitance: Rgb,
    /// Exitance at the three corners, for interpolation.
    pub corner_exitance: [Rgb; 3],
}

/// The solved scene: linear, unclamped exitance.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Solution {
    /// Vertices of the refined mesh, in the scene's units.
    pub vertices: Vec<DVec3>,
    /// The elements, ordered by input triangle, front before back.
    pub elements: Vec<SolutionElement>,
}

impl Solution {
    /// The corner positions of an element.
    #[must_use]
    pub fn corners(&self, element: &SolutionElement) -> [DVec3; 3] {
        element.vertices.map(|v| self.vertices[v.index()])
    }

    /// The area of an element.
    #[must_use]
    pub fn area(&self, element: &SolutionElement) -> f64 {
        let [a, b, c] = self.corners(element);
        0.5 * (b - a).cross(c - a).length()
    }

    /// The area mean of the front's exitance, one value per input triangle in file order.
    /// A triangle without area has no elements, and shows its emittance.
    #[must_use]
    pub fn triangle_exitance(&self, scene: &Scene) -> Vec<Rgb> {
        let mut sums = vec![(Rgb::ZERO, 0.0); scene.triangles().len()];
        for element in self.elements.iter().filter(|e| e.face == Face::Front) {
            let area = self.area(element);
            let (power, total) = &mut sums[element.triangle.index()];
            *power += element.exitance * area;
            *total += area;
        }
        scene
            .ids()
            .zip(sums)
            .map(
                |(id, (power, area))| {
                    if area > 0.0 { power / area } else { scene.material_of(id).emittance }
                },
            )
            .collect()
    }
}
