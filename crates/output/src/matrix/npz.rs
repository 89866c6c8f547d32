//! SciPy's sparse matrix file: the arrays of a compressed sparse row matrix in a zip archive.
//!
//! # References
//! `scipy.sparse.save_npz`: arrays `indices`, `indptr`, `format`, `shape`, `data`.

use std::io::{self, Write};

use super::zip::Archive;
use super::{Table, npy};
use crate::Error;

/// Writes the matrix, and beside its own arrays `error` (as `data`), `area` and `name` (by
/// row).
pub(super) fn write(out: &mut dyn Write, table: &Table<'_>) -> Result<(), Error> {
    let n = table.len();
    let stored = table.columns.len();
    // SciPy wants both kinds of index as wide as the wider needs.
    let wide = i32::try_from(stored.max(n)).is_err();
    let mut archive = Archive::new(out);
    indices(&mut archive, "indices.npy", wide, table.columns.iter().map(|j| u64::from(*j)))?;
    indices(&mut archive, "indptr.npy", wide, table.starts.iter().map(|k| *k as u64))?;
    archive.member("format.npy", 3, &npy::header("|S3", &[]), |out| out.write_all(b"csr"))?;
    indices(&mut archive, "shape.npy", true, [n as u64; 2].into_iter())?;
    floats(&mut archive, "data.npy", table.values)?;
    floats(&mut archive, "error.npy", table.errors)?;
    floats(&mut archive, "area.npy", table.areas)?;
    names(&mut archive, table.names)?;
    archive.finish()
}

fn floats(archive: &mut Archive<'_>, name: &str, values: &[f64]) -> Result<(), Error> {
    let header = npy::header("<f8", &[values.len()]);
    archive.member(name, 8 * values.len() as u64, &header, |out| {
        values.iter().try_for_each(|value| out.write_all(&value.to_le_bytes()))
    })
}

fn indices(
    archive: &mut Archive<'_>,
    name: &str,
    wide: bool,
    values: impl ExactSizeIterator<Item = u64> + Clone,
) -> Result<(), Error> {
    let (dtype, width) = if wide { ("<i8", 8) } else { ("<i4", 4) };
    let size = width as u64 * values.len() as u64;
    // Of a number that fits, the narrow form is the wide one without its last bytes.
    archive.member(name, size, &npy::header(dtype, &[values.len()]), |out| {
        values.clone().try_for_each(|value| out.write_all(&value.to_le_bytes()[..width]))
    })
}

/// Strings of equal length, in UTF-32, filled up with zeros.
fn names(archive: &mut Archive<'_>, names: &[String]) -> Result<(), Error> {
    let longest = names.iter().map(|name| name.chars().count()).max().unwrap_or(0).max(1);
    let size = 4 * longest as u64 * names.len() as u64;
    let header = npy::header(&format!("<U{longest}"), &[names.len()]);
    archive.member("name.npy", size, &header, |out| {
        names.iter().try_for_each(|name| -> io::Result<()> {
            let characters = name.chars().map(u32::from).chain(std::iter::repeat(0)).take(longest);
            characters.into_iter().try_for_each(|c| out.write_all(&c.to_le_bytes()))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number(bytes: &[u8], at: usize, width: usize) -> usize {
        bytes[at..at + width].iter().rev().fold(0, |n, b| n << 8 | usize::from(*b))
    }

    /// The members of an archive by way of its directory, as a reader finds them, checksums
    /// tested.
    fn members(archive: &[u8]) -> Vec<(String, Vec<u8>)> {
        let end = archive.len() - 22;
        assert_eq!(&archive[end..end + 4], b"PK\x05\x06");
        let mut at = number(archive, end + 16, 4);
        let mut members = Vec::new();
        for _ in 0..number(archive, end + 10, 2) {
            assert_eq!(&archive[at..at + 4], b"PK\x01\x02");
            let (sum, size) = (number(archive, at + 16, 4), number(archive, at + 24, 4));
            let name_length = number(archive, at + 28, 2);
            let name = &archive[at + 46..at + 46 + name_length];
            let local = number(archive, at + 42, 4);
            assert_eq!(&archive[local..local + 4], b"PK\x03\x04");
            assert_eq!(archive[local + 6..local + 30], archive[at + 8..at + 32]);
            assert_eq!(&archive[local + 30..local + 30 + name_length], name);
            let start = local + 30 + name_length;
            let bytes = archive[start..start + size].to_vec();
            assert_eq!(crc32fast::hash(&bytes) as usize, sum);
            members.push((String::from_utf8(name.to_vec()).unwrap(), bytes));
            at += 46 + name_length;
        }
        assert_eq!(at, end);
        members
    }

    #[test]
    fn the_archive_holds_the_arrays() {
        let names = ["ä", "bcd"].map(String::from);
        let table = Table {
            names: &names,
            areas: &[1.0, 2.0],
            starts: &[0, 1, 2],
            columns: &[1, 0],
            values: &[0.5, 0.25],
            errors: &[1e-3, 5e-4],
        };
        let mut archive = Vec::new();
        write(&mut archive, &table).unwrap();
        let members = members(&archive);
        let array = |name: &str| {
            let (_, bytes) = members.iter().find(|(n, _)| n == name).unwrap();
            let data = 10 + number(bytes, 8, 2);
            (String::from_utf8_lossy(&bytes[10..data]).into_owned(), bytes[data..].to_vec())
        };
        let floats = |values: [f64; 2]| values.map(f64::to_le_bytes).concat();
        assert_eq!(array("data.npy").1, floats([0.5, 0.25]));
        assert_eq!(array("error.npy").1, floats([1e-3, 5e-4]));
        assert_eq!(array("area.npy").1, floats([1.0, 2.0]));
        assert_eq!(array("indices.npy").1, [1, 0, 0, 0, 0, 0, 0, 0]);
        assert_eq!(array("indptr.npy").1, [0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0]);
        assert_eq!(array("shape.npy").1, [2u64, 2].map(u64::to_le_bytes).concat());
        assert_eq!(array("format.npy").1, b"csr");
        let (header, name) = array("name.npy");
        assert!(header.starts_with("{'descr': '<U3', 'fortran_order': False, 'shape': (2,), }"));
        let letters = ['ä', '\0', '\0', 'b', 'c', 'd'].map(|c| u32::from(c).to_le_bytes());
        assert_eq!(name, letters.concat());
    }
}
