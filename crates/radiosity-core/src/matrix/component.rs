//! Light that nothing absorbs: surfaces that see only each other and reflect everything.

use scene::Rgb;

use super::{Error, Matrix};

/// A row that misses 1 by no more than this, beside its errors, is closed: the rounding of
/// its form factors.
const ROUNDING: f64 = 1e-12;

/// Refuses a channel in which light enters a closed part of the scene where every
/// reflectance is 1.
pub(super) fn refuse_endless(
    matrix: &Matrix,
    reflectance: &[Rgb],
    emittance: &[Rgb],
) -> Result<(), Error> {
    (0..3).try_for_each(|c| {
        let lossless: Vec<bool> =
            (0..matrix.len()).map(|i| reflectance[i][c] == 1.0 && is_closed(matrix, i)).collect();
        // The rule, and worth no look at who sees whom.
        if !lossless.contains(&true) {
            return Ok(());
        }
        let part = parts(matrix);
        let (mut loses, mut lit) = (vec![false; matrix.len()], vec![false; matrix.len()]);
        for i in 0..matrix.len() {
            loses[part[i]] |= !lossless[i];
            lit[part[i]] |= emittance[i][c] > 0.0;
        }
        let endless = (0..matrix.len()).find(|&i| lit[part[i]] && !loses[part[i]]);
        endless.map_or(Ok(()), |i| Err(Error::Singular { name: matrix.names[i].clone() }))
    })
}

/// Whether what leaves a surface cannot be told from what arrives elsewhere.
fn is_closed(matrix: &Matrix, row: usize) -> bool {
    1.0 - matrix.row_sum(row) <= matrix.row_error(row) + ROUNDING
}

/// For each surface, the first surface of those that light joins it to.
pub(super) fn parts(matrix: &Matrix) -> Vec<usize> {
    let mut first: Vec<usize> = (0..matrix.len()).collect();
    for i in 0..matrix.len() {
        for entry in matrix.row(i).filter(|e| e.value > 0.0) {
            let (a, b) = (find(&mut first, i), find(&mut first, entry.column as usize));
            first[a.max(b)] = a.min(b);
        }
    }
    (0..matrix.len()).map(|i| find(&mut first, i)).collect()
}

/// The first surface of a part, with the path to it halved on the way.
fn find(first: &mut [usize], mut i: usize) -> usize {
    while first[i] != i {
        first[i] = first[first[i]];
        i = first[i];
    }
    i
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::Entry;

    /// Two pairs of plates that see only their partner.
    fn two_pairs() -> Matrix {
        let sees = |column| vec![Entry { column, value: 1.0, error: 0.0 }];
        let names = ["a", "b", "c", "d"].map(String::from).into();
        Matrix::from_rows(names, vec![1.0; 4], vec![sees(1), sees(0), sees(3), sees(2)]).unwrap()
    }

    #[test]
    fn only_light_that_reaches_the_lossless_part_is_endless() {
        let matrix = two_pairs();
        let rho = [0.5, 1.0, 1.0, 1.0].map(Rgb::splat);
        let lit = |at: usize| {
            let mut emittance = [Rgb::ZERO; 4];
            emittance[at] = Rgb::new(0.0, 1.0, 0.0);
            refuse_endless(&matrix, &rho, &emittance)
        };
        assert_eq!((lit(0), lit(1)), (Ok(()), Ok(())));
        let endless = Err(Error::Singular { name: "c".into() });
        assert_eq!((lit(2), lit(3)), (endless.clone(), endless));
    }
}
