//! NumPy's array file, version 1.0: a line of Python that says what the bytes are, then the
//! bytes.
//!
//! The crates that write it bring a parser for that line and big integers, or an array type,
//! which outweigh these lines by far.
//!
//! # References
//! NumPy enhancement proposal 1, "A simple file format for NumPy arrays".

use std::io::{self, Write};

use super::Table;
use crate::Error;

/// Data starts at a multiple of this.
const ALIGNMENT: usize = 64;

/// Writes all form factors, zeros too, row after row.
pub(super) fn write_dense(out: &mut dyn Write, table: &Table<'_>) -> Result<(), Error> {
    let n = table.len();
    let mut bytes = || -> io::Result<()> {
        out.write_all(&header("<f8", &[n, n]))?;
        let mut row = vec![0.0; n];
        for i in 0..n {
            row.fill(0.0);
            table.row(i).for_each(|(j, value, _)| row[j] = value);
            for value in &row {
                out.write_all(&value.to_le_bytes())?;
            }
        }
        Ok(())
    };
    bytes().map_err(Error::write)
}

/// What stands before the bytes of an array of this type and shape.
pub(super) fn header(dtype: &str, shape: &[usize]) -> Vec<u8> {
    const MAGIC: &[u8] = b"\x93NUMPY\x01\x00";
    let sizes: String = shape.iter().map(|size| format!("{size},")).collect();
    let mut line = format!("{{'descr': '{dtype}', 'fortran_order': False, 'shape': ({sizes}), }}");
    let before = MAGIC.len() + size_of::<u16>();
    while !(before + line.len() + 1).is_multiple_of(ALIGNMENT) {
        line.push(' ');
    }
    line.push('\n');
    let length = u16::try_from(line.len()).expect("a type and a shape are shorter than 64 kB");
    [MAGIC, &length.to_le_bytes(), line.as_bytes()].concat()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_header_is_as_numpy_writes_it() {
        let bytes = header("<f8", &[3, 4]);
        assert_eq!(bytes.len() % ALIGNMENT, 0);
        assert_eq!(&bytes[..10], b"\x93NUMPY\x01\x00\x76\x00");
        let line = std::str::from_utf8(&bytes[10..]).unwrap();
        assert_eq!(line.trim_end(), "{'descr': '<f8', 'fortran_order': False, 'shape': (3,4,), }");
        assert!(line.ends_with('\n'));
        assert!(header("|S3", &[]).windows(13).any(|w| w == b"'shape': (), "));
    }
}
