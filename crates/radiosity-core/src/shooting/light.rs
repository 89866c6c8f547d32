//! The light of a step's shooters to all receivers: who is lit in which run, and where sums go.

use std::sync::{Mutex, PoisonError};

use scene::Rgb;

use super::Shooting;
use super::detail::Detail;
use super::near::Near;
use super::shooter::{Preparation, Shooter};
use super::transfer::{Counts, Receivers, Scratch, Shot};
use crate::executor::Executor;
use crate::observer::Stopper;

/// Receivers per run: their segments from one cell form a batch.
const RUN: usize = 512;

impl<E: Executor> Shooting<'_, E> {
    /// Lays out the first `shooters`: their cells, and the points in elements near them.
    pub(super) fn prepare(&mut self, shooters: usize) {
        let preparation = Preparation {
            mesh: self.mesh,
            census: self.census,
            state: &self.state,
            config: &self.config,
            mean: self.mean,
            receivers: &self.receivers,
        };
        let shooters = &mut self.shooters[..shooters];
        self.executor.for_each(shooters, |shooter| shooter.prepare(&preparation));
    }

    /// Lights every receiver point, every probe and the inside of near elements by each of the
    /// first `shooters`; `false` if it was stopped on the way: then nothing counts.
    pub(super) fn transfer(&mut self, shooters: usize, stopper: Option<&Stopper>) -> bool {
        let (mesh, exchange) = (self.mesh, self.config.exchange);
        let shooters = &mut self.shooters[..shooters];
        let detail = Detail::of(&self.config);
        let mut shots = Vec::with_capacity(shooters.len());
        let mut slots = Vec::with_capacity(shooters.len());
        for Shooter { patch, cells, near, arriving, seen, learnt } in shooters {
            let patch = &mesh.patches[*patch];
            shots.push(Shot::new(self.occluder, cells, mesh, patch, exchange, &detail, self.mean));
            slots.push((near, arriving, learnt.then_some(seen)));
        }
        let mut runs: Vec<Run> = Vec::new();
        for (shot, (near, arriving, seen)) in shots.iter().zip(slots) {
            let mut seen = seen.map(|s| s.chunks_mut(RUN));
            let mut closures = self.closure.as_deref().map(|c| c.chunks(RUN));
            let slots = self.receivers.chunks(RUN).zip(arriving.chunks_mut(RUN));
            runs.extend(slots.map(|(points, arriving)| Run {
                receivers: Receivers { points, shares: None },
                seen: seen.as_mut().and_then(Iterator::next),
                closure: closures.as_mut().and_then(Iterator::next),
                ..Run::new(shot, arriving)
            }));
            let Near { points, weights, arriving, .. } = near;
            let slots = points.chunks(RUN).zip(weights.chunks(RUN)).zip(arriving.chunks_mut(RUN));
            runs.extend(slots.map(|((points, shares), arriving)| Run {
                receivers: Receivers { points, shares: Some(shares) },
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
    arriving: &'a mut [Rgb],
    /// Where to sum the form factors to what is visible.
    seen: Option<&'a mut [f64]>,
    /// Factors on what arrives.
    closure: Option<&'a [f64]>,
    counts: Counts,
    done: bool,
}

impl<'a> Run<'a> {
    fn new(shot: &'a Shot<'a>, arriving: &'a mut [Rgb]) -> Self {
        Self {
            shot,
            receivers: Receivers { points: &[], shares: None },
            arriving,
            seen: None,
            closure: None,
            counts: Counts::default(),
            done: false,
        }
    }

    fn light(&mut self, scratch: &mut Scratch) {
        let seen = self.seen.as_deref_mut();
        self.counts = self.shot.light(self.receivers, self.arriving, seen, scratch);
        if let Some(closure) = self.closure {
            self.arriving.iter_mut().zip(closure).for_each(|(a, k)| *a = *a * *k);
        }
        self.done = true;
    }
}
