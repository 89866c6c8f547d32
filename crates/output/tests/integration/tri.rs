//! Records out, through the reader of the format.

use output::{Format, Options};
use scene::Rgb;
use tri_io::{Reader, TriRecord};

use crate::common::{bytes, square};

#[test]
fn exitance_is_clamped_and_rounded_in_front_of_a_black_back() {
    let text = bytes(Format::Tri, &square(Rgb::new(-3.0, 99.5, 1e9)), &Options::default());
    let records: Vec<TriRecord> = Reader::new(text.as_slice()).map(Result::unwrap).collect();
    assert_eq!(records.len(), 2);
    let expected = TriRecord {
        front: [0, 100, 255],
        back: [0; 3],
        vertices: [[0.0; 3], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        normals: Some([[0.0, 0.0, 1.0]; 3]),
    };
    assert_eq!(records[1], expected);
}
