//! Counts beside those of the baseline, and what follows from them.

use std::fmt;

use super::baseline::Counted;
use super::percent::{Percent, signed};
use crate::precision::numbers::grouped;

/// What to do where the baseline is no longer what the code does.
const RENEW: &str = "renew the baseline with `cargo xtask instructions --write`";

/// Every kernel of either list, in the order of the counts, then what the baseline has besides.
#[derive(Debug, PartialEq)]
pub(super) struct Comparison {
    rows: Vec<Row>,
    threshold: Percent,
}

#[derive(Debug, PartialEq)]
struct Row {
    name: String,
    before: Option<u64>,
    now: Option<u64>,
}

/// What follows from a comparison.
#[derive(Debug, PartialEq)]
pub(super) struct Verdict {
    /// What is worth saying, a line each.
    pub(super) notes: Vec<String>,
    /// What is wrong, if anything is.
    pub(super) failure: Option<String>,
}

impl Comparison {
    pub(super) fn of(before: &[Counted], now: &[Counted], threshold: Percent) -> Self {
        let count = |list: &[Counted], name: &str| {
            list.iter().find(|kernel| kernel.name == name).map(|kernel| kernel.instructions)
        };
        let gone = before.iter().filter(|kernel| count(now, &kernel.name).is_none());
        let row = |kernel: &Counted| Row {
            name: kernel.name.clone(),
            before: count(before, &kernel.name),
            now: count(now, &kernel.name),
        };
        Self { rows: now.iter().chain(gone).map(row).collect(), threshold }
    }

    /// Too many more instructions are a failure, unless another toolchain counted the baseline:
    /// `differences` says in what. Fewer, and kernels without a count, are only said.
    pub(super) fn verdict(&self, differences: &[String]) -> Verdict {
        let threshold = self.threshold;
        let both = |is: fn(Percent, u64, u64) -> bool| {
            self.named(|row| row.before.zip(row.now).is_some_and(|(b, n)| is(threshold, b, n)))
        };
        let more = both(Percent::exceeded).map(|names| {
            format!("more instructions than the baseline by more than {threshold}: {names}")
        });
        let less = both(Percent::undercut)
            .map(|names| format!("fewer by more than {threshold}: {names}; {RENEW}"));
        let new = self
            .named(|row| row.before.is_none())
            .map(|names| format!("not in the baseline: {names}; {RENEW}"));
        let gone = self
            .named(|row| row.now.is_none())
            .map(|names| format!("in the baseline alone, gone or not for this machine: {names}"));
        let other = (!differences.is_empty()).then(|| {
            let differences = differences.join(", ");
            format!("the baseline is of another toolchain, so nothing fails: {differences}")
        });
        let notes = [other.clone(), less, new, gone].into_iter().flatten();
        match other {
            Some(_) => Verdict { notes: notes.chain(more).collect(), failure: None },
            None => Verdict { notes: notes.collect(), failure: more },
        }
    }

    /// The kernels of which something is true; nothing where there are none.
    fn named(&self, is: impl Fn(&Row) -> bool) -> Option<String> {
        let names: Vec<_> =
            self.rows.iter().filter(|row| is(row)).map(|row| row.name.as_str()).collect();
        (!names.is_empty()).then(|| names.join(", "))
    }
}

/// A table, its columns aligned.
impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let longest = self.rows.iter().map(|row| row.name.len()).max().unwrap_or(0);
        let mut line = |cells: [&str; 4]| {
            let [name, before, now, change] = cells;
            writeln!(f, "{name:longest$}  {before:>13}  {now:>13}  {change:>9}")
        };
        line(["kernel", "baseline", "now", "change"])?;
        for Row { name, before, now } in &self.rows {
            let count = |count: &Option<u64>| count.map_or("–".into(), grouped);
            let change = before.zip(*now).map_or("–".into(), |(b, n)| signed(b, n));
            line([name, &count(before), &count(now), &change])?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::baseline::sample;
    use super::*;

    /// The sample beside counts of three kernels, one of them new.
    fn comparison(one: u64, two: u64) -> Comparison {
        let counts = [("a/one", one), ("a/two", two), ("c/four", 7)];
        let now = counts.map(|(name, instructions)| Counted { name: name.into(), instructions });
        Comparison::of(&sample().kernels, &now, Percent::DEFAULT)
    }

    const NEW: &str =
        "not in the baseline: c/four; renew the baseline with `cargo xtask instructions --write`";
    const GONE: &str = "in the baseline alone, gone or not for this machine: b/three";

    #[test]
    fn the_table_has_a_row_for_each_kernel_of_either() {
        let expected = "\
kernel       baseline            now     change
a/one       1,234,567      1,240,000    +0.44 %
a/two           1,000            950   −5.00 %
c/four              –              7          –
b/three        20,000              –          –
";
        // Digits and signs are one character each, whatever their bytes.
        let found = comparison(1_240_000, 950).to_string();
        let words = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(words(&found), words(expected));
        let widths: Vec<_> = found.lines().map(|line| line.chars().count()).collect();
        assert!(widths.iter().all(|width| *width == widths[0]), "{found}");
    }

    #[test]
    fn more_than_the_threshold_fails_and_less_is_said() {
        let alike = comparison(1_234_567, 1020).verdict(&[]);
        assert_eq!(alike, Verdict { notes: vec![NEW.into(), GONE.into()], failure: None });
        let worse = comparison(1_300_000, 1021).verdict(&[]);
        let failure = "more instructions than the baseline by more than 2 %: a/one, a/two";
        assert_eq!(worse.failure.as_deref(), Some(failure));
        let better = comparison(1_200_000, 1000).verdict(&[]);
        assert_eq!(better.failure, None);
        assert!(better.notes[0].starts_with("fewer by more than 2 %: a/one; renew the baseline"));
    }

    #[test]
    fn with_another_toolchain_nothing_fails() {
        let verdict = comparison(1_300_000, 1000).verdict(&["rustc 2 instead of rustc 1".into()]);
        assert_eq!(verdict.failure, None);
        let first =
            "the baseline is of another toolchain, so nothing fails: rustc 2 instead of rustc 1";
        assert_eq!(verdict.notes[0], first);
        assert!(verdict.notes.last().unwrap().starts_with("more instructions"));
    }
}
