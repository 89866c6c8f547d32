//! Progressive shooting: the brightest patch lights all others, until little is unshot.
//!
//! One step: **select** the patch with the most unshot power, or some; **transfer** its light to
//! every receiver point, each into its own slot; **commit** what arrived to elements and
//! patches. A step reads a frozen state, so its result does not depend on who computes what.
//! Where little is absorbed, an **ambient** correction every few steps takes the place of
//! hundreds of sweeps.

mod account;
mod ambient;
mod cell;
mod commit;
mod correct;
mod detail;
mod gather;
mod light;
mod near;
mod remaining;
mod select;
mod shooter;
mod state;
mod stop;
mod transfer;

use accel::Occluder;
use scene::{Rgb, Solution};

use crate::census::{Census, Lost};
use crate::config::{Correction, Exchange, ShootingConfig};
use crate::energy::{RgbSum, Sum};
use crate::executor::Executor;
use crate::mesh::{Mesh, ReceiverPoint};
use crate::observer::{Control, Observer, StepReport, Stopper};
use crate::reconstruct;
use account::Account;
use ambient::{Ambient, LOSS_OF_PLAIN, Phase};
pub use gather::Gathered;
pub use remaining::Remaining;
use shooter::Shooter;
use state::State;
use stop::STALL_FALL;
pub use stop::{DIVERGED, StopReason};
pub(crate) use transfer::SEGMENT_LIFT;
use transfer::{Counts, Scratch};

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
    /// Channels that are lit and that no surface absorbs.
    endless: [bool; 3],
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
    /// Those of the present step, with room for more.
    shooters: Vec<Shooter>,
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
        let mut area = Sum::default();
        let mut most = 0.0f64;
        for element in &mesh.elements {
            let root = mesh.root_of(element);
            emitted.add(root.emittance * element.area);
            absorption.add((Rgb::splat(1.0) - root.reflectance) * element.area);
            area.add(element.area);
            most = most.max(root.reflectance.max_channel());
        }
        let emitted = emitted.value() * sides(config.exchange);
        let absorption = absorption.value();
        let stiff = config.correction == Correction::Auto && most > 1.0 - LOSS_OF_PLAIN;
        Self {
            state: State::new(mesh, receivers.len()),
            mean: mean_irradiance(emitted, absorption, area.value()),
            endless: [0, 1, 2].map(|c| emitted[c] > 0.0 && absorption[c] == 0.0),
            emitted,
            ambient: stiff.then(|| Ambient::new(mesh, receivers.len())),
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
            shooters: Vec::new(),
            scratch: Vec::new(),
        }
    }

    /// Shoots until the stop rule, the observer or a stall ends it.
    pub fn run(&mut self, observer: &mut impl Observer) -> StopReason {
        let stopper = observer.stopper();
        loop {
            if let Some(reason) = self.finished() {
                return reason;
            }
            let done = self.step_unless(stopper.as_ref());
            if !done || self.tell(observer) == Control::Stop {
                return self.finished().unwrap_or(StopReason::Stopped);
            }
        }
    }

    /// Asks for less unshot light than before: shooting may go on from where it stopped.
    pub fn tighten(&mut self, unshot: f64) {
        self.config.stop.unshot = unshot;
    }

    /// One step: select, transfer, commit; then, where it pays, an ambient correction. Does
    /// nothing when all is shot.
    pub fn step(&mut self) {
        self.step_unless(None);
    }

    /// One step, if nothing stops it: `false` if it was stopped, and nothing changed.
    fn step_unless(&mut self, stopper: Option<&Stopper>) -> bool {
        let (schedule, receivers) = (self.config.schedule, self.receivers.len());
        let completing = self.ambient.as_ref().filter(|a| a.phase == Phase::Completing);
        let mut chosen = completing.map_or_else(Vec::new, |ambient| {
            ambient.waiting().take(select::at_once(schedule, receivers)).collect()
        });
        if chosen.is_empty() {
            let power = &self.state.patch_power;
            chosen = select::brightest(power, self.emitted, schedule, receivers);
        }
        if let Some(most) = self.config.stop.max_shots {
            chosen.truncate(most.saturating_sub(self.shots).max(1) as usize);
        }
        if chosen.is_empty() {
            return true;
        }
        if !self.shoot(&chosen, stopper) {
            return false;
        }
        let unshot = self.unshot_share();
        if unshot < self.lowest.0 * (1.0 - STALL_FALL) {
            self.lowest = (unshot, self.shots);
        }
        true
    }

    /// Shoots each patch that has not shot yet, however little it has: afterwards the bound of
    /// [`Shooting::remaining`] knows what every point sees. Does nothing where reflectances
    /// are so low that the bound is tight without that.
    pub fn complete(&mut self, observer: &mut impl Observer) -> Control {
        let stopper = observer.stopper();
        let most = select::at_once(self.config.schedule, self.receivers.len());
        loop {
            let waiting = self.ambient.iter().flat_map(Ambient::waiting);
            let chosen: Vec<usize> = waiting.take(most).collect();
            if chosen.is_empty() {
                return Control::Continue;
            }
            let done = self.shoot(&chosen, stopper.as_ref());
            if !done || self.tell(observer) == Control::Stop {
                return Control::Stop;
            }
        }
    }

    /// Tells of a step, and shows the light if that is wanted.
    fn tell(&self, observer: &mut impl Observer) -> Control {
        let report = self.report();
        let control = observer.step(&report);
        if control == Control::Continue && observer.wants_solution(&report) {
            observer.solution(&report, self.mesh, &self.solution());
        }
        control
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

    /// Shoots the light of some patches, be it none, and books it; `false` if it was stopped, and
    /// nothing changed.
    fn shoot(&mut self, patches: &[usize], stopper: Option<&Stopper>) -> bool {
        if self.shooters.len() < patches.len() {
            self.shooters.resize_with(patches.len(), Shooter::default);
        }
        for (shooter, &patch) in self.shooters.iter_mut().zip(patches) {
            shooter.patch = patch;
            shooter.learnt = self.ambient.as_ref().is_some_and(|a| a.wants(patch));
        }
        if !self.transfer(patches.len(), stopper) {
            return false;
        }
        let mut power = RgbSum::default();
        let mut sampled = (!self.census.is_empty()).then(Lost::default);
        for &patch in patches {
            let of_patch = self.state.power_of(self.mesh, patch) * sides(self.config.exchange);
            power.add(of_patch);
            if let Some(sampled) = &mut sampled {
                let lost = self.census.lost(patch, of_patch, &self.state.unshot);
                sampled.wrong_side += lost.wrong_side;
                sampled.escaped += lost.escaped;
            }
        }
        for &patch in patches {
            for e in self.mesh.patches[patch].elements.clone() {
                self.state.unshot[e as usize] = Rgb::ZERO;
            }
        }
        let shooters = &self.shooters[..patches.len()];
        let closure = self.closure.as_deref();
        commit::commit(self.mesh, shooters, closure, &mut self.state, self.executor);
        if let Some(ambient) = &mut self.ambient {
            for shooter in shooters.iter().filter(|s| s.learnt) {
                let patch = &self.mesh.patches[shooter.patch];
                let root = self.mesh.nodes[patch.node as usize].root as usize;
                ambient.learn(shooter.patch, self.mesh.roots[root].reflectance, &shooter.seen);
            }
        }
        let mut rest = power;
        for received in &self.state.patch_received {
            rest.add(*received * -1.0);
        }
        self.account.book(rest.value(), sampled);
        self.watch(power.value());
        self.shots += patches.len() as u64;
        self.help(patches);
        true
    }
}

/// What light there is on average, if none escaped: emitted power over Σ A (1 − ρ). Where
/// nothing absorbs, that of one bounce: cells are split for what matters beside it, and beside
/// nothing everything would.
fn mean_irradiance(emitted: Rgb, absorption: Rgb, area: f64) -> Rgb {
    let mean = |c: usize| match (absorption[c] > 0.0, area > 0.0) {
        (true, _) => emitted[c] / absorption[c],
        (false, true) => emitted[c] / area,
        (false, false) => 0.0,
    };
    Rgb([0, 1, 2].map(mean))
}

/// How many sides of a surface shine with its exitance.
fn sides(exchange: Exchange) -> f64 {
    match exchange {
        Exchange::OneSided => 1.0,
        Exchange::Paired => 2.0,
    }
}
