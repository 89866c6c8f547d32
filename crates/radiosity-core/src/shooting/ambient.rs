//! What a uniform light would do in this scene, learnt from the shots that are done anyway.
//!
//! Where little is absorbed, plain shooting needs 6.9/(1 − ρ) sweeps for 1e-6. Nearly all of
//! that is one uniform light going round. Its fate is known once every patch has shot: with
//! exitance ρ everywhere, an irradiance h = Kρ arrives. So the unshot light u can be traded for
//! a·ρ of shot light, with a such that no unshot power is left in sum, and what remains to be
//! shot is the uneven rest, of either sign (an ambient term as in Cohen, Chen, Wallace &
//! Greenberg 1988, but exact: deflation with one vector for each part of the scene that light
//! joins, so that none gets to where it cannot go).

mod keep;

use scene::Rgb;

use super::state::State;
use crate::energy::RgbSum;
use crate::mesh::Mesh;

/// A first sweep that loses at least this share of the light per bounce goes on without
/// corrections: plain shooting needs fewer than 10 sweeps then.
pub(crate) const LOSS_OF_PLAIN: f64 = 0.4;

/// Corrections per sweep.
pub(super) const PER_SWEEP: u64 = 8;

/// Where the correction stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    /// The first sweep: it shows how much is lost per bounce.
    Watching,
    /// Enough is lost: no correction.
    LeftOut,
    /// Little is lost: patches that have not shot yet do so, to learn the rest of h.
    Completing,
    /// All is known; corrections go on.
    Correcting,
}

/// Row sums and h = Kρ at all receivers, as far as patches have shot.
#[derive(Debug)]
pub(super) struct Ambient {
    pub(super) phase: Phase,
    /// ΣF·V over the patches that have shot: the row sum, once all have.
    pub(super) rows: Vec<f64>,
    /// Σρ·F·V over the same patches.
    pub(super) reflected: Vec<Rgb>,
    /// The patch of each of the mesh's points, or one of them.
    patch_of: Vec<u32>,
    /// A patch that each receiver sees, once one is known.
    sees: Vec<Option<u32>>,
    /// Patches that light joins: a forest that leads to one patch of each part of the scene.
    joined: Vec<u32>,
    /// Patches that have not shot yet.
    waiting: Vec<bool>,
    left: usize,
    /// Power shot and reflected in the first sweep.
    shot: RgbSum,
    returned: RgbSum,
}

/// What one correction moved, W per channel, one side.
#[derive(Clone, Debug, Default)]
pub(super) struct Moved {
    /// The factor a of the uniform light, by patch: the same for all that light joins.
    pub(super) factors: Vec<Rgb>,
    pub(super) shot: Rgb,
    pub(super) received: Rgb,
}

impl Ambient {
    pub(super) fn new(mesh: &Mesh, receivers: usize) -> Self {
        let patches = mesh.patches.len();
        Self {
            patch_of: patch_of(mesh),
            sees: vec![None; receivers],
            joined: (0..patches as u32).collect(),
            phase: Phase::Watching,
            rows: vec![0.0; receivers],
            reflected: vec![Rgb::ZERO; receivers],
            waiting: vec![true; patches],
            left: patches,
            shot: RgbSum::default(),
            returned: RgbSum::default(),
        }
    }

    /// Whether the patch has not been learnt from yet.
    pub(super) fn wants(&self, patch: usize) -> bool {
        self.waiting[patch]
    }

    /// Takes in what each receiver has seen of a patch that shot for the first time.
    pub(super) fn learn(&mut self, patch: usize, reflectance: Rgb, seen: &[f64]) {
        for (i, &seen) in seen.iter().enumerate().filter(|(_, seen)| **seen > 0.0) {
            self.rows[i] += seen;
            self.reflected[i] += reflectance * seen;
            self.sees[i] = Some(patch as u32);
            if let Some(&own) = self.patch_of.get(i) {
                let (a, b) = (self.part(patch as u32), self.part(own));
                self.joined[a.max(b) as usize] = a.min(b);
            }
        }
    }

    /// The patch that stands for the part of the scene that a patch belongs to.
    fn part(&mut self, mut patch: u32) -> u32 {
        while self.joined[patch as usize] != patch {
            // Halving the way keeps later ways short.
            let next = self.joined[self.joined[patch as usize] as usize];
            self.joined[patch as usize] = next;
            patch = next;
        }
        patch
    }

    /// Notes that a patch has shot.
    pub(super) fn learnt(&mut self, patch: usize) {
        if std::mem::take(&mut self.waiting[patch]) {
            self.left -= 1;
        }
    }

    /// Whether every patch has shot: then the rows are whole.
    pub(super) fn whole(&self) -> bool {
        self.left == 0
    }

