//! The real files, where they lie beside the checkout.

use std::fs;
use std::path::{Path, PathBuf};

use tri_io::Writer;

use crate::support::read;

fn scenes() -> Option<PathBuf> {
    let crate_folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let found = crate_folder.ancestors().map(|folder| folder.join("shared/scenes"));
    let found = found.into_iter().find(|folder| folder.is_dir());
    if found.is_none() {
        println!("skipped: there is no folder shared/scenes beside the checkout");
    }
    found
}

/// Counts are those of `grep -c Triangle`.
#[test]
fn real_files_hold_what_grep_counts() {
    let Some(folder) = scenes() else { return };
    for (name, count) in
        [("blocks.tri", 464), ("box.tri", 16), ("church.tri", 9506), ("room.tri", 156)]
    {
        let (records, error) = read(fs::read(folder.join(name)).unwrap().as_slice());
        assert!(error.is_none(), "{name}: {error:?}");
        assert_eq!(records.len(), count, "{name}");
        assert!(records.iter().all(|record| record.normals.is_none()), "{name}");

        let mut writer = Writer::new(Vec::new());
        records.iter().for_each(|record| writer.write(record).unwrap());
        let again = read(writer.finish().unwrap().as_slice()).0;
        assert_eq!(again, records, "{name}");
    }
}
