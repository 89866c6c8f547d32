//! Kernels of `tri-io`: text to records, records to text, floats to text.

use tri_io::{FloatBuffer, Reader, TriRecord, Writer, write_f32, write_f64};

use crate::count::count;
use crate::random::Random;
use crate::scenes;

/// Floats written by a kernel.
const FLOATS: usize = 20_000;

/// Coordinates of few digits, as the bundled scenes have them.
pub(crate) fn parse() -> f64 {
    count(|| read(scenes::FURNISHED).len()) as f64
}

/// Coordinates of as many digits as an f32 in f64 has: those that integers divide.
pub(crate) fn parse_long() -> f64 {
    let text = write(&long_records());
    count(|| read(&text).len()) as f64
}

/// Bytes written.
pub(crate) fn write_long() -> f64 {
    let records = long_records();
    count(|| write(&records)).len() as f64
}

/// Bytes written, of values with every bit pattern equally likely.
pub(crate) fn float_f32() -> f64 {
    let mut random = Random(1);
    let values: Vec<f32> = std::iter::repeat_with(|| f32::from_bits(random.bits() as u32))
        .filter(|value| value.is_finite())
        .take(FLOATS)
        .collect();
    let mut buffer = FloatBuffer::new();
    count(|| values.iter().map(|&value| write_f32(value, &mut buffer).len()).sum::<usize>()) as f64
}

/// Bytes written, of values within ±500 with all their digits.
pub(crate) fn float_f64() -> f64 {
    let mut random = Random(2);
    let values: Vec<f64> = (0..FLOATS).map(|_| 1000.0 * random.signed()).collect();
    let mut buffer = FloatBuffer::new();
    count(|| values.iter().map(|&value| write_f64(value, &mut buffer).len()).sum::<usize>()) as f64
}

fn read(text: &[u8]) -> Vec<TriRecord> {
    Reader::new(text).collect::<Result<_, _>>().expect("the text is valid")
}

fn write(records: &[TriRecord]) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new());
    for record in records {
        writer.write(record).expect("a Vec takes everything");
    }
    writer.finish().expect("a Vec takes everything")
}

/// The room's triangles, moved to where coordinates have many digits.
fn long_records() -> Vec<TriRecord> {
    let mut random = Random(3);
    let mut records = read(scenes::FURNISHED);
    for coordinate in records.iter_mut().flat_map(|r| r.vertices.iter_mut().flatten()) {
        *coordinate = f64::from((*coordinate + random.signed()) as f32);
    }
    records
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_records_are_read_and_written() {
        assert_eq!((parse(), parse_long()), (1472.0, 1472.0));
        assert_eq!(read(&write(&long_records())), long_records());
        assert!(write_long() > 1.5 * scenes::FURNISHED.len() as f64, "more digits are more bytes");
    }

    /// 6 to 9 digits bring every f32 back, 15 to 17 every f64.
    #[test]
    fn floats_have_as_many_digits_as_they_need() {
        let bytes = [float_f32(), float_f64()].map(|sum| sum / FLOATS as f64);
        assert!((9.0..15.0).contains(&bytes[0]) && (16.0..20.0).contains(&bytes[1]), "{bytes:?}");
    }
}
