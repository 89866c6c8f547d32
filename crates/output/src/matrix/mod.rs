//! Form factors as a table: CSV, a dense `.npy` array, or a sparse `.npz` matrix.

mod csv;
mod npy;
mod npz;
mod zip;

use std::io::Write;
use std::path::{Path, PathBuf};

use crate::{Error, ErrorKind, Written, replace_file};

/// Form factors between named surfaces, row after row (compressed sparse rows): row i is
/// `starts[i]..starts[i + 1]` of `columns`, `values` and `errors`.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a> {
    /// What the surfaces are called.
    pub names: &'a [String],
    /// Their areas.
    pub areas: &'a [f64],
    /// Where each row starts, and where the last one ends.
    pub starts: &'a [usize],
    /// The surfaces that light arrives at.
    pub columns: &'a [u32],
    /// The form factors.
    pub values: &'a [f64],
    /// How far they may be from the truth.
    pub errors: &'a [f64],
}

/// A file format for form factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// `i,j,F,error`: a line for each stored form factor.
    Csv,
    /// NumPy's array file: all N × N form factors in f64, zeros too. The names and areas of
    /// the rows go into a table beside it ([`names_path`]).
    Npy,
    /// SciPy's sparse matrix file (`scipy.sparse.load_npz`), with the further arrays `error`,
    /// `area` and `name`.
    Npz,
}

impl Format {
    /// Every known extension, as messages list them.
    pub const EXTENSIONS: &'static str = "a file name that ends in .csv, .npy or .npz";

    /// The format that the extension of a path names, in either case.
    ///
    /// # Errors
    /// [`ErrorKind::Option`], whose message lists the known ones.
    ///
    /// # Examples
    /// ```
    /// use output::matrix::Format;
    ///
    /// assert_eq!(Format::from_path("F.NPZ".as_ref())?, Format::Npz);
    /// let message = Format::from_path("F.txt".as_ref()).unwrap_err().to_string();
    /// assert_eq!(message, "F.txt: expected a file name that ends in .csv, .npy or .npz");
    /// # Ok::<(), output::Error>(())
    /// ```
    pub fn from_path(path: &Path) -> Result<Self, Error> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_ascii_lowercase());
        match extension.as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("npy") => Ok(Self::Npy),
            Some("npz") => Ok(Self::Npz),
            _ => Err(Error::new(ErrorKind::Option(Self::EXTENSIONS)).at(path)),
        }
    }
}

/// Where the names of a `.npy` array's rows are written: `F.npy` has `F.names.csv`.
#[must_use]
pub fn names_path(npy: &Path) -> PathBuf {
    npy.with_extension("names.csv")
}

/// Writes form factors in the format that the path's extension names, whole or not at all,
/// and the names beside a `.npy`. Returns the files written.
///
/// # Errors
/// An unknown extension, more than the format can count, or what the file system answers.
///
/// # Panics
/// If the lists of the table do not belong together.
pub fn write_file(path: &Path, table: &Table<'_>) -> Result<Vec<Written>, Error> {
    let format = Format::from_path(path)?;
    let mut written = vec![replace_file(path, |out| write(format, out, table))?];
    if format == Format::Npy {
        written.push(replace_file(&names_path(path), |out| csv::write_names(out, table))?);
    }
    Ok(written)
}

/// Writes form factors into any sink; names and areas are not in a `.npy`.
///
/// # Errors
/// More than the format can count, or what the sink answers.
///
/// # Panics
/// If the lists of the table do not belong together.
pub fn write(format: Format, out: &mut dyn Write, table: &Table<'_>) -> Result<(), Error> {
    table.check();
    match format {
        Format::Csv => csv::write(out, table),
        Format::Npy => npy::write_dense(out, table),
        Format::Npz => npz::write(out, table),
    }
}

impl Table<'_> {
    fn len(&self) -> usize {
        self.names.len()
    }

    /// The columns, values and errors of a row.
    fn row(&self, row: usize) -> impl Iterator<Item = (usize, f64, f64)> {
        let range = self.starts[row]..self.starts[row + 1];
        range.map(|k| (self.columns[k] as usize, self.values[k], self.errors[k]))
    }

    fn check(&self) {
        let (n, stored) = (self.names.len(), self.columns.len());
        let fits = self.areas.len() == n
            && self.starts.len() == n + 1
            && self.starts.is_sorted()
            && self.starts[n] == stored
            && self.values.len() == stored
            && self.errors.len() == stored
            && self.columns.iter().all(|j| (*j as usize) < n);
        assert!(fits, "the lists of a table belong together");
    }
}
