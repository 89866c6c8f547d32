//! Numbers as text: two or three digits, which is what measurements carry.

use super::statistics::Spread;

/// `1.8 %`, `0.012 %`: two digits of a share.
pub(crate) fn percent(share: f64) -> String {
    format!("{} %", digits(share * 100.0, 2))
}

/// `8 %`, `0.5 %`: a share as somebody typed it.
pub(crate) fn goal(share: f64) -> String {
    // Six decimals of a percentage: what the product adds lies far behind them.
    format!("{} %", (share * 1e8).round() / 1e6)
}

/// `4.25 s`, `0.312 s`, `85.2 s`.
pub(crate) fn seconds(time: f64) -> String {
    format!("{} s", digits(time, 3))
}

/// `0.300 s (0.200–0.400)`: the median of several times, with both ends where there is more than
/// one.
pub(crate) fn times(readings: &[f64]) -> String {
    let Spread { median, least, most } = Spread::of(readings);
    if readings.len() < 2 {
        return seconds(median);
    }
    format!("{} ({}–{})", seconds(median), digits(least, 3), digits(most, 3))
}

/// `950`, `4,000`, `4.79 M`.
pub(crate) fn count(n: u64) -> String {
    match n {
        0..100_000 => grouped(n),
        100_000..1_000_000 => format!("{} k", digits(n as f64 / 1e3, 3)),
        1_000_000..1_000_000_000 => format!("{} M", digits(n as f64 / 1e6, 3)),
        _ => format!("{} G", digits(n as f64 / 1e9, 3)),
    }
}

/// `64,000`: all digits, by thousands.
pub(crate) fn grouped(n: u64) -> String {
    let text = n.to_string();
    let mut grouped = String::new();
    for (place, digit) in text.chars().enumerate() {
        if place > 0 && (text.len() - place).is_multiple_of(3) {
            grouped.push(',');
        }
        grouped.push(digit);
    }
    grouped
}

/// A number from 0 with `significant` digits, or with all digits of its integer part.
pub(crate) fn digits(x: f64, significant: i32) -> String {
    if x == 0.0 {
        return "0".into();
    }
    let decimals = |x: f64| (significant - 1 - x.log10().floor() as i32).max(0) as usize;
    // 9.96 rounds to 10.0 at first: one digit too many.
    let rounded: f64 = format!("{x:.*}", decimals(x)).parse().unwrap_or(x);
    format!("{x:.*}", decimals(rounded))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_have_two_digits() {
        let texts = [0.017886, 0.1, 0.7097, 9.9049, 0.000119, 0.0, 0.0996].map(percent);
        assert_eq!(texts, ["1.8 %", "10 %", "71 %", "990 %", "0.012 %", "0 %", "10 %"]);
    }

    #[test]
    fn goals_are_as_typed() {
        assert_eq!([0.08, 0.07, 0.005, 1e-6].map(goal), ["8 %", "7 %", "0.5 %", "0.0001 %"]);
    }

    #[test]
    fn times_have_three_digits() {
        let texts = [0.00417, 0.99961, 1.0, 12.34, 301.7].map(seconds);
        assert_eq!(texts, ["0.00417 s", "1.00 s", "1.00 s", "12.3 s", "302 s"]);
    }

    #[test]
    fn several_times_have_their_ends() {
        assert_eq!(times(&[0.2, 0.4, 0.3]), "0.300 s (0.200–0.400)");
        assert_eq!(times(&[1.5]), "1.50 s");
    }

    #[test]
    fn counts_are_short() {
        let texts = [7, 4000, 99_999, 721_171, 4_791_978, 12_345_678_901].map(count);
        assert_eq!(texts, ["7", "4,000", "99,999", "721 k", "4.79 M", "12.3 G"]);
        assert_eq!(grouped(1_234_567), "1,234,567");
    }
}
