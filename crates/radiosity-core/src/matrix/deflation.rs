//! Deflation: one shot of all surfaces at once, as bright as the light still on its way.

use scene::Rgb;

use super::Matrix;
use super::component::parts;
use crate::energy::RgbSum;

/// What a shot of every surface with exitance ρ brings, worked out once.
///
/// Plain shooting moves the mean of the unshot light by one bounce a sweep, which takes
/// 6.9 / (1 − ρ) sweeps for six digits. Deflation shoots a·ρ from every surface at once, in
/// each channel, with the a that leaves no unshot power on the whole: what remains has both
/// signs, and dies out as quickly as the light evens out. Parts of the scene that no light
/// joins have each their own a.
///
/// # References
/// The ambient term of Cohen, Chen, Wallace & Greenberg 1988, put into the iteration.
#[derive(Clone, Debug)]
pub(super) struct Deflation {
    /// Which part of the scene each surface belongs to.
    part: Vec<usize>,
    /// Power that arrives at each surface when each shoots exitance ρ.
    arriving: Vec<Rgb>,
    /// What it then has more to shoot than before, below zero where it absorbs or loses.
    gain: Vec<Rgb>,
    /// Power that a part loses, absorbed or gone: −Σ gain.
    loss: Vec<Rgb>,
    /// The part of it that no surface receives.
    escaping: Vec<Rgb>,
}

impl Deflation {
    pub(super) fn new(matrix: &Matrix, areas: &[f64], reflectance: &[Rgb]) -> Self {
        let part = parts(matrix);
        let arriving = arriving(matrix, areas, reflectance);
        let mut gain = Vec::with_capacity(areas.len());
        let mut loss = vec![RgbSum::default(); areas.len()];
        let mut escaping = loss.clone();
        for (i, rho) in reflectance.iter().enumerate() {
            let sent = *rho * areas[i];
            gain.push(*rho * arriving[i] - sent);
            loss[part[i]].add(gain[i] * -1.0);
            escaping[part[i]].add(sent * (1.0 - matrix.row_sum(i)));
        }
        let values = |sums: Vec<RgbSum>| sums.into_iter().map(RgbSum::value).collect();
        Self { part, arriving, gain, loss: values(loss), escaping: values(escaping) }
    }

    /// Shoots a·ρ from every surface; what leaves the scene is added to `escaped`.
    pub(super) fn shoot(&self, received: &mut [Rgb], unshot: &mut [Rgb], escaped: &mut RgbSum) {
        let mut power = vec![RgbSum::default(); self.part.len()];
        self.part.iter().zip(&*unshot).for_each(|(part, u)| power[*part].add(*u));
        let share = |(power, loss): (RgbSum, &Rgb)| {
            let power = power.value();
            let share = |c: usize| if loss[c] > 0.0 { power[c] / loss[c] } else { 0.0 };
            Rgb([0, 1, 2].map(share))
        };
        let share: Vec<Rgb> = power.into_iter().zip(&self.loss).map(share).collect();
        for (i, part) in self.part.iter().enumerate() {
            received[i] += share[*part] * self.arriving[i];
            unshot[i] += share[*part] * self.gain[i];
        }
        share.iter().zip(&self.escaping).for_each(|(a, e)| escaped.add(*a * *e));
    }
}

/// The power that exitance ρ everywhere brings, Σ_j A_j F_ji ρ_j: the columns of F, so that
/// not a bit of it is lost where rows and columns do not match.
fn arriving(matrix: &Matrix, areas: &[f64], reflectance: &[Rgb]) -> Vec<Rgb> {
    let mut power = vec![RgbSum::default(); matrix.len()];
    for (j, rho) in reflectance.iter().enumerate() {
        for entry in matrix.row(j) {
            power[entry.column as usize].add(*rho * (areas[j] * entry.value));
        }
    }
    power.into_iter().map(RgbSum::value).collect()
}
