//! Progressive shooting: the brightest patch lights all others, until little is unshot.
//!
//! One step: **select** the patch with the most unshot power, or some; **transfer** its light to
//! every receiver point, each into its own slot; **commit** what arrived to elements and
//! patches. A step reads a frozen state, so its result does not depend on who computes what.
//! Where little is absorbed, an **ambient** correction every few steps takes the place of
//! hundreds of sweeps.

mod account;
mod ambient;
mod blocks;
mod cell;
mod commit;
mod correct;
mod detail;
mod gather;
mod light;
mod near;
mod overshoot;
mod progress;
mod reach;
mod remaining;
mod select;
mod shooter;
mod shown;
mod state;
mod stop;
mod survey;
mod transfer;

use accel::Occluder;
use scene::Rgb;

use crate::census::{Census, Lost};
use crate::checkpoint::Kept;
use crate::config::{Correction, Exchange, ShootingConfig};
use crate::energy::{RgbSum, Sum};
use crate::executor::Executor;
use crate::mesh::{Mesh, ReceiverPoint};
use crate::needs;
use crate::observer::{Control, Observer, Stage, StepReport, Stopper};
use account::Account;
pub(crate) use ambient::LOSS_OF_PLAIN;
use ambient::{Ambient, Phase};
use blocks::Blocks;
use commit::Brought;
pub use gather::Gathered;
use light::Lent;
use overshoot::Foresight;
pub(crate) use progress::{Course, MOST_COUNTED, Progress};
pub use remaining::Remaining;
use shooter::Shooter;
use state::State;
use stop::STALL_FALL;
pub use stop::{DIVERGED, StopReason};
pub(crate) use survey::{Survey, survey};
use transfer::Counts;
pub(crate) use transfer::SEGMENT_LIFT;

