//! A patch that shoots in this step, with what of it the receivers need and what they get.

use scene::Rgb;

use super::cell::{self, Cell};
use super::detail::Detail;
use super::near::Near;
use super::state::State;
use crate::census::Census;
use crate::config::ShootingConfig;
use crate::mesh::{Mesh, ReceiverPoint};

/// One shooter of a step; its buffers are kept from step to step.
#[derive(Default)]
pub(super) struct Shooter {
    pub(super) patch: usize,
    /// The patch in pieces, with their unshot exitances.
    pub(super) cells: Vec<Cell>,
    pub(super) near: Near,
    /// Irradiance that it brings to each receiver.
    pub(super) arriving: Vec<Rgb>,
    /// Whether its form factors to all receivers are summed, too.
    pub(super) learnt: bool,
    /// Those sums, if so.
    pub(super) seen: Vec<f64>,
}

/// What preparing a shooter takes.
pub(super) struct Preparation<'a> {
    pub(super) mesh: &'a Mesh,
    pub(super) census: &'a Census,
    pub(super) state: &'a State,
    pub(super) config: &'a ShootingConfig,
    /// The scene's mean irradiance.
    pub(super) mean: Rgb,
    pub(super) receivers: &'a [ReceiverPoint],
}

impl Shooter {
    /// Lays out the cells, finds the near elements and clears the slots.
    pub(super) fn prepare(&mut self, with: &Preparation) {
        let Preparation { mesh, census, state, config, mean, receivers } = *with;
        let patch = &mesh.patches[self.patch];
        let quarterings = Detail::of(config).quarterings;
        cell::cells_of(mesh, census, patch, &state.unshot, quarterings, &mut self.cells);
        let brightness = self.cells[0].unshot.abs().share_of(mean).max_channel();
        self.near.find(mesh, patch, config.exchange, brightness / config.bright);
        self.arriving.resize(receivers.len(), Rgb::ZERO);
        self.seen.clear();
        if self.learnt {
            self.seen.resize(receivers.len(), 0.0);
        }
    }
}
