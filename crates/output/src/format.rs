//! The formats, and how a file name picks one.

use std::path::Path;

use crate::{Error, ErrorKind};

/// A file format that a lit scene can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// One row of text per input triangle.
    Csv,
    /// The report's triangle records, one per element.
    Tri,
    /// Binary polygons with exitance per vertex.
    Ply,
    /// Binary glTF 2.0.
    Glb,
    /// A picture.
    Png,
}

impl Format {
    /// Every known extension, as messages list them.
    pub const EXTENSIONS: &'static str = ".csv, .tri, .ply, .glb or .png";

    /// The format that the extension of a path names, in either case.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownExtension`], whose message lists the known ones.
    ///
    /// # Examples
    /// ```
    /// use output::Format;
    ///
    /// assert_eq!(Format::from_path("lit.GLB".as_ref())?, Format::Glb);
    /// let message = Format::from_path("lit.gif".as_ref()).unwrap_err().to_string();
    /// assert!(message.ends_with("expected .csv, .tri, .ply, .glb or .png"));
    /// # Ok::<(), output::Error>(())
    /// ```
    pub fn from_path(path: &Path) -> Result<Self, Error> {
        let extension = path.extension().map(|e| e.to_string_lossy().into_owned());
        match extension.as_deref().map(str::to_ascii_lowercase).as_deref() {
            Some("csv") => Ok(Self::Csv),
            Some("tri") => Ok(Self::Tri),
            Some("ply") => Ok(Self::Ply),
            Some("glb") => Ok(Self::Glb),
            Some("png") => Ok(Self::Png),
            _ => Err(Error::new(ErrorKind::UnknownExtension(extension)).at(path)),
        }
    }
}
