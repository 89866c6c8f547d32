//! The runs of one cell together, and cells that differ in one thing alone.

use super::amdahl;
use super::cell::{Accel, Cell, Method};
use super::record::{Outcome, Record, Timed};
use crate::precision::statistics::Spread;

/// All runs of a cell whose times count, by round.
#[derive(Clone, Debug)]
pub(super) struct Group<'a> {
    pub(super) cell: &'a Cell,
    runs: Vec<(usize, &'a Timed)>,
}

/// Cells that differ in the number of threads alone.
#[derive(Clone, Debug)]
pub(super) struct Scaling<'a> {
    /// Ascending; the first is one thread.
    pub(super) points: Vec<&'a Group<'a>>,
}

/// Every cell with a time that counts, in the order of the records.
pub(super) fn groups(records: &[Record]) -> Vec<Group<'_>> {
    let mut groups: Vec<Group> = Vec::new();
    for Record { cell, run, outcome } in records {
        let Outcome::Timed(timed) = outcome else { continue };
        match groups.iter_mut().find(|group| group.cell == cell) {
            Some(group) => group.runs.push((*run, timed)),
            None => groups.push(Group { cell, runs: vec![(*run, timed)] }),
        }
    }
    groups
}

/// Every cell of one thread with those of more.
pub(super) fn scalings<'a>(groups: &'a [Group<'a>]) -> Vec<Scaling<'a>> {
    let single = |group: &&Group| group.cell.programs == 1;
    let alone = groups.iter().filter(single).filter(|group| group.cell.threads == 1);
    let all = alone.map(|first| {
        let like = |group: &&Group| Cell { threads: 1, ..group.cell.clone() } == *first.cell;
        let mut points: Vec<_> = groups.iter().filter(single).filter(like).collect();
        points.sort_by_key(|group| group.cell.threads);
        Scaling { points }
    });
    all.filter(|scaling| scaling.points.len() > 1).collect()
}

impl Group<'_> {
    /// How many runs count.
    pub(super) fn runs(&self) -> usize {
        self.runs.len()
    }

    /// Wall time of each run.
    pub(super) fn seconds(&self) -> Vec<f64> {
        self.runs.iter().map(|(_, timed)| timed.seconds).collect()
    }

    pub(super) fn time(&self) -> Spread {
        Spread::of(&self.seconds())
    }

    /// The first run: what does not depend on the clock is the same in all.
    pub(super) fn first(&self) -> &Timed {
        self.runs[0].1
    }

    /// Median time of a stage.
    pub(super) fn stage(&self, name: &str) -> f64 {
        let of = |(_, timed): &(usize, &Timed)| timed.stages.get(name).copied().unwrap_or(0.0);
        Spread::of(&self.runs.iter().map(of).collect::<Vec<_>>()).median
    }

    /// Median of the most memory, bytes.
    pub(super) fn peak(&self) -> Option<f64> {
        let peaks: Option<Vec<f64>> =
            self.runs.iter().map(|(_, timed)| Some(timed.peak? as f64)).collect();
        peaks.map(|peaks| Spread::of(&peaks).median)
    }

    /// Cores that others kept busy, the mean over the runs.
    pub(super) fn others(&self) -> Option<f64> {
        let others: Option<Vec<f64>> = self.runs.iter().map(|(_, timed)| timed.others).collect();
        others.map(|others| others.iter().sum::<f64>() / others.len() as f64)
    }

    /// Times of this one over those of `other` in the same rounds: what the machine does to a whole
    /// round falls out.
    pub(super) fn over(&self, other: &Group) -> Vec<f64> {
        let of = |(round, timed): &(usize, &Timed)| {
            let (_, theirs) = other.runs.iter().find(|(run, _)| run == round)?;
            Some(timed.seconds / theirs.seconds)
        };
        self.runs.iter().filter_map(of).collect()
    }

    /// Whether the program decides everything that the method leaves open.
    pub(super) fn is_default(&self) -> bool {
        let Cell { schedule, sharing, accel, programs, .. } = self.cell;
        // `tasks` is what the program does anyway.
        let own_loop = sharing.as_deref().is_none_or(|l| l == "tasks");
        let own_occluder = accel.is_none_or(|a| a == Accel::Bvh);
        schedule.is_none() && own_loop && own_occluder && *programs == 1
    }

    pub(super) fn is_mesh(&self) -> bool {
        self.cell.method == Method::Mesh
    }
}

