//! Powers of two that bring light to about 1, so that no product of it over- or underflows.

/// The power of two at or below a positive finite number; 0 for 0.
pub(super) fn exponent(x: f64) -> i32 {
    const FRACTION_BITS: u32 = 52;
    const BIAS: i32 = 1023;
    if x == 0.0 {
        return 0;
    }
    let biased = (x.to_bits() >> FRACTION_BITS) as i32 & 0x7ff;
    if biased == 0 {
        // A subnormal number has lost the bits of its exponent: they come back times 2^52.
        return exponent(x * 2f64.powi(FRACTION_BITS as i32)) - FRACTION_BITS as i32;
    }
    biased - BIAS
}

/// x·2^power, in halves, because the power itself may be out of range.
pub(super) fn scaled(x: f64, power: i32) -> f64 {
    let half = power / 2;
    x * 2f64.powi(half) * 2f64.powi(power - half)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_positive_number_is_brought_to_between_1_and_2() {
        for x in [1.0, 1.999, 0.75, 1e300, f64::MAX, 1e-300, f64::MIN_POSITIVE, 5e-324, 1e-310] {
            let near_one = scaled(x, -exponent(x));
            assert!((1.0..2.0).contains(&near_one), "{x}: {near_one}");
            assert_eq!(scaled(near_one, exponent(x)), x);
        }
        assert_eq!(exponent(0.0), 0);
    }
}
