//! Bytes as .tri records: the same ones however the source hands them over.

#![no_main]

use std::io::{self, Read};

use libfuzzer_sys::fuzz_target;
use radiosity_fuzz::one_line;
use tri_io::{Reader, TriRecord};

/// A source that gives a few bytes at a time.
struct Drops<'a> {
    rest: &'a [u8],
    most: usize,
}

impl Read for Drops<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let most = self.most.min(buffer.len());
        self.rest.read(&mut buffer[..most])
    }
}

/// All records, and the message after them, if any.
fn records(source: impl Read) -> (Vec<TriRecord>, Option<String>) {
    let (mut records, mut message) = (Vec::new(), None);
    for record in Reader::new(source) {
        match record {
            Ok(record) => records.push(record),
            Err(error) => {
                message = Some(error.to_string());
                one_line(message.as_deref().unwrap_or_default());
            }
        }
    }
    (records, message)
}

fuzz_target!(|bytes: &[u8]| {
    let whole = records(bytes);
    assert!(whole.0.iter().flat_map(|r| r.vertices.as_flattened()).all(|x| x.is_finite()));
    for most in [1, 7] {
        assert_eq!(records(Drops { rest: bytes, most }), whole, "{most} bytes at a time");
    }
});
