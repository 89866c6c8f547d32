//! A patch that shoots in this step, with what of it the receivers need and what they get.

use scene::Rgb;

use super::blocks::Blocks;
use super::cell::{self, Cell};
use super::detail::Detail;
use super::light::RUN;
use super::near::{Near, Wanted};
use super::state::State;
use crate::census::Census;
use crate::config::ShootingConfig;
use crate::mesh::Mesh;

/// One shooter of a step; its buffers are kept from step to step.
#[derive(Default)]
pub(super) struct Shooter {
    pub(super) patch: usize,
    /// The patch in pieces, with their unshot exitances.
    pub(super) cells: Vec<Cell>,
    pub(super) near: Near,
    /// Irradiance that it brings to each receiver, in each channel that is computed.
    pub(super) arriving: Vec<f64>,
    /// Whether it brings any to each run of receivers; the slots of others are 0.
    pub(super) lit: Vec<bool>,
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
    pub(super) blocks: &'a Blocks,
    /// How many receivers there are.
    pub(super) receivers: usize,
    /// Roots that receive nothing; none if absent.
    pub(super) black: &'a [bool],
}

impl Shooter {
    /// Lays out the cells, finds the near elements and clears the slots.
    pub(super) fn prepare(&mut self, with: &Preparation) {
        let Preparation { mesh, census, state, config, mean, receivers, black, blocks } = *with;
        let patch = &mesh.patches[self.patch];
        let quarterings = Detail::of(config).quarterings;
        cell::cells_of(mesh, census, patch, &state.unshot, quarterings, &mut self.cells);
        let brightness = self.cells[0].unshot.abs().share_of(mean).max_channel();
        let channels = config.needs.channels.count();
        let light = brightness / config.bright;
        let wanted = Wanted { channels, black, blocks };
        self.near.find(mesh, patch, config.exchange, light, &wanted);
        self.arriving.resize(receivers * channels, 0.0);
        self.lit.resize(receivers.div_ceil(RUN), false);
        self.seen.clear();
        if self.learnt {
            self.seen.resize(receivers, 0.0);
        }
    }
}
