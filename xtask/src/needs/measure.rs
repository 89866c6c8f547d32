//! A case solved with what its scene needs and with everything, by turns.

use std::path::Path;
use std::process::Command;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use super::cases::Case;

/// What came of a case.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Record {
    pub(super) name: String,
    pub(super) flags: String,
    /// Topics of the decisions that leave something out.
    pub(super) left_out: Vec<String>,
    /// Whether all of these say that they change no bit.
    pub(super) exact: bool,
    pub(super) same_bytes: bool,
    /// E1 between the two solutions, worst channel.
    pub(super) apart: f64,
    /// What both solutions state of their errors, together.
    pub(super) stated: Option<f64>,
    /// Form factors and segments that were foreseen for what was needed.
    pub(super) foreseen: Amounts,
    pub(super) needed: Side,
    pub(super) everything: Side,
}

/// Amounts of work.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Amounts {
    pub(super) elements: f64,
    pub(super) form_factors: f64,
    pub(super) segments: f64,
    pub(super) directions: f64,
}

/// One of the two ways.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Side {
    pub(super) work: Amounts,
    /// Planning, building and solving, of each round.
    pub(super) seconds: Vec<f64>,
}

/// A solve that takes more seconds than this is done a few times only.
const LONG: f64 = 5.0;
const FEW_ROUNDS: usize = 3;

/// Solves a case `rounds` times either way, or [`FEW_ROUNDS`] times if that takes long.
pub(super) fn measure(
    program: &Path,
    case: &Case,
    scene: &Path,
    folder: &Path,
    rounds: usize,
) -> Result<Record, String> {
    let mut reports = [Value::Null, Value::Null];
    let mut seconds = [Vec::new(), Vec::new()];
    for round in 0..rounds {
        if round >= FEW_ROUNDS && seconds.iter().flatten().any(|s| *s > LONG) {
            break;
        }
        // Each is the first as often as the other: the machine's clock drifts.
        for turn in 0..2 {
            let side = (round + turn) % 2;
            let report = solve(program, case, scene, folder, side)?;
            let of = |part: &str| report["seconds"][part].as_f64().unwrap_or(f64::NAN);
            seconds[side].push(of("plan") + of("occluder") + of("solve"));
            reports[side] = report;
        }
    }
    let [needed, everything] = &reports;
    let read = |side: usize| {
        let path = folder.join(format!("{side}.csv"));
        std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))
    };
    let decisions: Vec<&Value> = needed["plan"]["decisions"]
        .as_array()
        .into_iter()
        .flatten()
        .filter(|decision| decision["leaves_out"] == true)
        .collect();
    let text = |value: &Value| value.as_str().unwrap_or_default().to_owned();
    let stated = |report: &Value| report["error"]["total"].as_f64();
    let [seconds_needed, seconds_everything] = seconds;
    Ok(Record {
        name: case.name.into(),
        flags: case.flags.into(),
        left_out: decisions.iter().map(|d| text(&d["topic"])).collect(),
        exact: decisions.iter().all(|d| text(&d["effect"]).starts_with("none")),
        same_bytes: read(0)? == read(1)?,
        apart: apart(program, folder)?,
        stated: stated(needed).zip(stated(everything)).map(|(a, b)| a + b),
        foreseen: Amounts::of(&needed["plan"]["foreseen"]),
        needed: Side { work: Amounts::of(&needed["plan"]["actual"]), seconds: seconds_needed },
        everything: Side {
            work: Amounts::of(&everything["plan"]["actual"]),
            seconds: seconds_everything,
        },
    })
}

/// One solve; its report.
fn solve(
    program: &Path,
    case: &Case,
    scene: &Path,
    folder: &Path,
    side: usize,
) -> Result<Value, String> {
    let report = folder.join("report.json");
    let mut command = Command::new(program);
    command.arg("solve").arg(scene).args(case.flags.split(' '));
    command.args(["--need", if side == 0 { "auto" } else { "everything" }]);
    command.arg("-o").arg(folder.join(format!("{side}.csv"))).arg("--report").arg(&report);
    let done = command.output().map_err(|e| format!("{}: {e}", program.display()))?;
    if !done.status.success() {
        return Err(format!("failed: {command:?}\n{}", String::from_utf8_lossy(&done.stderr)));
    }
    let text =
        std::fs::read_to_string(&report).map_err(|e| format!("{}: {e}", report.display()))?;
    serde_json::from_str(&text).map_err(|e| format!("{}: {e}", report.display()))
}

