//! Form factors as a stored matrix: computed, closed and solved.
//!
//! For up to some thousand surfaces the whole matrix F fits in memory: it can be written out,
//! its defects can be read off, and light can be shot through it as often as one likes,
//! without a further form factor. [`Surfaces`] says what the rows are, [`compute`] fills
//! them, [`Matrix::defects`] judges them, [`Matrix::close`] repairs those of a closed
//! enclosure and [`MatrixShooting`] solves B = E + ρ F B.
//!
//! # Examples
//! Two plates that see only each other, the first of them shining:
//! B₁ = 1 + ρ B₂ and B₂ = ρ B₁, so B₁ = 1 / (1 − ρ²).
//!
//! ```
//! use radiosity_core::matrix::{Entry, Matrix, MatrixConfig, MatrixShooting};
//! use scene::Rgb;
//!
//! let sees = |column| vec![Entry { column, value: 1.0, error: 0.0 }];
//! let names = vec!["front".into(), "back".into()];
//! let plates = Matrix::from_rows(names, vec![1.0, 1.0], vec![sees(1), sees(0)])?;
//! let (reflectance, emittance) = ([Rgb::splat(0.5); 2], [Rgb::splat(1.0), Rgb::ZERO]);
//! let mut shooting =
//!     MatrixShooting::new(&plates, &reflectance, &emittance, MatrixConfig::until(1e-12))?;
//! shooting.run();
//! assert!((shooting.exitance()[0][0] - 4.0 / 3.0).abs() < 1e-11);
//! # Ok::<(), radiosity_core::matrix::Error>(())
//! ```

mod closure;
mod component;
mod compute;
mod defects;
mod deflation;
mod error;
mod scale;
mod shooting;
mod surfaces;

pub use closure::Closed;
pub use compute::{ComputeConfig, Computed, compute};
pub use defects::{Defects, RowSum};
pub use error::Error;
pub use shooting::{MatrixConfig, MatrixShooting, Method};
pub use surfaces::{Between, Surfaces};

use crate::energy::Sum;

/// One stored form factor of a row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry {
    /// The receiving surface.
    pub column: u32,
    /// The share of the light leaving the row's surface that arrives there.
    pub value: f64,
    /// How far the value may be from the truth.
    pub error: f64,
}

/// Form factors F between surfaces, row by row, zeros left out (compressed sparse rows),
/// with the surfaces' names and areas.
///
/// 20 bytes per stored form factor.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Matrix {
    names: Vec<String>,
    areas: Vec<f64>,
    /// Row i is `starts[i]..starts[i + 1]` of the three below.
    starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
    errors: Vec<f64>,
}

impl Matrix {
    /// A matrix from its rows, each in ascending order of columns. An entry whose value and
    /// error are both 0 is left out; a 0 that may be wrong is kept.
    ///
    /// # Errors
    /// [`Error::Length`] if names, areas and rows differ in number; [`Error::Area`] for an
    /// area that is not finite and above 0; [`Error::Entry`] for a column out of range or
    /// out of order, or a value or error that is not finite and at least 0.
    pub fn from_rows(
        names: Vec<String>,
        areas: Vec<f64>,
        rows: Vec<Vec<Entry>>,
    ) -> Result<Self, Error> {
        for (what, found) in [("areas", areas.len()), ("rows", rows.len())] {
            if found != names.len() {
                return Err(Error::Length { what, expected: names.len(), found });
            }
        }
        if let Some(row) = areas.iter().position(|a| !(a.is_finite() && *a > 0.0)) {
            return Err(Error::Area { row });
        }
        let stored = rows.iter().map(Vec::len).sum();
        let mut matrix = Self {
            starts: Vec::with_capacity(names.len() + 1),
            columns: Vec::with_capacity(stored),
            values: Vec::with_capacity(stored),
            errors: Vec::with_capacity(stored),
            names,
            areas,
        };
        matrix.starts.push(0);
        for (row, entries) in rows.into_iter().enumerate() {
            check_row(row, &entries, matrix.len())?;
            for entry in entries.iter().filter(|e| e.value > 0.0 || e.error > 0.0) {
                matrix.columns.push(entry.column);
                matrix.values.push(entry.value);
                matrix.errors.push(entry.error);
            }
            matrix.starts.push(matrix.columns.len());
        }
        Ok(matrix)
    }

    /// How many surfaces there are.
    #[must_use]
    pub fn len(&self) -> usize {
        self.areas.len()
    }

