//! What must hold before a time counts: a quick wrong answer is no answer.

use super::cell::Cell;
use super::chart::STAGES;
use super::record::{Digest, Outcome, Record, Timed};
use crate::precision::{Errors, Said, Stated, numbers::percent};

/// The most by which the energy ledger of a solve may fail to add up, as docs/report.md promises.
const MOST_IMBALANCE: f64 = 1e-12;

/// The most by which a fixed mesh, which states no error, may differ from the reference: what
/// the room's light is misplaced by, however long it runs, in the program this one grew from.
const MOST_WRONG: f64 = 0.26;

/// A stated error counts as kept within so many standard errors of the reference.
const REFERENCE_ERRORS: f64 = 3.0;

/// Whether one solve did what the cell asks.
pub(super) fn solve(cell: &Cell, said: &Said) -> Result<(), String> {
    if said.threads != cell.threads {
        return Err(format!("{} threads did the work", said.threads));
    }
    if let Some(limit) = &said.work.limit {
        return Err(format!("{limit} ended the work before its goal"));
    }
    if said.imbalance.is_nan() || said.imbalance > MOST_IMBALANCE {
        let off = said.imbalance;
        return Err(format!("the energy ledger is off by {off:e}, at most {MOST_IMBALANCE:e}"));
    }
    if let Some(stage) = said.stages.keys().find(|name| !is_shown(name)) {
        return Err(format!("a stage {stage:?} is in no chart"));
    }
    let reached = match &said.stated {
        Some(Stated { e1, .. }) => e1.is_some_and(|error| error <= cell.goal),
        None => said.work.unshot <= cell.goal,
    };
    if reached { Ok(()) } else { Err(format!("{} is not reached", percent(cell.goal))) }
}

/// Whether a stage has its place in the charts, or does not count as time.
fn is_shown(name: &str) -> bool {
    ["read", "output"].contains(&name) || STAGES.iter().any(|(stage, _)| *stage == name)
}

/// Whether the error is what was stated, or no larger than a solution's may be.
pub(super) fn error(
    stated: Option<&Stated>,
    measured: Errors,
    reference: f64,
) -> Result<(), String> {
    let stated = stated.and_then(|stated| stated.e1);
    let most = stated.unwrap_or(MOST_WRONG) + REFERENCE_ERRORS * reference;
    if measured.e1 <= most {
        return Ok(());
    }
    let what = if stated.is_some() { "stated" } else { "of a solution" };
    Err(format!("E1 is {}, more than the {} {what}", percent(measured.e1), percent(most)))
}

/// Whether a run has the bytes of every run before that must have the same, and its work.
pub(super) fn same(cell: &Cell, timed: &Timed, before: &[Record]) -> Result<(), String> {
    let light = cell.light();
    let found = before.iter().find_map(|record| match &record.outcome {
        Outcome::Timed(first) if record.cell.light() == light => Some((&record.cell, first)),
        _ => None,
    });
    let Some((first, Timed { solution, work, .. })) = found else { return Ok(()) };
    if *solution != timed.solution {
        let [ours, theirs] = [timed.solution, *solution]
            .map(|Digest { crc32, bytes }| format!("{bytes} bytes with the checksum {crc32:08x}"));
        return Err(format!("the solution has {ours}, that of `{}` {theirs}", first.name()));
    }
    if *work != timed.work {
        return Err(format!("the work is {:?}, that of `{}` {work:?}", timed.work, first.name()));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::cell::{Accel, Method};
    use crate::bench::sample;

    fn said() -> Said {
        let Timed { seconds, stages, work, stated, imbalance, peak, .. } = sample::timed(1.0);
        Said { threads: 2, seconds, stages, work, stated, imbalance, peak }
    }

    #[test]
    fn a_solve_that_does_something_else_is_refused() {
        let cell = sample::cell();
        assert_eq!(solve(&cell, &said()), Ok(()));
        let refused = |said: &Said| solve(&cell, said).unwrap_err();
        let one = refused(&Said { threads: 1, ..said() });
        assert_eq!(one, "1 threads did the work");
        assert!(refused(&Said { imbalance: 2e-12, ..said() }).contains("2e-12"));
        assert!(refused(&Said { imbalance: f64::NAN, ..said() }).contains("ledger"));
        let mut other = said();
        other.stages.insert("sofa".into(), 1.0);
        assert!(refused(&other).contains("sofa"));
        let mut short = said();
        short.work.unshot = 2e-3;
        assert_eq!(refused(&short), "0.10 % is not reached");
        short.work.limit = Some("--max-time".into());
        assert!(refused(&short).starts_with("--max-time ended"));
    }

    #[test]
    fn a_refinement_must_state_its_goal() {
        let goal = 0.02;
        let refine = Cell { method: Method::Refine, elements: None, goal, ..sample::cell() };
        let with = |e1| Said { stated: Some(Stated { e1, einf: None }), ..said() };
        assert_eq!(solve(&refine, &with(Some(0.02))), Ok(()));
        assert!(solve(&refine, &with(Some(0.03))).is_err());
        assert!(solve(&refine, &with(None)).is_err());
    }

    #[test]
    fn an_error_above_the_stated_one_is_refused() {
        let stated = Stated { e1: Some(0.01), einf: None };
        let measured = |e1| Errors { e1, einf: 0.5 };
        assert_eq!(error(Some(&stated), measured(0.0102), 1e-4), Ok(()));
        let refused = error(Some(&stated), measured(0.012), 1e-4).unwrap_err();
        assert_eq!(refused, "E1 is 1.2 %, more than the 1.0 % stated");
        assert_eq!(error(None, measured(0.2), 1e-4), Ok(()));
        let refused = error(None, measured(0.3), 1e-4).unwrap_err();
        assert_eq!(refused, "E1 is 30 %, more than the 26 % of a solution");
        assert!(error(None, measured(f64::NAN), 1e-4).is_err());
    }

    #[test]
    fn threads_loops_and_occluders_must_not_change_a_byte() {
        let before = sample::runs(&sample::cell(), &[1.0]);
        let mut timed = sample::timed(2.0);
        let octree = Cell {
            threads: 1,
            sharing: Some("static".into()),
            accel: Some(Accel::Octree),
            ..sample::cell()
        };
        assert_eq!(same(&octree, &timed, &before), Ok(()));
        timed.solution.crc32 ^= 1;
        let refused = same(&octree, &timed, &before).unwrap_err();
        assert!(refused.contains("0000abcc") && refused.contains("0000abcd"), "{refused}");
        // Another schedule takes other steps, and another mesh is another mesh.
        let other = Cell { schedule: Some("single".into()), ..octree.clone() };
        assert_eq!(same(&other, &timed, &before), Ok(()));
        let other = Cell { elements: Some(1), ..octree.clone() };
        assert_eq!(same(&other, &timed, &before), Ok(()));
        timed.solution.crc32 ^= 1;
        timed.work.segments += 1;
        assert!(same(&octree, &timed, &before).unwrap_err().starts_with("the work is"));
    }
}
