//! What repeated runs and rows of goals come to.

/// Middle and ends of repeated readings.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Spread {
    pub(crate) median: f64,
    pub(crate) least: f64,
    pub(crate) most: f64,
}

impl Spread {
    /// The spread of one reading or more.
    ///
    /// # Panics
    /// Without a reading there is no spread.
    pub(crate) fn of(readings: &[f64]) -> Self {
        let mut sorted = readings.to_vec();
        sorted.sort_by(f64::total_cmp);
        let (least, most) = (sorted[0], sorted[sorted.len() - 1]);
        let (below, above) = (sorted[(sorted.len() - 1) / 2], sorted[sorted.len() / 2]);
        Self { median: (below + above) / 2.0, least, most }
    }
}

/// When an error is reached for good.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Reached {
    /// At these seconds, between two solves.
    At(f64),
    /// By the quickest solve already, which takes these seconds.
    By(f64),
    Not,
}

/// The time from which on no slower solve is worse than `target`, straight between solves on
/// logarithmic axes. `solves` are pairs of seconds and error.
///
/// A single solve can hit the light by luck, when what its mesh adds makes up for what is
/// unshot: so the last crossing counts, not the first.
pub(super) fn time_to(target: f64, solves: &[(f64, f64)]) -> Reached {
    let mut sorted = solves.to_vec();
    sorted.sort_by(|a, b| a.0.total_cmp(&b.0));
    let Some(last_above) = sorted.iter().rposition(|(_, error)| *error > target) else {
        return sorted.first().map_or(Reached::Not, |(seconds, _)| Reached::By(*seconds));
    };
    let Some(&(t1, e1)) = sorted.get(last_above + 1) else {
        return Reached::Not;
    };
    let (t0, e0) = sorted[last_above];
    // No straight line leads to an error of 0: it counts where it is.
    let share = if e1 > 0.0 { (e0 / target).ln() / (e0 / e1).ln() } else { 1.0 };
    Reached::At(t0 * (t1 / t0).powf(share))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle() {
        let three = Spread::of(&[3.0, 1.0, 20.0]);
        assert_eq!(three, Spread { median: 3.0, least: 1.0, most: 20.0 });
        assert_eq!(Spread::of(&[4.0, 1.0, 2.0, 9.0]).median, 3.0);
        assert_eq!(Spread::of(&[0.5]), Spread { median: 0.5, least: 0.5, most: 0.5 });
    }

    /// On a straight line error = 0.1 / time, the time to an error is 0.1 / error.
    #[test]
    fn between_solves_the_time_follows_the_power_law() {
        let solves = [(10.0, 0.01), (1.0, 0.1), (100.0, 0.001)];
        for target in [0.05, 0.01, 0.002] {
            let Reached::At(seconds) = time_to(target, &solves) else { panic!("{target}") };
            assert!((seconds * target / 0.1 - 1.0).abs() < 1e-12, "{target}: {seconds}");
        }
        assert_eq!(time_to(0.1, &solves), Reached::By(1.0));
        assert_eq!(time_to(0.0005, &solves), Reached::Not);
        assert_eq!(time_to(0.1, &[]), Reached::Not);
    }

    #[test]
    fn luck_does_not_count() {
        let lucky = [(1.0, 0.1), (2.0, 0.001), (3.0, 0.05), (4.0, 0.005)];
        let Reached::At(seconds) = time_to(0.01, &lucky) else { panic!() };
        assert!((3.0..4.0).contains(&seconds), "{seconds}");
        assert_eq!(time_to(0.01, &lucky[..3]), Reached::Not);
    }

    #[test]
    fn an_exact_solve_counts_where_it_is() {
        assert_eq!(time_to(0.01, &[(1.0, 0.1), (2.0, 0.0)]), Reached::At(2.0));
    }
}
