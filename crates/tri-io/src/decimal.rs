//! Decimal text to the nearest `f64`, fast where the answer is exact.

/// Powers of ten, all of which an `f64` holds exactly.
const POWERS: [f64; MAX_DIGITS + 1] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18, 1e19,
];

/// More digits than this may overflow the `u64` they are gathered in, and 10^19 is the last power
/// of ten that a `u64` holds.
const MAX_DIGITS: usize = 19;

/// Reads the plain decimal that `bytes` begins with, and says how long it is.
///
/// Up to 2^53 the digits are exact in `f64`, as is the power of ten, so their quotient is rounded
/// once, which is the correct rounding (Clinger 1990, section 4); beyond, integers divide.
/// Everything else is left to [`parse`]: an exponent, many digits, no number at all, or a number
/// that the end of `bytes` may cut.
///
/// # References
/// W. D. Clinger, "How to read floating point numbers accurately", PLDI 1990.
#[inline]
pub(crate) fn fast_prefix(bytes: &[u8]) -> Option<(f64, usize)> {
    let first = *bytes.first()?;
    let sign_length = usize::from(first == b'-' || first == b'+');
    let (whole, point) = digits(bytes, sign_length, 0)?;
    let mut count = point - sign_length;
    let (mut mantissa, mut end, mut decimals) = (whole, point, 0);
    if bytes[point] == b'.' {
        (mantissa, end) = digits(bytes, point + 1, whole)?;
        decimals = end - (point + 1);
        count += decimals;
    }
    if count == 0 || count > MAX_DIGITS || !ends_word(bytes[end]) {
        return None;
    }
    let magnitude = if mantissa <= 1 << f64::MANTISSA_DIGITS {
        mantissa as f64 / POWERS[decimals]
    } else {
        divide(mantissa, 10_u64.pow(decimals as u32))
    };
    Some((if first == b'-' { -magnitude } else { magnitude }, end))
}

/// The `f64` nearest to the quotient of two integers, neither of them 0.
///
/// Both are shifted to begin with their highest bit, so the quotient has 63 or 64 bits. Its last
/// bit then only has to say whether anything follows, and the conversion rounds once. Coordinates
/// that were `f32` take this way when written in shortest form: reading them with it takes 0.7 of
/// the time of reading them with [`parse`] (example `read_rate`, 2026-11-23).
fn divide(dividend: u64, divisor: u64) -> f64 {
    let (up, down) = (dividend.leading_zeros(), divisor.leading_zeros());
    let dividend = u128::from(dividend << up) << 63;
    let divisor = u128::from(divisor << down);
    let (quotient, rest) = (dividend / divisor, dividend % divisor);
    let bits = quotient as u64 | u64::from(rest != 0);
    // 2^(down - up - 63), an exponent from -126 to 0.
    let scale = f64::from_bits(u64::from(1023 - 63 + down - up) << (f64::MANTISSA_DIGITS - 1));
    bits as f64 * scale
}

/// Reads the plain integer from 0 to 255 that `bytes` begins with, and says how long it is.
#[inline]
pub(crate) fn fast_channel(bytes: &[u8]) -> Option<(u8, usize)> {
    let (value, end) = digits(bytes, 0, 0)?;
    let whole = (1..=3).contains(&end) && ends_word(bytes[end]);
    whole.then_some((u8::try_from(value).ok()?, end))
}

/// Reads a whole word as a finite number, exactly as `str::parse` does.
pub(crate) fn parse(word: &[u8]) -> Option<f64> {
    let value: f64 = std::str::from_utf8(word).ok()?.parse().ok()?;
    value.is_finite().then_some(value)
}

/// Whether a word ends before this byte: at a blank as C's `isspace` has it, or at a comment.
#[inline]
pub(crate) fn ends_word(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t'..=b'\r' | b'#')
}

/// Appends digits from `at` on to `mantissa`; gives it and the place of the first other byte.
///
/// The sum wraps when there are too many digits; the caller counts them.
#[inline]
fn digits(bytes: &[u8], mut at: usize, mut mantissa: u64) -> Option<(u64, usize)> {
    loop {
        let digit = bytes.get(at)?.wrapping_sub(b'0');
        if digit > 9 {
            return Some((mantissa, at));
        }
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
}
