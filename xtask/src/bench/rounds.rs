//! Runs cells round by round: each cell once, then each once more, so that the machine's drift hits
//! all alike and what is interrupted has whole rounds.

use std::path::Path;

use super::cell::Cell;
use super::check;
use super::others::Clock;
use super::record::{Book, Digest, Outcome, Record, Timed};
use crate::precision::numbers::{percent, seconds};
use crate::precision::{Program, Said};

/// Runs what the book does not hold yet, and keeps each run as soon as it is done.
pub(super) fn run(
    book: &mut Book,
    program: &Program,
    root: &Path,
    cells: &[Cell],
    rounds: usize,
) -> Result<(), String> {
    let all = cells.len() * rounds;
    let mut done = 0;
    for round in 0..rounds {
        for cell in cells {
            done += 1;
            if book.holds(cell, round) {
                continue;
            }
            let outcome = match once(cell, program, root, &book.records) {
                Ok(timed) => {
                    let error = timed.measured.map(|m| format!(", E1 {}", percent(m.e1)));
                    let error = error.unwrap_or_default();
                    println!("[{done}/{all}] {}: {}{error}", cell.name(), seconds(timed.seconds));
                    Outcome::Timed(timed)
                }
                // Exit code 2 is a wrong command line: nothing was run, and no record is of use.
                Err(reason) if reason.contains("exit status: 2") => {
                    let line = reason.lines().next().unwrap_or_default();
                    return Err(format!("{}: {line}", cell.name()));
                }
                Err(reason) => {
                    println!("[{done}/{all}] {}: does not count: {reason}", cell.name());
                    Outcome::Refused(reason)
                }
            };
            book.add(Record { cell: cell.clone(), run: round, outcome })?;
        }
    }
    Ok(())
}

/// Runs a cell once; an error says why its time does not count.
fn once(cell: &Cell, program: &Program, root: &Path, before: &[Record]) -> Result<Timed, String> {
    let scene = cell.scene.path(root);
    let settings = cell.settings();
    let clock = Clock::now();
    let runs = match cell.programs {
        1 => vec![(program.solve(&scene, &settings)?, program.solution()?)],
        programs => program.solve_at_once(programs, &scene, &settings)?,
    };
    let others = clock.zip(Clock::now()).and_then(|(start, end)| start.others_until(end));
    for (said, _) in &runs {
        check::solve(cell, said)?;
    }
    let [(first, solution), rest @ ..] = &runs[..] else { return Err("nothing ran".into()) };
    let compared = match cell.scene.reference(root) {
        Some(reference) if cell.programs == 1 => Some(program.compare(&reference)?),
        _ => None,
    };
    if let Some(compared) = &compared {
        check::error(first.stated.as_ref(), compared.errors, compared.reference)?;
    }
    let timed = Timed {
        seconds: runs.iter().map(|(said, _)| said.seconds).sum::<f64>() / runs.len() as f64,
        stages: first.stages.clone(),
        work: first.work.clone(),
        peak: first.peak,
        stated: first.stated.clone(),
        measured: compared.map(|c| c.errors),
        reference: compared.map(|c| c.reference),
        imbalance: first.imbalance,
        solution: Digest::of(solution),
        others,
    };
    check::same(cell, &timed, before)?;
    for (Said { work, .. }, solution) in rest {
        let other = Timed { work: work.clone(), solution: Digest::of(solution), ..timed.clone() };
        let own = Record { cell: cell.clone(), run: 0, outcome: Outcome::Timed(timed.clone()) };
        check::same(cell, &other, &[own])?;
    }
    Ok(timed)
}
