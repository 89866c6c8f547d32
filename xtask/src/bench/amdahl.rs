//! Amdahl's law: what part of the work stays on one thread.
//!
//! With the share s of the time serial and the rest spread evenly over t threads, the time falls
//! to s + (1 − s)/t of that of one thread, which is 1 over the speed-up.
//!
//! # References
//! G. M. Amdahl, "Validity of the single processor approach to achieving large scale computing
//! capabilities", AFIPS Conference Proceedings 30 (1967), 483–485.

/// The share s that fits pairs of threads and speed-up best, by least squares on 1/speed-up;
/// nothing where no pair has more than one thread. Below 0 the threads do more than their
/// number, as with caches of their own.
pub(super) fn serial_share(speed_ups: impl IntoIterator<Item = (usize, f64)>) -> Option<f64> {
    // 1/S − 1/t = s·(1 − 1/t) is a line through 0, with the slope s.
    let (mut products, mut squares) = (0.0, 0.0);
    for (threads, speed_up) in speed_ups {
        let ideal = 1.0 / threads as f64;
        let lever = 1.0 - ideal;
        products += lever * (1.0 / speed_up - ideal);
        squares += lever * lever;
    }
    (squares > 0.0).then(|| products / squares)
}

/// The speed-up by so many threads when the share `serial` stays on one.
pub(super) fn speed_up(serial: f64, threads: usize) -> f64 {
    1.0 / (serial + (1.0 - serial) / threads as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// From Amdahl's law by hand: a tenth serial, 1/(0.1 + 0.9/2) = 1/0.55 and so on.
    #[test]
    fn the_share_of_a_made_up_curve_is_found() {
        let curve = [(1, 1.0), (2, 1.0 / 0.55), (4, 1.0 / 0.325), (9, 1.0 / 0.2)];
        let share = serial_share(curve).unwrap();
        assert!((share - 0.1).abs() < 1e-14, "{share}");
        assert!((speed_up(0.1, 9) - 5.0).abs() < 1e-14);
        for share in [0.0, 0.03, 0.5, 1.0] {
            let curve = (1..=24).map(|threads| (threads, speed_up(share, threads)));
            let found = serial_share(curve).unwrap();
            assert!((found - share).abs() < 1e-13, "{found}, not {share}");
        }
    }

    /// Two readings that disagree: s = Σ (1/S − 1/t)(1 − 1/t) / Σ (1 − 1/t)², here
    /// (0.1·0.5 + 0.15·0.75)/(0.25 + 0.5625).
    #[test]
    fn readings_that_disagree_are_weighed_by_least_squares() {
        let share = serial_share([(2, 1.0 / 0.6), (4, 1.0 / 0.4)]).unwrap();
        assert!((share - 0.1625 / 0.8125).abs() < 1e-14, "{share}");
    }

    #[test]
    fn more_than_the_number_of_threads_is_below_zero() {
        let share = serial_share([(2, 2.1)]).unwrap();
        assert!(share < 0.0, "{share}");
    }

    #[test]
    fn one_thread_says_nothing() {
        assert_eq!(serial_share([(1, 1.0)]), None);
        assert_eq!(serial_share([]), None);
    }
}
