//! Progressive shooting: the brightest patch lights all others, until little is unshot.
//!
//! One step: **select** the patch with the most unshot power; **transfer** its light to
//! every receiver point, each into its own slot; **commit** what arrived to elements and
//! patches. A step reads a frozen state, so its result does not depend on who computes what.
//! Where little is absorbed, an **ambient** correction every few steps takes the place of
//! hundreds of sweeps.

mod account;
mod ambient;
mod cell;
mod commit;
mod detail;
mod gather;
mod near;
mod remaining;
mod select;
mod state;
mod transfer;

use accel::Occluder;
use scene::{Rgb, Solution};

use crate::census::Census;
use crate::config::{Correction, Exchange, ShootingConfig};
use crate::energy::RgbSum;
use crate::executor::Executor;
use crate::mesh::{Mesh, ReceiverPoint};
use crate::observer::{Control, Observer, StepReport};
use crate::reconstruct;
use account::Account;
use ambient::{Ambient, LOSS_OF_PLAIN, PER_SWEEP, Phase};
use cell::Cell;
use detail::Detail;
pub use gather::Gathered;
use near::Near;
pub use remaining::Remaining;
use state::State;
pub(crate) use transfer::SEGMENT_LIFT;
use transfer::{Counts, Receivers, Scratch, Shot};

/// Receivers per run: their segments from one cell form a batch.
const RUN: usize = 256;

/// The solver gives up when this many shots per patch in a row lowered the unshot power by
/// less than [`STALL_FALL`]: light goes round between perfect reflectors.
const STALL_SWEEPS: u64 = 20;

/// Unshot power over emitted power beyond which the solver gives up: it starts at 1, and
/// with rows that sum to at most 1 it cannot rise.
pub const DIVERGED: f64 = 2.0;

/// Relative fall of the unshot power that counts as progress: a mean absorption of 5e-5.
const STALL_FALL: f64 = 1e-3;

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

/// The shooting solver over one mesh and one occluder.
pub struct Shooting<'a, E: Executor> {
    mesh: &'a Mesh,
    occluder: &'a dyn Occluder,
    census: &'a Census,
    executor: &'a E,
    config: ShootingConfig,
    /// The mesh's points, then the probes.
    receivers: Vec<ReceiverPoint>,
    state: State,
    /// Mean irradiance, if no light escaped: emitted power over Σ A (1 − ρ).
    mean: Rgb,
    emitted: Rgb,
    account: Account,
    shots: u64,
    counts: Counts,
    lowest: (f64, u64),
    /// `None` where more is absorbed than a correction could be worth.
    ambient: Option<Ambient>,
    /// Factor on what arrives at each receiver, once rows are closed.
    closure: Option<Vec<f64>>,
    /// Row sums before they were closed.
    raw_rows: Option<[f64; 2]>,
    cells: Vec<Cell>,
    near: Near,
    arriving: Vec<Rgb>,
    seen: Vec<f64>,
    scratch: Vec<Scratch>,
}

impl<'a, E: Executor> Shooting<'a, E> {
    /// Nothing received, all emittance unshot.
    ///
    /// `occluder` holds the scene's input triangles in order. `census` may be empty: then
    /// all that is not received counts as escaped.
    #[must_use]
    pub fn new(
        mesh: &'a Mesh,
        occluder: &'a dyn Occluder,
        census: &'a Census,
        executor: &'a E,
        config: ShootingConfig,
    ) -> Self {
        Self::with_probes(mesh, occluder, census, executor, config, &[])
    }

