//! The light of a step's shooters to all receivers: who is lit in which run, and where sums go.

use std::sync::{Mutex, PoisonError};

use super::Shooting;
use super::detail::Detail;
use super::near::NearSlots;
use super::shooter::{Preparation, Shooter};
use super::transfer::{Counts, Receivers, Scratch, Shot};
use crate::executor::Executor;
use crate::observer::Stopper;

/// Receivers per run: their segments from one cell form a batch.
pub(super) const RUN: usize = 512;

impl<E: Executor> Shooting<'_, E> {
    /// Lays out the first `shooters`: their cells, and the points in elements near them.
    pub(super) fn prepare(&mut self, shooters: usize) {
        let preparation = Preparation {
            mesh: self.mesh,
            census: self.census,
            state: &self.state,
            config: &self.config,
            mean: self.mean,
            receivers: self.receivers.len(),
            black: &self.black,
            blocks: &self.blocks,
        };
        let shooters = &mut self.shooters[..shooters];
        self.executor.for_each(shooters, |shooter| shooter.prepare(&preparation));
    }

    /// Lights every receiver point, every probe and the inside of near elements by each of the
    /// first `shooters`; `false` if it was stopped on the way: then nothing counts.
    pub(super) fn transfer(&mut self, shooters: usize, stopper: Option<&Stopper>) -> bool {
        let (mesh, exchange, needs) = (self.mesh, self.config.exchange, self.config.needs);
        let run = RUN * needs.channels.count();
        let in_blocks = (!needs.singles || !needs.black).then_some(&self.blocks);
        let shooters = &mut self.shooters[..shooters];
        let detail = Detail::of(&self.config);
        let mut shots = Vec::with_capacity(shooters.len());
        let mut slots = Vec::with_capacity(shooters.len());
        for Shooter { patch, cells, near, arriving, lit, seen, learnt } in shooters {
            let patch = &mesh.patches[*patch];
            let (occluder, mean) = (self.occluder, self.mean);
            let shot = Shot::new(occluder, cells, mesh, patch, exchange, &needs, &detail, mean);
            shots.push(Shot { space: self.blocks.space_of(mesh, &patch.elements), ..shot });
            slots.push((near, arriving, lit, learnt.then_some(seen)));
        }
        let mut runs: Vec<Run> = Vec::new();
        for (shot, (near, arriving, lit, seen)) in shots.iter().zip(slots) {
            let mut seen = seen.map(|s| s.chunks_mut(RUN));
            let mut closures = self.closure.as_deref().map(|c| c.chunks(RUN));
            let blocks_of = |i: usize| in_blocks.map(|blocks| (i * RUN, blocks.of_run(i)));
            let slots = self.receivers.chunks(RUN).zip(arriving.chunks_mut(run)).zip(lit);
            runs.extend(slots.enumerate().map(|(i, ((points, arriving), lit))| Run {
                receivers: Receivers { points, shares: None, blocks: blocks_of(i) },
                seen: seen.as_mut().and_then(Iterator::next),
                closure: closures.as_mut().and_then(Iterator::next),
                lit: Some(lit),
                ..Run::new(shot, arriving)
            }));
            let NearSlots { points, weights, arriving, blocks } = near.slots();
            let slots = points.chunks(RUN).zip(weights.chunks(RUN)).zip(arriving.chunks_mut(run));
            runs.extend(slots.enumerate().map(|(i, ((points, shares), arriving))| Run {
                receivers: Receivers {
                    points,
                    shares: Some(shares),
                    blocks: in_blocks.map(|_| (i * RUN, blocks.of_run(i))),
                },
                ..Run::new(shot, arriving)
            }));
        }
        self.executor.for_each(&mut runs, |run| {
            if !stopper.is_some_and(|stop| stop()) {
                let mut scratch = self.scratch.take();
                run.light(&mut scratch);
                self.scratch.give_back(scratch);
            }
        });
        if runs.iter().any(|run| !run.done) {
            return false;
        }
        for run in &runs {
            self.counts.rays += run.counts.rays;
            self.counts.form_factors += run.counts.form_factors;
        }
        true
    }
}

/// Buffers for as many runs as there are at one time. Each run having its own from step to step,
/// they would take more room than all else: up to 100 kB each, a thousand runs a step.
#[derive(Default)]
pub(super) struct Lent(Mutex<Vec<Scratch>>);

impl Lent {
    fn take(&self) -> Scratch {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).pop().unwrap_or_default()
    }

    fn give_back(&self, scratch: Scratch) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).push(scratch);
    }
}

/// A run of receivers of one shot with its slots.
struct Run<'a> {
    shot: &'a Shot<'a>,
    receivers: Receivers<'a>,
    arriving: &'a mut [f64],
    /// Whether anything is in these slots.
    lit: Option<&'a mut bool>,
    /// Where to sum the form factors to what is visible.
    seen: Option<&'a mut [f64]>,
    /// Factors on what arrives.
    closure: Option<&'a [f64]>,
    counts: Counts,
    done: bool,
}

impl<'a> Run<'a> {
    fn new(shot: &'a Shot<'a>, arriving: &'a mut [f64]) -> Self {
        Self {
            shot,
            receivers: Receivers { points: &[], shares: None, blocks: None },
            arriving,
            lit: None,
            seen: None,
            closure: None,
            counts: Counts::default(),
            done: false,
        }
    }

    fn light(&mut self, scratch: &mut Scratch) {
        match self.shot.channels.count() {
            1 => self.light_channels::<1>(scratch),
            _ => self.light_channels::<3>(scratch),
        }
        self.done = true;
    }

    fn light_channels<const N: usize>(&mut self, scratch: &mut Scratch) {
        if self.lit.as_deref_mut().is_some_and(std::mem::take) {
            self.arriving.fill(0.0);
        }
        let seen = self.seen.as_deref_mut();
        let arriving = self.arriving.as_chunks_mut::<N>().0;
        self.counts = self.shot.light(self.receivers, arriving, seen, scratch);
        if let Some(lit) = &mut self.lit {
            **lit = self.counts.form_factors > 0;
        }
        if let Some(closure) = self.closure {
            for (arriving, k) in arriving.iter_mut().zip(closure) {
                arriving.iter_mut().for_each(|a| *a *= k);
            }
        }
    }
}
