//! What the solution shows: the light received, and, if asked for, a guess at what is still to come.
//!
//! The guess is the ambient term of Cohen, Chen, Wallace & Greenberg (1988, section 4.3): all that
//! is unshot, and what it will still be reflected to, spread evenly over the surfaces. It never takes
//! part in the shooting.

use scene::{Rgb, Solution};

use super::Shooting;
use super::state::State;
use crate::energy::{RgbSum, Sum};
use crate::executor::Executor;
use crate::reconstruct::{self, Light};

impl<E: Executor> Shooting<'_, E> {
    /// The exitance so far, unshot light included: what leaves each element; with what is still to
    /// come, if [`ambient`](crate::ShootingConfig::ambient) light is asked for.
    #[must_use]
    pub fn solution(&self) -> Solution {
        self.solution_showing(&self.shown())
    }

    /// The irradiance at each probe, as the solution shows it.
    #[must_use]
    pub fn at_probes(&self) -> Vec<Rgb> {
        let still = self.still();
        let probes = &self.state.at_points[self.mesh.points.len()..];
        probes.iter().map(|h| with(*h, still)).collect()
    }

    /// The irradiance that the solution shows at the mesh's points.
    pub(crate) fn shown(&self) -> Vec<Rgb> {
        let own = &self.state.at_points[..self.mesh.points.len()];
        let mut shown = reconstruct::shown(self.mesh, self.census, own);
        let still = self.still();
        shown.iter_mut().for_each(|h| *h = with(*h, still));
        shown
    }

    /// The solution that shows this at the mesh's points.
    pub(crate) fn solution_showing(&self, shown: &[Rgb]) -> Solution {
        let still = self.still();
        let means = self.state.irradiance.iter().map(|h| with(*h, still));
        reconstruct::solution(self.mesh, means, shown)
    }

    /// What the solution that shows this is made of.
    pub(crate) fn into_light(self, shown: Vec<Rgb>) -> Light {
        let still = self.still();
        let State { mut irradiance, .. } = self.state;
        irradiance.iter_mut().for_each(|h| *h = with(*h, still));
        Light { irradiance, shown }
    }

    /// The irradiance that is still to come, were what is unshot spread evenly over all elements that
    /// got some light; 0 if the solution shows what was received alone.
    fn still(&self) -> Rgb {
        if !self.config.ambient {
            return Rgb::ZERO;
        }
        let (mut area, mut lit) = (Sum::default(), RgbSum::default());
        for (element, h) in self.mesh.elements.iter().zip(&self.state.irradiance) {
            area.add(element.area);
            lit.add(Rgb(h.0.map(|h| if h > 0.0 { element.area } else { 0.0 })));
        }
        let (area, lit) = (area.value(), lit.value());
        let everywhere = self.foresight.irradiance(self.net(), self.account.arriving_share());
        Rgb([0, 1, 2].map(|c| if lit[c] > 0.0 { everywhere[c] * (area / lit[c]) } else { 0.0 }))
    }

    /// What of the exitance that the solution shows is such a guess: its power, and its largest
    /// value.
    pub(super) fn guessed(&self) -> (Rgb, Rgb) {
        let (mut power, mut largest) = (RgbSum::default(), Rgb::ZERO);
        let still = self.still();
        if still != Rgb::ZERO {
            for (element, h) in self.mesh.elements.iter().zip(&self.state.irradiance) {
                let guess = self.mesh.root_of(element).reflectance * (with(*h, still) - *h);
                power.add(guess * element.area);
                largest = Rgb([0, 1, 2].map(|c| largest[c].max(guess[c])));
            }
        }
        (power.value(), largest)
    }
}

/// An irradiance with what is still to come there: nothing where no light came so far, in a dark
/// room behind a wall or under a box.
fn with(so_far: Rgb, still: Rgb) -> Rgb {
    Rgb([0, 1, 2].map(|c| if so_far[c] > 0.0 { so_far[c] + still[c] } else { so_far[c] }))
}
