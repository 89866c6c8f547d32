//! Where the emitted power went, to the last bit that f64 can tell.

use scene::Rgb;

use crate::checkpoint::{Inconsistent, Reader, Record, record};

/// A sum that keeps what f64 rounds away (Neumaier 1974).
#[derive(Clone, Copy, Debug, Default)]
pub struct Sum {
    total: f64,
    lost: f64,
}

impl Sum {
    /// Adds one term.
    pub fn add(&mut self, term: f64) {
        let next = self.total + term;
        self.lost += if self.total.abs() >= term.abs() {
            (self.total - next) + term
        } else {
            (term - next) + self.total
        };
        self.total = next;
    }

    /// The sum so far.
    #[must_use]
    pub fn value(self) -> f64 {
        self.total + self.lost
    }
}

/// A compensated sum per channel.
#[derive(Clone, Copy, Debug, Default)]
pub struct RgbSum([Sum; 3]);

impl RgbSum {
    /// Adds one term.
    pub fn add(&mut self, term: Rgb) {
        for (sum, channel) in self.0.iter_mut().zip(term.0) {
            sum.add(channel);
        }
    }

    /// The sum so far.
    #[must_use]
    pub fn value(self) -> Rgb {
        Rgb(self.0.map(Sum::value))
    }
}

record!(Sum { total, lost });

impl Record for RgbSum {
    fn write(&self, out: &mut dyn std::io::Write) -> std::io::Result<()> {
        self.0.write(out)
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Inconsistent> {
        Ok(Self(Record::read(from)?))
    }
}

/// Where the emitted power went, W per channel:
/// emitted = absorbed + escaped + wrong side + unshot.
///
/// Each term is summed on its own path through the solver, so [`Ledger::imbalance`] finds
/// light that was lost or made; it is a check for bugs, not a measure of accuracy.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Ledger {
    /// ΣA·E over all lit sides.
    pub emitted: Rgb,
    /// Received and not reflected.
    pub absorbed: Rgb,
    /// Shot, and neither received nor met by a back: light that left an open scene, and
    /// with it the defect of the form factors, of either sign.
    pub escaped: Rgb,
    /// The part of `escaped` that no sampled direction confirms: an estimate of what the
    /// form factors lost (above 0) or made (below 0). Exact in a closed scene.
    pub form_factor_defect: Rgb,
    /// Met the back of a one-sided surface, and stayed there.
    pub wrong_side: Rgb,
    /// Received or emitted, and not shot yet.
    pub unshot: Rgb,
}

record!(Ledger { emitted, absorbed, escaped, form_factor_defect, wrong_side, unshot });

impl Ledger {
    /// |emitted − absorbed − escaped − wrong side − unshot| / emitted, worst channel;
    /// 0 in a channel without light.
    #[must_use]
    pub fn imbalance(&self) -> f64 {
        let mut worst = 0.0f64;
        for c in 0..3 {
            if self.emitted[c] > 0.0 {
                let mut sum = Sum::default();
                sum.add(self.emitted[c]);
                for term in [self.absorbed, self.escaped, self.wrong_side, self.unshot] {
                    sum.add(-term[c]);
                }
                worst = worst.max(sum.value().abs() / self.emitted[c]);
            }
        }
        worst
    }

    /// A term over the emitted power, all channels together; 0 without light.
    #[must_use]
    pub fn share(&self, term: Rgb) -> f64 {
        let emitted = self.emitted.sum();
        if emitted > 0.0 { term.sum() / emitted } else { 0.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn compensated_sum_keeps_small_terms() {
        // 1 + 1e-17·1e5 − 1 = 1e-12; a plain f64 sum gives 0.
        let mut sum = Sum::default();
        sum.add(1.0);
        for _ in 0..100_000 {
            sum.add(1e-17);
        }
        sum.add(-1.0);
        assert!((sum.value() - 1e-12).abs() < 1e-24, "{}", sum.value());
    }
}
