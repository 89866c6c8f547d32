//! Binary glTF 2.0: the scene's groups, materials and cameras, with the light in the
//! vertices.

mod buffer;
mod document;

use std::io::Write;

use scene::{Scene, Solution};

use crate::{Error, ErrorKind, Exposure};

const MAGIC: &[u8; 4] = b"glTF";
const VERSION: u32 = 2;
const JSON_CHUNK: &[u8; 4] = b"JSON";
const BINARY_CHUNK: &[u8; 4] = b"BIN\0";
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;

/// Writes a GLB container. Its header states its length, so it is built in memory first.
pub(crate) fn write(
    out: &mut dyn Write,
    scene: &Scene,
    solution: &Solution,
    exposure: Exposure,
) -> Result<(), Error> {
    let scale = exposure.scale_for(scene, solution);
    let geometry = buffer::build(scene, solution, scale)?;
    let document = document::build(scene, &geometry, scale)?;
    let mut json = serde_json::to_vec(&document).map_err(Error::write)?;
    // Chunks end on four bytes: text is padded with spaces, data with zeros.
    json.resize(json.len().next_multiple_of(4), b' ');
    let sections = geometry.sections();
    let binary: usize = sections.iter().map(|s| s.len()).sum();
    let mut total = HEADER_BYTES + CHUNK_HEADER_BYTES + json.len();
    if binary > 0 {
        total += CHUNK_HEADER_BYTES + binary;
    }
    let length = |bytes: usize| {
        u32::try_from(bytes).map_err(|_| Error::new(ErrorKind::TooLarge("more than 4 GiB")))
    };
    let mut pieces: Vec<Vec<u8>> = vec![
        [*MAGIC, VERSION.to_le_bytes(), length(total)?.to_le_bytes()].concat(),
        [length(json.len())?.to_le_bytes(), *JSON_CHUNK].concat(),
        json,
    ];
    if binary > 0 {
        pieces.push([length(binary)?.to_le_bytes(), *BINARY_CHUNK].concat());
    }
    for piece in pieces.iter().map(Vec::as_slice).chain(sections) {
        out.write_all(piece).map_err(Error::write)?;
    }
    Ok(())
}
