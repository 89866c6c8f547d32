//! Float text beside the alternatives and by digits, and the reader and writer in bytes per second,
//! by bytes.
//!
//! `cargo bench -p radiosity-tri-io -- float_text`, `-- digits`, `-- records` and `-- bytes`.

#![allow(missing_docs)] // `criterion_group!` makes public functions without any

use std::ffi::c_char;
use std::hint::black_box;
use std::io::Write as _;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use tri_io::{FloatBuffer, Reader, TriRecord, Writer, write_f32, write_f64};

/// Values per float bench: enough that no branch predictor learns them by heart.
const VALUES: usize = 8192;

/// Triangles of the generated scene: 26 MB of text with six decimals, 38 MB in shortest form.
const TRIANGLES: usize = 200_000;

/// xorshift64*: the same values on every run.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }

    /// Uniform in [-1, 1).
    fn signed(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    }
}

/// Coordinates within ±500 as scenes hold them: half, at random, on a grid of whole units.
fn coordinates(random: &mut Random) -> Vec<f32> {
    (0..VALUES)
        .map(|_| {
            let value = 500.0 * random.signed();
            (if random.signed() < 0.0 { value.round() } else { value }) as f32
        })
        .collect()
}

/// Finite values with every bit pattern equally likely.
fn bit_patterns(random: &mut Random) -> Vec<f32> {
    std::iter::repeat_with(|| f32::from_bits(random.next() as u32))
        .filter(|value| value.is_finite())
        .take(VALUES)
        .collect()
}

fn float_text(c: &mut Criterion) {
    let mut random = Random(1);
    for (name, values) in
        [("coordinates", coordinates(&mut random)), ("bit_patterns", bit_patterns(&mut random))]
    {
        let mut group = c.benchmark_group(format!("float_text/{name}"));
        group.throughput(Throughput::Elements(VALUES as u64));
        let mut each = |name: &str, length: &mut dyn FnMut(f32) -> usize| {
            group.bench_function(name, |b| {
                b.iter(|| values.iter().map(|&value| length(black_box(value))).sum::<usize>());
            });
        };

        let mut buffer = FloatBuffer::new();
        each("write_f32", &mut |value| black_box(write_f32(value, &mut buffer)).len());
        let mut buffer = zmij::Buffer::new();
        each("zmij", &mut |value| black_box(buffer.format(value)).len());
        let mut buffer = ryu::Buffer::new();
        each("ryu", &mut |value| black_box(buffer.format(value)).len());
        let mut buffer = Vec::with_capacity(512);
        each("std", &mut |value| {
            buffer.clear();
            write!(buffer, "{value}").expect("a Vec takes everything");
            black_box(&buffer).len()
        });
        // %f loses digits; %.9g is what C needs to bring every f32 back.
        each("printf_f", &mut |value| print(c"%f".as_ptr(), value));
        each("printf_9g", &mut |value| print(c"%.9g".as_ptr(), value));
        group.finish();
    }
}

/// Numbers by their significant digits: an `f32` has up to 9, an `f64` up to 17.
fn digits(c: &mut Criterion) {
    let rounded = |digits: usize| {
        let mut random = Random(2);
        let value = move |_| format!("{:.*e}", digits - 1, 500.0 * random.signed());
        (0..VALUES).map(value)
    };
    let mut group = c.benchmark_group("digits/write_f32");
    group.throughput(Throughput::Elements(VALUES as u64));
    for digits in [1, 3, 6, 9] {
        let values: Vec<f32> =
            rounded(digits).map(|text| text.parse().expect("it is a number")).collect();
        let mut buffer = FloatBuffer::new();
        let mut length = |value: &f32| write_f32(black_box(*value), &mut buffer).len();
        group.bench_function(BenchmarkId::from_parameter(digits), |b| {
            b.iter(|| values.iter().map(&mut length).sum::<usize>());
        });
    }
    group.finish();
    let mut group = c.benchmark_group("digits/write_f64");
    group.throughput(Throughput::Elements(VALUES as u64));
    for digits in [1, 5, 9, 13, 17] {
        let values: Vec<f64> =
            rounded(digits).map(|text| text.parse().expect("it is a number")).collect();
        let mut buffer = FloatBuffer::new();
        let mut length = |value: &f64| write_f64(black_box(*value), &mut buffer).len();
        group.bench_function(BenchmarkId::from_parameter(digits), |b| {
            b.iter(|| values.iter().map(&mut length).sum::<usize>());
        });
    }
}

