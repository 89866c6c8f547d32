//! Progressive shooting through a stored matrix.

use scene::Rgb;

use super::component::refuse_endless;
use super::deflation::Deflation;
use super::scale::{exponent, scaled};
use super::{Error, Matrix};
use crate::config::StopRule;
use crate::energy::{Ledger, RgbSum};
use crate::shooting::{DIVERGED, StopReason};

/// Deflations in a sweep. In a cube of 384 elements, of reflectance .9 to .999999 or mixed,
/// eight to 48 need the same number of shots to within a twentieth; one needs up to a sixth
/// more.
const DEFLATIONS_PER_SWEEP: usize = 8;

/// A scene that absorbs this share per bounce needs some ten plain sweeps to six digits, and
/// without deflation no light is ever negative: each shot brings B nearer from below.
const ENOUGH_ABSORPTION: f64 = 0.4;

/// Shooting has stalled when this many sweeps in a row did not lower the unshot power by
/// [`STALL_FALL`].
const STALL_SWEEPS: u64 = 20;

/// Relative fall of the unshot power that counts as progress: a mean absorption of 5e-5.
const STALL_FALL: f64 = 1e-3;

/// How light that is reflected many times is brought to rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Method {
    /// Deflated, if the first sweep shows that less than .4 of the light is lost per bounce.
    #[default]
    Auto,
    /// One surface after the other: sweeps grow as 1 / (1 − ρ).
    Plain,
    /// All surfaces together besides, eight times a sweep: sweeps hardly depend on ρ.
    Deflated,
}

/// How light is shot through a matrix.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MatrixConfig {
    /// When to stop; `unshot` counts positive and negative light alike.
    pub stop: StopRule,
    /// How light that is reflected many times is brought to rest.
    pub method: Method,
}

impl MatrixConfig {
    /// A stop at `unshot` of the emitted power in every channel, by the method that suits.
    #[must_use]
    pub fn until(unshot: f64) -> Self {
        Self { stop: StopRule { unshot, max_shots: None }, method: Method::Auto }
    }
}

/// The shooting solver over a stored matrix: B = E + ρ F B, per channel.
///
/// The surface with the most unshot power, relative to what its channel emits, shoots next
/// (Southwell's order; Gortler, Cohen & Slusallek 1993). Unshot power keeps its sign, because
/// deflation can overshoot. Light is scaled by a power of two to about 1 first, so
/// B(2^k E) = 2^k B(E) to the bit. Time per shot: the surfaces, three channels each.
#[derive(Clone, Debug)]
pub struct MatrixShooting<'a> {
    matrix: &'a Matrix,
    reflectance: Vec<Rgb>,
    config: MatrixConfig,
    deflation: Option<Deflation>,
    /// Powers of two that areas and each channel's light were divided by.
    area_scale: i32,
    light_scale: [i32; 3],
    areas: Vec<f64>,
    emittance: Vec<Rgb>,
    emitted: Rgb,
    /// 1 / emitted, and 0 without light.
    per_emitted: [f64; 3],
    /// What the rows lack to 1.
    openness: Vec<f64>,
    /// Power that arrived at each surface so far.
    received: Vec<Rgb>,
    /// Power that each surface has still to shoot.
    unshot: Vec<Rgb>,
    escaped: RgbSum,
    shot: Rgb,
    next: Next,
    shots: u64,
    deflations: u64,
    lowest: (f64, u64),
}

/// What one look at all surfaces finds.
#[derive(Clone, Copy, Debug)]
struct Next {
    /// The surface with the most unshot power.
    shooter: Option<usize>,
    /// Unshot over emitted power, worst channel.
    unshot: f64,
}

