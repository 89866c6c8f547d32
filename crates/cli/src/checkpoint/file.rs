//! The file of --checkpoint: the solver's state, what it belongs to, and a checksum.
//!
//! docs/checkpoint.md says what each byte is.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use radiosity_core::{Checkpoint, Inconsistent, Kept};

use super::Identity;
use crate::failure::Failure;
use crate::screen;
use crate::settings::Keeping;

/// What the file starts with: bytes that no text has, and that a transfer as text would change.
const MAGIC: [u8; 8] = *b"\x89RADCKP\n";

/// Version of the file and of the solver's state in it.
const FORMAT: u32 = 2;

/// Writes the state when it is due.
pub(crate) struct Keeper {
    path: PathBuf,
    every: Duration,
    identity: Identity,
    /// The end of the last writing: it must never take all of the time.
    last: Instant,
    written: u32,
    failed: bool,
}

impl Keeper {
    /// What the settings ask for, if they do.
    pub(crate) fn of(keeping: &Keeping, identity: &Identity) -> Option<Self> {
        keeping.checkpoint.as_ref().map(|path| Self {
            path: path.clone(),
            every: keeping.every,
            identity: identity.clone(),
            last: Instant::now(),
            written: 0,
            failed: false,
        })
    }

    /// Whether the state is to be written.
    pub(crate) fn due(&self) -> bool {
        self.last.elapsed() >= self.every
    }

    /// Writes the state. What cannot be written is warned of, once: the work is worth more than
    /// its checkpoint.
    pub(crate) fn keep(&mut self, kept: &Kept<'_>) {
        match write(&self.path, &self.identity, kept) {
            Ok(()) => self.written += 1,
            Err(failure) if !self.failed => {
                screen::warning(&format!("checkpoint: {failure}; the work goes on without"));
                self.failed = true;
            }
            Err(_) => {}
        }
        self.last = Instant::now();
    }

    /// Says how to go on with work that a limit ended.
    pub(crate) fn say_how_to_go_on(&self) {
        if self.written > 0 {
            let path = self.path.display();
            screen::say(&format!("--resume {path} goes on from here"));
        }
    }
}

/// Writes a checkpoint beside the old one, and puts it in its place.
fn write(path: &Path, identity: &Identity, kept: &Kept<'_>) -> Result<(), Failure> {
    output::replace_file(path, |file| {
        let mut out = Summed { out: file, sum: crc32fast::Hasher::new() };
        let text = identity.text();
        let mut fill = || -> io::Result<()> {
            out.write_all(&MAGIC)?;
            out.write_all(&FORMAT.to_le_bytes())?;
            out.write_all(&(text.len() as u32).to_le_bytes())?;
            out.write_all(text.as_bytes())?;
            kept.write(&mut out)?;
            let sum = out.sum.clone().finalize();
            out.out.write_all(&sum.to_le_bytes())
        };
        fill().map_err(output::Error::from)
    })?;
    Ok(())
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

/// Reads a checkpoint of this work.
pub(crate) fn read(path: &Path, identity: &Identity) -> Result<Checkpoint, Failure> {
    let failed = |message: String| failed(path, &message);
    let bytes = bytes(path).map_err(|e| failed(e.to_string()))?;
    let (there, state) = parts(&bytes).map_err(&failed)?;
    identity.check(there).map_err(&failed)?;
    Checkpoint::read(state).map_err(|e| inconsistent(path, e))
}

/// The state in the file contradicts itself, or this work.
pub(crate) fn inconsistent(path: &Path, error: Inconsistent) -> Failure {
    failed(path, &format!("is damaged, or of other work: {error}"))
}

fn failed(path: &Path, message: &str) -> Failure {
    Failure::Failed(format!("{}: {message}", path.display()))
}

/// The bytes of the file; no more than its start, if that is none of ours.
fn bytes(path: &Path) -> io::Result<Vec<u8>> {
    let file = File::open(path)?;
    let mut bytes = Vec::new();
    (&file).take(MAGIC.len() as u64).read_to_end(&mut bytes)?;
    if bytes == MAGIC {
        (&file).read_to_end(&mut bytes)?;
    }
    Ok(bytes)
}

/// What the file belongs to, and the state.
fn parts(bytes: &[u8]) -> Result<(&str, &[u8]), String> {
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
        assert!(newer.contains("format 3, expected 2: a newer program"), "{newer}");
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
