//! When shooting ends, and why.

use scene::Rgb;

use super::{Shooting, sides};
use crate::executor::Executor;

/// The solver gives up when this many shots per patch in a row lowered the unshot power by
/// less than [`STALL_FALL`]: light goes round between perfect reflectors.
const STALL_SWEEPS: u64 = 20;

/// Net unshot power over emitted power beyond which the solver gives up: it starts at 1, and
/// with rows that sum to at most 1 it cannot rise.
pub const DIVERGED: f64 = 2.0;

/// Relative fall of the unshot power that counts as progress: a mean absorption of 5e-5.
pub(super) const STALL_FALL: f64 = 1e-3;

/// Why the solver stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StopReason {
    /// Unshot power is at or below the asked share.
    Converged,
    /// Nothing emits.
    NoLight,
    /// The asked number of shots is done.
    ShotLimit,
    /// The observer said so.
    Stopped,
    /// Unshot power no longer falls: the scene absorbs too little.
    Stalled,
    /// Unshot power grew past [`DIVERGED`] times the emitted: surfaces lie in one another
    /// and each takes the light of all.
    Diverged,
    /// A closed scene in which nothing absorbs: the light has no end, and no solution.
    Singular,
}

impl<E: Executor> Shooting<'_, E> {
    /// Whether there is a reason not to shoot again.
    #[must_use]
    pub fn finished(&self) -> Option<StopReason> {
        let stall = STALL_SWEEPS * self.mesh.patches.len() as u64;
        if self.emitted == Rgb::ZERO {
            Some(StopReason::NoLight)
        } else if self.nothing_absorbs() {
            Some(StopReason::Singular)
        } else if self.unshot_share() <= self.config.stop.unshot {
            Some(StopReason::Converged)
        } else if self.config.stop.max_shots.is_some_and(|most| self.shots >= most) {
            Some(StopReason::ShotLimit)
        } else if self.net_share() > DIVERGED {
            Some(StopReason::Diverged)
        } else if self.shots > self.lowest.1 + stall {
            Some(StopReason::Stalled)
        } else {
            None
        }
    }

    /// ΣA|u| over the emitted power, worst channel; 0 without light.
    pub(super) fn unshot_share(&self) -> f64 {
        let unshot = self.state.unshot_power() * sides(self.config.exchange);
        unshot.share_of(self.emitted).max_channel()
    }

    /// |ΣAu| over the emitted power, worst channel: light that patches shot in advance and owe
    /// counts against that which they have.
    fn net_share(&self) -> f64 {
        let net = self.net().abs() * sides(self.config.exchange);
        net.share_of(self.emitted).max_channel()
    }

    /// Whether light in some lit channel can go nowhere: every reflectance is 1, and no
    /// sampled direction meets a back or leaves the scene.
    fn nothing_absorbs(&self) -> bool {
        self.endless.contains(&true) && !self.census.is_empty() && !self.census.any_lost()
    }
}
