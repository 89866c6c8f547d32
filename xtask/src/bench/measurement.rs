//! What was measured, as it is kept in JSON.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::amdahl;
use super::scene::Scene;
use crate::precision::{self, Machine, statistics::Spread};

/// All runs of one command on one machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Measurement {
    pub(super) machine: Machine,
    /// As asked for.
    pub(super) elements: usize,
    pub(super) scenes: Vec<Solved>,
}

/// One scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Solved {
    pub(super) scene: Scene,
    /// Its path from the workspace's root.
    pub(super) file: String,
    /// Those of the mesh.
    pub(super) elements: u64,
    /// Cores that other programs kept busy meanwhile, on average; nothing where unknown.
    pub(super) others: Option<f64>,
    pub(super) series: Vec<Series>,
    /// What the machine itself can do; nothing where it has one core.
    pub(super) copies: Option<Copies>,
}

/// Programs of one thread that ran at once, which share nothing but the machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Copies {
    pub(super) programs: usize,
    /// Mean wall time of occluder and solve over the programs, one for each round.
    pub(super) seconds: Vec<f64>,
}

/// One mode with each number of threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Series {
    pub(super) mode: Mode,
    /// Ascending; the first is one thread.
    pub(super) points: Vec<Timed>,
}

/// What is passed on to the program; nothing where its own choice is left to it.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Mode {
    /// How loops are shared out.
    #[serde(rename = "loop")]
    pub(super) sharing: Option<String>,
    /// How shooters follow each other.
    pub(super) schedule: Option<String>,
}

/// One number of threads.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Timed {
    pub(super) threads: usize,
    /// Wall time of occluder and solve, one for each round.
    pub(super) seconds: Vec<f64>,
}

/// The serial share by Amdahl's law.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct SerialShare {
    /// Fitted to the medians.
    pub(super) fitted: f64,
    /// Fitted to single rounds.
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Measurement {
    /// Reads a kept measurement.
    ///
    /// # Errors
    /// Names the file and what is wrong there.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let failed = |e: String| format!("{}: {e}", path.display());
        let text = fs::read_to_string(path).map_err(|e| failed(e.to_string()))?;
        let read: Self = serde_json::from_str(&text).map_err(|e| failed(e.to_string()))?;
        for solved in &read.scenes {
            for series in &solved.series {
                series.check().map_err(|e| failed(format!("{}: {e}", solved.scene.name())))?;
            }
            let rounds = solved.series.first().map_or(0, |series| series.points[0].seconds.len());
            if solved.copies.as_ref().is_some_and(|copies| copies.seconds.len() != rounds) {
                let scene = solved.scene.name();
                return Err(failed(format!("{scene}: expected copies in {rounds} rounds")));
            }
        }
        Ok(read)
    }

    /// Writes the measurement to be kept.
    pub(super) fn write(&self, path: &Path) -> Result<(), String> {
        let text = serde_json::to_string_pretty(self).map_err(|e| e.to_string())?;
        precision::write(path, &(text + "\n"))
    }
}

impl Solved {
    /// How many times the work of one program the copies did in its time: no program's threads can
    /// do more on this machine.
    pub(super) fn most(&self) -> Option<(usize, Spread)> {
        let Copies { programs, seconds } = self.copies.as_ref()?;
        let alone = &self.series.first()?.points.first()?.seconds;
        let most = alone.iter().zip(seconds).map(|(one, many)| *programs as f64 * one / many);
        Some((*programs, Spread::of(&most.collect::<Vec<_>>())))
    }
}

impl Series {
    /// What the rest relies on.
    fn check(&self) -> Result<(), String> {
        let [first, ..] = &self.points[..] else { return Err("no runs".into()) };
        if first.threads != 1 {
            return Err(format!("first {} threads, expected 1", first.threads));
        }
        if !self.points.is_sorted_by(|a, b| a.threads < b.threads) {
            return Err("numbers of threads do not ascend".into());
        }
        let rounds = first.seconds.len();
        for Timed { threads, seconds } in &self.points {
            if rounds == 0 || seconds.len() != rounds {
                let found = seconds.len();
                return Err(format!("{threads} threads: {found} runs, expected {}", rounds.max(1)));
            }
            if !seconds.iter().all(|time| *time > 0.0 && time.is_finite()) {
                return Err(format!("{threads} threads: expected seconds above 0"));
            }
        }
        Ok(())
    }

    /// Time of one thread over that of `point`, each against the same round: what the machine
    /// does to a whole round falls out.
    pub(super) fn speed_up(&self, point: &Timed) -> Spread {
        Spread::of(&self.speed_ups(point).collect::<Vec<_>>())
    }

