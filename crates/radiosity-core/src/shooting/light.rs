//! One patch's light to all receivers: who is lit in which run, and where the sums go.

use scene::Rgb;

use super::Shooting;
use super::cell;
use super::detail::Detail;
use super::near::Near;
use super::transfer::{Counts, Receivers, Scratch, Shot};
use crate::executor::Executor;

/// Receivers per run: their segments from one cell form a batch.
const RUN: usize = 256;

impl<E: Executor> Shooting<'_, E> {
    /// An exitance over the scene's mean irradiance, brightest channel.
    fn brightness(&self, exitance: Rgb) -> f64 {
        exitance.abs().share_of(self.mean).max_channel()
    }

    /// Lights every receiver point, every probe and the inside of near elements.
    pub(super) fn transfer(&mut self, shooter: usize) {
        let (mesh, exchange) = (self.mesh, self.config.exchange);
        let patch = &mesh.patches[shooter];
        let root = &mesh.roots[mesh.nodes[patch.node as usize].root as usize];
        let detail = Detail::of(&self.config);
        let quarterings = detail.quarterings;
        cell::cells_of(mesh, self.census, patch, &self.state.unshot, quarterings, &mut self.cells);
        let light = self.brightness(self.cells[0].unshot) / self.config.bright;
        self.near.find(mesh, patch, exchange, light);
        let shot = Shot::new(self.occluder, &self.cells, mesh, patch, exchange, &detail, self.mean);
        let learn = self.ambient.as_ref().is_some_and(|a| a.wants(shooter));
        if learn {
            self.seen.fill(0.0);
        }
        let mut runs: Vec<Run> = Vec::new();
        let totals = self.state.at_points.chunks_mut(RUN);
        let slots = self.receivers.chunks(RUN).zip(self.arriving.chunks_mut(RUN));
        let slots = slots.zip(self.seen.chunks_mut(RUN));
        let mut closures = self.closure.as_deref().map(|c| c.chunks(RUN));
        runs.extend(slots.zip(totals).map(|(((receivers, arriving), seen), total)| Run {
            receivers: Receivers { points: receivers, shares: None },
            arriving,
            seen: learn.then_some(seen),
            closure: closures.as_mut().and_then(Iterator::next),
            total: Some(total),
            scratch: None,
            counts: Counts::default(),
        }));
        let Near { points, weights, arriving, .. } = &mut self.near;
        let slots = points.chunks(RUN).zip(weights.chunks(RUN)).zip(arriving.chunks_mut(RUN));
        runs.extend(slots.map(|((points, shares), arriving)| Run {
            receivers: Receivers { points, shares: Some(shares) },
            arriving,
            seen: None,
            closure: None,
            total: None,
            scratch: None,
            counts: Counts::default(),
        }));
        if self.scratch.len() < runs.len() {
            self.scratch.resize_with(runs.len(), Scratch::default);
        }
        for (run, scratch) in runs.iter_mut().zip(&mut self.scratch) {
            run.scratch = Some(scratch);
        }
        self.executor.for_each(&mut runs, |run| run.light(&shot));
        for run in &runs {
            self.counts.rays += run.counts.rays;
            self.counts.form_factors += run.counts.form_factors;
        }
        if let (true, Some(ambient)) = (learn, self.ambient.as_mut()) {
            ambient.learn(shooter, root.reflectance, &self.seen);
        }
    }
}

/// A run of receivers with its slots.
struct Run<'a> {
    receivers: Receivers<'a>,
    arriving: &'a mut [Rgb],
    /// Where to sum the form factors to what is visible.
    seen: Option<&'a mut [f64]>,
    /// Factors on what arrives.
    closure: Option<&'a [f64]>,
    /// Where to add what arrived, for the mesh's own points and the probes.
    total: Option<&'a mut [Rgb]>,
    scratch: Option<&'a mut Scratch>,
    counts: Counts,
}

impl Run<'_> {
    fn light(&mut self, shot: &Shot) {
        let Some(scratch) = self.scratch.as_deref_mut() else { return };
        let seen = self.seen.as_deref_mut();
        self.counts = shot.light(self.receivers, self.arriving, seen, scratch);
        if let Some(closure) = self.closure {
            self.arriving.iter_mut().zip(closure).for_each(|(a, k)| *a = *a * *k);
        }
        if let Some(total) = self.total.as_deref_mut() {
            total.iter_mut().zip(&*self.arriving).for_each(|(t, a)| *t += *a);
        }
    }
}
