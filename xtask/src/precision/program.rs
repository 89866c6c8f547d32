//! The release program, started as a user starts it, and what it says.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;
use serde_json::Value;

use super::measurement::{Errors, Stated, Work};
use super::subject::Subject;
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
    pub(crate) work: Work,
    pub(super) stated: Option<Stated>,
}

/// What `radiosity compare` says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Compared {
    pub(super) errors: Errors,
    /// The reference's own standard error in the measure of E1.
    pub(super) reference: f64,
}

impl Program {
    /// Builds the program with optimisation. What it writes goes into a folder of this name
    /// beside it, so that two tasks may run at once.
    pub(crate) fn build(root: &Path, scratch: &str) -> Result<Self, String> {
        let path = built::program(root, "cli", "radiosity")?;
        let scratch = path.with_file_name(scratch);
        fs::create_dir_all(&scratch).map_err(|e| format!("{}: {e}", scratch.display()))?;
        Ok(Self { root: root.to_path_buf(), path, scratch })
    }

    /// Solves a scene, given by its path from the root, with these settings, and keeps the
    /// solution for [`Self::solution`] and [`Self::compare`].
    pub(crate) fn solve(&self, scene: &str, settings: &[String]) -> Result<Said, String> {
        self.solve_to("solve", scene, settings)
    }

    /// Solves a scene by so many programs at once; none of the solutions is kept.
    pub(crate) fn solve_at_once(
        &self,
        programs: usize,
        scene: &str,
        settings: &[String],
    ) -> Result<Vec<Said>, String> {
        std::thread::scope(|scope| {
            let run = |i: usize| {
                scope.spawn(move || self.solve_to(&format!("copy-{i}"), scene, settings))
            };
            let running: Vec<_> = (0..programs).map(run).collect();
            let said = running.into_iter().map(|thread| {
                thread.join().unwrap_or_else(|_| Err("a thread that ran it panicked".into()))
            });
            said.collect()
        })
    }

    fn solve_to(&self, name: &str, scene: &str, settings: &[String]) -> Result<Said, String> {
        let [solution, report] =
            ["csv", "json"].map(|end| self.scratch.join(format!("{name}.{end}")));
        let mut command = Command::new(&self.path);
        command.arg("solve").arg(scene).args(settings);
        command.arg("-o").arg(solution).arg("--report").arg(&report);
        self.output(command)?;
        let failed = |e: String| format!("{}: {e}", report.display());
        let text = fs::read_to_string(&report).map_err(|e| failed(e.to_string()))?;
        said(&text).map_err(failed)
    }

    /// Holds the last solution against the subject's reference.
    pub(super) fn compare(&self, subject: Subject) -> Result<Compared, String> {
        let mut command = Command::new(&self.path);
        command.arg("compare").arg(self.solution_path()).arg(subject.reference());
        compared(&self.output(command)?)
    }

    /// The text of the last solution.
    pub(crate) fn solution(&self) -> Result<String, String> {
        let path = self.solution_path();
        fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
    }

    fn solution_path(&self) -> PathBuf {
        self.scratch.join("solve.csv")
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
    let Report { settings, mesh, solve, error, seconds } =
        serde_json::from_value(report).map_err(|e| e.to_string())?;
    Ok(Said {
        threads: settings.threads,
        seconds: seconds.occluder + seconds.solve,
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
    seconds: Seconds,
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
struct Seconds {
    occluder: f64,
    solve: f64,
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
            "seconds": { "read": 9.0, "occluder": 0.25, "solve": 1.0, "output": 9.0 },
        })
    }

    #[test]
    fn a_report_is_read() {
        let said = said(&report().to_string()).unwrap();
        // Neither reading nor writing counts.
        assert_eq!((said.threads, said.seconds), (2, 1.25));
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
