//! A matrix from geometry: each pair once, rows spread over an executor.

use form_factor::{Ask, Occluders, between, between_occluded_within};

use super::{Entry, Matrix, Surfaces, sum};
use crate::energy::Sum;
use crate::executor::Executor;

/// How a matrix is computed.
#[derive(Clone, Copy, Debug)]
pub struct ComputeConfig<'a> {
    /// Error asked of each form factor between two polygons: this share of it or, where something
    /// may stand in between, this share of 1 / N, N being the number of polygons, if that is more.
    /// So a row, whose form factors sum to at most 1, is off by at most twice the tolerance.
    pub tolerance: f64,
    /// What may block the view; `None` where nothing does, as in a convex enclosure.
    pub occluders: Option<&'a Occluders>,
}

/// A matrix, and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Computed {
    /// The form factors, as computed: nothing is repaired.
    pub matrix: Matrix,
    /// Pairs of polygons.
    pub pairs: u64,
    /// Pairs between which light goes.
    pub lit: u64,
    /// Pairs between which something may stand, so that visibility had to be computed.
    pub visibility: u64,
    /// Integrand values taken.
    pub effort: u64,
}

/// Computes the form factors between the rows of `surfaces`.
///
/// Each pair of polygons is computed once, from the side that suits the estimator, and stands
/// in both rows: A_i F_ij = A_j F_ji holds by construction, to rounding, and so says nothing
/// of the accuracy, which the errors and the row sums do. Between rows of several polygons
/// F_GH = Σ A_i F_ij / A_G over the polygons i of G and j of H, and the error is the sum of
/// theirs, which is on the safe side. Every executor gives the same bits.
///
/// Errors may exceed what [`ComputeConfig::tolerance`] asks where rounding or the effort spent on
/// one pair denies it; [`Matrix::errors`] says so in every case.
///
/// Time: N²/2 pairs of N polygons. Memory while computing: 24 bytes for each polygon and each
/// row that it sees.
#[must_use]
pub fn compute(surfaces: &Surfaces, config: &ComputeConfig, executor: &impl Executor) -> Computed {
    let mut shots: Vec<Shot> =
        (0..surfaces.polygons()).map(|from| Shot { from, ..Shot::default() }).collect();
    executor.for_each(&mut shots, |shot| shot.fill(surfaces, config));
    let count = |of: fn(&Shot) -> u64| shots.iter().map(of).sum();
    let (lit, visibility) = (count(|s| s.lit), count(|s| s.visibility));
    let effort = count(|s| s.effort);
    let n = surfaces.polygons() as u64;
    let pairs = n * n.saturating_sub(1) / 2;
    Computed { matrix: assemble(surfaces, &shots), pairs, lit, visibility, effort }
}

/// What one polygon exchanges with those after it.
#[derive(Default)]
struct Shot {
    from: usize,
    /// Exchange areas A F by the other's row, ascending.
    exchange: Vec<Exchange>,
    lit: u64,
    visibility: u64,
    effort: u64,
}

/// An exchange area with its error.
#[derive(Clone, Copy, Default)]
struct Exchange {
    row: u32,
    area: f64,
    error: f64,
}

impl Shot {
    fn fill(&mut self, surfaces: &Surfaces, config: &ComputeConfig) {
        let a = &surfaces.polygons[self.from];
        let mut found = Vec::new();
        let relative = config.tolerance;
        let ask = Ask { relative, absolute: relative / surfaces.polygons() as f64 };
        for (b, row) in surfaces.polygons.iter().zip(&surfaces.rows).skip(self.from + 1) {
            let estimate = match config.occluders {
                Some(occluders) => between_occluded_within(a, b, occluders, ask),
                None => between(a, b, relative),
            };
            self.effort += u64::from(estimate.effort);
            self.visibility += u64::from(estimate.visibility);
            self.lit += u64::from(estimate.value > 0.0);
            if estimate.value > 0.0 || estimate.error > 0.0 {
                let (area, error) = (a.area() * estimate.value, a.area() * estimate.error);
                found.push(Exchange { row: *row, area, error });
            }
        }
        self.exchange = gathered(found);
    }
}

