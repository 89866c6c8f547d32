//! What was measured, as it is kept in JSON.

use std::fs;
use std::path::Path;

use serde::{Deserialize, Serialize};

use super::statistics::Spread;
use super::subject::Subject;

/// All runs of one scene on one machine.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Measurement {
    pub(crate) subject: Subject,
    pub(crate) machine: Machine,
    /// Threads of the program.
    pub(crate) threads: usize,
    /// The reference's own standard error in the measure of E1, worst channel.
    pub(crate) reference_error: f64,
    pub(crate) series: Vec<Series>,
}

#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Machine {
    pub(crate) cpu: String,
    pub(crate) cores: usize,
}

/// One way to solve, with goals that become harder.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Series {
    pub(crate) method: Method,
    pub(crate) solves: Vec<Solve>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase", deny_unknown_fields)]
pub(crate) enum Method {
    /// `--error`: until the stated error is the goal.
    Refinement,
    /// `--elements` and `--converge`: until the unshot share is the goal.
    Mesh {
        /// As asked for.
        elements: usize,
    },
    /// A fixed mesh again, with `--accel octree`.
    Octree { elements: usize },
    /// A fixed mesh again, with `--accel bvh`.
    Bvh { elements: usize },
}

/// One goal, run several times.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Solve {
    /// The stated error or the unshot share asked for.
    pub(crate) goal: f64,
    /// Wall time of occluder and solve of each run.
    pub(crate) seconds: Vec<f64>,
    /// The same in every run.
    pub(crate) work: Work,
    /// What the program says of its own error.
    pub(crate) stated: Option<Stated>,
    /// Against the reference.
    pub(crate) measured: Errors,
}

/// Work that no clock measures.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Work {
    pub(crate) elements: u64,
    pub(crate) shots: u64,
    pub(crate) segments: u64,
    pub(crate) form_factors: u64,
    /// Unshot power over emitted power, worst channel.
    pub(crate) unshot: f64,
    /// What ended a refinement before its goal.
    pub(crate) limit: Option<String>,
}

/// The stated error of the triangles' exitance; nothing where a part is unknown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Stated {
    pub(crate) e1: Option<f64>,
    pub(crate) einf: Option<f64>,
}

/// Errors of the worst channel.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Errors {
    pub(crate) e1: f64,
    pub(crate) einf: f64,
}

impl Measurement {
    /// Reads a kept measurement.
    ///
    /// # Errors
    /// Names the file, the line and what is wrong there.
    pub(crate) fn read(path: &Path) -> Result<Self, String> {
        let failed = |e: String| format!("{}: {e}", path.display());
        let text = fs::read_to_string(path).map_err(|e| failed(e.to_string()))?;
        let read: Self = serde_json::from_str(&text).map_err(|e| failed(e.to_string()))?;
        if let Some((method, solve)) = read.solves().find(|(_, solve)| solve.seconds.is_empty()) {
            let goal = solve.goal;
            return Err(failed(format!("{method:?} to {goal}: no seconds, expected at least one")));
        }
        Ok(read)
    }

    /// Writes the measurement to be kept.
    pub(super) fn write(&self, path: &Path) -> Result<(), String> {
        let text = serde_json::to_string_pretty(self).map_err(|e| e.to_string())?;
        super::write(path, &(text + "\n"))
    }

    /// Every solve with its method, in order.
    pub(crate) fn solves(&self) -> impl Iterator<Item = (Method, &Solve)> {
        self.series.iter().flat_map(|s| s.solves.iter().map(|solve| (s.method, solve)))
    }

    /// The solves of the refinement.
    pub(crate) fn refinement(&self) -> impl Iterator<Item = &Solve> {
        self.solves().filter(|(method, _)| *method == Method::Refinement).map(|(_, solve)| solve)
    }
}

impl Solve {
    /// Median, least and most seconds.
    pub(crate) fn time(&self) -> Spread {
        Spread::of(&self.seconds)
    }

    /// Stated over measured E1.
    pub(crate) fn ratio(&self) -> Option<f64> {
        Some(self.stated.as_ref()?.e1? / self.measured.e1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::sample;

    #[test]
    fn what_is_written_is_read_again() {
        let text = serde_json::to_string(&sample::measurement()).unwrap();
        assert_eq!(serde_json::from_str::<Measurement>(&text).unwrap(), sample::measurement());
    }

    #[test]
    fn a_file_that_is_not_a_measurement_is_refused_with_its_place() {
        let folder = std::env::temp_dir().join(format!("xtask-measurement-{}", std::process::id()));
        let path = folder.join("room.json");
        let error_of = |text: &str| {
            crate::precision::write(&path, text).unwrap();
            Measurement::read(&path).unwrap_err()
        };
        let unknown = error_of("{ \"subject\": \"room\",\n \"sofa\": 1 }");
        let mut untimed = sample::measurement();
        untimed.series[0].solves[0].seconds.clear();
        let untimed = error_of(&serde_json::to_string(&untimed).unwrap());
        fs::remove_dir_all(folder).unwrap();
        assert!(unknown.contains("room.json: unknown field `sofa`"), "{unknown}");
        assert!(unknown.contains("line 2"), "{unknown}");
        assert!(untimed.ends_with("no seconds, expected at least one"), "{untimed}");
    }
}
