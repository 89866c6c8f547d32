//! The light in the mesh between two shots.

use scene::Rgb;

use crate::mesh::Mesh;

/// Irradiance and unshot exitance: 24 bytes a point, 48 an element, 24 a patch.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// Irradiance received at each receiver point.
    pub(super) at_points: Vec<Rgb>,
    /// Mean irradiance received by each element.
    pub(super) irradiance: Vec<Rgb>,
    /// Mean unshot exitance of each element.
    pub(super) unshot: Vec<Rgb>,
    /// Unshot power of each patch, one side.
    pub(super) patch_power: Vec<Rgb>,
    /// Power that each patch received in the last shot.
    pub(super) patch_received: Vec<Rgb>,
}

impl State {
    /// Nothing received, all emittance unshot.
    pub(super) fn new(mesh: &Mesh) -> Self {
        let unshot: Vec<Rgb> = mesh.elements.iter().map(|e| mesh.root_of(e).emittance).collect();
        let mut state = Self {
            at_points: vec![Rgb::ZERO; mesh.points.len()],
            irradiance: vec![Rgb::ZERO; mesh.elements.len()],
            unshot,
            patch_power: vec![Rgb::ZERO; mesh.patches.len()],
            patch_received: vec![Rgb::ZERO; mesh.patches.len()],
        };
        for p in 0..mesh.patches.len() {
            state.patch_power[p] = state.power_of(mesh, p);
        }
        state
    }

    /// The unshot power of a patch, summed over its elements.
    pub(super) fn power_of(&self, mesh: &Mesh, patch: usize) -> Rgb {
        let elements = mesh.patches[patch].elements.clone();
        elements.map(|e| self.unshot[e as usize] * mesh.elements[e as usize].area).sum()
    }

    /// All unshot power, one side.
    pub(super) fn unshot_power(&self) -> Rgb {
        self.patch_power.iter().copied().sum()
    }
}
