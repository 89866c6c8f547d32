//! The numbers that a surface can have. What is none of them is refused where it is read.

/// How far above 1 a stated reflectance may lie and still stand for 1: a number that was
/// narrowed to f32, or printed with seven digits, is off by less.
pub(crate) const ROUNDING: f64 = 1e-6;

/// Whether a channel may be stated as a share of the arriving light.
#[cfg(any(feature = "obj", feature = "gltf"))]
pub(crate) fn is_reflectance(channel: f64) -> bool {
    (0.0..=1.0 + ROUNDING).contains(&channel)
}

/// Whether a channel may be stated as emittance.
#[cfg(any(feature = "obj", feature = "gltf"))]
pub(crate) fn is_emittance(channel: f64) -> bool {
    channel >= 0.0 && channel.is_finite()
}

#[cfg(all(test, any(feature = "obj", feature = "gltf")))]
mod tests {
    use super::*;

    #[test]
    fn the_ends_belong_to_the_ranges() {
        let next_f32 = f64::from(1.0_f32.next_up());
        for sound in [0.0, -0.0, 1e-320, 0.5, 1.0, next_f32, 1.000_001] {
            assert!(is_reflectance(sound), "{sound}");
        }
        for wrong in [-1e-320, -0.1, 1.000_001_1, 1.2, f64::INFINITY, f64::NAN] {
            assert!(!is_reflectance(wrong), "{wrong}");
        }
        for sound in [0.0, -0.0, 1e-320, f64::MAX] {
            assert!(is_emittance(sound), "{sound}");
        }
        for wrong in [-1e-320, -1.0, f64::INFINITY, f64::NEG_INFINITY, f64::NAN] {
            assert!(!is_emittance(wrong), "{wrong}");
        }
    }
}
