//! What several of the tests need.

use std::io::{self, Read};

use tri_io::{Error, Reader, TriRecord};

/// Reads everything, up to the first error.
pub(crate) fn read(source: impl Read) -> (Vec<TriRecord>, Option<Error>) {
    let mut records = Vec::new();
    for item in Reader::new(source) {
        match item {
            Ok(record) => records.push(record),
            Err(error) => return (records, Some(error)),
        }
    }
    (records, None)
}

/// xorshift64*: the same values on every run and machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// Uniform below `bound`, near enough.
    pub(crate) fn below(&mut self, bound: u64) -> u64 {
        self.next() % bound
    }

    /// A finite value, every bit pattern equally likely: half are below 1, few are ordinary.
    pub(crate) fn finite(&mut self) -> f64 {
        loop {
            let value = f64::from_bits(self.next());
            if value.is_finite() {
                return value;
            }
        }
    }
}

/// A source that gives its bytes in pieces of 1 to 7, and is interrupted now and then.
pub(crate) struct Dribble<'a> {
    bytes: &'a [u8],
    random: Random,
}

impl<'a> Dribble<'a> {
    pub(crate) fn new(bytes: &'a [u8], seed: u64) -> Self {
        Self { bytes, random: Random(seed) }
    }
}

impl Read for Dribble<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let size = self.random.below(8) as usize;
        if size == 0 {
            return Err(io::ErrorKind::Interrupted.into());
        }
        let (piece, rest) = self.bytes.split_at(size.min(self.bytes.len()).min(buffer.len()));
        buffer[..piece.len()].copy_from_slice(piece);
        self.bytes = rest;
        Ok(piece.len())
    }
}