#[allow(unsafe_code)] // the C library is what we compare with
fn print(format: *const c_char, value: f32) -> usize {
    let mut buffer: [c_char; 64] = [0; 64];
    // SAFETY: the buffer is as long as stated, and the format takes exactly one double.
    let length =
        unsafe { libc::snprintf(buffer.as_mut_ptr(), buffer.len(), format, f64::from(value)) };
    black_box(&buffer);
    usize::try_from(length).expect("the formats are valid")
}

fn room(random: &mut Random, triangles: usize) -> Vec<TriRecord> {
    let mut triple = || [(); 3].map(|()| f64::from((500.0 * random.signed()) as f32));
    (0..triangles)
        .map(|_| TriRecord {
            front: [61, 181, 181],
            back: [0, 0, 0],
            vertices: [triple(), triple(), triple()],
            normals: None,
        })
        .collect()
}

/// The text that C's `%f` makes, six decimals for every number.
fn six_decimals(records: &[TriRecord]) -> Vec<u8> {
    let mut text = Vec::new();
    for TriRecord { front: [r, g, b], vertices, .. } in records {
        writeln!(text, "Triangle \n{r} {g} {b} 0 0 0").expect("a Vec takes everything");
        for [x, y, z] in vertices {
            writeln!(text, "{x:.6} {y:.6} {z:.6}").expect("a Vec takes everything");
        }
    }
    text
}

fn shortest(records: &[TriRecord]) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new());
    for record in records {
        writer.write(record).expect("a Vec takes everything");
    }
    writer.finish().expect("a Vec takes everything")
}

fn records(c: &mut Criterion) {
    let records = room(&mut Random(1), TRIANGLES);
    let mut group = c.benchmark_group("records");
    group.sample_size(20);
    for (name, text) in [("six_decimals", six_decimals(&records)), ("shortest", shortest(&records))]
    {
        group.throughput(Throughput::Bytes(text.len() as u64));
        group.bench_function(format!("read/{name}"), |b| {
            b.iter(|| assert_eq!(read(black_box(&text)), TRIANGLES));
        });
        group.bench_function(format!("split_and_parse/{name}"), |b| {
            b.iter(|| split_and_parse(black_box(&text)));
        });
    }
    group.throughput(Throughput::Bytes(shortest(&records).len() as u64));
    group.bench_function("write/shortest", |b| b.iter(|| shortest(black_box(&records)).len()));
    group.finish();
}

/// Files of ever more bytes: what starting costs, and that nothing grows faster than the file.
fn bytes(c: &mut Criterion) {
    for direction in ["read", "write"] {
        let mut group = c.benchmark_group(format!("bytes/{direction}"));
        for triangles in [10, 100, 1000, 10_000, 100_000] {
            let records = room(&mut Random(3), triangles);
            let text = shortest(&records);
            group.throughput(Throughput::Bytes(text.len() as u64));
            group.bench_function(BenchmarkId::from_parameter(text.len()), |b| match direction {
                "read" => b.iter(|| read(black_box(&text))),
                _ => b.iter(|| shortest(black_box(&records)).len()),
            });
        }
    }
}

/// How many records a text holds.
fn read(text: &[u8]) -> usize {
    let mut count = 0;
    for record in Reader::new(text) {
        black_box(record.expect("the text is valid"));
        count += 1;
    }
    count
}

/// What std alone offers for a text already in memory: no records, no checks, no places.
fn split_and_parse(text: &[u8]) -> f64 {
    let text = std::str::from_utf8(text).expect("the text is ASCII");
    text.split_ascii_whitespace().filter_map(|word| word.parse::<f64>().ok()).sum()
}

criterion_group!(benches, float_text, digits, records, bytes);
criterion_main!(benches);
