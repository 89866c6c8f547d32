//! A picture as PNG: what a screen shows.

use std::io::Write;

use scene::{Scene, Solution};

use super::draw_with;
use crate::{Error, Options};

/// Draws and writes a PNG.
pub(crate) fn write(
    out: &mut dyn Write,
    scene: &Scene,
    solution: &Solution,
    options: &Options,
) -> Result<(), Error> {
    let picture = draw_with(scene, solution, options)?;
    let bytes = picture.to_srgb(picture.scale(options.exposure));
    encode(out, (picture.width, picture.height), &bytes)
}

/// Encodes sRGB bytes, three a pixel, row by row from the top left.
pub(crate) fn encode(
    out: &mut dyn Write,
    (width, height): (u32, u32),
    bytes: &[u8],
) -> Result<(), Error> {
    let mut encoder = ::png::Encoder::new(out, width, height);
    encoder.set_color(::png::ColorType::Rgb);
    encoder.set_depth(::png::BitDepth::Eight);
    encoder.set_source_srgb(::png::SrgbRenderingIntent::Perceptual);
    let encode = || {
        let mut writer = encoder.write_header()?;
        writer.write_image_data(bytes)?;
        writer.finish()
    };
    encode().map_err(|error| match error {
        // The sink's own words, without the encoder's around them.
        ::png::EncodingError::IoError(cause) => Error::write(cause),
        other => Error::write(other),
    })
}