    /// Whether there are no surfaces.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.areas.is_empty()
    }

    /// What the surfaces are called.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The surfaces' areas.
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// Where each row starts in [`columns`](Self::columns), [`values`](Self::values) and
    /// [`errors`](Self::errors), and where the last one ends.
    #[must_use]
    pub fn starts(&self) -> &[usize] {
        &self.starts
    }

    /// The receiving surfaces, row after row.
    #[must_use]
    pub fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// The form factors, row after row.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The errors of the form factors, row after row.
    #[must_use]
    pub fn errors(&self) -> &[f64] {
        &self.errors
    }

    /// The stored form factors of a row.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn row(&self, row: usize) -> impl Iterator<Item = Entry> + '_ {
        let range = self.starts[row]..self.starts[row + 1];
        range.map(|k| Entry {
            column: self.columns[k],
            value: self.values[k],
            error: self.errors[k],
        })
    }

    /// The form factor from one surface to another; 0 where none is stored.
    ///
    /// # Panics
    /// If there is no such row.
    #[must_use]
    pub fn value(&self, row: usize, column: usize) -> f64 {
        let range = self.starts[row]..self.starts[row + 1];
        let found = self.columns[range.clone()].binary_search_by_key(&column, |c| *c as usize);
        found.map_or(0.0, |k| self.values[range.start + k])
    }

    /// The share of the light leaving a surface that arrives anywhere.
    ///
    /// # Panics
    /// If there is no such row.
    #[must_use]
    pub fn row_sum(&self, row: usize) -> f64 {
        sum(self.row(row).map(|e| e.value))
    }

    /// How far the sum of a row may be from the truth, all its errors taken together.
    ///
    /// # Panics
    /// If there is no such row.
    #[must_use]
    pub fn row_error(&self, row: usize) -> f64 {
        sum(self.row(row).map(|e| e.error))
    }
}

/// A compensated sum.
fn sum(terms: impl Iterator<Item = f64>) -> f64 {
    let mut sum = Sum::default();
    terms.for_each(|term| sum.add(term));
    sum.value()
}

fn check_row(row: usize, entries: &[Entry], len: usize) -> Result<(), Error> {
    let valid = |x: f64| x.is_finite() && x >= 0.0;
    let ordered = entries.windows(2).all(|w| w[0].column < w[1].column);
    let wrong = |e: &Entry| e.column as usize >= len || !valid(e.value) || !valid(e.error);
    if !ordered || entries.iter().any(wrong) {
        return Err(Error::Entry { row });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn entry(column: u32, value: f64, error: f64) -> Entry {
        Entry { column, value, error }
    }

    fn build(areas: Vec<f64>, rows: Vec<Vec<Entry>>) -> Result<Matrix, Error> {
        let names = (0..rows.len()).map(|i| i.to_string()).collect();
        Matrix::from_rows(names, areas, rows)
    }

    #[test]
    fn zeros_are_left_out_unless_they_may_be_wrong() {
        let row = vec![entry(0, 0.0, 0.0), entry(1, 0.25, 0.0), entry(2, 0.0, 1e-3)];
        let matrix = build(vec![1.0; 3], vec![row, vec![], vec![]]).unwrap();
        assert_eq!(matrix.columns(), [1, 2]);
        assert_eq!((matrix.value(0, 1), matrix.value(0, 0)), (0.25, 0.0));
        assert_eq!((matrix.row_sum(0), matrix.row_error(0)), (0.25, 1e-3));
        assert_eq!(matrix.starts(), [0, 2, 2, 2]);
    }

    #[test]
    fn what_no_form_factor_can_be_is_refused() {
        for row in [
            vec![entry(2, 0.5, 0.0)],
            vec![entry(1, 0.5, 0.0), entry(0, 0.5, 0.0)],
            vec![entry(1, f64::NAN, 0.0)],
            vec![entry(1, -0.1, 0.0)],
            vec![entry(1, 0.1, f64::INFINITY)],
        ] {
            let rows = vec![vec![], row];
            assert_eq!(build(vec![1.0; 2], rows), Err(Error::Entry { row: 1 }));
        }
        assert_eq!(build(vec![1.0, 0.0], vec![vec![]; 2]), Err(Error::Area { row: 1 }));
        let lengths = Error::Length { what: "areas", expected: 2, found: 1 };
        assert_eq!(build(vec![1.0], vec![vec![]; 2]), Err(lengths));
    }
}
