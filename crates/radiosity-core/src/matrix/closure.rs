//! Closure: the rows of a closed enclosure brought to a sum of 1, reciprocity kept.

use super::{Error, Matrix, sum};

/// Rounds of scaling before giving up. A round multiplies what is left by at most
/// (1 − λ)/2, λ the least eigenvalue of F: .7 for a cube, so some hundred rounds reach the
/// last bit; a matrix that needs more has no closure.
const MAX_ROUNDS: u32 = 2_000;

/// Row sums that stay further from 1 than this were not closed: rounding alone, over rows
/// of a million form factors, stays below.
const LEFT_OVER: f64 = 1e-12;

/// Row sums count as right within this many times their errors taken together, which are
/// estimates themselves.
const BENEFIT_OF_DOUBT: f64 = 2.0;

/// Beside the stated errors, the rounding of a row's form factors.
const ROW_ROUNDING: f64 = 1e-9;

/// What closing changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closed {
    /// The largest |row sum − 1| before.
    pub before: f64,
    /// The largest |row sum − 1| after.
    pub after: f64,
    /// The largest change of one form factor.
    pub change: f64,
    /// The largest change of one form factor over its value.
    pub relative_change: f64,
    /// Rounds of scaling.
    pub rounds: u32,
}

impl Matrix {
    /// Brings every row of a closed enclosure to a sum of 1.
    ///
    /// The exchange areas S_ij = A_i F_ij become d_i S_ij d_j, with the factors d > 0 for
    /// which every row of S sums to its area: so S stays symmetric, form factors stay at
    /// least 0, zeros stay zeros, and no form factor is changed by much more than the rows
    /// it is in were wrong. Errors keep their size relative to the form factors, and grow by
    /// the change. The factors are iterated as d_i ← d_i √(A_i / Σ_j d_i S_ij d_j): the
    /// square root keeps symmetric scaling from swinging. (Least squares, van Leersum 1989
    /// and Loehrke, Dolaghan & Burns 1995, would weigh entries by their errors, but can make
    /// small ones negative.)
    ///
    /// A scene that is open, or shows backs, has nothing to repair: its row sums are right
    /// below 1. So a row further from 1 than twice its form factors' errors taken together
    /// is refused, and the matrix is left as it was.
    ///
    /// Each pair's exchange is taken as the mean of both directions, which changes nothing in
    /// a matrix that [`compute`](super::compute) made.
    ///
    /// # Errors
    /// [`Error::Open`] for the row that misses 1 by the most; [`Error::NotClosable`] if no
    /// factors exist.
    ///
    /// # References
    /// Sinkhorn & Knopp 1967 (existence); Knight, Ruiz & Uçar 2014, "A symmetry preserving
    /// algorithm for matrix scaling", §1.
    pub fn close(&mut self) -> Result<Closed, Error> {
        let Some(defects) = self.defects() else {
            return Ok(Closed {
                before: 0.0,
                after: 0.0,
                change: 0.0,
                relative_change: 0.0,
                rounds: 0,
            });
        };
        self.refuse_open()?;
        let exchange = self.exchange();
        let (factors, rounds) = self.factors(&exchange);
        let mut closed = self.clone();
        let (mut change, mut relative_change) = (0.0f64, 0.0f64);
        for i in 0..self.len() {
            let range = self.starts[i]..self.starts[i + 1];
            for (k, entry) in range.zip(self.row(i)) {
                let old = entry.value;
                let both = factors[i] * factors[entry.column as usize];
                let new = both * exchange[k] / self.areas[i];
                closed.values[k] = new;
                let ratio = if old > 0.0 { new / old } else { 1.0 };
                closed.errors[k] = entry.error * ratio + (new - old).abs();
                change = change.max((new - old).abs());
                relative_change = relative_change.max((ratio - 1.0).abs());
            }
        }
        let after = closed.defects().map_or(0.0, |d| d.closure());
        if after > LEFT_OVER || factors.iter().any(|d| !(d.is_finite() && *d > 0.0)) {
            return Err(Error::NotClosable { defect: after });
        }
        *self = closed;
        Ok(Closed { before: defects.closure(), after, change, relative_change, rounds })
    }

    /// Finds the row that misses 1 by the most, where its errors do not allow it.
    fn refuse_open(&self) -> Result<(), Error> {
        let mut worst: Option<(f64, Error)> = None;
        for row in 0..self.len() {
            let (sum, stated) = (self.row_sum(row), self.row_error(row));
            let error = BENEFIT_OF_DOUBT * stated + ROW_ROUNDING;
            let defect = (sum - 1.0).abs();
            if defect > error && worst.as_ref().is_none_or(|(most, _)| defect > *most) {
                worst = Some((defect, Error::Open { name: self.names[row].clone(), sum, error }));
            }
        }
        worst.map_or(Ok(()), |(_, error)| Err(error))
    }

    /// The exchange area of each stored entry, both directions' mean.
    fn exchange(&self) -> Vec<f64> {
        // One walk over the rows meets the entries of each column in ascending order of
        // rows, so a cursor per row finds the mirrored entry without a search.
        let mut cursor = self.starts.clone();
        let mut exchange: Vec<f64> = vec![0.0; self.values.len()];
        for i in 0..self.len() {
            for k in self.starts[i]..self.starts[i + 1] {
                let j = self.columns[k] as usize;
                exchange[k] += 0.5 * self.areas[i] * self.values[k];
                let end = self.starts[j + 1];
                while cursor[j] < end && (self.columns[cursor[j]] as usize) < i {
                    cursor[j] += 1;
                }
                if cursor[j] < end && self.columns[cursor[j]] as usize == i {
                    exchange[cursor[j]] += 0.5 * self.areas[i] * self.values[k];
                }
            }
        }
        exchange
    }

    /// The factors d, iterated until rounding hides what is still gained, and the rounds.
    fn factors(&self, exchange: &[f64]) -> (Vec<f64>, u32) {
        let mut factors = vec![1.0; self.len()];
        let mut best = f64::INFINITY;
        for round in 0..MAX_ROUNDS {
            let row_sum = |i: usize| {
                let range = self.starts[i]..self.starts[i + 1];
                let seen = range.map(|k| exchange[k] * factors[self.columns[k] as usize]);
                factors[i] * sum(seen) / self.areas[i]
            };
            let sums: Vec<f64> = (0..self.len()).map(row_sum).collect();
            let defect = sums.iter().map(|s| (s - 1.0).abs()).fold(0.0, f64::max);
            if defect == 0.0 || (defect <= LEFT_OVER && defect >= best) {
                return (factors, round);
            }
            best = best.min(defect);
            factors.iter_mut().zip(&sums).for_each(|(d, s)| *d /= s.sqrt());
        }
        (factors, MAX_ROUNDS)
    }
}