/// E1 between the two solutions, by the program itself.
fn apart(program: &Path, folder: &Path) -> Result<f64, String> {
    let file = |side: usize| folder.join(format!("{side}.csv"));
    let mut command = Command::new(program);
    let done = command.arg("compare").arg(file(0)).arg(file(1)).output();
    let done = done.map_err(|e| format!("{}: {e}", program.display()))?;
    let text = String::from_utf8_lossy(&done.stdout);
    let line = text.lines().find(|line| line.starts_with("E1"));
    let worst = line.and_then(|line| line.split_whitespace().last()).and_then(|w| w.parse().ok());
    worst.ok_or_else(|| format!("{command:?}: names no E1:\n{text}"))
}

impl Amounts {
    fn of(work: &Value) -> Self {
        let of = |field: &str| work[field].as_f64().unwrap_or(f64::NAN);
        Self {
            elements: of("elements"),
            form_factors: of("form_factors"),
            segments: of("segments"),
            directions: of("directions"),
        }
    }
}

impl Record {
    /// The median of the rounds' ratios of time: below 1 where leaving out pays.
    pub(super) fn ratio(&self) -> f64 {
        let pairs = self.needed.seconds.iter().zip(&self.everything.seconds);
        let mut ratios: Vec<f64> = pairs.map(|(a, b)| a / b).collect();
        ratios.sort_unstable_by(f64::total_cmp);
        ratios.get(ratios.len() / 2).copied().unwrap_or(f64::NAN)
    }

    /// What is wrong with it, if anything.
    pub(super) fn complaint(&self) -> Option<String> {
        let what = format!("{} {}", self.name, self.flags);
        if self.exact && !self.same_bytes {
            return Some(format!("{what}: exact decisions, and other bytes"));
        }
        if self.stated.is_some_and(|stated| self.apart > stated) {
            return Some(format!("{what}: {} apart, more than is stated", self.apart));
        }
        if self.ratio() > SLOWER {
            return Some(format!("{what}: {:.3} times as long as with everything", self.ratio()));
        }
        None
    }
}

/// No case may take longer than with everything by more than this.
const SLOWER: f64 = 1.02;

#[cfg(test)]
mod tests {
    use super::*;

    fn record() -> Record {
        let work = Amounts { elements: 1.0, form_factors: 2.0, segments: 3.0, directions: 4.0 };
        let side = |seconds: [f64; 3]| Side { work: work.clone(), seconds: seconds.into() };
        Record {
            name: "a".into(),
            flags: "-f".into(),
            left_out: Vec::new(),
            exact: true,
            same_bytes: true,
            apart: 0.0,
            stated: Some(0.02),
            foreseen: work.clone(),
            needed: side([1.0, 2.0, 9.0]),
            everything: side([2.0, 2.5, 3.0]),
        }
    }

    #[test]
    fn what_is_wrong_is_said() {
        assert!((record().ratio() - 0.8).abs() < 1e-12);
        assert_eq!(record().complaint(), None);
        let other_bytes = Record { same_bytes: false, ..record() };
        assert!(other_bytes.complaint().is_some_and(|c| c.contains("other bytes")));
        let allowed = Record { exact: false, apart: 0.01, ..other_bytes };
        assert_eq!(allowed.complaint(), None);
        let wrong = Record { apart: 0.03, ..allowed };
        assert!(wrong.complaint().is_some_and(|c| c.contains("more than is stated")));
        let seconds = vec![3.0, 3.0, 3.2];
        let slow = Record { needed: Side { seconds, ..record().needed }, ..record() };
        assert!(slow.complaint().is_some_and(|c| c.contains("1.2")), "{:?}", slow.complaint());
    }
}
