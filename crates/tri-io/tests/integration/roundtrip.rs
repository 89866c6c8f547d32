//! Records written and read again.

use std::io;

use tri_io::{TriRecord, Writer};

use crate::support::{Dribble, Random, read};

const SPECIAL: [f64; 12] = [
    0.0,
    -0.0,
    1e308,
    -1e308,
    f64::MAX,
    f64::MIN_POSITIVE,
    5e-324,
    -2.5e-310,
    0.1,
    250.0,
    9_007_199_254_740_993.0,
    1e16,
];

fn records(count: usize, random: &mut Random) -> Vec<TriRecord> {
    (0..count).map(|_| record(random)).collect()
}

fn record(random: &mut Random) -> TriRecord {
    let value = |random: &mut Random| match random.below(4) {
        0 => SPECIAL[random.below(SPECIAL.len() as u64) as usize],
        1 => random.finite(),
        2 => f64::from((random.below(1 << 24) as f32 - 8_388_608.0) / 16_384.0),
        _ => random.below(2001) as f64 - 1000.0,
    };
    let corners = |random: &mut Random| [(); 3].map(|()| [(); 3].map(|()| value(random)));
    let vertices = corners(random);
    let normals = (random.below(2) == 0).then(|| corners(random));
    let mut colour = || [(); 3].map(|()| random.next() as u8);
    TriRecord { front: colour(), back: colour(), vertices, normals }
}

fn write(records: &[TriRecord]) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new());
    for record in records {
        writer.write(record).unwrap();
    }
    writer.finish().unwrap()
}

/// Equality of every bit: `==` alone takes -0 for 0.
#[track_caller]
fn assert_same(read: &[TriRecord], written: &[TriRecord]) {
    assert_eq!(read.len(), written.len());
    let bits = |corners: &[[f64; 3]; 3]| corners.map(|corner| corner.map(f64::to_bits));
    for (read, written) in read.iter().zip(written) {
        assert_eq!((read.front, read.back), (written.front, written.back));
        assert_eq!(bits(&read.vertices), bits(&written.vertices), "{written:?}");
        assert_eq!(read.normals.as_ref().map(bits), written.normals.as_ref().map(bits));
    }
}

#[test]
fn records_come_back_bit_for_bit() {
    let written = records(5000, &mut Random(3));
    let text = write(&written);
    let (read, error) = read(text.as_slice());
    assert!(error.is_none(), "{error:?}");
    assert_same(&read, &written);
}

#[test]
fn pieces_of_any_size_read_the_same() {
    // More than twice the reader's buffer of 256 KiB, so that it is also refilled when full.
    let written = records(3000, &mut Random(5));
    let text = write(&written);
    assert!(text.len() > 600_000, "{}", text.len());
    for seed in 1..5 {
        let (read, error) = read(Dribble::new(&text, seed));
        assert!(error.is_none(), "{error:?}");
        assert_same(&read, &written);
    }
}

#[test]
fn a_buffer_edge_anywhere_in_a_record_changes_nothing() {
    let written = records(3, &mut Random(8));
    let text = write(&written);
    for edge in 0..=text.len() {
        // Blanks push the byte at `edge` to the first place after the buffer.
        let mut padded = vec![b'\n'; 256 * 1024 - edge];
        padded.extend_from_slice(&text);
        let (read, error) = read(padded.as_slice());
        assert!(error.is_none(), "{error:?}");
        assert_same(&read, &written);

        padded.extend_from_slice(b"?");
        let error = read_error(&padded);
        let line = padded.iter().filter(|&&byte| byte == b'\n').count() + 1;
        assert_eq!(error, format!("{line}:1: expected `Triangle`, found \"?\""));
    }
}

fn read_error(text: &[u8]) -> String {
    read(text).1.unwrap().to_string()
}

#[test]
fn the_layout_is_that_of_existing_files() {
    let record = TriRecord {
        front: [61, 181, 0],
        back: [255, 10, 9],
        vertices: [[-250.0, 200.0, -50.0], [0.5, 1e300, -0.0], [1e-7, 0.1, 3.0]],
        normals: None,
    };
    let with = TriRecord { normals: Some([[0.0, 0.0, 1.0]; 3]), ..record.clone() };
    let text = String::from_utf8(write(&[record, with])).unwrap();
    let expected = "\
Triangle
61 181 0 255 10 9
-250 200 -50
0.5 1e+300 -0
1e-7 0.1 3
Triangle
61 181 0 255 10 9
-250 200 -50 0 0 1
0.5 1e+300 -0 0 0 1
1e-7 0.1 3 0 0 1
";
    assert_eq!(text, expected);
}

#[test]
fn every_channel_value_is_spelt() {
    let mut record = record(&mut Random(1));
    for value in 0..=255 {
        record.front = [value, 255 - value, value / 2];
        assert_same(&read(write(&[record.clone()]).as_slice()).0, &[record.clone()]);
    }
}

#[test]
fn a_refused_record_leaves_no_trace() {
    let good = record(&mut Random(2));
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let mut bad_vertex = good.clone();
        bad_vertex.vertices[2][2] = value;
        let mut bad_normal = good.clone();
        bad_normal.normals = Some([[0.0; 3], [0.0; 3], [1.0, value, 0.0]]);

        let mut writer = Writer::new(Vec::new());
        writer.write(&good).unwrap();
        for (record, start) in
            [(&bad_vertex, "vertex 3 has z ="), (&bad_normal, "normal 3 has y =")]
        {
            let error = writer.write(record).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::InvalidInput);
            assert!(error.to_string().starts_with(start), "{error}");
        }
        writer.write(&good).unwrap();
        assert_eq!(writer.finish().unwrap(), write(&[good.clone(), good.clone()]));
    }
}

#[test]
fn a_failing_output_is_reported_at_the_end_at_the_latest() {
    struct Full;
    impl io::Write for Full {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(io::ErrorKind::StorageFull.into())
        }
        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }
    let mut writer = Writer::new(Full);
    let outcome = writer.write(&record(&mut Random(2))).and_then(|()| writer.finish().map(drop));
    assert_eq!(outcome.unwrap_err().kind(), io::ErrorKind::StorageFull);
}
