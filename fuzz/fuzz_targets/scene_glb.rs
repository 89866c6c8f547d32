//! Bytes as a GLB file, or as JSON and a binary chunk that make a sound one.

#![no_main]

use libfuzzer_sys::fuzz_target;
use radiosity_fuzz::scene;

/// Parts the JSON from the binary chunk: a byte that no JSON has.
const BORDER: u8 = 0xff;

fuzz_target!(|bytes: &[u8]| {
    if bytes.starts_with(b"glTF") {
        return scene("a.glb", bytes);
    }
    let mut parts = bytes.splitn(2, |&byte| byte == BORDER);
    let json = parts.next().unwrap_or_default();
    scene("a.glb", &pack(json, parts.next().unwrap_or_default()));
});

/// # References
/// glTF 2.0, section 4.4: a header and chunks, each filled up to four bytes.
fn pack(json: &[u8], binary: &[u8]) -> Vec<u8> {
    let mut body = Vec::new();
    for (kind, data, filler) in [(b"JSON", json, b' '), (b"BIN\0", binary, 0)] {
        let length = data.len().next_multiple_of(4);
        body.extend((length as u32).to_le_bytes());
        body.extend(kind);
        body.extend(data);
        body.resize(body.len() + length - data.len(), filler);
    }
    let length = 12 + body.len() as u32;
    [b"glTF", &2_u32.to_le_bytes()[..], &length.to_le_bytes(), &body].concat()
}
