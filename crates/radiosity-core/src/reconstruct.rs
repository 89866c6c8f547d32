//! Irradiance to exitance: the solution that outputs read.

use scene::{Rgb, Solution, SolutionElement};

use crate::census::Census;
use crate::checkpoint::record;
use crate::mesh::Mesh;

/// What a solution is made of, beside its mesh: 24 bytes an element and 24 a point.
#[derive(Clone, Debug, Default)]
pub(crate) struct Light {
    /// Mean irradiance of each element.
    pub(crate) irradiance: Vec<Rgb>,
    /// Irradiance to show at each of the mesh's points.
    pub(crate) shown: Vec<Rgb>,
}

record!(Light { irradiance, shown });

impl Light {
    /// Whether it can be the light of this mesh.
    pub(crate) fn fits(&self, mesh: &Mesh) -> bool {
        self.irradiance.len() == mesh.elements.len() && self.shown.len() == mesh.points.len()
    }
}

/// Exitance = emittance + reflectance · irradiance, for each element's mean and its corners.
pub(crate) fn solution(
    mesh: &Mesh,
    irradiance: impl IntoIterator<Item = Rgb>,
    shown: &[Rgb],
) -> Solution {
    let elements = mesh
        .elements
        .iter()
        .zip(irradiance)
        .map(|(element, mean)| {
            let root = mesh.root_of(element);
            let exitance = |h: Rgb| root.emittance + root.reflectance * h;
            SolutionElement {
                vertices: element.vertices,
                triangle: root.triangle,
                face: root.face,
                exitance: exitance(mean),
                corner_exitance: element.points.map(|p| exitance(shown[p as usize])),
            }
        })
        .collect();
    Solution { vertices: mesh.vertices.clone(), elements }
}

/// The irradiance to show at each of the mesh's points: its own, or, for a buried point with
/// neighbours in the open, their mean instead of the dark that nobody sees, so that no shadow creeps
/// out from under what stands there. Means of elements keep the light that arrived.
pub(crate) fn shown(mesh: &Mesh, census: &Census, at_points: &[Rgb]) -> Vec<Rgb> {
    let mut sums = vec![(Rgb::ZERO, 0u32); at_points.len()];
    for element in &mesh.elements {
        for p in element.points.iter().filter(|p| census.buried(**p)) {
            for open in element.points.iter().filter(|q| !census.buried(**q)) {
                let (sum, n) = &mut sums[*p as usize];
                *sum += at_points[*open as usize];
                *n += 1;
            }
        }
    }
    let mean = |(&own, (sum, n)): (&Rgb, (Rgb, u32))| if n > 0 { sum / f64::from(n) } else { own };
    at_points.iter().zip(sums).map(mean).collect()
}
