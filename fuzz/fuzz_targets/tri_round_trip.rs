//! Records as .tri text and back: the same bits.

#![no_main]

use arbitrary::Arbitrary;
use libfuzzer_sys::fuzz_target;
use tri_io::{Reader, TriRecord, Writer};

#[derive(Arbitrary, Debug)]
struct Record {
    front: [u8; 3],
    back: [u8; 3],
    vertices: [[f64; 3]; 3],
    normals: Option<[[f64; 3]; 3]>,
}

/// All numbers of a record as bits: −0 is another number than 0 here.
fn bits(record: &TriRecord) -> ([u8; 6], Vec<u64>) {
    let ([a, b, c], [d, e, f]) = (record.front, record.back);
    let numbers = record.vertices.iter().chain(record.normals.iter().flatten()).flatten();
    ([a, b, c, d, e, f], numbers.map(|x| x.to_bits()).collect())
}

fuzz_target!(|records: Vec<Record>| {
    let finite = |x: &[[f64; 3]; 3]| x.as_flattened().iter().all(|x| x.is_finite());
    let records: Vec<TriRecord> = records
        .into_iter()
        .filter(|r| finite(&r.vertices) && r.normals.iter().all(finite))
        .map(|Record { front, back, vertices, normals }| TriRecord { front, back, vertices, normals })
        .collect();
    let mut writer = Writer::new(Vec::new());
    for record in &records {
        writer.write(record).expect("a vector takes everything");
    }
    let text = writer.finish().expect("a vector takes everything");
    let read: Vec<TriRecord> =
        Reader::new(&text[..]).collect::<Result<_, _>>().expect("what was written can be read");
    assert_eq!(read.len(), records.len());
    for (read, written) in read.iter().zip(&records) {
        assert_eq!(bits(read), bits(written));
    }
});
