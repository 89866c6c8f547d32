//! What other programs took of the machine meanwhile, as Linux counts it.
//!
//! A machine with other work to do has fewer cores than it says: times of many threads then say
//! more about the others than about this program.

use std::fs;

/// Processor time since the machine started, in the kernel's ticks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Clock {
    cores: u64,
    /// Of all cores: idle and not.
    all: u64,
    /// Of all cores, whoever used them.
    busy: u64,
    /// Of this process and the programs it has waited for.
    own: u64,
}

impl Clock {
    /// Now; nothing where the system does not say.
    pub(super) fn now() -> Option<Self> {
        let machine = fs::read_to_string("/proc/stat").ok()?;
        let process = fs::read_to_string("/proc/self/stat").ok()?;
        Self::read(&machine, &process)
    }

    /// Reads /proc/stat and /proc/self/stat.
    fn read(machine: &str, process: &str) -> Option<Self> {
        let cores = machine.lines().filter(|line| core(line)).count() as u64;
        let ticks = machine.lines().find_map(|line| line.strip_prefix("cpu "))?;
        // user, nice, system, idle, waiting for disks, two kinds of interrupts, stolen by other
        // guests of the host; what follows is counted in the first two already.
        let ticks: Vec<u64> =
            ticks.split_whitespace().take(8).map_while(|t| t.parse().ok()).collect();
        let [.., idle, waiting, _, _, _] = ticks[..] else { return None };
        let all = ticks.iter().sum::<u64>();
        // The program's name, in parentheses, may hold anything. After it comes field 3; fields
        // 14 to 17 are the times of the process and of its children, user and system.
        let (_, fields) = process.rsplit_once(')')?;
        let times: Vec<u64> =
            fields.split_whitespace().skip(11).take(4).map_while(|t| t.parse().ok()).collect();
        let own = (times.len() == 4).then(|| times.iter().sum())?;
        Some(Self { cores, all, busy: all - idle - waiting, own })
    }

    /// How many cores others kept busy from `self` to `end`, on average; nothing where no time
    /// has passed.
    pub(super) fn others_until(self, end: Self) -> Option<f64> {
        let passed = end.all.checked_sub(self.all).filter(|ticks| *ticks > 0)?;
        let (busy, own) = (end.busy.saturating_sub(self.busy), end.own.saturating_sub(self.own));
        // The two counts are not read at one moment: a little less than nothing is nothing.
        Some(busy.saturating_sub(own) as f64 / passed as f64 * self.cores as f64)
    }
}

/// Whether a line of /proc/stat is that of one core.
fn core(line: &str) -> bool {
    line.strip_prefix("cpu").is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit()))
}

#[cfg(test)]
mod tests {
    use super::*;

    const MACHINE: &str = "\
cpu  100 10 20 1000 50 5 5 10 40 0
cpu0 50 5 10 500 25 2 3 5 20 0
cpu1 50 5 10 500 25 3 2 5 20 0
intr 12345
";
    const PROCESS: &str = "7 (a (odd) b) S 1 2 3 4 5 6 7 8 9 10 30 4 20 6 20 0 1 0";

    #[test]
    fn ticks_are_summed() {
        // 100 + 10 + 20 + 5 + 5 + 10 busy, 1050 not; 30 + 4 + 20 + 6 own.
        let expected = Clock { cores: 2, all: 1200, busy: 150, own: 60 };
        assert_eq!(Clock::read(MACHINE, PROCESS), Some(expected));
        assert_eq!(Clock::read("cpu  1 2 3\n", PROCESS), None);
        for other in ["7 (a) S 1", "nothing"] {
            assert_eq!(Clock::read(MACHINE, other), None);
        }
    }

    /// 100 ticks pass on each of two cores; of 160 busy ones 90 are one's own.
    #[test]
    fn what_others_took_is_in_cores() {
        let start = Clock { cores: 2, all: 1000, busy: 100, own: 10 };
        let end = Clock { cores: 2, all: 1200, busy: 260, own: 100 };
        assert_eq!(start.others_until(end), Some(0.7));
        assert_eq!(start.others_until(Clock { busy: 180, ..end }), Some(0.0));
        assert_eq!(start.others_until(start), None);
    }
}
