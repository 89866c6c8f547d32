//! Shooting more than there is: what a patch will receive before its next turn, in advance.
//!
//! Light that others have not shot yet will come to the patch that shoots now, and some of it would
//! have to be shot again. So the patch shoots that too, and owes it: its unshot light is negative
//! until what was foreseen arrives (Feda & Purgathofer 1992, "Accelerating radiosity by
//! overshooting"). The light converges to the same; a wrong guess costs a shot, never an error.

use scene::Rgb;

use super::Shooting;
use super::ambient::{LOSS_OF_PLAIN, Phase};
use super::state::State;
use crate::energy::RgbSum;
use crate::executor::Executor;
use crate::mesh::Mesh;

/// No more bounces are foreseen than of a light of which this share comes back each time: where
/// more does, ambient corrections take over, and until then guesses must not run away.
const MOST_RETURNED: f64 = 0.6;

/// With a mean reflectance below this, the first sweep will show that corrections are not worth
/// their while: a little less than what they are decided by.
const MOST_PLAIN: f64 = 1.0 - LOSS_OF_PLAIN - 0.05;

/// What is the same for all patches.
#[derive(Clone, Debug, Default)]
pub(super) struct Foresight {
    /// Area of all elements, and of each channel's reflectance over them.
    area: f64,
    reflecting: Rgb,
    /// Reflectance over the area of each patch.
    of_patches: Vec<Rgb>,
}

impl Foresight {
    pub(super) fn of(mesh: &Mesh) -> Self {
        let mut foresight = Self::default();
        for patch in &mesh.patches {
            let mut reflecting = Rgb::ZERO;
            for e in patch.elements.clone() {
                let element = &mesh.elements[e as usize];
                reflecting += mesh.root_of(element).reflectance * element.area;
                foresight.area += element.area;
            }
            foresight.reflecting += reflecting;
            foresight.of_patches.push(reflecting);
        }
        foresight
    }

    /// The irradiance that each element may expect, were this unshot power and all that is reflected
    /// of it spread evenly; `arrives` is the share of what is shot that meets an element.
    pub(super) fn irradiance(&self, unshot: Rgb, arrives: Rgb) -> Rgb {
        let reflected = self.reflecting.share_of(Rgb::splat(self.area));
        Rgb([0, 1, 2].map(|c| {
            let returned = (arrives[c] * reflected[c]).clamp(0.0, MOST_RETURNED);
            (unshot[c] * arrives[c] / self.area / (1.0 - returned)).max(0.0)
        }))
    }
}

impl<E: Executor> Shooting<'_, E> {
    /// Adds to the unshot light of these patches what they will still receive and reflect; returns
    /// what their elements owe for it, in their order.
    ///
    /// An element that received less than others so far expects less in the same measure: nothing
    /// where no light comes.
    pub(super) fn foresee(&mut self, patches: &[usize]) -> Vec<Rgb> {
        if !self.overshoots() {
            return Vec::new();
        }
        let (all, arrives) = (self.net(), self.account.arriving_share());
        let mut owed = Vec::new();
        let mean = self.account.arrived() / self.foresight.area;
        for &patch in patches {
            let own = self.state.patch_net[patch];
            let even = self.foresight.irradiance(all - own, arrives);
            // A patch that owes shoots what it owes: it foresaw too much.
            let even = Rgb([0, 1, 2].map(|c| if own[c] > 0.0 { even[c] } else { 0.0 }));
            for e in self.mesh.patches[patch].elements.clone().map(|e| e as usize) {
                let reflectance = self.mesh.root_of(&self.mesh.elements[e]).reflectance;
                let so_far = self.state.irradiance[e].share_of(mean);
                owed.push(reflectance * even * Rgb([0, 1, 2].map(|c| so_far[c].clamp(0.0, 1.0))));
            }
        }
        let State { unshot, .. } = &mut self.state;
        let elements = patches.iter().flat_map(|&p| self.mesh.patches[p].elements.clone());
        elements.zip(&owed).for_each(|(e, more)| unshot[e as usize] += *more);
        owed
    }

    /// Whether it pays and does no harm. Rows that will be closed are learnt from the first sweep:
    /// its shots must be cut into the same cells as later ones, and not be brighter than they are.
    fn overshoots(&self) -> bool {
        // Without corrections, guesses of bounces that come back again and again run away.
        let learning = self.ambient.as_ref().is_none_or(|a| a.phase != Phase::LeftOut);
        let closed = || !self.census.is_empty() && !self.census.any_lost();
        let mean = self.foresight.reflecting.share_of(Rgb::splat(self.foresight.area));
        let stiff = mean.max_channel() > MOST_PLAIN;
        self.config.overshoot && !(learning && stiff && closed())
    }

    /// The unshot power of each patch that is worth a shot: all of it, but what is owed for light
    /// that will come.
    pub(super) fn worth_shooting(&self) -> Vec<Rgb> {
        let State { patch_power, patch_net, .. } = &self.state;
        if !self.overshoots() {
            return patch_power.clone();
        }
        let even = self.foresight.irradiance(self.net(), self.account.arriving_share());
        let of_patch = |((power, net), reflecting): ((&Rgb, &Rgb), &Rgb)| {
            let expected = *reflecting * even;
            Rgb([0, 1, 2].map(|c| power[c] - (-net[c]).clamp(0.0, expected[c])))
        };
        patch_power.iter().zip(patch_net).zip(&self.foresight.of_patches).map(of_patch).collect()
    }

    /// ΣAu, one side.
    pub(super) fn net(&self) -> Rgb {
        let mut net = RgbSum::default();
        self.state.patch_net.iter().for_each(|of_patch| net.add(*of_patch));
        net.value()
    }

    /// Takes back what was added: the light of these patches was not shot after all.
    pub(super) fn forget(&mut self, patches: &[usize], before: &[Rgb]) {
        let elements = patches.iter().flat_map(|&p| self.mesh.patches[p].elements.clone());
        elements.zip(before).for_each(|(e, unshot)| self.state.unshot[e as usize] = *unshot);
    }

    /// Marks the light of these patches as shot, with what they owe.
    pub(super) fn settle(&mut self, patches: &[usize], owed: &[Rgb]) {
        let elements = patches.iter().flat_map(|&p| self.mesh.patches[p].elements.clone());
        for (i, e) in elements.enumerate() {
            self.state.unshot[e as usize] = owed.get(i).map_or(Rgb::ZERO, |owed| *owed * -1.0);
        }
    }
}
