//! When ambient corrections are made, and how they are booked.

use scene::Rgb;

use super::ambient::{LOSS_OF_PLAIN, PER_SWEEP, Phase};
use super::{Shooting, sides};
use crate::census::Lost;
use crate::config::Exchange;
use crate::executor::Executor;

impl<E: Executor> Shooting<'_, E> {
    /// In the first sweep, books how much comes back.
    pub(super) fn watch(&mut self, power: Rgb) {
        let Some(ambient) = self.ambient.as_mut().filter(|a| a.phase == Phase::Watching) else {
            return;
        };
        let mut returned = Rgb::ZERO;
        for (patch, received) in self.mesh.patches.iter().zip(&self.state.patch_received) {
            let root = self.mesh.nodes[patch.node as usize].root as usize;
            returned += self.mesh.roots[root].reflectance * *received;
        }
        ambient.watch(power, returned * sides(self.config.exchange));
    }

    /// Ambient corrections after these patches shot: decided on after the first sweep, made every
    /// few shots.
    pub(super) fn help(&mut self, patches_shot: &[usize]) {
        let patches = self.mesh.patches.len() as u64;
        let Some(ambient) = self.ambient.as_mut() else { return };
        patches_shot.iter().for_each(|&patch| ambient.learnt(patch));
        let period = (patches / PER_SWEEP).max(1);
        let before = self.shots - patches_shot.len() as u64;
        match ambient.phase {
            Phase::Watching if self.shots >= patches => {
                let plain = ambient.loss() >= LOSS_OF_PLAIN;
                ambient.phase = if plain { Phase::LeftOut } else { Phase::Completing };
            }
            Phase::Correcting if self.shots / period > before / period => {
                self.correct();
            }
            _ => {}
        }
        if self.ambient.as_ref().is_some_and(|a| a.phase == Phase::Completing && a.whole()) {
            self.close();
            self.correct();
        }
    }

    /// Closes the rows, if no sampled direction loses light.
    fn close(&mut self) {
        let closed = !self.census.is_empty() && !self.census.any_lost();
        let Some(ambient) = self.ambient.as_mut() else { return };
        ambient.phase = Phase::Correcting;
        if !closed || self.config.exchange != Exchange::OneSided {
            return;
        }
        let own = &ambient.rows[..self.mesh.points.len()];
        // Points that receive nothing have no row.
        let some = self.blocks.left_out > 0;
        let own = || own.iter().copied().filter(|row| !some || *row > 0.0);
        self.raw_rows = Some([own().fold(f64::INFINITY, f64::min), own().fold(0.0, f64::max)]);
        let (factors, gained) = ambient.close(self.mesh, &mut self.state);
        self.account.book(gained * -1.0, Some(Lost::default()));
        self.closure = Some(factors);
    }

    /// One ambient correction, booked as what it stands for: a shot of all patches at once.
    fn correct(&mut self) {
        let Some(ambient) = &mut self.ambient else { return };
        let moved = ambient.correct(self.mesh, &mut self.state);
        let sampled = (!self.census.is_empty()).then(|| self.uniform_loss(&moved.factors));
        self.account.book(moved.shot * sides(self.config.exchange) - moved.received, sampled);
    }
}
