//! A zip archive whose members are stored as they are.
//!
//! Form factors hardly compress, and the crates that write zip archives bring encryption,
//! clocks and random numbers; stored members need a checksum and two kinds of record.
//!
//! # References
//! PKWARE APPNOTE 6.3.10, §4.3.7 (local header), §4.3.12 (central directory), §4.3.16 (end).

use std::io::{self, Write};

use crate::{Error, ErrorKind};

/// Version 2.0 of the format is needed to read it.
const VERSION: u16 = 20;

/// Names are UTF-8 (bit 11).
const FLAGS: u16 = 1 << 11;

/// 1 January 1980, the first day there is: archives of the same matrix are the same bytes.
const DATE: u16 = 1 << 5 | 1;

/// An archive that is being written.
pub(super) struct Archive<'a> {
    out: &'a mut dyn Write,
    written: u64,
    members: u16,
    directory: Vec<u8>,
}

impl<'a> Archive<'a> {
    pub(super) fn new(out: &'a mut dyn Write) -> Self {
        Self { out, written: 0, members: 0, directory: Vec::new() }
    }

    /// Adds a member: a header and the `size` bytes that `fill` writes. `fill` is called
    /// twice, because the checksum stands before the bytes.
    pub(super) fn member(
        &mut self,
        name: &str,
        size: u64,
        header: &[u8],
        fill: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Error> {
        let size = header.len() as u64 + size;
        let (size32, start) = (narrow(size)?, narrow(self.written)?);
        let mut sum = Checksum(crc32fast::Hasher::new(), 0);
        sum.write_all(header).and_then(|()| fill(&mut sum)).map_err(Error::write)?;
        let Checksum(hasher, length) = sum;
        assert_eq!(length, size, "{name}: the size is known beforehand");

        let name_length = u16::try_from(name.len()).expect("names of arrays are short");
        let mut common = Vec::new();
        for field in [VERSION, FLAGS, 0, 0, DATE] {
            common.extend(field.to_le_bytes());
        }
        for field in [hasher.finalize(), size32, size32] {
            common.extend(field.to_le_bytes());
        }
        common.extend(name_length.to_le_bytes());
        common.extend([0; 2]);

        let local = [b"PK\x03\x04", &common[..], name.as_bytes()].concat();
        let write = |out: &mut dyn Write| {
            out.write_all(&local)?;
            out.write_all(header)?;
            fill(out)
        };
        write(self.out).map_err(Error::write)?;
        self.written += local.len() as u64 + size;
        self.members += 1;

        self.directory.extend(b"PK\x01\x02");
        self.directory.extend(VERSION.to_le_bytes());
        self.directory.extend(common);
        // No comment, disk 0, no attributes.
        self.directory.extend([0; 10]);
        self.directory.extend(start.to_le_bytes());
        self.directory.extend(name.as_bytes());
        Ok(())
    }

    /// Writes the directory.
    pub(super) fn finish(self) -> Result<(), Error> {
        let length = u32::try_from(self.directory.len()).expect("a directory of few members");
        let mut end = b"PK\x05\x06\0\0\0\0".to_vec();
        end.extend(self.members.to_le_bytes());
        end.extend(self.members.to_le_bytes());
        end.extend(length.to_le_bytes());
        end.extend(narrow(self.written)?.to_le_bytes());
        end.extend([0; 2]);
        self.out.write_all(&[self.directory, end].concat()).map_err(Error::write)
    }
}

/// Sizes and places in an archive are 32 bits wide.
fn narrow(bytes: u64) -> Result<u32, Error> {
    let too_large = || Error::new(ErrorKind::TooLarge("an archive holds less than 4 GiB"));
    u32::try_from(bytes).map_err(|_| too_large())
}

/// Sums up and counts what is written to it.
struct Checksum(crc32fast::Hasher, u64);

impl Write for Checksum {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.update(bytes);
        self.1 += bytes.len() as u64;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