/// One exchange per row, ascending; what belongs to a row is added in the order given.
fn gathered(mut found: Vec<Exchange>) -> Vec<Exchange> {
    // A stable sort: the order of the sums is that of the polygons.
    found.sort_by_key(|e| e.row);
    let one = |of_row: &[Exchange]| Exchange {
        row: of_row[0].row,
        area: sum(of_row.iter().map(|e| e.area)),
        error: sum(of_row.iter().map(|e| e.error)),
    };
    found.chunk_by(|a, b| a.row == b.row).map(one).collect()
}

/// Adds what the polygons of each row exchange, in both directions.
fn assemble(surfaces: &Surfaces, shots: &[Shot]) -> Matrix {
    let mut areas = vec![Sum::default(); surfaces.names.len()];
    let mut exchange: Vec<Vec<Exchange>> = vec![Vec::new(); surfaces.names.len()];
    for (shot, &row) in shots.iter().zip(&surfaces.rows) {
        areas[row as usize].add(surfaces.polygons[shot.from].area());
        for e in &shot.exchange {
            exchange[row as usize].push(*e);
            exchange[e.row as usize].push(Exchange { row, ..*e });
        }
    }
    let areas: Vec<f64> = areas.into_iter().map(Sum::value).collect();
    let share = |(found, area): (Vec<Exchange>, &f64)| -> Vec<Entry> {
        let entry =
            |e: Exchange| Entry { column: e.row, value: e.area / area, error: e.error / area };
        gathered(found).into_iter().map(entry).collect()
    };
    let rows = exchange.into_iter().zip(&areas).map(share).collect();
    Matrix::from_rows(surfaces.names.clone(), areas, rows).expect(
        "polygons have area, rows of a surface list have polygons, and form factors are finite",
    )
}

#[cfg(test)]
mod tests {
    use form_factor::Polygon;
    use glam::DVec3;

    use super::*;
    use crate::Sequential;

    /// The faces of a box in triangles that face inwards.
    fn cuboid(low: f64, high: f64) -> Vec<[DVec3; 3]> {
        let corner = |i: usize| {
            DVec3::from_array([i & 1, i >> 1 & 1, i >> 2].map(|b| if b == 0 { low } else { high }))
        };
        let faces =
            [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
        let halves = |[a, b, c, d]: [usize; 4]| [[a, b, c], [a, c, d]];
        faces.into_iter().flat_map(halves).map(|t| t.map(corner)).collect()
    }

    #[test]
    fn rows_are_right_to_twice_the_tolerance_past_what_stands_in_between() {
        // A block that floats in a room: closed, so that each row sums to 1.
        let block = cuboid(0.3, 0.6).into_iter().map(|[a, b, c]| [a, c, b]);
        let triangles: Vec<_> = cuboid(0.0, 1.0).into_iter().chain(block).collect();
        let surfaces = Surfaces::each(triangles.iter().map(|&t| Polygon::triangle(t).unwrap()));
        let occluders = Occluders::build(&triangles);
        for tolerance in [1e-2, 1e-3] {
            let config = ComputeConfig { tolerance, occluders: Some(&occluders) };
            let computed = compute(&surfaces, &config, &Sequential);
            let defects = computed.matrix.defects().unwrap();
            assert!(defects.row_error <= 2.0 * tolerance, "{tolerance:e}: {defects:?}");
            assert!(defects.closure() <= defects.row_error, "{tolerance:e}: {defects:?}");
            // Only the room's walls can see one another past the block: 60 pairs not of one face.
            let seen = computed.visibility;
            assert!((30..=60).contains(&seen), "{seen} of {} pairs", computed.pairs);
        }
        let config = ComputeConfig { tolerance: 1e-3, occluders: None };
        assert_eq!(compute(&surfaces, &config, &Sequential).visibility, 0);
    }
}
