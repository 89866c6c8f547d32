//! How carefully one patch's light is carried to a receiver.

use crate::config::ShootingConfig;

/// Limits at which cells are split and estimators change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Detail {
    /// Relative error asked of one form factor.
    pub(super) tolerance: f64,
    /// A cell is split while it brings more than this share of the scene's mean irradiance.
    pub(super) cell_share: f64,
    /// How often a cell that the mesh does not split may be quartered for that.
    pub(super) quarterings: u8,
    /// A cell of several elements serves a point only beyond this many of its radii: nearer,
    /// the elements' own exitances matter. So does which part of an element is covered.
    pub(super) open_radii: f64,
}

impl Detail {
    /// What shots use: up to 16 segments from one element, for a bright shooter's penumbra.
    pub(super) fn of(config: &ShootingConfig) -> Self {
        let ShootingConfig { tolerance, cell_share, .. } = *config;
        Self { tolerance, cell_share, quarterings: 2, open_radii: 2.5 }
    }

    /// What shots are held to: exact form factors everywhere, a sixteenth of the light per
    /// segment, up to 256 segments from one element, five times the distance at which elements
    /// shine for themselves: at twice, a third of what patches of 40 elements err by in the Cornell
    /// box stayed unseen; at eight times no more is seen.
    pub(super) fn second_estimate(config: &ShootingConfig) -> Self {
        let cell_share = config.cell_share / 16.0;
        Self { tolerance: 0.0, cell_share, quarterings: 4, open_radii: 12.0 }
    }
}
