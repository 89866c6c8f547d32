//! The reader's numbers against `str::parse` and, for ties, against their closed form.

use std::fmt::Write as _;

use crate::support::{Random, read};

/// Reads every text as a coordinate and compares it, bit for bit, with the value beside it.
fn check_all(cases: &[(String, f64)]) {
    let mut text = String::new();
    for nine in cases.chunks(9) {
        text.push_str("Triangle 0 0 0 0 0 0");
        let padding = std::iter::repeat_n("0", 9 - nine.len());
        for word in nine.iter().map(|(word, _)| word.as_str()).chain(padding) {
            write!(text, "\n{word}").unwrap();
        }
        text.push('\n');
    }
    let (records, error) = read(text.as_bytes());
    assert!(error.is_none(), "{}", error.unwrap());
    let values = records.iter().flat_map(|record| record.vertices.as_flattened());
    let mut count = 0;
    for (value, (word, expected)) in values.zip(cases) {
        assert_eq!(value.to_bits(), expected.to_bits(), "{word}: {value:?} != {expected:?}");
        count += 1;
    }
    assert_eq!(count, cases.len());
}

/// Adds a case whose answer is that of `str::parse`, unless it overflows.
fn push(cases: &mut Vec<(String, f64)>, word: String) {
    let value: f64 = word.parse().unwrap();
    if value.is_finite() {
        cases.push((word, value));
    }
}

#[test]
fn a_million_decimals_are_read_as_std_reads_them() {
    let mut random = Random(0x5eed);
    let mut cases = Vec::new();
    while cases.len() < 1_000_000 {
        let sign = ["", "-", "+"][random.below(3) as usize];
        let digits = match random.below(4) {
            // One to twenty digits, leading zeros included.
            0 | 1 => {
                let count = 1 + random.below(20) as usize;
                (0..count).map(|_| char::from(b'0' + random.below(10) as u8)).collect()
            }
            // Around the end of the exact integers, 2^53, and of the u64.
            2 => {
                let end = if random.below(2) == 0 { 1_u128 << 53 } else { 1 << 64 };
                (end - 500 + u128::from(random.below(1000))).to_string()
            }
            // Many zeros, before or after.
            _ => {
                let zeros = "0".repeat(random.below(30) as usize);
                let number = random.below(100_000);
                if random.below(2) == 0 {
                    format!("{zeros}{number}")
                } else {
                    format!("{number}{zeros}")
                }
            }
        };
        // The point anywhere, at both ends included, or nowhere.
        let mut word = digits.clone();
        let point = random.below(digits.len() as u64 + 2) as usize;
        if point <= digits.len() {
            word.insert(point, '.');
        }
        let exponent = match random.below(6) {
            0 => format!("e{}", random.below(40) as i64 - 20),
            1 => format!("E{:+}", random.below(700) as i64 - 350),
            _ => String::new(),
        };
        push(&mut cases, format!("{sign}{word}{exponent}"));
    }
    check_all(&cases);
}

#[test]
fn shortest_and_full_texts_of_any_f64_are_read_back() {
    let mut random = Random(7);
    let mut cases = Vec::new();
    for _ in 0..20_000 {
        let value = random.finite();
        cases.push((format!("{value:e}"), value));
        cases.push((format!("{value:.17e}"), value));
        // Up to 1077 bytes: the whole expansion.
        if cases.len() % 16 == 0 {
            cases.push((format!("{value}"), value));
            cases.push((format!("{value:.1074}"), value));
        }
    }
    check_all(&cases);
}

/// (2n + 1) / 2 · 2^(1-k) lies halfway between two neighbours, and its decimal, (2n + 1) · 5^k
/// with k decimals, fits a `u128` for these k. It rounds to the even neighbour, and one unit more
/// or less far behind decides otherwise.
#[test]
fn ties_round_to_even() {
    let mut random = Random(11);
    let mut cases = Vec::new();
    for _ in 0..20_000 {
        let k = 1 + random.below(30) as u32;
        let lower = (1 << 52) + random.below(1 << 52);
        let tie = u128::from(2 * lower + 1) * 5_u128.pow(k);
        let even = lower + lower % 2;
        let scale = 2.0_f64.powi(1 - k as i32);
        let decimal = |number: u128| {
            let digits = format!("{number:0>width$}", width = k as usize + 1);
            let (whole, decimals) = digits.split_at(digits.len() - k as usize);
            format!("{whole}.{decimals}")
        };
        let value = |integer: u64| integer as f64 * scale;
        cases.push((decimal(tie), value(even)));
        cases.push((format!("{}0000000000000000001", decimal(tie)), value(lower + 1)));
        cases.push((format!("{}9999999999999999999", decimal(tie - 1)), value(lower)));
    }
    check_all(&cases);
}

#[test]
fn edges_of_the_range() {
    let cases: Vec<(String, f64)> = [
        ("1.7976931348623157e308", f64::MAX),
        ("-1.7976931348623157e308", f64::MIN),
        ("2.2250738585072014e-308", f64::MIN_POSITIVE),
        ("2.2250738585072011e-308", f64::from_bits(0x000f_ffff_ffff_ffff)),
        ("4.9e-324", f64::from_bits(1)),
        ("5e-324", f64::from_bits(1)),
        ("2.4e-324", 0.0),
        ("-1e-999", -0.0),
        ("-0", -0.0),
        ("-0.000", -0.0),
        ("+0", 0.0),
        ("9007199254740992", 9_007_199_254_740_992.0),
        ("9007199254740993", 9_007_199_254_740_992.0),
        ("900719925474099.3", 900_719_925_474_099.2),
        ("18446744073709551616", 18_446_744_073_709_551_616.0),
        ("0.0000000000000000001", 1e-19),
        ("0.00000000000000000000001", 1e-23),
    ]
    .map(|(word, value)| (word.to_owned(), value))
    .into();
    check_all(&cases);
}
