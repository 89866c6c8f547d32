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
    /// Binary glTF 2.0; written with the feature `glb`.
    Glb,
    /// A picture; drawn and written with the feature `png`.
    Png,
}

impl Format {
    /// Every extension that this build writes, as messages list them.
    pub const EXTENSIONS: &'static str = match (cfg!(feature = "glb"), cfg!(feature = "png")) {
        (true, true) => ".csv, .tri, .ply, .glb or .png",
        (true, false) => ".csv, .tri, .ply or .glb",
        (false, true) => ".csv, .tri, .ply or .png",
        (false, false) => ".csv, .tri or .ply",
    };

    /// The format that the extension of a path names, in either case.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownExtension`], whose message lists the known ones, or
    /// [`ErrorKind::FeatureOff`] for a format that this build leaves out.
    ///
    /// # Examples
    /// ```
    /// use output::Format;
    ///
    /// assert_eq!(Format::from_path("lit.PLY".as_ref())?, Format::Ply);
    /// let message = Format::from_path("lit.gif".as_ref()).unwrap_err().to_string();
    /// assert!(message.ends_with(Format::EXTENSIONS));
    /// # Ok::<(), output::Error>(())
    /// ```
    pub fn from_path(path: &Path) -> Result<Self, Error> {
        let extension = path.extension().map(|e| e.to_string_lossy().into_owned());
        let format = match extension.as_deref().map(str::to_ascii_lowercase).as_deref() {
            Some("csv") => Self::Csv,
            Some("tri") => Self::Tri,
            Some("ply") => Self::Ply,
            Some("glb") => Self::Glb,
            Some("png") => Self::Png,
            _ => return Err(Error::new(ErrorKind::UnknownExtension(extension)).at(path)),
        };
        format.check().map_err(|error| error.at(path))?;
        Ok(format)
    }

    /// Whether this build writes it.
    pub(crate) fn check(self) -> Result<(), Error> {
        match self {
            Self::Glb if !cfg!(feature = "glb") => Err(Error::new(ErrorKind::FeatureOff("glb"))),
            Self::Png if !cfg!(feature = "png") => Err(Error::new(ErrorKind::FeatureOff("png"))),
            _ => Ok(()),
        }
    }
}