impl<'a> MatrixShooting<'a> {
    /// Nothing received, all emittance unshot.
    ///
    /// # Errors
    /// [`Error::Length`], [`Error::Reflectance`] and [`Error::Emittance`] for lists that do
    /// not fit the matrix or that no surface can have; [`Error::Singular`] if light enters a
    /// closed part of the scene that absorbs nothing.
    pub fn new(
        matrix: &'a Matrix,
        reflectance: &[Rgb],
        emittance: &[Rgb],
        config: MatrixConfig,
    ) -> Result<Self, Error> {
        check(matrix, reflectance, emittance)?;
        refuse_endless(matrix, reflectance, emittance)?;
        let brightest = |c: usize| emittance.iter().map(|e| e[c]).fold(0.0, f64::max);
        let light_scale = [0, 1, 2].map(|c| exponent(brightest(c)));
        let near_one = |e: &Rgb| Rgb([0, 1, 2].map(|c| scaled(e[c], -light_scale[c])));
        let emittance: Vec<Rgb> = emittance.iter().map(near_one).collect();
        let area_scale = exponent(matrix.areas.iter().copied().fold(0.0, f64::max));
        let areas: Vec<f64> = matrix.areas.iter().map(|a| scaled(*a, -area_scale)).collect();
        let unshot: Vec<Rgb> = areas.iter().zip(&emittance).map(|(a, e)| *e * *a).collect();
        let mut emitted = RgbSum::default();
        unshot.iter().for_each(|power| emitted.add(*power));
        let emitted = emitted.value();
        let mut shooting = Self {
            reflectance: reflectance.to_vec(),
            config,
            deflation: None,
            area_scale,
            light_scale,
            emittance,
            emitted,
            per_emitted: emitted.0.map(|e| if e > 0.0 { 1.0 / e } else { 0.0 }),
            openness: (0..matrix.len()).map(|i| 1.0 - matrix.row_sum(i)).collect(),
            received: vec![Rgb::ZERO; matrix.len()],
            unshot,
            escaped: RgbSum::default(),
            shot: Rgb::ZERO,
            next: Next { shooter: None, unshot: 0.0 },
            shots: 0,
            deflations: 0,
            lowest: (f64::INFINITY, 0),
            areas,
            matrix,
        };
        if config.method == Method::Deflated {
            shooting.deflate_from_now_on();
        }
        shooting.look();
        Ok(shooting)
    }

    /// Shoots until there is a reason not to.
    pub fn run(&mut self) -> StopReason {
        loop {
            if let Some(reason) = self.finished() {
                return reason;
            }
            self.step();
        }
    }

    /// Whether there is a reason not to shoot again.
    #[must_use]
    pub fn finished(&self) -> Option<StopReason> {
        let unshot = self.next.unshot;
        let stall = STALL_SWEEPS * self.matrix.len() as u64;
        if self.emitted == Rgb::ZERO {
            Some(StopReason::NoLight)
        } else if unshot <= self.config.stop.unshot || self.next.shooter.is_none() {
            Some(StopReason::Converged)
        } else if self.config.stop.max_shots.is_some_and(|most| self.shots >= most) {
            Some(StopReason::ShotLimit)
        } else if unshot > self.diverged() {
            Some(StopReason::Diverged)
        } else if self.shots > self.lowest.1 + stall {
            Some(StopReason::Stalled)
        } else {
            None
        }
    }

    /// One shot, and the deflation that may be due. Does nothing when all is shot.
    pub fn step(&mut self) {
        let Some(shooter) = self.next.shooter else { return };
        self.shoot(shooter);
        self.shots += 1;
        let sweep = self.matrix.len() as u64;
        if self.config.method == Method::Auto && self.shots == sweep && self.absorbs_little() {
            self.deflate_from_now_on();
        }
        let due = self.shots.is_multiple_of(sweep.div_ceil(DEFLATIONS_PER_SWEEP as u64));
        if let (Some(deflation), true) = (&self.deflation, due) {
            deflation.shoot(&mut self.received, &mut self.unshot, &mut self.escaped);
            self.deflations += 1;
        }
        self.look();
        if self.next.unshot < self.lowest.0 * (1.0 - STALL_FALL) {
            self.lowest = (self.next.unshot, self.shots);
        }
    }

    /// What leaves each surface, unshot light included.
    ///
    /// # Units
    /// Those of the emittance.
    #[must_use]
    pub fn exitance(&self) -> Vec<Rgb> {
        let exitance = |i: usize| {
            let irradiance = self.received[i] / self.areas[i];
            self.unscaled(self.emittance[i] + self.reflectance[i] * irradiance, 0)
        };
        (0..self.areas.len()).map(exitance).collect()
    }

    /// What arrives at each surface, per area.
    ///
    /// # Units
    /// Those of the emittance.
    #[must_use]
    pub fn irradiance(&self) -> Vec<Rgb> {
        let received = self.received.iter().zip(&self.areas);
        received.map(|(power, area)| self.unscaled(*power / *area, 0)).collect()
    }

