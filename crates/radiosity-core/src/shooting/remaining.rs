//! The most that further shooting can still add.

use scene::Rgb;

use super::Shooting;
use crate::energy::RgbSum;
use crate::executor::Executor;

/// An upper bound on what infinitely many further shots would change, over a mesh whose rows sum
/// to at most 1.
///
/// Without overshooting and corrections u ≥ 0, and the light so far is a lower bound. With u the
/// unshot exitance and K the transfer, what is missing is e = Σ_{k≥1} (ρK)^k u, and |e| is at
/// most what |u| would bring. Where the solution shows an ambient guess a of it, |e − a| ≤ |e| + a.
/// Where h = Kρ is known, K(ρh) ≤ h·max h makes W = h/(1 − max h) satisfy W ≥ K(ρ(1 + W)),
/// and so ΣA·e ≤ ΣA·|u|·W by A·K's symmetry, e ≤ ρ·max|u|/(1 − max h). Otherwise max ρ stands
/// for h in both. Far tighter where reflectances are mixed: what counts is the most reflective
/// view, not the most reflective element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Remaining {
    /// ΣA·e, W per channel, one side.
    pub power: Rgb,
    /// The largest e of an element, W·m⁻² per channel.
    pub local: Rgb,
}

impl<E: Executor> Shooting<'_, E> {
    /// Bounds what is still missing; infinite where nothing is known to absorb.
    #[must_use]
    pub fn remaining(&self) -> Remaining {
        let most = self.most_reflectance();
        let largest = self.ambient.as_ref().map_or(most, |ambient| {
            let seen = ambient.largest(most);
            Rgb([0, 1, 2].map(|c| seen[c].min(most[c])))
        });
        let known = self.ambient.as_ref().filter(|ambient| ambient.whole());
        let mut power = RgbSum::default();
        let mut local = Rgb::ZERO;
        for (element, u) in self.mesh.elements.iter().zip(&self.state.unshot) {
            let u = u.abs();
            let weight = known.map_or(largest, |ambient| ambient.of_element(element.points));
            power.add(u * weight * element.area);
            local = Rgb([0, 1, 2].map(|c| local[c].max(u[c])));
        }
        let amplified = |value: Rgb| {
            Rgb([0, 1, 2].map(|c| match 1.0 - largest[c] {
                _ if value[c] == 0.0 => 0.0,
                rest if rest > 0.0 => value[c] / rest,
                _ => f64::INFINITY,
            }))
        };
        let (guessed, most_guessed) = self.guessed();
        let (power, local) = (amplified(power.value()), amplified(local * most));
        Remaining { power: power + guessed, local: local + most_guessed }
    }

    /// The largest reflectance of the mesh, per channel.
    pub(super) fn most_reflectance(&self) -> Rgb {
        let largest = |a: Rgb, b: Rgb| Rgb([0, 1, 2].map(|c| a[c].max(b[c])));
        self.mesh.roots.iter().map(|r| r.reflectance).fold(Rgb::ZERO, largest)
    }
}
