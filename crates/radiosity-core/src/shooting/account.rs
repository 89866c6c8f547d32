//! Where the power went: the books of the shots.

use scene::Rgb;

use super::{Shooting, sides};
use crate::census::Lost;
use crate::energy::{Ledger, RgbSum};
use crate::executor::Executor;

/// Sums over the shots so far, W per channel.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Account {
    pub(super) escaped: RgbSum,
    pub(super) sampled_escape: RgbSum,
    pub(super) wrong_side: RgbSum,
    /// Arrived at elements.
    pub(super) received: RgbSum,
    /// Arrived at black surfaces that receive nothing, as the census samples it.
    pub(super) black: RgbSum,
}

impl Account {
    /// The share of what was shot that met an element; all before the first shot.
    pub(super) fn arriving_share(&self) -> Rgb {
        let (received, lost) = (self.arrived(), self.escaped.value());
        let shot = received + lost + self.wrong_side.value();
        let share = received.share_of(shot);
        Rgb([0, 1, 2].map(|c| if shot[c] > 0.0 { share[c].clamp(0.0, 1.0) } else { 1.0 }))
    }

    /// What met a surface.
    pub(super) fn arrived(&self) -> Rgb {
        self.received.value() + self.black.value()
    }

    /// Books power that was shot, of which this much arrived: what no element received met a
    /// back or escaped. Without a census (`sampled` is `None`), all of it escaped.
    pub(super) fn book(&mut self, rest: Rgb, sampled: Option<Lost>) {
        let Lost { wrong_side, black, .. } = sampled.unwrap_or_default();
        self.wrong_side.add(wrong_side);
        self.black.add(black);
        self.escaped.add(rest - wrong_side - black);
        self.sampled_escape.add(sampled.map_or(rest, |lost| lost.escaped));
    }
}

impl<E: Executor> Shooting<'_, E> {
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
        let mut defect = self.account.escaped;
        defect.add(self.account.sampled_escape.value() * -1.0);
        absorbed.add(self.account.black.value());
        Ledger {
            emitted: self.emitted,
            absorbed: absorbed.value(),
            escaped: self.account.escaped.value(),
            form_factor_defect: defect.value(),
            wrong_side: self.account.wrong_side.value(),
            unshot: unshot.value(),
        }
    }

    /// What of the light that met black surfaces is to be booked: none where they receive it.
    pub(super) fn black_share(&self, sampled: Rgb) -> Rgb {
        if self.black.is_empty() { Rgb::ZERO } else { sampled }
    }

    /// Where an exitance ρ of all elements, times the factor of their patch, is lost, as the
    /// census samples it.
    pub(super) fn uniform_loss(&self, factors: &[Rgb]) -> Lost {
        let k = sides(self.config.exchange);
        let reflectance: Vec<Rgb> =
            self.mesh.elements.iter().map(|e| self.mesh.root_of(e).reflectance).collect();
        let mut all = Lost::default();
        for (i, (patch, &factor)) in self.mesh.patches.iter().zip(factors).enumerate() {
            let power: Rgb = patch
                .elements
                .clone()
                .map(|e| reflectance[e as usize] * (self.mesh.elements[e as usize].area * k))
                .sum();
            let lost = self.census.lost(i, power, &reflectance);
            all.wrong_side += lost.wrong_side * factor;
            all.escaped += lost.escaped * factor;
            all.black += self.black_share(lost.black) * factor;
        }
        all
    }
}
