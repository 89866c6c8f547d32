//! The release program, started as a user starts it, and what it says.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;
use serde_json::Value;

use super::measurement::{Errors, Stated, Work};
use crate::built;

/// The version of the program's report that is read here; docs/report.md says what it holds.
const SCHEMA: u64 = 2;

/// The built program and a folder for what it writes.
pub(crate) struct Program {
    root: PathBuf,
    path: PathBuf,
    scratch: PathBuf,
}

/// What one solve says of itself.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Said {
    pub(crate) threads: usize,
    /// Building the occluder and solving.
    pub(crate) seconds: f64,
    /// The same, by what it was for; with reading and writing, which do not count.
    pub(crate) stages: BTreeMap<String, f64>,
    pub(crate) work: Work,
    pub(crate) stated: Option<Stated>,
    /// By how much the energy ledger does not add up, relative.
    pub(crate) imbalance: f64,
    /// Most memory, bytes; nothing where the system does not tell.
    pub(crate) peak: Option<u64>,
}

/// What `radiosity compare` says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Compared {
    pub(crate) errors: Errors,
    /// The reference's own standard error in the measure of E1.
    pub(crate) reference: f64,
}

impl Program {
    /// Builds the program with optimisation. What it writes goes into a folder of this name
    /// beside it, so that two tasks may run at once.
    pub(crate) fn build(root: &Path, scratch: &str) -> Result<Self, String> {
        let path = built::program(root, "radiosity", "radiosity")?;
        let scratch = path.with_file_name(scratch);
        fs::create_dir_all(&scratch).map_err(|e| format!("{}: {e}", scratch.display()))?;
        Ok(Self { root: root.to_path_buf(), path, scratch })
    }

    /// Solves a scene, given by its path from the root, with these settings, and keeps the
    /// solution for [`Self::solution`] and [`Self::compare`].
    pub(crate) fn solve(&self, scene: &str, settings: &[String]) -> Result<Said, String> {
        self.solve_to("solve", scene, settings)
    }

    /// Solves a scene by so many programs at once: what each says, and its solution.
    pub(crate) fn solve_at_once(
        &self,
        programs: usize,
        scene: &str,
        settings: &[String],
    ) -> Result<Vec<(Said, String)>, String> {
        std::thread::scope(|scope| {
            let run = |i: usize| {
                scope.spawn(move || {
                    let name = format!("copy-{i}");
                    let said = self.solve_to(&name, scene, settings)?;
                    Ok((said, self.solution_of(&name)?))
                })
            };
            let running: Vec<_> = (0..programs).map(run).collect();
            let said = running.into_iter().map(|thread| {
                thread.join().unwrap_or_else(|_| Err("a thread that ran it panicked".into()))
            });
            said.collect()
        })
    }

    fn solve_to(&self, name: &str, scene: &str, settings: &[String]) -> Result<Said, String> {
        let solution = self.solution_path(name);
        let report = solution.with_extension("json");
        let mut command = Command::new(&self.path);
        command.arg("solve").arg(scene).args(settings);
        command.arg("-o").arg(solution).arg("--report").arg(&report);
        self.output(command)?;
        let failed = |e: String| format!("{}: {e}", report.display());
        let text = fs::read_to_string(&report).map_err(|e| failed(e.to_string()))?;
        said(&text).map_err(failed)
    }

    /// Holds the last solution against a reference, given by its path from the root.
    pub(crate) fn compare(&self, reference: &str) -> Result<Compared, String> {
        let mut command = Command::new(&self.path);
        command.arg("compare").arg(self.solution_path("solve")).arg(reference);
        compared(&self.output(command)?)
    }

    /// The text of the last solution.
    pub(crate) fn solution(&self) -> Result<String, String> {
        self.solution_of("solve")
    }

    fn solution_of(&self, name: &str) -> Result<String, String> {
        let path = self.solution_path(name);
        fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
    }

    fn solution_path(&self, name: &str) -> PathBuf {
        self.scratch.join(name).with_extension("csv")
    }

    /// The program's own bytes: other bytes are another program, whatever its revision says.
    pub(crate) fn bytes(&self) -> Result<Vec<u8>, String> {
        fs::read(&self.path).map_err(|e| format!("{}: {e}", self.path.display()))
    }

    /// Runs to the end and gives what was printed.
    fn output(&self, mut command: Command) -> Result<String, String> {
        let failed = |e: String| format!("{}: {e}", self.path.display());
        let output = command.current_dir(&self.root).output().map_err(|e| failed(e.to_string()))?;
        if output.status.success() {
            return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
        }
        let last = String::from_utf8_lossy(&output.stderr).trim_end().to_owned();
        Err(failed(format!("{}: {last}", output.status)))
    }
}

/// Reads a report.
fn said(text: &str) -> Result<Said, String> {
    let report: Value = serde_json::from_str(text).map_err(|e| e.to_string())?;
    if report["schema"] != SCHEMA {
        return Err(format!("schema is {}, expected {SCHEMA}", report["schema"]));
    }
    let Report { settings, mesh, solve, error, energy, seconds, memory } =
        serde_json::from_value(report).map_err(|e| e.to_string())?;
    let Seconds { read, occluder, solve: solving, mut stages, output } = seconds;
    let rest = (solving - stages.values().sum::<f64>()).max(0.0);
    let around = [("read", read), ("occluder", occluder), ("other", rest), ("output", output)];
    stages.extend(around.map(|(name, seconds)| (name.to_owned(), seconds)));
    Ok(Said {
        threads: settings.threads,
        seconds: occluder + solving,
        stages,
        imbalance: energy.imbalance,
        peak: memory.peak,
        work: Work {
            elements: mesh.elements,
            shots: solve.shots,
            segments: solve.rays,
            form_factors: solve.form_factors,
            unshot: solve.unshot,
            limit: solve.limit,
        },
        stated: error.map(|e| Stated { e1: e.total, einf: e.largest.total }),
    })
}