    /// As [`Shooting::new`], with places of the caller's that receive but do not reflect:
    /// [`Shooting::at_probes`] says what arrives there.
    #[must_use]
    pub fn with_probes(
        mesh: &'a Mesh,
        occluder: &'a dyn Occluder,
        census: &'a Census,
        executor: &'a E,
        config: ShootingConfig,
        probes: &[ReceiverPoint],
    ) -> Self {
        let receivers: Vec<_> = mesh.points.iter().chain(probes).copied().collect();
        let mut emitted = RgbSum::default();
        let mut absorption = RgbSum::default();
        let mut most = 0.0f64;
        for element in &mesh.elements {
            let root = mesh.root_of(element);
            emitted.add(root.emittance * element.area);
            absorption.add((Rgb::splat(1.0) - root.reflectance) * element.area);
            most = most.max(root.reflectance.max_channel());
        }
        let emitted = emitted.value() * sides(config.exchange);
        let stiff = config.correction == Correction::Auto && most > 1.0 - LOSS_OF_PLAIN;
        Self {
            state: State::new(mesh, receivers.len()),
            mean: emitted.share_of(absorption.value()),
            emitted,
            ambient: stiff.then(|| Ambient::new(mesh, receivers.len())),
            arriving: vec![Rgb::ZERO; receivers.len()],
            seen: vec![0.0; receivers.len()],
            mesh,
            occluder,
            census,
            executor,
            config,
            receivers,
            account: Account::default(),
            shots: 0,
            counts: Counts::default(),
            lowest: (f64::INFINITY, 0),
            closure: None,
            raw_rows: None,
            cells: Vec::new(),
            near: Near::default(),
            scratch: Vec::new(),
        }
    }

