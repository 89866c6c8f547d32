//! The light in the mesh between two shots.

use scene::Rgb;

use crate::mesh::Mesh;

/// Irradiance and unshot exitance: 24 bytes a point, 48 an element, 72 a patch.
#[derive(Clone, Debug, Default)]
pub(super) struct State {
    /// Irradiance received at each receiver point, and at each probe after them.
    pub(super) at_points: Vec<Rgb>,
    /// Mean irradiance received by each element.
    pub(super) irradiance: Vec<Rgb>,
    /// Mean unshot exitance of each element.
    pub(super) unshot: Vec<Rgb>,
    /// Unshot power of each patch, one side: ΣA|u|, since a correction can leave u below 0.
    pub(super) patch_power: Vec<Rgb>,
    /// The same with its sign: ΣAu.
    pub(super) patch_net: Vec<Rgb>,
    /// Power that each patch received in the last shot.
    pub(super) patch_received: Vec<Rgb>,
}

impl State {
    /// Nothing received, all emittance unshot.
    pub(super) fn new(mesh: &Mesh, receivers: usize) -> Self {
        let unshot: Vec<Rgb> = mesh.elements.iter().map(|e| mesh.root_of(e).emittance).collect();
        let mut state = Self {
            at_points: vec![Rgb::ZERO; receivers],
            irradiance: vec![Rgb::ZERO; mesh.elements.len()],
            unshot,
            patch_power: vec![Rgb::ZERO; mesh.patches.len()],
            patch_net: vec![Rgb::ZERO; mesh.patches.len()],
            patch_received: vec![Rgb::ZERO; mesh.patches.len()],
        };
        state.sum_patches(mesh);
        state
    }

    /// Sums the patches' unshot power anew.
    pub(super) fn sum_patches(&mut self, mesh: &Mesh) {
        let sums = self.patch_power.iter_mut().zip(&mut self.patch_net);
        for (patch, (power, net)) in mesh.patches.iter().zip(sums) {
            (*power, *net) = (Rgb::ZERO, Rgb::ZERO);
            for e in patch.elements.clone().map(|e| e as usize) {
                *power += self.unshot[e].abs() * mesh.elements[e].area;
                *net += self.unshot[e] * mesh.elements[e].area;
            }
        }
    }

    /// The unshot power of a patch, with its sign.
    pub(super) fn power_of(&self, mesh: &Mesh, patch: usize) -> Rgb {
        let elements = mesh.patches[patch].elements.clone();
        elements.map(|e| self.unshot[e as usize] * mesh.elements[e as usize].area).sum()
    }

    /// All unshot power, one side: ΣA|u|.
    pub(super) fn unshot_power(&self) -> Rgb {
        self.patch_power.iter().copied().sum()
    }
}
