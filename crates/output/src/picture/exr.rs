//! A picture as OpenEXR: the light itself, linear and unclamped, for programs that expose it.
//!
//! A single part of scan lines in 32-bit floats, 16 lines a block, each block deflated (the format's
//! ZIP), after the file layout that openexr.com publishes.

use std::io::Write;

use flate2::Compression;
use flate2::write::ZlibEncoder;
use scene::{Scene, Solution};

use super::{Picture, draw_with};
use crate::{Error, Options};

const MAGIC: [u8; 4] = [0x76, 0x2f, 0x31, 0x01];
/// Version 2 without flags: one part, in scan lines, names of at most 31 bytes.
const VERSION: [u8; 4] = [2, 0, 0, 0];
/// In the order that the format asks for: by name.
const CHANNELS: [&str; 4] = ["A", "B", "G", "R"];
/// The format's number for 32-bit floats.
const FLOAT: i32 = 2;
/// The format's number for blocks deflated on their own.
const ZIP: u8 = 3;
/// Lines in such a block.
const BLOCK: usize = 16;
/// What the difference of a byte to the one before is shifted by, so that none is near 0.
const MIDDLE: u8 = 128;

/// Draws and writes an EXR: red, green, blue, as exitance averaged over the pixel, and alpha, the
/// share of the pixel that shows anything; colours are multiplied by it, as the format expects.
pub(crate) fn write(
    out: &mut dyn Write,
    scene: &Scene,
    solution: &Solution,
    options: &Options,
) -> Result<(), Error> {
    encode(out, &draw_with(scene, solution, options)?).map_err(Error::write)
}

fn encode(out: &mut dyn Write, picture: &Picture) -> std::io::Result<()> {
    let head = header(picture.width, picture.height);
    let lines: Vec<_> = picture.pixels.chunks(picture.width as usize).collect();
    let blocks = lines.chunks(BLOCK).map(block).collect::<Result<Vec<_>, _>>()?;
    out.write_all(&head)?;
    // Where each block begins, from the start of the file.
    let mut offset = (head.len() + blocks.len() * size_of::<u64>()) as u64;
    for bytes in &blocks {
        out.write_all(&offset.to_le_bytes())?;
        offset += (2 * size_of::<i32>() + bytes.len()) as u64;
    }
    for (number, bytes) in blocks.iter().enumerate() {
        // A picture has at most 32768 lines, and a block 8 MiB.
        out.write_all(&((number * BLOCK) as i32).to_le_bytes())?;
        out.write_all(&(bytes.len() as i32).to_le_bytes())?;
        out.write_all(bytes)?;
    }
    Ok(())
}

/// Magic number, version and attributes.
fn header(width: u32, height: u32) -> Vec<u8> {
    let mut bytes = [MAGIC, VERSION].concat();
    let mut attribute = |name: &str, kind: &str, value: &[u8]| {
        for word in [name, kind] {
            bytes.extend(word.as_bytes());
            bytes.push(0);
        }
        bytes.extend((value.len() as i32).to_le_bytes());
        bytes.extend(value);
    };
    let words = |words: &[i32]| -> Vec<u8> { words.iter().flat_map(|w| w.to_le_bytes()).collect() };
    let mut channels = Vec::new();
    for name in CHANNELS {
        channels.extend(name.as_bytes());
        channels.push(0);
        // Type, a hint about perception and room for others, samples along both axes.
        channels.extend(words(&[FLOAT, 0, 1, 1]));
    }
    channels.push(0);
    let window = words(&[0, 0, width as i32 - 1, height as i32 - 1]);
    attribute("channels", "chlist", &channels);
    attribute("comments", "string", b"exitance, W/m2 per channel: radiance times pi");
    attribute("compression", "compression", &[ZIP]);
    attribute("dataWindow", "box2i", &window);
    attribute("displayWindow", "box2i", &window);
    attribute("lineOrder", "lineOrder", &[0]);
    attribute("pixelAspectRatio", "float", &1f32.to_le_bytes());
    attribute("screenWindowCenter", "v2f", &[0; 8]);
    attribute("screenWindowWidth", "float", &1f32.to_le_bytes());
    bytes.push(0);
    bytes
}

/// Lines as the bytes of a block: deflated, or as they are where that is no shorter.
fn block(lines: &[&[super::Pixel]]) -> std::io::Result<Vec<u8>> {
    let mut plain = Vec::new();
    for line in lines {
        for channel in 0..CHANNELS.len() {
            for pixel in *line {
                let [r, g, b] = pixel.light().0.map(|c| c as f32);
                let alpha = pixel.surface.share + pixel.lamp.share;
                plain.extend([alpha, b, g, r][channel].to_le_bytes());
            }
        }
    }
    // Bytes at even places, then those at odd ones; then each as its difference to the one before.
    let halves = plain.iter().step_by(2).chain(plain.iter().skip(1).step_by(2));
    let mut before = None;
    let differences: Vec<u8> = halves
        .map(|&byte| match before.replace(byte) {
            Some(before) => byte.wrapping_sub(before).wrapping_add(MIDDLE),
            None => byte,
        })
        .collect();
    let mut encoder = ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(&differences)?;
    let short = encoder.finish()?;
    Ok(if short.len() < plain.len() { short } else { plain })
}
