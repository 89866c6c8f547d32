//! Progressive shooting: the brightest patch lights all others, until little is unshot.
//!
//! One step: **select** the patch with the most unshot power; **transfer** its light to
//! every receiver point, each into its own slot; **commit** what arrived to elements and
//! patches. A step reads a frozen state, so its result does not depend on who computes what.

mod cell;
mod commit;
mod near;
mod select;
mod state;
mod transfer;

use accel::Occluder;
use form_factor::Rule;
use scene::{Rgb, Solution};

use crate::census::{Census, Lost};
use crate::config::{Exchange, ShootingConfig};
use crate::energy::{Ledger, RgbSum};
use crate::executor::Executor;
use crate::mesh::Mesh;
use crate::observer::{Control, Observer, StepReport};
use crate::reconstruct;
use cell::Cell;
use near::Near;
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
    state: State,
    /// Mean irradiance, if no light escaped: emitted power over Σ A (1 − ρ).
    mean: Rgb,
    emitted: Rgb,
    escaped: RgbSum,
    sampled_escape: RgbSum,
    wrong_side: RgbSum,
    shots: u64,
    counts: Counts,
    lowest: (f64, u64),
    cells: Vec<Cell>,
    near: Near,
    arriving: Vec<Rgb>,
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
        let state = State::new(mesh);
        let mut emitted = RgbSum::default();
        let mut absorption = RgbSum::default();
        for element in &mesh.elements {
            let root = mesh.root_of(element);
            emitted.add(root.emittance * element.area);
            absorption.add((Rgb::splat(1.0) - root.reflectance) * element.area);
        }
        let emitted = emitted.value() * sides(config.exchange);
        let absorption = absorption.value();
        let mean = |c: usize| if absorption[c] > 0.0 { emitted[c] / absorption[c] } else { 0.0 };
        let mean = Rgb([0, 1, 2].map(mean));
        Self {
            mesh,
            occluder,
            census,
            executor,
            config,
            state,
            mean,
            emitted,
            escaped: RgbSum::default(),
            sampled_escape: RgbSum::default(),
            wrong_side: RgbSum::default(),
            shots: 0,
            counts: Counts::default(),
            lowest: (f64::INFINITY, 0),
            cells: Vec::new(),
            near: Near::default(),
            arriving: vec![Rgb::ZERO; mesh.points.len()],
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

    /// One shot: select, transfer, commit. Does nothing when all is shot.
    pub fn step(&mut self) {
        let Some(shooter) = select::brightest(&self.state.patch_power) else { return };
        let power = self.state.patch_power[shooter] * sides(self.config.exchange);
        let lost = self.census.lost(shooter, power, &self.state.unshot);
        self.transfer(shooter);
        for e in self.mesh.patches[shooter].elements.clone() {
            self.state.unshot[e as usize] = Rgb::ZERO;
        }
        commit::commit(self.mesh, &self.arriving, &self.near, &mut self.state, self.executor);
        self.account(power, lost);
        self.shots += 1;
        let unshot = self.unshot_share();
        if unshot < self.lowest.0 * (1.0 - STALL_FALL) {
            self.lowest = (unshot, self.shots);
        }
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

    /// Where the emitted power went so far.
    #[must_use]
    pub fn ledger(&self) -> Ledger {
        let k = sides(self.config.exchange);
        let mut absorbed = RgbSum::default();
        let mut unshot = RgbSum::default();
        for (i, element) in self.mesh.elements.iter().enumerate() {
            let rho = self.mesh.root_of(element).reflectance;
            let received = self.state.irradiance[i] * element.area;
            absorbed.add(received - rho * received * k);
            unshot.add(self.state.unshot[i] * (element.area * k));
        }
        let wrong_side = self.wrong_side.value();
        let mut defect = self.escaped;
        defect.add(self.sampled_escape.value() * -1.0);
        Ledger {
            emitted: self.emitted,
            absorbed: absorbed.value(),
            escaped: self.escaped.value(),
            form_factor_defect: defect.value(),
            wrong_side,
            unshot: unshot.value(),
        }
    }

    /// The exitance so far, unshot light included: what leaves each element.
    #[must_use]
    pub fn solution(&self) -> Solution {
        let State { irradiance, at_points, .. } = &self.state;
        reconstruct::solution(self.mesh, self.census, irradiance, at_points)
    }

    /// Unshot power over emitted power, worst channel; 0 without light.
    fn unshot_share(&self) -> f64 {
        let unshot = self.state.unshot_power() * sides(self.config.exchange);
        let share = |c| if self.emitted[c] > 0.0 { unshot[c] / self.emitted[c] } else { 0.0 };
        (0..3).map(share).fold(0.0, f64::max)
    }

    /// Whether light in some lit channel can go nowhere: every reflectance is 1, and no
    /// sampled direction meets a back or leaves the scene.
    fn nothing_absorbs(&self) -> bool {
        (0..3).any(|c| self.emitted[c] > 0.0 && self.mean[c] == 0.0)
            && !self.census.is_empty()
            && !self.census.any_lost()
    }

    /// An exitance over the scene's mean irradiance, brightest channel.
    fn brightness(&self, exitance: Rgb) -> f64 {
        let share = |c| if self.mean[c] > 0.0 { exitance[c] / self.mean[c] } else { 0.0 };
        (0..3).map(share).fold(0.0, f64::max)
    }

    /// Lights every receiver point and the inside of near elements.
    fn transfer(&mut self, shooter: usize) {
        let (mesh, exchange) = (self.mesh, self.config.exchange);
        let patch = &mesh.patches[shooter];
        let root = &mesh.roots[mesh.nodes[patch.node as usize].root as usize];
        cell::cells_of(mesh, self.census, patch, &self.state.unshot, &mut self.cells);
        let light = self.brightness(self.cells[0].unshot) / self.config.bright;
        self.near.find(mesh, patch, exchange, light);
        let shot = Shot {
            occluder: self.occluder,
            cells: &self.cells,
            normal: root.normal,
            triangle: root.triangle.0,
            exchange,
            rule: Rule::for_tolerance(self.config.tolerance),
            extent: mesh.extent,
            negligible: self.mean * self.config.cell_share,
        };
        let mut runs: Vec<Run> = Vec::new();
        let totals = self.state.at_points.chunks_mut(RUN);
        let slots = mesh.points.chunks(RUN).zip(self.arriving.chunks_mut(RUN));
        runs.extend(slots.zip(totals).map(|((receivers, arriving), total)| {
            Run::new(Receivers { points: receivers, shares: None }, arriving, Some(total))
        }));
        let Near { points, weights, arriving, .. } = &mut self.near;
        let slots = points.chunks(RUN).zip(weights.chunks(RUN)).zip(arriving.chunks_mut(RUN));
        runs.extend(slots.map(|((points, shares), arriving)| {
            Run::new(Receivers { points, shares: Some(shares) }, arriving, None)
        }));
        if self.scratch.len() < runs.len() {
            self.scratch.resize_with(runs.len(), Scratch::default);
        }
        for (run, scratch) in runs.iter_mut().zip(&mut self.scratch) {
            run.scratch = Some(scratch);
        }
        self.executor.for_each(&mut runs, |run| {
            let Some(scratch) = run.scratch.as_deref_mut() else { return };
            run.counts = shot.light(run.receivers, run.arriving, scratch);
            if let Some(total) = run.total.as_deref_mut() {
                total.iter_mut().zip(&*run.arriving).for_each(|(t, a)| *t += *a);
            }
        });
        for run in &runs {
            self.counts.rays += run.counts.rays;
            self.counts.form_factors += run.counts.form_factors;
        }
    }

    /// Books one shot's power: what no element received met a back or escaped.
    fn account(&mut self, power: Rgb, sampled: Lost) {
        let mut rest = RgbSum::default();
        rest.add(power);
        for received in &self.state.patch_received {
            rest.add(*received * -1.0);
        }
        let rest = rest.value();
        self.wrong_side.add(sampled.wrong_side);
        self.escaped.add(rest - sampled.wrong_side);
        self.sampled_escape.add(if self.census.is_empty() { rest } else { sampled.escaped });
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
    /// Where to add what arrived, for the mesh's own points.
    total: Option<&'a mut [Rgb]>,
    scratch: Option<&'a mut Scratch>,
    counts: Counts,
}

impl<'a> Run<'a> {
    fn new(
        receivers: Receivers<'a>,
        arriving: &'a mut [Rgb],
        total: Option<&'a mut [Rgb]>,
    ) -> Self {
        Self { receivers, arriving, total, scratch: None, counts: Counts::default() }
    }
}
