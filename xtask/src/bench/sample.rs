//! Small records for tests: made up, round, and with every case in them.

use super::cell::{Cell, Method};
use super::host::Host;
use super::record::{Digest, Outcome, Record, Timed};
use super::scene::Scene;
use crate::precision::{Errors, Work};

/// A fixed mesh of the room on two threads.
pub(super) fn cell() -> Cell {
    Cell {
        scene: Scene::Room,
        method: Method::Mesh,
        elements: Some(8000),
        goal: 1e-3,
        schedule: None,
        sharing: None,
        accel: None,
        threads: 2,
        programs: 1,
    }
}

/// A run of so many seconds, half of them for the transfer and a quarter for the commit.
pub(super) fn timed(seconds: f64) -> Timed {
    let stages = [("transfer", 0.5), ("commit", 0.25), ("occluder", 0.25)];
    Timed {
        seconds,
        stages: stages.map(|(name, share)| (name.to_owned(), share * seconds)).into(),
        work: Work {
            elements: 7999,
            shots: 100,
            segments: 1_000_000,
            form_factors: 2_000_000,
            unshot: 1e-3,
            limit: None,
        },
        peak: Some(20_000_000),
        stated: None,
        measured: Some(Errors { e1: 0.01, einf: 0.1 }),
        reference: Some(1e-4),
        imbalance: 1e-15,
        solution: Digest { crc32: 0xabcd, bytes: 100 },
        others: Some(0.05),
    }
}

/// All runs of a cell, the first of them run 0.
pub(super) fn runs(cell: &Cell, seconds: &[f64]) -> Vec<Record> {
    let record = |(run, seconds): (usize, &f64)| {
        let outcome = Outcome::Timed(timed(*seconds));
        Record { cell: cell.clone(), run, outcome }
    };
    seconds.iter().enumerate().map(record).collect()
}

/// 1, 2 and (without a core for each) 4 threads with the program's own loops, 1 thread with
/// static ones, two programs at once; a refinement; three sizes of mesh. Three rounds.
pub(super) fn records() -> Vec<Record> {
    let with = |threads: usize| Cell { threads, ..cell() };
    let alone = Cell { sharing: Some("static".into()), ..with(1) };
    let copies = Cell { programs: 2, ..with(1) };
    let mut records = runs(&with(1), &[8.0, 16.0, 8.0]);
    records.extend(runs(&with(2), &[5.0, 10.0, 4.0]));
    records.extend(runs(&with(4), &[5.0, 10.0, 5.0]));
    records.extend(runs(&alone, &[8.0, 16.0, 8.0]));
    records.extend(runs(&copies, &[10.0, 20.0, 8.0]));
    for (goal, seconds) in [(0.08, 0.5), (0.02, 2.0)] {
        let refine = Cell { method: Method::Refine, elements: None, goal, ..cell() };
        let mut refined = runs(&refine, &[seconds; 3]);
        for record in &mut refined {
            let Outcome::Timed(timed) = &mut record.outcome else { continue };
            timed.measured = Some(Errors { e1: goal / 2.0, einf: goal * 2.0 });
            timed.stated =
                Some(crate::precision::Stated { e1: Some(goal), einf: Some(goal * 10.0) });
        }
        records.extend(refined);
    }
    for (elements, seconds, bytes) in [(1000, 0.1, 10), (10_000, 1.0, 20), (100_000, 10.0, 110)] {
        let grown = Cell { elements: Some(elements), goal: 1e-2, ..cell() };
        let mut grown = runs(&grown, &[seconds; 3]);
        for record in &mut grown {
            let Outcome::Timed(timed) = &mut record.outcome else { continue };
            timed.work.elements = elements as u64;
            timed.peak = Some(bytes * 1_000_000);
        }
        records.extend(grown);
    }
    records
}

/// Two cores.
pub(super) fn host() -> Host {
    Host {
        date: "2026-01-31".into(),
        host: "some-host".into(),
        cpu: "Some CPU @ 2.60GHz".into(),
        cores: 2,
        memory: Some(24 << 30),
        system: "Linux 6.1".into(),
        toolchain: "rustc 1.95.0".into(),
        revision: "0123abc".into(),
        program: "89abcdef".into(),
    }
}