/// The part of a report that is read here.
#[derive(Deserialize)]
struct Report {
    settings: Settings,
    mesh: Mesh,
    solve: SolveFacts,
    error: Option<ErrorFacts>,
    energy: Energy,
    seconds: Seconds,
    memory: Memory,
}

#[derive(Deserialize)]
struct Settings {
    threads: usize,
}

#[derive(Deserialize)]
struct Mesh {
    elements: u64,
}

#[derive(Deserialize)]
struct SolveFacts {
    unshot: f64,
    shots: u64,
    rays: u64,
    form_factors: u64,
    limit: Option<String>,
}

#[derive(Deserialize)]
struct ErrorFacts {
    total: Option<f64>,
    largest: Total,
}

#[derive(Deserialize)]
struct Total {
    total: Option<f64>,
}

#[derive(Deserialize)]
struct Energy {
    imbalance: f64,
}

#[derive(Deserialize)]
struct Seconds {
    read: f64,
    occluder: f64,
    solve: f64,
    stages: BTreeMap<String, f64>,
    output: f64,
}

#[derive(Deserialize)]
struct Memory {
    peak: Option<u64>,
}

/// Reads the table of `compare`: the last column is the worst channel.
fn compared(table: &str) -> Result<Compared, String> {
    let worst = |name: &str| {
        let row = table.lines().find_map(|line| line.strip_prefix(name));
        let column = row.and_then(|rest| rest.split_whitespace().last());
        column
            .and_then(|number| number.parse::<f64>().ok())
            .ok_or_else(|| format!("`compare` printed no row `{name}`, but: {}", table.trim_end()))
    };
    let errors = Errors { e1: worst("E1 ")?, einf: worst("Einf ")? };
    Ok(Compared { errors, reference: worst("ref. se ")? })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report() -> Value {
        serde_json::json!({
            "schema": 2,
            "settings": { "threads": 2, "error": 0.04 },
            "mesh": { "elements": 4000, "patches": 520 },
            "solve": { "unshot": 0.0016, "shots": 1651, "rays": 4_791_978,
                       "form_factors": 4_791_979, "limit": null, "stopped": "converged" },
            "error": { "total": 0.0317, "mesh": 0.0236, "largest": { "total": null } },
            "energy": { "imbalance": 1e-15 },
            "seconds": { "read": 9.0, "occluder": 0.25, "solve": 1.0, "output": 9.0,
                         "stages": { "mesh": 0.25, "transfer": 0.5 } },
            "memory": { "peak": 12_000_000 },
        })
    }

    #[test]
    fn a_report_is_read() {
        let said = said(&report().to_string()).unwrap();
        // Neither reading nor writing counts.
        assert_eq!((said.threads, said.seconds), (2, 1.25));
        assert_eq!((said.imbalance, said.peak), (1e-15, Some(12_000_000)));
        // What no stage of the solve took is there, too.
        let stages: Vec<_> = said.stages.iter().map(|(name, s)| (name.as_str(), *s)).collect();
        let expected = [
            ("mesh", 0.25),
            ("occluder", 0.25),
            ("other", 0.25),
            ("output", 9.0),
            ("read", 9.0),
            ("transfer", 0.5),
        ];
        assert_eq!(stages, expected);
        assert_eq!(said.stated, Some(Stated { e1: Some(0.0317), einf: None }));
        let work = said.work;
        let counts = (work.elements, work.shots, work.segments, work.form_factors);
        assert_eq!(counts, (4000, 1651, 4_791_978, 4_791_979));
        assert_eq!((work.unshot, work.limit), (0.0016, None));
    }

    #[test]
    fn one_mesh_states_nothing_and_a_limit_has_a_name() {
        let mut report = report();
        report["error"] = Value::Null;
        report["solve"]["limit"] = "--max-time".into();
        let said = said(&report.to_string()).unwrap();
        assert_eq!((said.stated, said.work.limit), (None, Some("--max-time".into())));
    }

    #[test]
    fn a_report_of_another_kind_is_refused() {
        let mut other = report();
        other["schema"] = 1.into();
        assert_eq!(said(&other.to_string()), Err("schema is 1, expected 2".into()));
        let mut without = report();
        without["solve"].as_object_mut().unwrap().remove("shots");
        assert_eq!(said(&without.to_string()), Err("missing field `shots`".into()));
    }

    #[test]
    fn the_table_of_compare_is_read() {
        let table = "\
measure          r          g          b      worst
E1         0.016662   0.017735   0.017886   0.017886
E2         0.024812   0.023663   0.024667   0.024812
Einf       0.126555   0.077358   0.097687   0.126555
ref. se    0.000119   0.000102   0.000110   0.000119
over 116 of 156 rows
";
        let errors = Errors { e1: 0.017886, einf: 0.126555 };
        assert_eq!(compared(table), Ok(Compared { errors, reference: 0.000119 }));
        let without = table.replace("ref. se", "");
        assert!(compared(&without).unwrap_err().starts_with("`compare` printed no row `ref. se `"));
    }
}
