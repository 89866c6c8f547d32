//! Two sets of records beside each other: what became faster or slower beyond the noise.

use super::cell::Cell;
use super::group::{Group, groups};
use super::record::Book;
use crate::precision::numbers::{digits, percent, seconds};

/// How likely a change may be that is none: one in a hundred.
///
/// Of n + m runs of which nothing is different, all n are slower than all m, or all faster, in two
/// of (n + m) over n orders: for five and five, 2/252.
const CHANCE: f64 = 0.01;

/// What became of a cell's time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Verdict {
    Slower,
    Faster,
    /// Runs of both are mixed, or too few to tell.
    Noise,
}

/// What the comparison says.
pub(super) struct Comparison {
    /// In lines, to be printed.
    pub(super) text: String,
    /// Cells that became slower by more than the threshold, beyond the noise.
    pub(super) regressions: usize,
}

/// Holds `now` against `before`. Only times of the same machine can regress; work and memory are
/// compared whatever the machine.
pub(super) fn compare(before: &Book, now: &Book, threshold: f64) -> Comparison {
    let same_machine = before.host.is_like(&now.host);
    let mut lines = vec![format!(
        "against {} ({}) of {}:",
        before.host.revision, before.host.program, before.host.date
    )];
    if !same_machine {
        lines.push(format!(
            "that was {} cores of {}, this is {} cores of {}: times are not compared",
            before.host.cores, before.host.cpu, now.host.cores, now.host.cpu
        ));
    }
    let (old, new) = (groups(&before.records), groups(&now.records));
    let (mut regressions, mut noise, mut compared) = (0, 0, 0);
    for group in &new {
        let Some(earlier) = old.iter().find(|other| other.cell == group.cell) else { continue };
        compared += 1;
        let name = group.cell.name();
        lines.extend(changed_work(earlier, group).into_iter().map(|w| format!("{name}: {w}")));
        if !same_machine {
            continue;
        }
        let ratio = group.time().median / earlier.time().median;
        let word = match verdict(&earlier.seconds(), &group.seconds()) {
            Verdict::Noise => {
                noise += 1;
                continue;
            }
            Verdict::Faster => "faster",
            Verdict::Slower if ratio > 1.0 + threshold => {
                regressions += 1;
                "SLOWER"
            }
            Verdict::Slower => "slower",
        };
        lines.push(format!(
            "{name}: {word}, {} times: {} before, {} now",
            digits(ratio, 3),
            seconds(earlier.time().median),
            seconds(group.time().median)
        ));
    }
    let only = |these: &[Group], those: &[Group]| {
        let known = |cell: &Cell| those.iter().any(|other| other.cell == cell);
        these.iter().filter(|group| !known(group.cell)).count()
    };
    lines.push(format!(
        "{compared} cells compared, {noise} within the noise; {} only before, {} only now",
        only(&old, &new),
        only(&new, &old)
    ));
    if regressions > 0 {
        lines.push(format!("{regressions} slower by more than {}", percent(threshold)));
    }
    Comparison { text: lines.join("\n"), regressions }
}

/// What differs and no clock measures.
fn changed_work(before: &Group, now: &Group) -> Vec<String> {
    let (old, new) = (before.first(), now.first());
    let counts = [
        ("elements", old.work.elements, new.work.elements),
        ("shots", old.work.shots, new.work.shots),
        ("segments", old.work.segments, new.work.segments),
        ("form factors", old.work.form_factors, new.work.form_factors),
    ];
    let differ = counts.into_iter().filter(|(_, old, new)| old != new);
    let mut lines: Vec<_> =
        differ.map(|(what, old, new)| format!("{what}: {old} before, {new} now")).collect();
    if let (Some(old), Some(new)) = (old.measured, new.measured)
        && old.e1 != new.e1
    {
        lines.push(format!("E1: {} before, {} now", percent(old.e1), percent(new.e1)));
    }
    lines
}

/// Whether all runs of one side lie beyond all of the other, where chance would not have it so.
fn verdict(before: &[f64], now: &[f64]) -> Verdict {
    let least = |times: &[f64]| times.iter().copied().fold(f64::INFINITY, f64::min);
    let most = |times: &[f64]| times.iter().copied().fold(0.0, f64::max);
    if 2.0 / orders(before.len(), now.len()) > CHANCE {
        Verdict::Noise
    } else if least(now) > most(before) {
        Verdict::Slower
    } else if most(now) < least(before) {
        Verdict::Faster
    } else {
        Verdict::Noise
    }
}

/// In how many orders n runs and m others can come: (n + m) over n.
fn orders(n: usize, m: usize) -> f64 {
    (1..=n).map(|i| (m + i) as f64 / i as f64).product()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::host::Host;
    use crate::bench::record::Outcome;
    use crate::bench::sample;

    fn book(name: &str, host: Host, seconds: &[f64]) -> Book {
        let folder = std::env::temp_dir().join(format!("xtask-{name}-{}", std::process::id()));
        let mut book = Book::open(&folder, host, true).unwrap();
        book.records = sample::runs(&sample::cell(), seconds);
        std::fs::remove_dir_all(folder).unwrap();
        book
    }

    const BEFORE: [f64; 5] = [1.0, 1.1, 1.2, 1.3, 1.4];

    #[test]
    fn only_runs_that_do_not_mix_are_a_change() {
        assert_eq!(orders(5, 5), 252.0);
        assert_eq!(verdict(&BEFORE, &[1.5, 1.6, 1.7, 1.8, 1.9]), Verdict::Slower);
        assert_eq!(verdict(&BEFORE, &[0.5, 0.6, 0.7, 0.8, 0.9]), Verdict::Faster);
        assert_eq!(verdict(&BEFORE, &[1.35, 1.6, 1.7, 1.8, 1.9]), Verdict::Noise);
        // Three and three do not mix by chance one time in ten.
        assert_eq!(verdict(&BEFORE[..3], &[5.0, 6.0, 7.0]), Verdict::Noise);
    }

    #[test]
    fn a_regression_is_beyond_noise_and_threshold() {
        let host = sample::host();
        let before = book("before", host.clone(), &BEFORE);
        let slow = BEFORE.map(|s| s + 0.41);
        let now = book("now", host.clone(), &slow);
        let all = compare(&before, &now, 0.05);
        assert_eq!(all.regressions, 1);
        assert!(all.text.contains("SLOWER, 1.34 times: 1.20 s before, 1.61 s now"), "{}", all.text);
        assert_eq!(compare(&before, &now, 0.5).regressions, 0);
        let fast = compare(&now, &before, 0.05);
        assert!(fast.regressions == 0 && fast.text.contains("faster"), "{}", fast.text);
        let other = Host { cores: 16, ..host };
        let elsewhere = compare(&before, &book("other", other, &slow), 0.05);
        assert_eq!(elsewhere.regressions, 0);
        assert!(elsewhere.text.contains("times are not compared"), "{}", elsewhere.text);
    }

    #[test]
    fn other_work_is_named() {
        let host = sample::host();
        let before = book("work", host.clone(), &BEFORE);
        let mut now = book("work-now", host, &BEFORE);
        let Outcome::Timed(timed) = &mut now.records[0].outcome else { panic!() };
        timed.work.segments += 1;
        let text = compare(&before, &now, 0.05).text;
        assert!(text.contains("segments: 1000000 before, 1000001 now"), "{text}");
        assert!(text.contains("1 cells compared, 1 within the noise"), "{text}");
    }
}
