//! A share in per cent: the threshold, and how much more or less something is.

use std::fmt;
use std::str::FromStr;

/// At least 0 and finite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Percent(f64);

impl Percent {
    /// See the flag `--threshold` for the reason.
    pub(super) const DEFAULT: Self = Self(2.0);

    /// Whether `now` is more than `before` by more than this.
    pub(super) fn exceeded(self, before: u64, now: u64) -> bool {
        change(before, now) > self.0
    }

    /// Whether `now` is less than `before` by more than this.
    pub(super) fn undercut(self, before: u64, now: u64) -> bool {
        change(before, now) < -self.0
    }
}

impl FromStr for Percent {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        crate::share::share(text).map(|share| Self(100.0 * share))
    }
}

impl fmt::Display for Percent {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} %", self.0)
    }
}

/// How many per cent `now` is more than `before`; below 0 if it is less.
pub(super) fn change(before: u64, now: u64) -> f64 {
    100.0 * (now as f64 - before as f64) / before as f64
}

/// `+1.23 %`, `−0.50 %`, `0`, and `+0.00 %` for what is too little to show.
pub(super) fn signed(before: u64, now: u64) -> String {
    let change = change(before, now);
    match now.cmp(&before) {
        std::cmp::Ordering::Less => format!("−{:.2} %", change.abs()),
        std::cmp::Ordering::Equal => "0".into(),
        std::cmp::Ordering::Greater => format!("+{change:.2} %"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_lies_beyond_the_threshold_counts() {
        let two = Percent::DEFAULT;
        assert!(!two.exceeded(1000, 1020) && two.exceeded(1000, 1021));
        assert!(!two.undercut(1000, 980) && two.undercut(1000, 979));
        assert!(!two.exceeded(1000, 900) && !two.undercut(1000, 1100));
        let none: Percent = "0".parse().unwrap();
        assert!(!none.exceeded(1000, 1000) && none.exceeded(1000, 1001));
    }

    #[test]
    fn a_change_has_its_sign() {
        let texts = [1000, 1012, 995, 2000, 999_999].map(|now| signed(1000.max(now / 2), now));
        assert_eq!(texts[..3], ["0", "+1.20 %", "−0.50 %"]);
        assert_eq!(texts[3], "+100.00 %");
        assert_eq!(signed(10_000_000, 10_000_001), "+0.00 %");
        assert_eq!(signed(10_000_000, 9_999_999), "−0.00 %");
    }

    #[test]
    fn a_threshold_is_a_share() {
        assert_eq!(["0.5%", "0.005"].map(str::parse), [Ok(Percent(0.5)), Ok(Percent(0.5))]);
        assert!("-1%".parse::<Percent>().is_err());
    }
}
