//! Float text: back to the same bits, as short as std's, in the promised form.

use tri_io::{FloatBuffer, write_f32, write_f64};

use crate::support::Random;

/// A prime, so that the sample meets all low bits; 2^32 / 4093 is about a million patterns.
const STRIDE: u32 = 4093;

fn check_f32(bits: u32) {
    let value = f32::from_bits(bits);
    let mut buffer = FloatBuffer::new();
    let text = write_f32(value, &mut buffer);
    let back: f32 = text.parse().unwrap();
    if value.is_nan() {
        assert_eq!(text, "NaN");
    } else {
        assert_eq!(back.to_bits(), bits, "{text}");
    }
}

fn check_digits_f32(bits: u32) {
    let value = f32::from_bits(bits);
    if value.is_finite() {
        check_digits(write_f32(value, &mut FloatBuffer::new()), &value);
    }
}

/// Compares the digits with std's, which are the shortest and of those the closest to the value.
/// Where two are equally close std takes the larger and we take the even one.
fn check_digits(text: &str, value: &impl std::fmt::LowerExp) {
    let (ours, std) = (digits(text), digits(&format!("{value:e}")));
    if ours != std {
        // 112 digits are all that an f32 has; an f64 with more than 200 is no tie.
        let exact = digits(&format!("{value:.200e}"));
        let (lower, higher) = (ours.clone().min(std.clone()), ours.clone().max(std.clone()));
        assert_eq!(exact, format!("{lower}5"), "{text} is no tie");
        let number = |digits: &str| digits.parse::<u64>().unwrap();
        assert_eq!(number(&lower) + 1, number(&higher));
        assert_eq!(number(&ours) % 2, 0, "{text} is odd");
    }
}

/// The digits without sign, point, exponent and outer zeros.
fn digits(text: &str) -> String {
    let mantissa = text.split('e').next().unwrap_or_default();
    let digits: String = mantissa.chars().filter(char::is_ascii_digit).collect();
    digits.trim_matches('0').to_owned()
}

#[test]
fn a_million_f32_come_back_with_the_digits_of_std() {
    for bits in (0..=u32::MAX).step_by(STRIDE as usize) {
        check_f32(bits);
        check_digits_f32(bits);
    }
}

#[test]
fn every_f32_near_a_power_of_two_comes_back_with_the_digits_of_std() {
    for exponent in 0..=0xff_u32 {
        for mantissa in (0..64).chain(0x7f_ffc0..=0x7f_ffff) {
            for sign in [0, 1 << 31] {
                check_f32(sign | exponent << 23 | mantissa);
                check_digits_f32(sign | exponent << 23 | mantissa);
            }
        }
    }
}

#[test]
#[ignore = "all 2^32 patterns take minutes: cargo test --release -p radiosity-tri-io -- --ignored every_f32"]
fn every_f32_comes_back() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    std::thread::scope(|scope| {
        for thread in 0..threads {
            scope.spawn(move || {
                let patterns = 1_u64 << 32;
                let own = patterns * thread / threads..patterns * (thread + 1) / threads;
                own.for_each(|bits| check_f32(bits as u32));
            });
        }
    });
}

/// The sign is one bit in front of the same digits, so the positive half stands for all.
#[test]
#[ignore = "takes minutes: cargo test --release -p radiosity-tri-io -- --ignored every_f32"]
fn every_f32_has_the_digits_of_std() {
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    std::thread::scope(|scope| {
        for thread in 0..threads {
            scope.spawn(move || {
                let patterns = 0x7f80_0000_u64;
                let own = patterns * thread / threads..patterns * (thread + 1) / threads;
                own.for_each(|bits| check_digits_f32(bits as u32));
            });
        }
    });
}

#[test]
fn f64_comes_back_with_the_digits_of_std() {
    let mut random = Random(9);
    let mut buffer = FloatBuffer::new();
    for index in 0..400_000 {
        let value = match index % 3 {
            0 => random.finite(),
            1 => (random.below(2_000_000) as f64 - 1e6) / 1000.0,
            _ => f64::from(random.finite() as f32),
        };
        let text = write_f64(value, &mut buffer);
        if value.is_finite() {
            assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{text}");
            check_digits(text, &value);
        }
    }
}

#[test]
fn form_of_f32() {
    let check = |value: f32, expected: &str| {
        assert_eq!(write_f32(value, &mut FloatBuffer::new()), expected);
    };
    check(0.0, "0");
    check(-0.0, "-0");
    check(250.0, "250");
    check(-100.0, "-100");
    check(0.5, "0.5");
    check(16_777_216.0, "16777216");
    check(999_999_900_000.0, "999999900000");
    check(1e12, "1000000000000");
    check(9_999_999_000_000.0, "9999999000000");
    check(1e13, "1e+13");
    check(1.5e20, "1.5e+20");
    check(1e-6, "0.000001");
    check(9.999_999e-7, "9.999999e-7");
    check(f32::MAX, "3.4028235e+38");
    check(f32::from_bits(1), "1e-45");
    check(f32::NAN, "NaN");
    check(-f32::NAN, "NaN");
    check(f32::INFINITY, "inf");
    check(f32::NEG_INFINITY, "-inf");
}

#[test]
fn form_of_f64() {
    let check = |value: f64, expected: &str| {
        assert_eq!(write_f64(value, &mut FloatBuffer::new()), expected);
    };
    check(-0.0, "-0");
    check(1e15, "1000000000000000");
    check(9_007_199_254_740_991.0, "9007199254740991");
    check(1e16, "1e+16");
    check(1e-5, "0.00001");
    check(9.9e-6, "9.9e-6");
    check(f64::MAX, "1.7976931348623157e+308");
    check(5e-324, "5e-324");
    check(f64::NEG_INFINITY, "-inf");
    check(f64::NAN, "NaN");
}

/// C reads the same bits as Rust; `strtof` of the C library at hand is the judge.
#[test]
fn c_reads_the_same_bits() {
    let mut buffer = FloatBuffer::new();
    for bits in (0..=u32::MAX).step_by(64 * STRIDE as usize) {
        let value = f32::from_bits(bits);
        if value.is_finite() {
            let text = std::ffi::CString::new(write_f32(value, &mut buffer)).unwrap();
            #[allow(unsafe_code)] // the C library is what is asked
            // SAFETY: the text ends in a NUL, and a null end pointer is allowed.
            let read = unsafe { strtof(text.as_ptr(), std::ptr::null_mut()) };
            assert_eq!(read.to_bits(), bits, "{text:?}");
        }
    }
}

#[allow(unsafe_code)] // libc the crate does not declare strtof
// SAFETY: this is the C standard's declaration, 7.22.1.3.
unsafe extern "C" {
    fn strtof(text: *const std::ffi::c_char, end: *mut *mut std::ffi::c_char) -> f32;
}