    fn speed_ups(&self, point: &Timed) -> impl Iterator<Item = f64> {
        self.points[0].seconds.iter().zip(&point.seconds).map(|(one, many)| one / many)
    }

    /// The points that have a core for each thread.
    pub(super) fn within(&self, cores: usize) -> impl Iterator<Item = &Timed> {
        self.points.iter().filter(move |point| point.threads <= cores)
    }

    /// Fitted to the points that have a core for each thread; nothing where one thread is alone.
    pub(super) fn serial_share(&self, cores: usize) -> Option<SerialShare> {
        let medians = self.within(cores).map(|p| (p.threads, self.speed_up(p).median));
        let fitted = amdahl::serial_share(medians)?;
        let rounds = (0..self.points[0].seconds.len()).filter_map(|round| {
            let one = self.points[0].seconds[round];
            amdahl::serial_share(self.within(cores).map(|p| (p.threads, one / p.seconds[round])))
        });
        let Spread { least, most, .. } = Spread::of(&rounds.collect::<Vec<_>>());
        Some(SerialShare { fitted, least, most })
    }
}

impl Mode {
    /// The flags that ask for it.
    pub(super) fn flags(&self) -> Vec<String> {
        let flag = |name: &str, value: &Option<String>| {
            value.iter().flat_map(|value| [name.to_owned(), value.clone()]).collect::<Vec<_>>()
        };
        [flag("--loop", &self.sharing), flag("--schedule", &self.schedule)].concat()
    }

    /// How it is called: its flags.
    pub(super) fn name(&self) -> String {
        let flags = self.flags();
        if flags.is_empty() { "no flags".into() } else { flags.join(" ") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    #[test]
    fn what_is_written_is_read_again() {
        let text = serde_json::to_string(&sample::measurement()).unwrap();
        assert_eq!(serde_json::from_str::<Measurement>(&text).unwrap(), sample::measurement());
    }

    #[test]
    fn a_file_that_cannot_be_drawn_is_refused() {
        let folder = std::env::temp_dir().join(format!("xtask-bench-{}", std::process::id()));
        let path = folder.join("scaling.json");
        let error_of = |break_it: &dyn Fn(&mut Vec<Timed>)| {
            let mut broken = sample::measurement();
            break_it(&mut broken.scenes[0].series[0].points);
            broken.write(&path).unwrap();
            Measurement::read(&path).unwrap_err()
        };
        let errors = [
            error_of(&|points| points.clear()),
            error_of(&|points| points[0].threads = 2),
            error_of(&|points| points[1].threads = 4),
            error_of(&|points| points[1].seconds.truncate(1)),
            error_of(&|points| points[1].seconds[0] = 0.0),
        ];
        fs::remove_dir_all(folder).unwrap();
        let expected = [
            "no runs",
            "first 2 threads, expected 1",
            "numbers of threads do not ascend",
            "2 threads: expected seconds above 0",
        ];
        let found = [&errors[0], &errors[1], &errors[2], &errors[4]];
        for (error, expected) in found.into_iter().zip(expected) {
            assert!(error.ends_with(&format!("scaling.json: room: {expected}")), "{error}");
        }
        assert!(errors[3].ends_with("2 threads: 1 runs, expected 3"), "{}", errors[3]);
    }

    /// The machine is twice as slow in the second round: 8/5, 16/10 and 8/4 are the speed-ups.
    #[test]
    fn speed_up_is_against_the_same_round() {
        let sample = sample::measurement();
        let series = &sample.scenes[0].series[0];
        let spread = series.speed_up(&series.points[1]);
        assert_eq!(spread, Spread { median: 1.6, least: 1.6, most: 2.0 });
        assert_eq!(series.speed_up(&series.points[0]).most, 1.0);
    }

    /// From two threads alone: 1/1.6 = s + (1 − s)/2, so s = 0.25; 1/2 gives 0.
    #[test]
    fn threads_without_a_core_are_left_out_of_the_fit() {
        let sample = sample::measurement();
        let series = &sample.scenes[0].series[0];
        let share = series.serial_share(2).unwrap();
        assert_eq!(share, SerialShare { fitted: 0.25, least: 0.0, most: 0.25 });
        assert!(series.serial_share(4).unwrap().fitted > 0.25);
        assert_eq!(series.serial_share(1), None);
    }

    #[test]
    fn flags_that_nobody_asked_for_are_left_out() {
        assert_eq!(Mode::default().flags(), Vec::<String>::new());
        let both = Mode { sharing: Some("guided:1".into()), schedule: Some("multi:4".into()) };
        assert_eq!(both.name(), "--loop guided:1 --schedule multi:4");
    }
}
