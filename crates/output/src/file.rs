//! One lit scene into one file, whole or not at all.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use scene::{Scene, Solution};

use crate::check::{Width, check};
#[cfg(feature = "glb")]
use crate::glb;
#[cfg(any(feature = "exr", feature = "png"))]
use crate::picture;
use crate::{Error, Format, Options, csv, ply, tri, vtu};

/// A file that was written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Written {
    /// Where it lies.
    pub path: PathBuf,
    /// Its length.
    pub bytes: u64,
}

/// Writes a lit scene in the format that the path's extension names.
///
/// The bytes go to a temporary neighbour first, which takes the path's place when it is
/// complete and on disk, so a reader never meets half a file, and a failure leaves the
/// old file as it was and nothing beside it.
///
/// # Errors
/// An extension that is unknown or whose feature is off, a solution that does not belong to the scene or is not finite,
/// an option outside its range, or what the file system answers.
pub fn write_file(
    path: &Path,
    scene: &Scene,
    solution: &Solution,
    options: &Options,
) -> Result<Written, Error> {
    let format = Format::from_path(path)?;
    replace_file(path, |out| write(format, out, scene, solution, options))
}

/// Writes a lit scene into any sink.
///
/// # Errors
/// As [`write_file`], without the path.
pub fn write(
    format: Format,
    out: &mut dyn Write,
    scene: &Scene,
    solution: &Solution,
    options: &Options,
) -> Result<(), Error> {
    options.check()?;
    let width = match format {
        Format::Csv | Format::Tri => Width::Double,
        Format::Ply | Format::Vtu | Format::Glb | Format::Png | Format::Exr => Width::Single,
    };
    check(scene, solution, width)?;
    match format {
        Format::Csv => csv::write(out, scene, solution),
        Format::Tri => tri::write(out, scene, solution),
        Format::Ply => ply::write(out, scene, solution, options.exposure),
        Format::Vtu => vtu::write(out, scene, solution),
        #[cfg(feature = "glb")]
        Format::Glb => glb::write(out, scene, solution, options),
        #[cfg(not(feature = "glb"))]
        Format::Glb => format.check(),
        #[cfg(feature = "png")]
        Format::Png => picture::write_png(out, scene, solution, options),
        #[cfg(not(feature = "png"))]
        Format::Png => format.check(),
        #[cfg(feature = "exr")]
        Format::Exr => picture::write_exr(out, scene, solution, options),
        #[cfg(not(feature = "exr"))]
        Format::Exr => format.check(),
    }
}

/// Replaces a file by what `fill` writes, all of it or not at all: how every output is made.
///
/// A link stays a link, and the file it leads to is replaced; a device or a pipe cannot be
/// replaced and is written to. A process that is killed while it writes leaves its temporary,
/// `.output-*.part`, behind.
///
/// # Errors
/// What `fill` or the file system answers; the old file then stays as it was.
pub fn replace_file(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), Error>,
) -> Result<Written, Error> {
    let target = std::fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    let written = match std::fs::metadata(&target) {
        Ok(there) if !there.is_file() && !there.is_dir() => write_through(&target, fill),
        _ => write_beside(&target, fill),
    };
    written.map(|bytes| Written { path: path.to_owned(), bytes }).map_err(|error| error.at(path))
}

/// Writes into what is no regular file; it has no size to report.
fn write_through(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), Error>,
) -> Result<u64, Error> {
    let file = std::fs::OpenOptions::new().write(true).open(path).map_err(Error::write)?;
    let mut out = BufWriter::new(file);
    fill(&mut out)?;
    out.flush().map_err(Error::write)?;
    Ok(0)
}

fn write_beside(
    path: &Path,
    fill: impl FnOnce(&mut dyn Write) -> Result<(), Error>,
) -> Result<u64, Error> {
    // A rename is atomic only within one file system, so the temporary is a neighbour.
    let folder = match path.parent() {
        Some(folder) if folder != Path::new("") => folder,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".output-").suffix(".part");
    // Temporaries are private by default; an output is as readable as any other new file.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut temporary = builder.tempfile_in(folder).map_err(Error::write)?;
    let mut out = BufWriter::new(temporary.as_file_mut());
    fill(&mut out)?;
    out.flush().map_err(Error::write)?;
    drop(out);
    let file = temporary.as_file();
    file.sync_all().map_err(Error::write)?;
    if let Ok(old) = std::fs::metadata(path) {
        file.set_permissions(old.permissions()).map_err(Error::write)?;
    }
    let bytes = file.metadata().map_err(Error::write)?.len();
    // Dropping the error drops the temporary, which removes it.
    temporary.persist(path).map_err(|e| Error::write(e.error))?;
    Ok(bytes)
}