    /// The patches that have not shot, in order.
    pub(super) fn waiting(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.waiting.len()).filter(|&patch| self.waiting[patch])
    }

    /// Books a shot of the first sweep.
    pub(super) fn watch(&mut self, shot: Rgb, returned: Rgb) {
        self.shot.add(shot);
        self.returned.add(returned);
    }

    /// The share of the shot power that did not come back, least channel; 1 without light.
    pub(super) fn loss(&self) -> f64 {
        1.0 - self.returned.value().share_of(self.shot.value()).max_channel()
    }

    /// The largest share of uniform light that any receiver sends back, per channel: patches
    /// that have not shot count as if they filled the rest of the view with `most` reflectance.
    pub(super) fn largest(&self, most: Rgb) -> Rgb {
        let unknown = if self.whole() { 0.0 } else { 1.0 };
        let mut largest = Rgb::ZERO;
        for (row, reflected) in self.rows.iter().zip(&self.reflected) {
            let rest = (1.0 - row).max(0.0) * unknown;
            for c in 0..3 {
                largest.0[c] = largest.0[c].max(reflected.0[c] + most.0[c] * rest);
            }
        }
        largest
    }

    /// h of an element: the mean of its corners.
    pub(super) fn of_element(&self, points: [u32; 3]) -> Rgb {
        points.iter().map(|&p| self.reflected[p as usize]).sum::<Rgb>() / 3.0
    }

    /// Trades unshot light for uniform light, such that ΣA·u = 0 in each channel of each part
    /// of the scene.
    pub(super) fn correct(&mut self, mesh: &Mesh, state: &mut State) -> Moved {
        let parts: Vec<usize> =
            (0..mesh.patches.len() as u32).map(|p| self.part(p) as usize).collect();
        let factors = self.factors(mesh, state, &parts);
        for (i, at) in state.at_points.iter_mut().enumerate() {
            if let Some(shooter) = self.sees[i] {
                *at += factors[shooter as usize] * self.reflected[i];
            }
        }
        let (mut shot, mut received) = (RgbSum::default(), RgbSum::default());
        let one = Rgb::splat(1.0);
        for (patch, &factor) in mesh.patches.iter().zip(&factors) {
            for i in patch.elements.clone().map(|e| e as usize) {
                let element = &mesh.elements[i];
                let rho = mesh.root_of(element).reflectance;
                let h = self.of_element(element.points);
                state.irradiance[i] += factor * h;
                state.unshot[i] -= factor * rho * (one - h);
                shot.add(factor * rho * element.area);
                received.add(factor * h * element.area);
            }
        }
        state.sum_patches(mesh);
        Moved { factors, shot: shot.value(), received: received.value() }
    }

    /// ΣA·u / ΣA·ρ(1 − h) of the part that each patch belongs to.
    fn factors(&self, mesh: &Mesh, state: &State, parts: &[usize]) -> Vec<Rgb> {
        let mut sums = vec![(RgbSum::default(), RgbSum::default()); parts.len()];
        let one = Rgb::splat(1.0);
        for (patch, &part) in mesh.patches.iter().zip(parts) {
            let (unshot, kept) = &mut sums[part];
            for i in patch.elements.clone().map(|e| e as usize) {
                let element = &mesh.elements[i];
                let rho = mesh.root_of(element).reflectance;
                unshot.add(state.unshot[i] * element.area);
                kept.add(rho * (one - self.of_element(element.points)) * element.area);
            }
        }
        let factor = |&part: &usize| sums[part].0.value().share_of(sums[part].1.value());
        parts.iter().map(factor).collect()
    }

    /// The factors that make every row sum to 1.
    pub(super) fn closing(&self) -> Vec<f64> {
        self.rows.iter().map(|&row| if row > 0.0 { 1.0 / row } else { 1.0 }).collect()
    }

    /// Makes every row sum to 1, in what has arrived and from now on; returns the factors and
    /// the power that the elements received more, one side.
    ///
    /// For closed scenes: there a row sum other than 1 is the quadrature's defect δ, and at
    /// reflectance ρ it is worth δ/(1 − ρ) of the light.
    pub(super) fn close(&mut self, mesh: &Mesh, state: &mut State) -> (Vec<f64>, Rgb) {
        let factors = self.closing();
        let open = state.at_points.clone();
        for (i, &k) in factors.iter().enumerate() {
            state.at_points[i] = state.at_points[i] * k;
            self.reflected[i] = self.reflected[i] * k;
        }
        let mut gained = RgbSum::default();
        for (i, element) in mesh.elements.iter().enumerate() {
            let corners = |at: &[Rgb]| element.points.iter().map(|&p| at[p as usize]).sum::<Rgb>();
            // Points inside the element follow its corners.
            let ratio = corners(&state.at_points).share_of(corners(&open));
            let closed = ratio * state.irradiance[i];
            let gain = closed - state.irradiance[i];
            state.irradiance[i] = closed;
            state.unshot[i] += mesh.root_of(element).reflectance * gain;
            gained.add(gain * element.area);
        }
        state.sum_patches(mesh);
        (factors, gained.value())
    }
}

/// The patch of each of the mesh's points, or one of them.
fn patch_of(mesh: &Mesh) -> Vec<u32> {
    let mut patch_of = vec![0; mesh.points.len()];
    for (patch, id) in mesh.patches.iter().zip(0u32..) {
        for e in patch.elements.clone() {
            for p in mesh.elements[e as usize].points {
                patch_of[p as usize] = id;
            }
        }
    }
    patch_of
}
