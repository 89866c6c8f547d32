//! How far a matrix is from what form factors must be.

use super::Matrix;

/// A row with its sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RowSum {
    /// Which row.
    pub row: usize,
    /// The sum of its form factors.
    pub sum: f64,
}

/// What a matrix says about its own accuracy. In a closed enclosure every row sums to 1; in
/// an open scene the rest to 1 is the share that leaves, or meets a back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Defects {
    /// The row with the smallest sum, the first of equals.
    pub lowest: RowSum,
    /// The row with the largest sum, the first of equals.
    pub highest: RowSum,
    /// The largest error of one form factor.
    pub error: f64,
    /// The largest sum of the errors of one row.
    pub row_error: f64,
}

impl Defects {
    /// The row whose sum is furthest from 1.
    #[must_use]
    pub fn worst(&self) -> RowSum {
        let far = |row: RowSum| (row.sum - 1.0).abs();
        if far(self.highest) > far(self.lowest) { self.highest } else { self.lowest }
    }

    /// The largest |row sum − 1|.
    #[must_use]
    pub fn closure(&self) -> f64 {
        (self.worst().sum - 1.0).abs()
    }
}

impl Matrix {
    /// Measures the rows; `None` without any.
    #[must_use]
    pub fn defects(&self) -> Option<Defects> {
        let mut rows = (0..self.len()).map(|row| RowSum { row, sum: self.row_sum(row) });
        let first = rows.next()?;
        let (mut lowest, mut highest) = (first, first);
        for row in rows {
            if row.sum < lowest.sum {
                lowest = row;
            }
            if row.sum > highest.sum {
                highest = row;
            }
        }
        let error = self.errors.iter().copied().fold(0.0, f64::max);
        let row_error = (0..self.len()).map(|row| self.row_error(row)).fold(0.0, f64::max);
        Some(Defects { lowest, highest, error, row_error })
    }

    /// The largest difference between A_i F_ij and A_j F_ji of the stored matrix, over the
    /// smaller of the two areas: in form factors, from the smaller surface's side.
    #[must_use]
    pub fn asymmetry(&self) -> f64 {
        let mut worst = 0.0f64;
        for i in 0..self.len() {
            for entry in self.row(i) {
                let j = entry.column as usize;
                let (a, b) = (self.areas[i], self.areas[j]);
                let difference = (a * entry.value - b * self.value(j, i)).abs();
                worst = worst.max(difference / a.min(b));
            }
        }
        worst
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::Entry;

    #[test]
    fn the_worst_row_is_named() {
        let row = |sum: f64| vec![Entry { column: 1, value: sum, error: 0.125 }];
        let names = ["a", "b", "c"].map(String::from).into();
        let rows = vec![row(0.875), row(1.25), row(1.0)];
        let matrix = Matrix::from_rows(names, vec![1.0; 3], rows).unwrap();
        let defects = matrix.defects().unwrap();
        assert_eq!((defects.lowest.row, defects.highest.row), (0, 1));
        assert_eq!((defects.worst().row, defects.closure()), (1, 0.25));
        assert_eq!((defects.error, defects.row_error), (0.125, 0.125));
        assert_eq!(Matrix::default().defects(), None);
        // Row 2 gives row 1 all it has, and gets nothing back.
        assert_eq!(matrix.asymmetry(), 1.0);
    }
}
