//! A PNG writer that does not compress.
//!
//! A compressor's next version may find shorter bytes; the bundled scenes must not change with
//! it, and their textures are a few dozen pixels.

/// An RGB picture, rows from the top.
pub(crate) fn encode(width: u32, pixels: &[[u8; 3]]) -> Vec<u8> {
    let rows = pixels.chunks(width as usize);
    let height = u32::try_from(rows.len()).expect("bundled textures are small");
    let mut header = Vec::new();
    header.extend(width.to_be_bytes());
    header.extend(height.to_be_bytes());
    // Eight bits, RGB, and the only compression, filter and order of rows there are.
    header.extend([8, 2, 0, 0, 0]);

    // Each row starts with its filter: none.
    let raw: Vec<u8> = rows.flat_map(|row| [0].into_iter().chain(row.concat())).collect();

    let mut file = b"\x89PNG\r\n\x1a\n".to_vec();
    chunk(&mut file, b"IHDR", &header);
    chunk(&mut file, b"IDAT", &stored(&raw));
    chunk(&mut file, b"IEND", &[]);
    file
}

/// A zlib stream of one stored block (RFC 1950, RFC 1951 §3.2.4).
fn stored(raw: &[u8]) -> Vec<u8> {
    let len = u16::try_from(raw.len()).expect("bundled textures fit one stored block");
    let mut stream = vec![0x78, 0x01, 0x01];
    stream.extend(len.to_le_bytes());
    stream.extend((!len).to_le_bytes());
    stream.extend(raw);
    stream.extend(adler32(raw).to_be_bytes());
    stream
}

fn chunk(file: &mut Vec<u8>, kind: &[u8; 4], data: &[u8]) {
    file.extend(u32::try_from(data.len()).expect("bundled textures are small").to_be_bytes());
    let start = file.len();
    file.extend(kind);
    file.extend(data);
    let sum = crc32(&file[start..]);
    file.extend(sum.to_be_bytes());
}

/// Bit by bit with the reversed polynomial of ISO 3309, as PNG asks.
fn crc32(bytes: &[u8]) -> u32 {
    let step = |crc: u32| (crc >> 1) ^ if crc & 1 == 1 { 0xEDB8_8320 } else { 0 };
    !bytes.iter().fold(!0, |crc, &byte| (0..8).fold(crc ^ u32::from(byte), |crc, _| step(crc)))
}

fn adler32(bytes: &[u8]) -> u32 {
    let (a, b) = bytes.iter().fold((1, 0), |(a, b), &byte| {
        let a = (a + u32::from(byte)) % 65521;
        (a, (b + a) % 65521)
    });
    b << 16 | a
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_have_their_published_check_values() {
        // The check value of CRC-32/ISO-HDLC, and RFC 1950's sum of a text worked by hand often.
        assert_eq!(crc32(b"123456789"), 0xCBF4_3926);
        assert_eq!(adler32(b"Wikipedia"), 0x11E6_0398);
    }

    #[test]
    fn an_empty_end_chunk_is_the_one_every_png_ends_with() {
        let file = encode(1, &[[1, 2, 3]]);
        assert!(file.ends_with(b"\0\0\0\0IEND\xAE\x42\x60\x82"));
    }
}
