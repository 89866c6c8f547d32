//! The container: a header, the JSON, the binary sections.

use std::io::Write;

use serde_json::Value;

use crate::{Error, ErrorKind};

const MAGIC: &[u8; 4] = b"glTF";
const VERSION: u32 = 2;
const JSON_CHUNK: &[u8; 4] = b"JSON";
const BINARY_CHUNK: &[u8; 4] = b"BIN\0";
const HEADER_BYTES: usize = 12;
const CHUNK_HEADER_BYTES: usize = 8;
/// Chunks, and all that vertices are read from, begin on a multiple of this.
pub(crate) const ALIGNMENT: usize = 4;

/// Writes a document and its sections, each a multiple of [`ALIGNMENT`] long but for the last.
pub(crate) fn write(
    out: &mut dyn Write,
    document: &Value,
    sections: &[&[u8]],
) -> Result<(), Error> {
    let mut json = serde_json::to_vec(document).map_err(Error::write)?;
    // Text is padded with spaces, data with zeros.
    json.resize(json.len().next_multiple_of(ALIGNMENT), b' ');
    let binary: usize = sections.iter().map(|s| s.len()).sum();
    let padding = binary.next_multiple_of(ALIGNMENT) - binary;
    let mut total = HEADER_BYTES + CHUNK_HEADER_BYTES + json.len();
    if binary > 0 {
        total += CHUNK_HEADER_BYTES + binary + padding;
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
        pieces.push([length(binary + padding)?.to_le_bytes(), *BINARY_CHUNK].concat());
    }
    let zeros = [0; ALIGNMENT];
    let sections = sections.iter().copied().chain([&zeros[..padding]]);
    for piece in pieces.iter().map(Vec::as_slice).chain(sections) {
        out.write_all(piece).map_err(Error::write)?;
    }
    Ok(())
}
