//! The kinds of loop, and their names as text.

use std::fmt;
use std::num::NonZeroUsize;
use std::str::FromStr;

use crate::ParseLoopError;

/// How a [`Pool`](crate::Pool) shares the items of a loop among its threads.
///
/// Items are independent, so the choice moves time around and never a bit of the result.
///
/// # Examples
/// ```
/// use radiosity_par::Loop;
///
/// let chunks_of_four: Loop = "dynamic:4".parse()?;
/// assert_eq!(chunks_of_four, Loop::Dynamic(const { std::num::NonZero::new(4).unwrap() }));
/// assert_eq!(chunks_of_four.to_string(), "dynamic:4");
/// assert!("dynamic:0".parse::<Loop>().is_err());
/// # Ok::<(), radiosity_par::ParseLoopError>(())
/// ```
///
/// # References
/// OpenMP Application Programming Interface 5.2 (2021), section 11.5.3, `schedule` clause.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Loop {
    /// `static`: one contiguous share for each thread, the same thread for the same share in
    /// every loop of that length.
    Static,
    /// `dynamic:N`: a thread that is free takes the next N items.
    Dynamic(NonZeroUsize),
    /// `guided:N`: a thread that is free takes (items left / threads), never fewer than N.
    Guided(NonZeroUsize),
    /// `tasks`: a thread halves its items down to one; a thread that is free takes half of
    /// what another has not begun (work stealing).
    #[default]
    Tasks,
}

impl Loop {
    /// The most items that one thread would take at once, however few there are.
    pub(crate) fn grain(self) -> usize {
        match self {
            Self::Static | Self::Tasks => 1,
            Self::Dynamic(chunk) | Self::Guided(chunk) => chunk.get(),
        }
    }
}

impl fmt::Display for Loop {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Static => f.write_str("static"),
            Self::Dynamic(chunk) => write!(f, "dynamic:{chunk}"),
            Self::Guided(chunk) => write!(f, "guided:{chunk}"),
            Self::Tasks => f.write_str("tasks"),
        }
    }
}

impl FromStr for Loop {
    type Err = ParseLoopError;

    /// Reads what `Display` writes; `dynamic` and `guided` alone mean N = 1.
    fn from_str(text: &str) -> Result<Self, ParseLoopError> {
        let refused = || ParseLoopError::new(text);
        let (name, chunk) = match text.split_once(':') {
            Some((name, digits)) => (name, Some(chunk(digits).ok_or_else(refused)?)),
            None => (text, None),
        };
        match (name, chunk) {
            ("static", None) => Ok(Self::Static),
            ("dynamic", chunk) => Ok(Self::Dynamic(chunk.unwrap_or(NonZeroUsize::MIN))),
            ("guided", chunk) => Ok(Self::Guided(chunk.unwrap_or(NonZeroUsize::MIN))),
            ("tasks", None) => Ok(Self::Tasks),
            _ => Err(refused()),
        }
    }
}

/// Digits alone: the standard parser would let a `+` pass.
fn chunk(digits: &str) -> Option<NonZeroUsize> {
    digits.bytes().all(|byte| byte.is_ascii_digit()).then(|| digits.parse().ok())?
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_text_names_its_loop_and_comes_back() {
        let n = |n| NonZeroUsize::new(n).unwrap();
        let cases = [
            ("static", Loop::Static, "static"),
            ("dynamic", Loop::Dynamic(n(1)), "dynamic:1"),
            ("dynamic:64", Loop::Dynamic(n(64)), "dynamic:64"),
            ("guided", Loop::Guided(n(1)), "guided:1"),
            (
                "guided:18446744073709551615",
                Loop::Guided(n(usize::MAX)),
                &format!("guided:{}", usize::MAX),
            ),
            ("tasks", Loop::Tasks, "tasks"),
        ];
        for (text, kind, written) in cases {
            assert_eq!(text.parse(), Ok(kind), "{text}");
            assert_eq!(kind.to_string(), written);
            assert_eq!(written.parse(), Ok(kind));
        }
    }

    #[test]
    fn any_other_text_is_refused_in_one_line() {
        let texts = [
            "",
            "Static",
            " static",
            "static:4",
            "tasks:1",
            "dynamic:",
            "dynamic:0",
            "dynamic:-1",
            "dynamic:+1",
            "dynamic:1.5",
            "dynamic:1:2",
            "dynamic,4",
            "guided:99999999999999999999999",
            "guided: 1",
            "a\nb",
        ];
        for text in texts {
            let error = text.parse::<Loop>().unwrap_err();
            assert_eq!(error.text(), text);
            let message = error.to_string();
            assert!(message.contains("expected static, dynamic:N, guided:N or tasks"), "{message}");
            assert_eq!(message.lines().count(), 1, "{message}");
        }
        assert_eq!(
            "dynamic:0".parse::<Loop>().unwrap_err().to_string(),
            "no loop is called \"dynamic:0\": expected static, dynamic:N, guided:N or tasks, \
             with a whole number N of at least 1"
        );
    }
}
