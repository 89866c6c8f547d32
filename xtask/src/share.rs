//! Shares as they are typed, here as for the program: `0.05` or `5%`.

/// Reads a share from 0 on.
///
/// # Errors
/// Names what is no share, and what is expected.
pub(crate) fn share(text: &str) -> Result<f64, String> {
    let (number, unit) = match text.strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    let share = number.trim().parse::<f64>().ok().map(|number| number * unit);
    let share = share.filter(|share| share.is_finite() && *share >= 0.0);
    share.ok_or_else(|| format!("`{text}`: expected a share as 0.05 or 5%"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_forms_are_read() {
        assert_eq!(["0.1", "10%", "0", "2.5 %"].map(share), [Ok(0.1), Ok(0.1), Ok(0.0), Ok(0.025)]);
        for text in ["", "%", "-1", "-1%", "nan", "inf", "x%"] {
            assert!(share(text).is_err(), "{text}");
        }
    }
}