    /// Where the emitted power went so far. `escaped` is what the rows lack to 1: light that
    /// left, or met a back, or the form factors' defect.
    #[must_use]
    pub fn ledger(&self) -> Ledger {
        let (mut absorbed, mut unshot) = (RgbSum::default(), RgbSum::default());
        for (i, rho) in self.reflectance.iter().enumerate() {
            absorbed.add((Rgb::splat(1.0) - *rho) * self.received[i]);
            unshot.add(self.unshot[i]);
        }
        let power = |power: Rgb| self.unscaled(power, self.area_scale);
        Ledger {
            emitted: power(self.emitted),
            absorbed: power(absorbed.value()),
            escaped: power(self.escaped.value()),
            unshot: power(unshot.value()),
            ..Ledger::default()
        }
    }

    /// Σ |unshot power| over emitted power, worst channel.
    #[must_use]
    pub fn unshot(&self) -> f64 {
        self.next.unshot
    }

    /// Shots so far.
    #[must_use]
    pub fn shots(&self) -> u64 {
        self.shots
    }

    /// Deflations so far; each costs about as much as a shot.
    #[must_use]
    pub fn deflations(&self) -> u64 {
        self.deflations
    }

    /// Shots per surface so far.
    #[must_use]
    pub fn sweeps(&self) -> f64 {
        self.shots as f64 / self.matrix.len().max(1) as f64
    }

    /// Sends what one surface has to all that it sees.
    fn shoot(&mut self, shooter: usize) {
        let matrix = self.matrix;
        let sent = std::mem::take(&mut self.unshot[shooter]);
        let row = matrix.starts[shooter]..matrix.starts[shooter + 1];
        for (column, value) in matrix.columns[row.clone()].iter().zip(&matrix.values[row]) {
            let j = *column as usize;
            let arriving = sent * *value;
            self.received[j] += arriving;
            self.unshot[j] += self.reflectance[j] * arriving;
        }
        self.escaped.add(sent * self.openness[shooter]);
        self.shot += sent;
    }

    /// Finds the next shooter, and how much is unshot.
    fn look(&mut self) {
        let (mut most, mut shooter) = (0.0, None);
        let mut shares = [0.0; 3];
        for (i, power) in self.unshot.iter().enumerate() {
            let mut largest = 0.0f64;
            for ((sum, power), per_emitted) in shares.iter_mut().zip(power.0).zip(self.per_emitted)
            {
                let share = power.abs() * per_emitted;
                *sum += share;
                largest = largest.max(share);
            }
            if largest > most {
                (most, shooter) = (largest, Some(i));
            }
        }
        self.next = Next { shooter, unshot: shares.into_iter().fold(0.0, f64::max) };
    }

    /// Whether the shots so far lost less than [`ENOUGH_ABSORPTION`] of their light, in the
    /// channel that lost the least.
    fn absorbs_little(&self) -> bool {
        let mut reflected = RgbSum::default();
        self.reflectance.iter().zip(&self.received).for_each(|(rho, h)| reflected.add(*rho * *h));
        let reflected = reflected.value();
        (0..3).any(|c| reflected[c] > (1.0 - ENOUGH_ABSORPTION) * self.shot[c])
    }

    fn deflate_from_now_on(&mut self) {
        self.deflation = Some(Deflation::new(self.matrix, &self.areas, &self.reflectance));
    }

    /// Unshot power over emitted power that cannot be right. Deflation takes as much power as
    /// there is, and counted with both signs that is at most twice as much.
    fn diverged(&self) -> f64 {
        if self.deflation.is_some() { 2.0 * DIVERGED } else { DIVERGED }
    }

    /// Light as it was given: `area_scale` is that of power, or 0.
    fn unscaled(&self, light: Rgb, area_scale: i32) -> Rgb {
        Rgb([0, 1, 2].map(|c| scaled(light[c], self.light_scale[c] + area_scale)))
    }
}

fn check(matrix: &Matrix, reflectance: &[Rgb], emittance: &[Rgb]) -> Result<(), Error> {
    for (what, list) in [("reflectances", reflectance), ("emittances", emittance)] {
        if list.len() != matrix.len() {
            return Err(Error::Length { what, expected: matrix.len(), found: list.len() });
        }
    }
    let wrong = |rho: &Rgb| !rho.0.iter().all(|c| (0.0..=1.0).contains(c));
    if let Some(surface) = reflectance.iter().position(wrong) {
        return Err(Error::Reflectance { surface });
    }
    let wrong = |e: &Rgb| !e.0.iter().all(|c| c.is_finite() && *c >= 0.0);
    if let Some(surface) = emittance.iter().position(wrong) {
        return Err(Error::Emittance { surface });
    }
    Ok(())
}
