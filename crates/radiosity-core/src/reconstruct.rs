//! Irradiance to exitance: the solution that outputs read.

use scene::{Rgb, Solution, SolutionElement};

use crate::mesh::Mesh;

/// Exitance = emittance + reflectance · irradiance, for each element's mean and its corners.
pub(crate) fn solution(mesh: &Mesh, irradiance: &[Rgb], at_points: &[Rgb]) -> Solution {
    let elements = mesh
        .elements
        .iter()
        .zip(irradiance)
        .map(|(element, &mean)| {
            let root = mesh.root_of(element);
            let exitance = |h: Rgb| root.emittance + root.reflectance * h;
            SolutionElement {
                vertices: element.vertices,
                triangle: root.triangle,
                face: root.face,
                exitance: exitance(mean),
                corner_exitance: element.points.map(|p| exitance(at_points[p as usize])),
            }
        })
        .collect();
    Solution { vertices: mesh.vertices.clone(), elements }
}