    /// Shoots until the stop rule, the observer or a stall ends it.
    pub fn run(&mut self, observer: &mut impl Observer) -> StopReason {
        loop {
            if let Some(reason) = self.finished() {
                return reason;
            }
            self.step();
            if observer.step(&self.report()) == Control::Stop {
                return self.finished().unwrap_or(StopReason::Stopped);
            }
        }
    }

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
        } else if self.unshot_share() > DIVERGED {
            Some(StopReason::Diverged)
        } else if self.shots > self.lowest.1 + stall {
            Some(StopReason::Stalled)
        } else {
            None
        }
    }

    /// Asks for less unshot light than before: shooting may go on from where it stopped.
    pub fn tighten(&mut self, unshot: f64) {
        self.config.stop.unshot = unshot;
    }

    /// One shot: select, transfer, commit; then, where it pays, an ambient correction. Does
    /// nothing when all is shot.
    pub fn step(&mut self) {
        let completing = self.ambient.as_ref().filter(|a| a.phase == Phase::Completing);
        let chosen = completing
            .and_then(Ambient::next_waiting)
            .or_else(|| select::brightest(&self.state.patch_power, self.emitted));
        let Some(shooter) = chosen else { return };
        self.shoot(shooter);
        self.shots += 1;
        self.help(shooter);
        let unshot = self.unshot_share();
        if unshot < self.lowest.0 * (1.0 - STALL_FALL) {
            self.lowest = (unshot, self.shots);
        }
    }

    /// Shoots each patch that has not shot yet, however little it has: afterwards the bound of
    /// [`Shooting::remaining`] knows what every point sees. Does nothing where reflectances
    /// are so low that the bound is tight without that.
    pub fn complete(&mut self, observer: &mut impl Observer) -> Control {
        while let Some(shooter) = self.ambient.as_ref().and_then(Ambient::next_waiting) {
            self.shoot(shooter);
            self.shots += 1;
            self.help(shooter);
            if observer.step(&self.report()) == Control::Stop {
                return Control::Stop;
            }
        }
        Control::Continue
    }

    /// What the observer hears.
    #[must_use]
    pub fn report(&self) -> StepReport {
        StepReport {
            shots: self.shots,
            rays: self.counts.rays,
            form_factors: self.counts.form_factors,
            unshot: self.unshot_share(),
        }
    }

    /// The exitance so far, unshot light included: what leaves each element.
    #[must_use]
    pub fn solution(&self) -> Solution {
        let State { irradiance, at_points, .. } = &self.state;
        reconstruct::solution(self.mesh, self.census, irradiance, at_points)
    }

    /// The irradiance so far at each probe.
    #[must_use]
    pub fn at_probes(&self) -> &[Rgb] {
        &self.state.at_points[self.mesh.points.len()..]
    }

    /// Whether ambient corrections take part: the first sweep lost too little light.
    #[must_use]
    pub fn corrected(&self) -> bool {
        self.ambient.as_ref().is_some_and(|a| a.phase == Phase::Correcting)
    }

    /// The least and largest row sum over all receiver points before they were closed to 1;
    /// `None` if they were not closed: light is lost, or corrections are left out.
    #[must_use]
    pub fn closed_rows(&self) -> Option<[f64; 2]> {
        self.raw_rows
    }

    /// ΣA|u| over the emitted power, worst channel; 0 without light.
    fn unshot_share(&self) -> f64 {
        let unshot = self.state.unshot_power() * sides(self.config.exchange);
        unshot.share_of(self.emitted).max_channel()
    }

    /// Whether light in some lit channel can go nowhere: every reflectance is 1, and no
    /// sampled direction meets a back or leaves the scene.
    fn nothing_absorbs(&self) -> bool {
        (0..3).any(|c| self.emitted[c] > 0.0 && self.mean[c] == 0.0)
            && !self.census.is_empty()
            && !self.census.any_lost()
    }

    /// Shoots one patch's light, be it none, and books it.
    fn shoot(&mut self, shooter: usize) {
        let power = self.state.power_of(self.mesh, shooter) * sides(self.config.exchange);
        let sampled =
            (!self.census.is_empty()).then(|| self.census.lost(shooter, power, &self.state.unshot));
        self.transfer(shooter);
        for e in self.mesh.patches[shooter].elements.clone() {
            self.state.unshot[e as usize] = Rgb::ZERO;
        }
        let closure = self.closure.as_deref();
        let (near, state) = (&self.near, &mut self.state);
        commit::commit(self.mesh, &self.arriving, near, closure, state, self.executor);
        let mut rest = RgbSum::default();
        rest.add(power);
        for received in &self.state.patch_received {
            rest.add(*received * -1.0);
        }
        self.account.book(rest.value(), sampled);
        self.watch(power);
    }

    /// In the first sweep, books how much comes back.
    fn watch(&mut self, power: Rgb) {
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

    /// Ambient corrections: decided on after the first sweep, made every few shots.
    fn help(&mut self, shooter: usize) {
        let patches = self.mesh.patches.len() as u64;
        let Some(ambient) = self.ambient.as_mut() else { return };
        ambient.learnt(shooter);
        match ambient.phase {
            Phase::Watching if self.shots >= patches => {
                let plain = ambient.loss() >= LOSS_OF_PLAIN;
                ambient.phase = if plain { Phase::LeftOut } else { Phase::Completing };
            }
            Phase::Correcting if self.shots.is_multiple_of((patches / PER_SWEEP).max(1)) => {
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
        let least = own.iter().copied().fold(f64::INFINITY, f64::min);
        self.raw_rows = Some([least, own.iter().copied().fold(0.0, f64::max)]);
        let (factors, gained) = ambient.close(self.mesh, &mut self.state);
        self.account.book(gained * -1.0, Some(crate::census::Lost::default()));
        self.closure = Some(factors);
    }

    /// One ambient correction, booked as what it stands for: a shot of all patches at once.
    fn correct(&mut self) {
        let Some(ambient) = &mut self.ambient else { return };
        let moved = ambient.correct(self.mesh, &mut self.state);
        let sampled = (!self.census.is_empty()).then(|| self.uniform_loss(&moved.factors));
        self.account.book(moved.shot * sides(self.config.exchange) - moved.received, sampled);
    }

    /// An exitance over the scene's mean irradiance, brightest channel.
    fn brightness(&self, exitance: Rgb) -> f64 {
        exitance.abs().share_of(self.mean).max_channel()
    }

    /// Lights every receiver point, every probe and the inside of near elements.
    fn transfer(&mut self, shooter: usize) {
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

/// How many sides of a surface shine with its exitance.
fn sides(exchange: Exchange) -> f64 {
    match exchange {
        Exchange::OneSided => 1.0,
        Exchange::Paired => 2.0,
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
