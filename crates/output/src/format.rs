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
    /// VTK's unstructured grid, for ParaView: light and surface per element.
    Vtu,
    /// Binary glTF 2.0; written with the feature `glb`.
    Glb,
    /// A picture; drawn and written with the feature `png`.
    Png,
    /// A picture in linear, unclamped exitance; drawn and written with the feature `exr`.
    Exr,
}

impl Format {
    /// All formats, those that this build leaves out among them.
    pub const ALL: [Self; 7] =
        [Self::Csv, Self::Tri, Self::Ply, Self::Vtu, Self::Glb, Self::Png, Self::Exr];

    /// The file name extension, without its dot; a format behind a feature has the feature's name.
    #[must_use]
    pub const fn extension(self) -> &'static str {
        match self {
            Self::Csv => "csv",
            Self::Tri => "tri",
            Self::Ply => "ply",
            Self::Vtu => "vtu",
            Self::Glb => "glb",
            Self::Png => "png",
            Self::Exr => "exr",
        }
    }

    /// Whether this build writes it.
    #[must_use]
    pub const fn is_on(self) -> bool {
        match self {
            Self::Csv | Self::Tri | Self::Ply | Self::Vtu => true,
            Self::Glb => cfg!(feature = "glb"),
            Self::Png => cfg!(feature = "png"),
            Self::Exr => cfg!(feature = "exr"),
        }
    }

    /// Every extension that this build writes, as messages list them: `.csv, .tri or .ply`.
    #[must_use]
    pub fn extensions() -> String {
        let on: Vec<_> = Self::ALL.into_iter().filter(|format| format.is_on()).collect();
        let mut list = String::new();
        for (i, format) in on.iter().enumerate() {
            list += match i {
                0 => ".",
                _ if i + 1 == on.len() => " or .",
                _ => ", .",
            };
            list += format.extension();
        }
        list
    }

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
    /// assert!(message.ends_with(&Format::extensions()));
    /// # Ok::<(), output::Error>(())
    /// ```
    pub fn from_path(path: &Path) -> Result<Self, Error> {
        let extension = path.extension().map(|e| e.to_string_lossy().into_owned());
        let named = |format: &Self| {
            extension.as_ref().is_some_and(|e| e.eq_ignore_ascii_case(format.extension()))
        };
        let Some(format) = Self::ALL.into_iter().find(named) else {
            return Err(Error::new(ErrorKind::UnknownExtension(extension)).at(path));
        };
        format.check().map_err(|error| error.at(path))?;
        Ok(format)
    }

    /// Refuses a format that this build leaves out.
    pub(crate) fn check(self) -> Result<(), Error> {
        match self.is_on() {
            true => Ok(()),
            false => Err(Error::new(ErrorKind::FeatureOff(self.extension()))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_reads_as_a_sentence_in_every_build() {
        let list = Format::extensions();
        let mut expected = ".csv, .tri, .ply, .vtu".to_owned();
        for (format, on) in [
            (".glb", cfg!(feature = "glb")),
            (".png", cfg!(feature = "png")),
            (".exr", cfg!(feature = "exr")),
        ] {
            if on {
                expected = expected + ", " + format;
            }
        }
        let last = expected.rfind(", ").unwrap();
        expected.replace_range(last..last + 1, " or");
        assert_eq!(list, expected);
    }
}
