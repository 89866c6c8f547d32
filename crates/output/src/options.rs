//! What a caller may choose about the outputs.

use std::sync::Arc;

use scene::{Camera, Document};

use crate::{Error, ErrorKind, Exposure};

/// The largest side of a picture, pixels: what common decoders accept.
const MAX_SIDE: u32 = 32_768;
/// The most samples along one side of a pixel: 256 a pixel leave nothing to smooth.
const MAX_SAMPLES: u32 = 16;

/// Choices for pictures and displayed colours; exitance itself is never changed.
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// Where a picture is taken from; without it the scene's first camera, or
    /// `camera::automatic` where it has none.
    pub camera: Option<Camera>,
    /// How exitance becomes display light, in pictures and vertex colours.
    pub exposure: Exposure,
    /// Width and height of a picture, pixels, each in 1..=32768.
    pub size: (u32, u32),
    /// Samples along each side of a pixel, in 1..=16.
    pub samples: u32,
    /// The glTF document that the scene was read from: a GLB is then that document, lit. Without
    /// it a GLB has a node for each group.
    pub document: Option<Arc<Document>>,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            camera: None,
            exposure: Exposure::Auto,
            size: (1024, 768),
            samples: 3,
            document: None,
        }
    }
}

impl Options {
    pub(crate) fn check(&self) -> Result<(), Error> {
        check_picture(self.size, self.samples)?;
        self.exposure.check()
    }
}

/// Whether a picture of this size and sampling can be drawn.
pub(crate) fn check_picture((width, height): (u32, u32), samples: u32) -> Result<(), Error> {
    let fail = |range| Err(Error::new(ErrorKind::Option(range)));
    if !(1..=MAX_SIDE).contains(&width) || !(1..=MAX_SIDE).contains(&height) {
        return fail("a picture of 1 to 32768 pixels a side");
    }
    if !(1..=MAX_SAMPLES).contains(&samples) {
        return fail("1 to 16 samples along a pixel");
    }
    Ok(())
}
