//! How often the light on its way is written.

use std::time::Duration;

/// When the next snapshot is due.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Every {
    /// So many shots after the last one.
    Shots(u64),
    /// So long after the last one.
    Time(Duration),
}

/// `every:200`, or a time as `30s`.
pub(super) fn every(text: &str) -> Result<Every, String> {
    let shots = text.strip_prefix("every:").unwrap_or_default().parse();
    match (shots, super::time(text)) {
        (Ok(shots), _) if shots > 0 => Ok(Every::Shots(shots)),
        (_, Ok(time)) if !text.ends_with(|c: char| c.is_ascii_digit()) => Ok(Every::Time(time)),
        _ => Err("expected every:N, N shots, or a time such as 30s".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shots_and_times() {
        assert_eq!(every("every:200"), Ok(Every::Shots(200)));
        assert_eq!(every("500ms"), Ok(Every::Time(Duration::from_millis(500))));
        // A bare number could be either.
        for text in ["every:0", "every:", "every:-1", "200", "0s", "often", ""] {
            assert!(every(text).is_err(), "{text}");
        }
    }
}