/// The shooting solver over one mesh and one occluder.
pub struct Shooting<'a, E: Executor> {
    mesh: &'a Mesh,
    occluder: &'a dyn Occluder,
    census: &'a Census,
    executor: &'a E,
    config: ShootingConfig,
    /// How often less unshot light was asked for.
    tightened: u32,
    /// Patches shoot that have not yet, whatever is unshot.
    completing: bool,
    /// The mesh's points, then the probes.
    receivers: Vec<ReceiverPoint>,
    blocks: Blocks,
    /// Roots that receive nothing, since they would reflect none of it; empty if all receive.
    black: Vec<bool>,
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
    foresight: Foresight,
    scratch: Lent,
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
        for element in &mesh.elements {
            let root = mesh.root_of(element);
            emitted.add(root.emittance * element.area);
            absorption.add((Rgb::splat(1.0) - root.reflectance) * element.area);
            area.add(element.area);
        }
        let lift = SEGMENT_LIFT * mesh.extent;
        let blocks = Blocks::of(blocks::MOST, mesh, &receivers, occluder, &config.needs, lift);
        let emitted = emitted.value() * sides(config.exchange);
        let absorption = absorption.value();
        Self {
            state: State::new(mesh, receivers.len()),
            mean: mean_irradiance(emitted, absorption, area.value()),
            endless: [0, 1, 2].map(|c| emitted[c] > 0.0 && absorption[c] == 0.0),
            emitted,
            ambient: stiff(mesh, &config).then(|| Ambient::new(mesh, receivers.len())),
            mesh,
            occluder,
            census,
            executor,
            config,
            tightened: 0,
            completing: false,
            receivers,
            blocks,
            black: if config.needs.black { Vec::new() } else { needs::black(&mesh.roots) },
            account: Account::default(),
            shots: 0,
            counts: Counts::default(),
            lowest: (f64::INFINITY, 0),
            closure: None,
            raw_rows: None,
            shooters: Vec::new(),
            foresight: Foresight::of(mesh),
            scratch: Lent::default(),
        }
    }

    /// Shoots until the stop rule, the observer or a stall ends it.
    pub fn run(&mut self, observer: &mut impl Observer) -> StopReason {
        let stopper = observer.stopper();
        loop {
            if let Some(reason) = self.finished() {
                return reason;
            }
            let done = self.step_unless(stopper.as_ref(), observer);
            if self.tell(done, observer) == Control::Stop {
                return self.finished().unwrap_or(StopReason::Stopped);
            }
        }
    }

    /// Asks for less unshot light than before: shooting may go on from where it stopped.
    pub fn tighten(&mut self, unshot: f64) {
        self.config.stop.unshot = unshot;
        self.tightened += 1;
        self.completing = false;
    }

    /// What the shots are on the way to.
    pub(crate) fn course(&self) -> Course {
        let unshot = self.config.stop.unshot;
        Course { unshot, tightened: self.tightened, completing: self.completing }
    }

    /// One step: select, transfer, commit; then, where it pays, an ambient correction. Does
    /// nothing when all is shot.
    pub fn step(&mut self) {
        self.step_unless(None, &mut ());
    }

    /// One step, if nothing stops it: `false` if it was stopped, and nothing changed.
    fn step_unless(&mut self, stopper: Option<&Stopper>, observer: &mut impl Observer) -> bool {
        observer.stage(Stage::Select);
        let (schedule, receivers) = (self.config.schedule, self.receivers.len());
        let completing = self.ambient.as_ref().filter(|a| a.phase == Phase::Completing);
        let mut chosen = completing.map_or_else(Vec::new, |ambient| {
            let patches = self.mesh.patches.len();
            ambient.waiting().take(select::at_once(schedule, patches, receivers)).collect()
        });
        if chosen.is_empty() {
            let worth = self.worth_shooting();
            chosen = select::brightest(&worth, self.emitted, schedule, receivers);
        }
        if chosen.is_empty() {
            // All is owed, and nothing is left to come.
            let power = &self.state.patch_power;
            chosen = select::brightest(power, self.emitted, schedule, receivers);
        }
        if let Some(most) = self.config.stop.max_shots {
            chosen.truncate(most.saturating_sub(self.shots).max(1) as usize);
        }
        if chosen.is_empty() {
            return true;
        }
        if !self.shoot(&chosen, stopper, observer) {
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
        self.completing = true;
        let stopper = observer.stopper();
        let (patches, receivers) = (self.mesh.patches.len(), self.receivers.len());
        let most = select::at_once(self.config.schedule, patches, receivers);
        loop {
            let waiting = self.ambient.iter().flat_map(Ambient::waiting);
            let chosen: Vec<usize> = waiting.take(most).collect();
            if chosen.is_empty() {
                return Control::Continue;
            }
            let done = self.shoot(&chosen, stopper.as_ref(), observer);
            if self.tell(done, observer) == Control::Stop {
                return Control::Stop;
            }
        }
    }

    /// Tells of a step that is done, or was stopped on the way; shows the light and hands out the
    /// state if they are wanted.
    fn tell(&self, done: bool, observer: &mut impl Observer) -> Control {
        let report = self.report();
        let control = if done { observer.step(&report) } else { Control::Stop };
        if control == Control::Continue && observer.wants_solution(&report) {
            observer.solution(&report, self.mesh, &self.solution());
        }
        self.hand_out(observer);
        control
    }

    /// Hands out the state, if it is to be kept.
    pub(crate) fn hand_out(&self, observer: &mut impl Observer) {
        if observer.keeps() {
            observer.keep(&Kept::new(self));
        }
    }

    /// What the observer hears.
    #[must_use]
    pub fn report(&self) -> StepReport {
        StepReport {
            shots: self.shots,
            rays: self.counts.rays,
            form_factors: self.counts.form_factors,
            directions: self.census.directions(),
            unshot: self.unshot_share(),
        }
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
    fn shoot(
        &mut self,
        patches: &[usize],
        stopper: Option<&Stopper>,
        observer: &mut impl Observer,
    ) -> bool {
        observer.stage(Stage::Select);
        if self.shooters.len() < patches.len() {
            self.shooters.resize_with(patches.len(), Shooter::default);
        }
        for (shooter, &patch) in self.shooters.iter_mut().zip(patches) {
            shooter.patch = patch;
            shooter.learnt = self.ambient.as_ref().is_some_and(|a| a.wants(patch));
        }
        let elements = patches.iter().flat_map(|&p| self.mesh.patches[p].elements.clone());
        let before: Vec<Rgb> = elements.map(|e| self.state.unshot[e as usize]).collect();
        let owed = self.foresee(patches);
        observer.stage(Stage::Prepare);
        self.prepare(patches.len());
        observer.stage(Stage::Transfer);
        if !self.transfer(patches.len(), stopper) {
            self.forget(patches, &before);
            return false;
        }
        observer.stage(Stage::Select);
        let mut power = RgbSum::default();
        let mut sampled = (!self.census.is_empty()).then(Lost::default);
        for &patch in patches {
            let of_patch = self.state.power_of(self.mesh, patch) * sides(self.config.exchange);
            power.add(of_patch);
            if let Some(sampled) = &mut sampled {
                let lost = self.census.lost(patch, of_patch, &self.state.unshot);
                sampled.wrong_side += lost.wrong_side;
                sampled.escaped += lost.escaped;
                sampled.black += self.black_share(lost.black);
            }
        }
        self.settle(patches, &owed);
        let shooters = &self.shooters[..patches.len()];
        observer.stage(Stage::Commit);
        let brought = Brought {
            mesh: self.mesh,
            shooters,
            closure: self.closure.as_deref(),
            blocks: &self.blocks,
            channels: self.config.needs.channels,
            black: &self.black,
        };
        commit::commit(brought, &mut self.state, self.executor);
        observer.stage(Stage::Select);
        if let Some(ambient) = &mut self.ambient {
            for shooter in shooters.iter().filter(|s| s.learnt) {
                let patch = &self.mesh.patches[shooter.patch];
                let root = self.mesh.nodes[patch.node as usize].root as usize;
                ambient.learn(shooter.patch, self.mesh.roots[root].reflectance, &shooter.seen);
            }
        }
        let mut rest = power;
        for received in &self.state.patch_received {
            self.account.received.add(*received);
            rest.add(*received * -1.0);
        }
        self.account.book(rest.value(), sampled);
        self.watch(power.value());
        self.shots += patches.len() as u64;
        observer.stage(Stage::Correct);
        self.help(patches);
        observer.stage(Stage::Select);
        true
    }
}

/// Whether corrections may be worth their while: some surface reflects more than plain shooting
/// is good for.
fn stiff(mesh: &Mesh, config: &ShootingConfig) -> bool {
    let used = || mesh.roots.iter().map(|root| root.reflectance.max_channel());
    match config.correction {
        Correction::Never => false,
        Correction::Always => true,
        Correction::Auto => used().fold(0.0, f64::max) > 1.0 - LOSS_OF_PLAIN,
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
