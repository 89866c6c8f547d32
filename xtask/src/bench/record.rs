//! Records of single runs, a JSON object a line, in a folder that says where they were made.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};

use super::cell::Cell;
use super::host::Host;
use crate::precision::{self, Errors, Stated, Work};

/// The files of a folder of records.
pub(super) const HOST: &str = "host.json";
pub(super) const RECORDS: &str = "records.jsonl";

/// One run of one cell.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Record {
    pub(super) cell: Cell,
    /// The round it belongs to, from 0.
    pub(super) run: usize,
    pub(super) outcome: Outcome,
}

/// What came of a run.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum Outcome {
    /// Its result is right, as far as one can tell: its time counts.
    Timed(Timed),
    /// Why its time does not count.
    Refused(String),
}

/// A run whose time counts.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Timed {
    /// Wall time of occluder and solve, by the program's own clock; the mean over programs that
    /// ran at once.
    pub(super) seconds: f64,
    /// What they were for, and reading and writing, which do not count.
    pub(super) stages: BTreeMap<String, f64>,
    /// The same in every run of a cell.
    pub(super) work: Work,
    /// Most memory, bytes.
    pub(super) peak: Option<u64>,
    pub(super) stated: Option<Stated>,
    /// Against the reference, where there is one.
    pub(super) measured: Option<Errors>,
    /// The reference's own standard error in the measure of E1.
    pub(super) reference: Option<f64>,
    /// By how much the energy ledger does not add up, relative.
    pub(super) imbalance: f64,
    pub(super) solution: Digest,
    /// Cores that other programs kept busy meanwhile, on average.
    pub(super) others: Option<f64>,
}

/// What tells solutions apart.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Digest {
    pub(super) crc32: u32,
    pub(super) bytes: usize,
}

/// A folder of records.
#[derive(Debug)]
pub(super) struct Book {
    folder: PathBuf,
    pub(super) host: Host,
    pub(super) records: Vec<Record>,
}

impl Digest {
    pub(super) fn of(text: &str) -> Self {
        Self { crc32: crc32fast::hash(text.as_bytes()), bytes: text.len() }
    }
}

impl Book {
    /// Reads a folder, or the list of records in one.
    ///
    /// # Errors
    /// Names the file, the line and what is wrong there.
    pub(super) fn read(path: &Path) -> Result<Self, String> {
        let folder = if path.is_file() { path.parent().unwrap_or(path) } else { path };
        let text = |name: &str| {
            let path = folder.join(name);
            fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))
        };
        let named = |e| format!("{}: {e}", folder.join(HOST).display());
        let host = serde_json::from_str(&text(HOST)?).map_err(named)?;
        let list = folder.join(RECORDS).display().to_string();
        let records = parsed(&text(RECORDS)?).map_err(|e| format!("{list}:{e}"))?;
        Ok(Self { folder: folder.to_owned(), host, records })
    }

    /// Goes on with a folder, or begins one; `fresh` leaves out what it holds.
    ///
    /// # Errors
    /// Where it holds records of another machine or program.
    pub(super) fn open(folder: &Path, host: Host, fresh: bool) -> Result<Self, String> {
        let list = folder.join(RECORDS);
        if !fresh && folder.join(HOST).exists() {
            cut(&list)?;
            let book = Self::read(folder)?;
            if !book.host.may_go_on(&host) {
                return Err(format!(
                    "{}: holds records of {} ({}) on {}, and this is {} ({}) on {}; --fresh leaves \
                     them out, --out takes another folder",
                    folder.display(),
                    book.host.revision,
                    book.host.program,
                    book.host.host,
                    host.revision,
                    host.program,
                    host.host
                ));
            }
            return Ok(book);
        }
        let text = serde_json::to_string_pretty(&host).map_err(|e| e.to_string())?;
        precision::write(&list, "")?;
        precision::write(&folder.join(HOST), &(text + "\n"))?;
        Ok(Self { folder: folder.to_owned(), host, records: Vec::new() })
    }

    /// Whether a run is among the records.
    pub(super) fn holds(&self, cell: &Cell, run: usize) -> bool {
        self.records.iter().any(|record| record.run == run && record.cell == *cell)
    }

    /// Adds a record to the list and to its file.
    pub(super) fn add(&mut self, record: Record) -> Result<(), String> {
        let path = self.folder.join(RECORDS);
        let failed = |e: std::io::Error| format!("{}: {e}", path.display());
        let line = serde_json::to_string(&record).map_err(|e| e.to_string())?;
        let mut file = fs::OpenOptions::new().append(true).open(&path).map_err(failed)?;
        // One write: an interrupt leaves the whole line, or a part that the next run cuts off.
        file.write_all((line + "\n").as_bytes()).map_err(failed)?;
        self.records.push(record);
        Ok(())
    }
}

/// Takes the last line away if it was cut off.
fn cut(list: &Path) -> Result<(), String> {
    let failed = |e: std::io::Error| format!("{}: {e}", list.display());
    let text = fs::read_to_string(list).map_err(failed)?;
    let whole = text.rfind('\n').map_or(0, |end| end + 1);
    if whole < text.len() {
        println!("{}: the last line is cut off and is left out", list.display());
        let file = fs::OpenOptions::new().write(true).open(list).map_err(failed)?;
        file.set_len(whole as u64).map_err(failed)?;
    }
    Ok(())
}

/// Reads a list of records; an error begins with its line.
fn parsed(text: &str) -> Result<Vec<Record>, String> {
    let record = |(number, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|e| format!("{number}: {e}"))
    };
    (1..).zip(text.lines()).map(record).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    #[test]
    fn a_book_is_gone_on_with_by_the_same_program_alone() {
        let folder = std::env::temp_dir().join(format!("xtask-records-{}", std::process::id()));
        let host = sample::host();
        let mut book = Book::open(&folder, host.clone(), false).unwrap();
        let records = sample::records();
        book.add(records[0].clone()).unwrap();
        book.add(records[1].clone()).unwrap();
        // As after a power cut.
        let list = folder.join(RECORDS);
        let whole = fs::read_to_string(&list).unwrap();
        fs::write(&list, format!("{whole}{}", &whole[..70])).unwrap();
        let tomorrow = Host { date: "2026-02-01".into(), ..host.clone() };
        let mut book = Book::open(&folder, tomorrow, false).unwrap();
        assert_eq!((&book.host, &book.records[..]), (&host, &records[..2]));
        assert!(book.holds(&records[1].cell, 1) && !book.holds(&records[1].cell, 2));
        book.add(records[2].clone()).unwrap();
        assert_eq!(Book::read(&list).unwrap().records, records[..3]);
        let other = Host { program: "0".into(), ..host.clone() };
        let refused = Book::open(&folder, other.clone(), false).unwrap_err();
        assert!(refused.contains("--fresh"), "{refused}");
        assert_eq!(Book::open(&folder, other, true).unwrap().records, []);
        fs::write(&list, "{}\n").unwrap();
        let damaged = Book::read(&folder).unwrap_err();
        fs::remove_dir_all(&folder).unwrap();
        assert!(damaged.contains("records.jsonl:1: missing field `cell`"), "{damaged}");
    }

    #[test]
    fn refusals_are_records_too() {
        let outcome = Outcome::Refused("the ledger is off by 1e-3".into());
        let record = Record { cell: sample::cell(), run: 3, outcome };
        let text = serde_json::to_string(&record).unwrap();
        assert_eq!(parsed(&text).unwrap(), [record]);
    }
}
