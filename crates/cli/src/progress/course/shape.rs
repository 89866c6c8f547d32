//! How the unshot power falls within a level: the next one takes much the same way.

/// Points of a shape: the unshot share falls by this factor from one to the next at least.
const FALL: f64 = 0.9;

/// Fewer points tell nothing.
const LEAST: usize = 6;

/// Unshot shares, and when they were reached.
#[derive(Default)]
pub(super) struct Shape {
    /// Falling shares with seconds since the level began.
    points: Vec<(f64, f64)>,
    last: (f64, f64),
}

impl Shape {
    /// Hears of a step.
    pub(super) fn hear(&mut self, unshot: f64, seconds: f64) {
        if unshot <= 0.0 {
            return;
        }
        self.last = (unshot, seconds);
        if self.points.last().is_none_or(|(before, _)| unshot <= before * FALL) {
            self.points.push(self.last);
        }
    }

    /// Whether it says anything of the next level.
    pub(super) fn tells(&self) -> bool {
        self.points.len() >= LEAST && self.last.1 > 0.0
    }

    /// The share of the time until `end` unshot that is over at `unshot`.
    pub(super) fn share(&self, unshot: f64, end: f64) -> f64 {
        let whole = self.seconds(end);
        if whole <= 0.0 {
            straight(unshot, end)
        } else {
            (self.seconds(unshot) / whole).clamp(0.0, 1.0)
        }
    }

    /// When so little was unshot: between points, and beyond them on the way that the last half took,
    /// the logarithm falls evenly.
    fn seconds(&self, unshot: f64) -> f64 {
        let mut before = (1.0f64, 0.0f64);
        for &(share, seconds) in self.points.iter().chain([&self.last]) {
            if share <= unshot {
                let fall = (before.0 / share).ln();
                let part = if fall > 0.0 { (before.0 / unshot).ln() / fall } else { 1.0 };
                return before.1 + part.clamp(0.0, 1.0) * (seconds - before.1);
            }
            before = (share, seconds);
        }
        let (end, whole) = self.last;
        let half = self.points.iter().find(|(_, seconds)| *seconds >= 0.5 * whole);
        match half {
            Some((share, seconds)) if *share > end => {
                let each = (whole - seconds) / (share / end).ln();
                whole + each * (end / unshot.max(f64::MIN_POSITIVE)).ln()
            }
            _ => whole,
        }
    }
}

/// The share of the way from 1 to `end` at `unshot`, where the logarithm falls evenly.
pub(super) fn straight(unshot: f64, end: f64) -> f64 {
    let (way, whole) = (unshot.max(f64::MIN_POSITIVE).ln(), end.clamp(f64::MIN_POSITIVE, 1.0).ln());
    if whole < 0.0 { (way / whole).clamp(0.0, 1.0) } else { 1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_way_is_found_again_and_goes_on() {
        // Slow at first, then a factor of ten in two seconds.
        let mut shape = Shape::default();
        for (unshot, seconds) in
            [(0.9, 1.0), (0.8, 2.0), (0.7, 3.0), (0.5, 4.0), (0.1, 6.0), (0.01, 8.0), (1e-3, 10.0)]
        {
            shape.hear(unshot, seconds);
        }
        assert!(shape.tells());
        for (unshot, end, expected) in [
            (0.9, 1e-3, 0.1),
            (0.1, 1e-3, 0.6),
            (0.1f64.powf(1.5), 1e-3, 0.7),
            (1e-3, 1e-4, 10.0 / 12.0),
            (1e-5, 1e-3, 1.0),
        ] {
            let share = shape.share(unshot, end);
            assert!((share - expected).abs() < 1e-9, "{unshot} of {end}: {share}, not {expected}");
        }
        assert!((straight(0.1, 1e-4) - 0.25).abs() < 1e-12);
        assert!(!Shape::default().tells());
    }
}
