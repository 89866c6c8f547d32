//! Form factors as text, one line each.

use std::io::{self, Write};

use tri_io::{FloatBuffer, write_f64};

use super::Table;
use crate::Error;

/// Writes `i,j,F,error`; every number reads back to the same bits.
pub(super) fn write(out: &mut dyn Write, table: &Table<'_>) -> Result<(), Error> {
    let names: Vec<String> = table.names.iter().map(|name| field(name)).collect();
    let mut value_text = FloatBuffer::new();
    let mut error_text = FloatBuffer::new();
    let mut text = || -> io::Result<()> {
        writeln!(out, "i,j,F,error")?;
        for (i, name) in names.iter().enumerate() {
            for (j, value, error) in table.row(i) {
                let value = write_f64(value, &mut value_text);
                let error = write_f64(error, &mut error_text);
                writeln!(out, "{name},{},{value},{error}", names[j])?;
            }
        }
        Ok(())
    };
    text().map_err(Error::write)
}

/// Writes `row,name,area`: what the rows and columns of an array stand for.
pub(super) fn write_names(out: &mut dyn Write, table: &Table<'_>) -> Result<(), Error> {
    let mut buffer = FloatBuffer::new();
    let mut text = || -> io::Result<()> {
        writeln!(out, "row,name,area")?;
        for (row, (name, area)) in table.names.iter().zip(table.areas).enumerate() {
            writeln!(out, "{row},{},{}", field(name), write_f64(*area, &mut buffer))?;
        }
        Ok(())
    };
    text().map_err(Error::write)
}

/// A name as a field: a number as it is, anything else in quotes, its own quotes doubled
/// (RFC 4180 §2).
fn field(name: &str) -> String {
    if !name.is_empty() && name.bytes().all(|b| b.is_ascii_digit()) {
        name.to_owned()
    } else {
        format!("\"{}\"", name.replace('"', "\"\""))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_numbers_go_unquoted() {
        assert_eq!(field("12"), "12");
        assert_eq!(field("12:back"), "\"12:back\"");
        assert_eq!(field("the \"red\" wall, left"), "\"the \"\"red\"\" wall, left\"");
        assert_eq!(field(""), "\"\"");
    }
}
