//! Logarithmic axes: their range, their ticks and how a tick is written.

/// What an axis shows and how its numbers are written.
#[derive(Clone, Debug)]
pub(crate) struct Axis {
    pub(crate) title: String,
    pub(crate) labels: Labels,
}

/// How a tick is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Labels {
    /// `0.2`, `1`, `50`; beyond four digits `1e-5`.
    Plain,
    /// `0.2 %`: the number is a share.
    Percent,
}

impl Axis {
    pub(crate) fn new(title: impl Into<String>, labels: Labels) -> Self {
        Self { title: title.into(), labels }
    }
}

impl Labels {
    /// The text of a tick.
    pub(super) fn text(self, value: f64) -> String {
        match self {
            Self::Plain => plain(value),
            Self::Percent => format!("{} %", plain(value * 100.0)),
        }
    }
}

/// A range of decades and where its ticks stand.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Scale {
    pub(super) low: f64,
    pub(super) high: f64,
    /// With a label and a line.
    pub(super) major: Vec<f64>,
    /// With a faint line.
    pub(super) minor: Vec<f64>,
}

/// Up to so many decades, 2 and 5 times a power of ten are labelled, too.
const DECADES_WITH_STEPS: f64 = 3.5;

/// Beyond so many decades, only some powers of ten are labelled.
const MOST_LABELLED_DECADES: f64 = 8.0;

/// The part of the data's extent that stays free on both sides.
const MARGIN: f64 = 0.04;

impl Scale {
    /// A scale that holds all values above 0; that from 0.1 to 1 where there are none.
    pub(super) fn over(values: impl Iterator<Item = f64>) -> Self {
        let exponents = values.filter(|v| *v > 0.0 && v.is_finite()).map(f64::log10);
        let (low, high) = exponents
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), e| (low.min(e), high.max(e)));
        let (low, high) = if low <= high { (low, high) } else { (-1.0, 0.0) };
        // One value alone would have no extent.
        let margin = (MARGIN * (high - low)).max(0.1);
        Self::between(low - margin, high + margin)
    }

    /// Ticks between two powers of ten, given by their exponents.
    fn between(low: f64, high: f64) -> Self {
        let within = |exponent: &f64| (low..=high).contains(exponent);
        let decades = low.floor() as i32..=high.ceil() as i32;
        let at = |digits: &'static [f64]| {
            let decades = decades.clone();
            decades
                .flat_map(move |decade| digits.iter().map(move |d| f64::from(decade) + d.log10()))
        };
        let value = |exponent: f64| 10f64.powf(exponent);
        let span = high - low;
        let steps: &[f64] = if span <= DECADES_WITH_STEPS { &[1.0, 2.0, 5.0] } else { &[1.0] };
        let every = (span / MOST_LABELLED_DECADES).ceil().max(1.0);
        let major = at(steps).filter(within).filter(|e| steps.len() > 1 || e % every == 0.0);
        let digits: &[f64] =
            if every > 1.0 { &[1.0] } else { &[2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0] };
        Self {
            low: value(low),
            high: value(high),
            major: major.map(value).collect(),
            minor: at(digits).filter(within).map(value).collect(),
        }
    }
}

/// A tick's number: ticks have one significant digit.
fn plain(value: f64) -> String {
    let exponent = value.log10();
    if (-3.5..4.5).contains(&exponent) {
        let decimals = (-(exponent + 1e-9).floor()).max(0.0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{value:.0e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(scale: &Scale, labels: Labels) -> Vec<String> {
        scale.major.iter().map(|value| labels.text(*value)).collect()
    }

    #[test]
    fn few_decades_have_labelled_steps() {
        let scale = Scale::over([0.04, 1.7].into_iter());
        assert_eq!(texts(&scale, Labels::Plain), ["0.05", "0.1", "0.2", "0.5", "1", "2"]);
        assert_eq!(texts(&scale, Labels::Percent)[0], "5 %");
        assert!(scale.low < 0.04 && scale.high > 1.7, "{scale:?}");
    }

    #[test]
    fn many_decades_have_powers_of_ten_only() {
        let scale = Scale::over([1e-4, 900.0].into_iter());
        let expected = ["1e-4", "0.001", "0.01", "0.1", "1", "10", "100", "1000"];
        assert_eq!(texts(&scale, Labels::Plain), expected);
        let most = Scale::over([1e-13, 1.0].into_iter());
        assert!(most.major.len() <= 8, "{most:?}");
        assert_eq!(texts(&most, Labels::Plain).last().map(String::as_str), Some("1"));
    }

    #[test]
    fn what_has_no_place_does_not_move_the_axis() {
        let with = Scale::over([0.0, -1.0, f64::NAN, f64::INFINITY, 0.1, 10.0].into_iter());
        assert_eq!(with, Scale::over([0.1, 10.0].into_iter()));
        assert_eq!(Scale::over([].into_iter()), Scale::over([0.1, 1.0].into_iter()));
    }

    #[test]
    fn one_value_has_an_axis_around_it() {
        let scale = Scale::over([0.5].into_iter());
        assert!(scale.low < 0.5 && 0.5 < scale.high, "{scale:?}");
        assert_eq!(texts(&scale, Labels::Plain), ["0.5"]);
    }
}
