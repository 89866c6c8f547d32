//! Numbers of threads as they are typed: `1..24`, `1,2,4`, or both.

use std::fmt;
use std::str::FromStr;

/// More than the program takes.
const MOST: usize = 4096;

/// Numbers of threads, ascending, once each. One thread is always among them: speed-up is
/// against it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Threads(Vec<usize>);

impl Threads {
    fn of(mut numbers: Vec<usize>) -> Self {
        numbers.push(1);
        numbers.sort_unstable();
        numbers.dedup();
        Self(numbers)
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = usize> {
        self.0.iter().copied()
    }
}

impl FromStr for Threads {
    type Err = String;

    /// Both ends of a range are in it.
    fn from_str(text: &str) -> Result<Self, String> {
        let mut numbers = Vec::new();
        for part in text.split(',') {
            let (first, last) = part.split_once("..").unwrap_or((part, part));
            let (first, last) = (number(first)?, number(last)?);
            if first > last {
                return Err(format!("`{part}`: expected the smaller number first"));
            }
            numbers.extend(first..=last);
        }
        Ok(Self::of(numbers))
    }
}

fn number(text: &str) -> Result<usize, String> {
    let number = text.trim().parse().ok().filter(|number| (1..=MOST).contains(number));
    number.ok_or_else(|| format!("`{text}`: expected 1 to {MOST} threads, as 1..24 or 1,2,4"))
}

impl fmt::Display for Threads {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let texts: Vec<_> = self.iter().map(|number| number.to_string()).collect();
        f.write_str(&texts.join(", "))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Vec<usize>, String> {
        text.parse().map(|Threads(numbers)| numbers)
    }

    #[test]
    fn ranges_hold_both_ends() {
        assert_eq!(parsed("1..4"), Ok(vec![1, 2, 3, 4]));
        assert_eq!(parsed("1..24").unwrap().len(), 24);
        assert_eq!(parsed("1..1"), Ok(vec![1]));
        assert_eq!(parsed("1,2, 8..10"), Ok(vec![1, 2, 8, 9, 10]));
    }

    #[test]
    fn one_thread_is_always_there_and_nothing_twice() {
        assert_eq!(parsed("8,2..4,4,2"), Ok(vec![1, 2, 3, 4, 8]));
        assert_eq!("2,3".parse::<Threads>().unwrap().to_string(), "1, 2, 3");
    }

    #[test]
    fn what_is_not_a_number_of_threads_is_named() {
        for text in ["", "0", "1..", "..4", "x", "1,,2", "-1", "1..=4", "4097", "1..0", "2.5"] {
            assert!(parsed(text).is_err(), "{text}");
        }
        assert_eq!(parsed("4..1").unwrap_err(), "`4..1`: expected the smaller number first");
        let error = parsed("1,two").unwrap_err();
        assert_eq!(error, "`two`: expected 1 to 4096 threads, as 1..24 or 1,2,4");
    }
}