impl Scaling<'_> {
    pub(super) fn one(&self) -> &Group<'_> {
        self.points[0]
    }

    /// Time of one thread over that of a point, each against the same round.
    pub(super) fn speed_up(&self, point: &Group) -> Option<Spread> {
        let ratios = self.one().over(point);
        (!ratios.is_empty()).then(|| Spread::of(&ratios))
    }

    /// The serial share by Amdahl's law, of the points that have a core for each thread.
    pub(super) fn serial_share(&self, cores: usize) -> Option<f64> {
        let within = self.points.iter().filter(|point| point.cell.threads <= cores);
        let medians = within.filter_map(|p| Some((p.cell.threads, self.speed_up(p)?.median)));
        amdahl::serial_share(medians)
    }

    /// How many times the work of one program as many programs as cores did in its time.
    pub(super) fn ceiling(&self, groups: &[Group]) -> Option<(usize, Spread)> {
        let light = self.one().cell.light();
        let many = groups.iter().find(|g| g.cell.programs > 1 && g.cell.light() == light)?;
        let alone = groups.iter().find(|g| *g.cell == Cell { programs: 1, ..many.cell.clone() })?;
        let programs = many.cell.programs;
        let ratios: Vec<_> = alone.over(many).iter().map(|r| r * programs as f64).collect();
        (!ratios.is_empty()).then(|| (programs, Spread::of(&ratios)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    /// Speed-ups of the sample by two threads, round by round: 8/5, 16/10, 8/4.
    #[test]
    fn rounds_are_held_against_each_other() {
        let records = sample::records();
        let groups = groups(&records);
        let scalings = scalings(&groups);
        assert_eq!(scalings.len(), 1, "one thread alone is no series");
        let threads: Vec<_> = scalings[0].points.iter().map(|p| p.cell.threads).collect();
        assert_eq!(threads, [1, 2, 4]);
        let two = scalings[0].speed_up(scalings[0].points[1]).unwrap();
        assert_eq!(two, Spread { median: 1.6, least: 1.6, most: 2.0 });
        // Amdahl's law: 1/1.6 = s + (1 − s)/2. Four threads have no cores.
        let share = scalings[0].serial_share(2).unwrap();
        assert!((share - 0.25).abs() < 1e-12, "{share}");
        // Two programs in 10, 20 and 8 s, one in 8, 16 and 8.
        let (programs, most) = scalings[0].ceiling(&groups).unwrap();
        assert_eq!((programs, most), (2, Spread { median: 1.6, least: 1.6, most: 2.0 }));
    }

    #[test]
    fn refused_runs_have_no_time() {
        let mut records = sample::runs(&sample::cell(), &[1.0, 2.0, 9.0]);
        records[2].outcome = Outcome::Refused("wrong".into());
        let groups = groups(&records);
        assert_eq!((groups[0].runs(), groups[0].time().most), (2, 2.0));
        let all: Vec<_> = records.drain(2..).collect();
        assert!(super::groups(&all).is_empty());
    }

    #[test]
    fn stages_and_memory_are_medians() {
        let records = sample::runs(&sample::cell(), &[1.0, 2.0, 9.0]);
        let groups = groups(&records);
        assert_eq!((groups[0].stage("transfer"), groups[0].stage("sofa")), (1.0, 0.0));
        assert_eq!(groups[0].peak(), Some(2e7));
        assert!(groups[0].is_default() && groups[0].is_mesh());
    }
}
