//! From a path or bytes to a scene, by the extension.

use std::fs;
use std::path::Path;

use crate::{Error, ErrorKind, Format, Imported, Options, tri, vs3};

/// What every format's reader is given.
pub(crate) struct Source<'a> {
    /// The file's name for messages, without its folders.
    pub(crate) name: &'a str,
    /// What it holds.
    pub(crate) bytes: &'a [u8],
    /// Where the files lie that it names; `None` if it must stand alone.
    #[cfg_attr(
        not(any(feature = "obj", feature = "gltf")),
        expect(dead_code, reason = ".tri and .vs3 name no files")
    )]
    pub(crate) folder: Option<&'a Path>,
}

/// Opens a scene file; its extension (`tri`, `vs3`, `obj`, `gltf` or `glb`, in any case)
/// tells the format. Files that it names are looked for beside it.
///
/// # Errors
/// If the file cannot be read, is not what its extension says, holds a number that no
/// surface can have, or needs a feature that this build lacks. Options that would give a
/// surface such a number count as well.
pub fn open(path: &Path, options: &Options) -> Result<Imported, Error> {
    let name =
        path.file_name().map_or_else(|| path.to_string_lossy(), |name| name.to_string_lossy());
    // The format is settled first, so that a wrong extension is not reported as a wrong path.
    let format = format_of(&name)?;
    let bytes = fs::read(path).map_err(|cause| {
        Error::new(ErrorKind::Io, &path.to_string_lossy(), format!("cannot be read: {cause}"))
            .because(cause)
    })?;
    read(format, &Source { name: &name, bytes: &bytes, folder: path.parent() }, options)
}

/// Opens a scene that is already in memory; the extension of `name` tells the format.
/// Files that it names count as missing.
///
/// # Errors
/// As for [`open`].
pub fn open_bytes(name: &str, bytes: &[u8], options: &Options) -> Result<Imported, Error> {
    read(format_of(name)?, &Source { name, bytes, folder: None }, options)
}

pub(crate) fn format_of(name: &str) -> Result<Format, Error> {
    let extension = Path::new(name).extension().unwrap_or_default().to_string_lossy();
    match extension.to_ascii_lowercase().as_str() {
        "tri" => Ok(Format::Tri),
        "vs3" => Ok(Format::Vs3),
        "obj" => Ok(Format::Obj),
        "gltf" => Ok(Format::Gltf),
        "glb" => Ok(Format::Glb),
        _ => Err(Error::new(
            ErrorKind::UnknownFormat,
            name,
            "expected a file that ends in .tri, .vs3, .obj, .gltf or .glb",
        )),
    }
}

fn read(format: Format, source: &Source<'_>, options: &Options) -> Result<Imported, Error> {
    match format {
        Format::Tri => tri::read(source, options),
        Format::Vs3 => vs3::read(source, options),
        #[cfg(feature = "obj")]
        Format::Obj => crate::obj::read(source, options),
        #[cfg(feature = "gltf")]
        Format::Gltf | Format::Glb => crate::gltf::read(source, format, options),
        #[cfg(not(feature = "obj"))]
        Format::Obj => Err(left_out("obj", source, format)),
        #[cfg(not(feature = "gltf"))]
        Format::Gltf | Format::Glb => Err(left_out("gltf", source, format)),
    }
}

/// What a file needs that this build lacks.
#[cfg(not(all(feature = "obj", feature = "gltf")))]
pub(crate) fn left_out(feature: &str, source: &Source<'_>, format: Format) -> Error {
    let message =
        format!("this program was built without the feature `{feature}`: it reads no {format}");
    Error::new(ErrorKind::FeatureOff, source.name, message)
}
