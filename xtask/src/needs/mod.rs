//! `cargo xtask needs`: what leaving out pays, scene by scene, and that it changes nothing.
//!
//! Each case is solved by turns with what its scene needs and with everything. Where all decisions say
//! that they are exact, the bytes must be the same; elsewhere the two must be within what they state;
//! and no case may take longer. The records go to docs/plan, the tables into docs/plan.md.

mod cases;
mod measure;
mod scenes;
mod table;

use std::path::Path;

use crate::built;
use measure::Record;

/// What to measure.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Rounds of each case
    #[arg(long, default_value_t = 5)]
    repeat: usize,

    /// Only the cases with this in their name; the records of the others stay
    #[arg(long)]
    only: Option<String>,

    /// Measure nothing; draw the tables from the records
    #[arg(long)]
    draw: bool,
}

/// Where records lie.
const RECORDS: &str = "docs/plan/records.json";

/// Where tables are shown.
const PAGE: &str = "docs/plan.md";

/// Measures, and draws the tables.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    if arguments.draw {
        return draw(root, &read(root)?);
    }
    let program = built::program(root, "radiosity", "radiosity")?;
    let folder = root.join("target").join("needs");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|part| name.contains(part));
    let mut records = Vec::new();
    for case in cases::all().iter().filter(|case| wanted(case.name)) {
        let scene = case.file(root, &folder)?;
        let record = measure::measure(&program, case, &scene, &folder, arguments.repeat.max(1))?;
        println!("{:<20} {:<46} {:.3}", record.name, record.flags, record.ratio());
        records.push(record);
    }
    let complaints: Vec<String> = records.iter().filter_map(Record::complaint).collect();
    let records = match arguments.only {
        Some(_) => among(read(root)?, records),
        None => records,
    };
    let text = serde_json::to_string_pretty(&records).map_err(|e| e.to_string())? + "\n";
    write(&root.join(RECORDS), &text)?;
    draw(root, &records)?;
    if complaints.is_empty() { Ok(()) } else { Err(complaints.join("\n")) }
}

/// Old records with fresh ones in the place of those of the same cases.
fn among(mut old: Vec<Record>, fresh: Vec<Record>) -> Vec<Record> {
    for record in fresh {
        match old.iter_mut().find(|o| o.name == record.name && o.flags == record.flags) {
            Some(place) => *place = record,
            None => old.push(record),
        }
    }
    old
}

fn read(root: &Path) -> Result<Vec<Record>, String> {
    let path = root.join(RECORDS);
    let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display()))
}

fn draw(root: &Path, records: &[Record]) -> Result<(), String> {
    let path = root.join(PAGE);
    let page = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
    write(&path, &drawn(&page, records)?)
}

/// The page with its tables made anew.
fn drawn(page: &str, records: &[Record]) -> Result<String, String> {
    let page = between(page, "measured", &table::markdown(records))?;
    between(&page, "foreseen", &table::foreseen(records))
}

/// The page with other text between the two marks of a table.
fn between(page: &str, name: &str, text: &str) -> Result<String, String> {
    let (start, end) = (format!("<!-- {name} -->\n"), format!("<!-- end of {name} -->\n"));
    let missing = || format!("{PAGE}: expected {start:?} before {end:?}");
    let first = page.find(&start).ok_or_else(missing)? + start.len();
    let last = page[first..].find(&end).ok_or_else(missing)? + first;
    Ok([&page[..first], text, &page[last..]].concat())
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    }
    std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_shows_the_records() {
        let root = crate::root();
        let page = std::fs::read_to_string(root.join(PAGE)).unwrap();
        let records = read(&root).unwrap();
        let fresh = drawn(&page, &records).unwrap();
        assert!(page == fresh, "run `cargo xtask needs --draw`");
        let complaints: Vec<String> = records.iter().filter_map(Record::complaint).collect();
        assert_eq!(complaints, Vec::<String>::new());
    }

    #[test]
    fn text_goes_between_its_marks() {
        let page = "a\n<!-- t -->\nold\n<!-- end of t -->\nb\n";
        let fresh = between(page, "t", "new\n").unwrap();
        assert_eq!(fresh, "a\n<!-- t -->\nnew\n<!-- end of t -->\nb\n");
        assert!(between(page, "u", "").is_err());
    }
}
