//! The bytes around the solver's state in a checkpoint: what they belong to, and a checksum.
//!
//! docs/checkpoint.md says what each byte is. Nothing here knows of the rest of the program, so
//! that `fuzz/` compiles this file, too.

use std::io::{self, Read, Write};

/// What the file starts with: bytes that no text has, and that a transfer as text would change.
const MAGIC: [u8; 8] = *b"\x89RADCKP\n";

/// Version of the file and of the solver's state in it.
const FORMAT: u32 = 1;

/// Writes all of a file: `text` tells what it belongs to, and `state` writes the state.
pub(super) fn write(
    out: &mut dyn Write,
    text: &str,
    state: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = Summed { out, sum: crc32fast::Hasher::new() };
    out.write_all(&MAGIC)?;
    out.write_all(&FORMAT.to_le_bytes())?;
    out.write_all(&(text.len() as u32).to_le_bytes())?;
    out.write_all(text.as_bytes())?;
    state(&mut out)?;
    let sum = out.sum.finalize();
    out.out.write_all(&sum.to_le_bytes())
}

/// The bytes of a file; no more than its start, if that is none of ours.
pub(super) fn bytes(mut file: impl Read) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.by_ref().take(MAGIC.len() as u64).read_to_end(&mut bytes)?;
    if bytes == MAGIC {
        file.read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

/// What the file belongs to, and the state.
pub(super) fn parts(bytes: &[u8]) -> Result<(&str, &[u8]), String> {
    let Some(rest) = bytes.strip_prefix(&MAGIC) else {
        return Err("is no checkpoint, expected a file that --checkpoint wrote".into());
    };
    let cut_short = || damaged("it is cut short");
    let (format, rest) = rest.split_first_chunk().ok_or_else(cut_short)?;
    let format = u32::from_le_bytes(*format);
    if format != FORMAT {
        let other = format!("is a checkpoint of format {format}, expected {FORMAT}");
        let newer = if format > FORMAT { ": a newer program wrote it" } else { "" };
        return Err(other + newer);
    }
    let (rest, sum) = rest.split_last_chunk().ok_or_else(cut_short)?;
    if crc32fast::hash(&bytes[..bytes.len() - sum.len()]) != u32::from_le_bytes(*sum) {
        return Err(damaged("its checksum is another"));
    }
    let (length, rest) = rest.split_first_chunk().ok_or_else(cut_short)?;
    let length = u32::from_le_bytes(*length) as usize;
    let (text, state) = rest.split_at_checked(length).ok_or_else(cut_short)?;
    let text = std::str::from_utf8(text).map_err(|e| damaged(&e.to_string()))?;
    Ok((text, state))
}

fn damaged(how: &str) -> String {
    format!("is a damaged checkpoint: {how}")
}

/// Sums what is written through it.
struct Summed<'a> {
    out: &'a mut dyn Write,
    sum: crc32fast::Hasher,
}

impl Write for Summed<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file with a right checksum.
    fn file(format: u32, text: &[u8], state: &[u8]) -> Vec<u8> {
        let length = text.len() as u32;
        let mut bytes =
            [&MAGIC, &format.to_le_bytes()[..], &length.to_le_bytes(), text, state].concat();
        bytes.extend(crc32fast::hash(&bytes).to_le_bytes());
        bytes
    }

    #[test]
    fn parts_are_found_and_damage_is() {
        let whole = file(FORMAT, b"scene: a\n", &[1, 2, 3]);
        assert_eq!(parts(&whole), Ok(("scene: a\n", &[1, 2, 3][..])));
        for length in 0..whole.len() {
            assert!(parts(&whole[..length]).is_err(), "{length}");
        }
        for at in 0..whole.len() {
            for bit in 0..8 {
                let mut bytes = whole.clone();
                bytes[at] ^= 1 << bit;
                assert!(parts(&bytes).is_err(), "{at}, {bit}");
            }
        }
        assert!(parts(&[&whole[..], &[0]].concat()).is_err());
    }

    #[test]
    fn other_formats_are_told_apart() {
        let newer = parts(&file(FORMAT + 1, b"", b"")).unwrap_err();
        assert!(newer.contains("format 2, expected 1: a newer program"), "{newer}");
        assert!(parts(&file(0, b"", b"")).unwrap_err().contains("format 0"));
        assert!(parts(b"\xff\xd8\xff\xe0 JFIF").unwrap_err().contains("no checkpoint"));
        // Right checksum, wrong inside.
        assert!(parts(&file(FORMAT, b"\xff", b"")).is_err());
        let mut long = file(FORMAT, b"", b"");
        long.truncate(12);
        long.extend(u32::MAX.to_le_bytes());
        long.extend(crc32fast::hash(&long).to_le_bytes());
        assert!(parts(&long).is_err());
    }
}
