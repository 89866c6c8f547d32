//! Every conversion from a file's units to the scene's, in one place.

use std::f64::consts::PI;

use scene::Rgb;

/// The .tri byte that stands for a full channel.
const TRI_FULL: u8 = u8::MAX;

/// Emittance of a .tri emitter per unit of its back colour, in display units (255 = white).
const TRI_EMITTANCE_PER_STEP: f64 = 100.0;

/// Emittance of a Lambertian emitter of the given radiance: E = πL.
///
/// # Units
/// W·m⁻²·sr⁻¹ in, W·m⁻² out.
#[cfg_attr(
    not(any(feature = "obj", feature = "gltf")),
    expect(dead_code, reason = "for OBJ and glTF")
)]
pub(crate) fn emittance_of_radiance(radiance: Rgb) -> Rgb {
    radiance * PI
}

/// Reflectance of a .tri front colour: ρ = reflect · front / 255.
pub(crate) fn tri_reflectance(front: [u8; 3], reflect: f64) -> Rgb {
    Rgb(front.map(|c| reflect * f64::from(c) / f64::from(TRI_FULL)))
}

/// Emittance of a .tri back colour, if it emits: some channel is exactly 255.
///
/// # Units
/// Display units: 255 is white.
pub(crate) fn tri_emittance(back: [u8; 3], light: f64) -> Option<Rgb> {
    back.contains(&TRI_FULL)
        .then(|| Rgb(back.map(|c| TRI_EMITTANCE_PER_STEP * f64::from(c) * light)))
}

/// The .tri front colour of a reflectance, and whether [`tri_reflectance`] turns it back
/// into a reflectance within half a step, `reflect` / 510.
pub(crate) fn tri_front(reflectance: Rgb, reflect: f64) -> ([u8; 3], bool) {
    let steps = reflectance.map(|c| (c / reflect * f64::from(TRI_FULL)).round());
    // The conversion brings what lies outside to the nearest byte.
    let front = steps.0.map(|step| step as u8);
    (front, steps.0 == front.map(f64::from))
}

/// The .tri back colour of an emittance, and whether [`tri_emittance`] turns it back into
/// an emittance within half a step, 50 · `light`.
///
/// The mark of an emitter is a channel of exactly 255. An emittance whose largest channel
/// is not there at this `light` keeps its colour and is scaled until it is.
///
/// # Units
/// Display units: 255 is white.
pub(crate) fn tri_back(emittance: Rgb, light: f64) -> ([u8; 3], bool) {
    let most = emittance.max_channel();
    // A negative emittance does not exist, so this is black.
    if most <= 0.0 {
        return ([0; 3], true);
    }
    let full = f64::from(TRI_FULL);
    let steps = emittance.map(|c| (c / (TRI_EMITTANCE_PER_STEP * light)).round());
    if steps.max_channel() == full {
        (steps.0.map(|step| step as u8), true)
    } else {
        (emittance.0.map(|c| (c / most * full).round() as u8), false)
    }
}

/// Linear values of the 256 codes of an 8-bit texture channel.
#[cfg(any(feature = "obj", feature = "gltf"))]
pub(crate) struct Decoding([f64; 256]);

#[cfg(any(feature = "obj", feature = "gltf"))]
impl Decoding {
    /// Colours, stored with the sRGB transfer function.
    ///
    /// # References
    /// IEC 61966-2-1:1999, section 5.2.
    pub(crate) fn srgb() -> Self {
        Self(std::array::from_fn(|code| {
            let encoded = code as f64 / 255.0;
            if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
        }))
    }

    /// Data such as glTF's metallic share: code / 255.
    #[cfg(feature = "gltf")]
    pub(crate) fn linear() -> Self {
        Self(std::array::from_fn(|code| code as f64 / 255.0))
    }

    /// The linear colour of a texel.
    pub(crate) fn decode(&self, texel: [u8; 3]) -> Rgb {
        Rgb(texel.map(|code| self.0[usize::from(code)]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tri_emits_only_at_exactly_255() {
        assert_eq!(tri_emittance([254, 254, 254], 1.0), None);
        assert_eq!(tri_emittance([255, 10, 0], 2.0), Some(Rgb::new(51_000.0, 2_000.0, 0.0)));
        assert_eq!(tri_reflectance([255, 51, 0], 0.5), Rgb::new(0.5, 0.1, 0.0));
    }

    #[test]
    fn tri_codes_survive_the_way_there_and_back() {
        for code in 0..=u8::MAX {
            for scale in [0.5, 1.0, 0.3, 1e-3] {
                let front = [code, 255 - code, 0];
                assert_eq!(tri_front(tri_reflectance(front, scale), scale), (front, true));
                let back = [code, 255, code / 2];
                let emittance = tri_emittance(back, scale).expect("a channel is 255");
                assert_eq!(tri_back(emittance, scale), (back, true));
            }
        }
    }

    #[test]
    fn what_tri_cannot_hold_is_told() {
        // 0.5 + half a step is 0.50098; what lies above is clamped.
        assert_eq!(tri_front(Rgb::new(0.5009, 0.2, 0.0), 0.5), ([255, 102, 0], true));
        assert_eq!(tri_front(Rgb::new(0.51, 0.2, 0.0), 0.5), ([255, 102, 0], false));
        assert_eq!(tri_front(Rgb::splat(0.2), 0.0), ([255; 3], false));
        // Half as strong, and twice: the colour stays.
        assert_eq!(tri_back(Rgb::new(12_750.0, 5_000.0, 0.0), 1.0), ([255, 100, 0], false));
        assert_eq!(tri_back(Rgb::new(51_000.0, 20_000.0, 0.0), 1.0), ([255, 100, 0], false));
        assert_eq!(tri_back(Rgb::ZERO, 1.0), ([0; 3], true));
        for light in [0.0, f64::NAN, f64::INFINITY, -1.0] {
            assert_eq!(tri_back(Rgb::splat(25_500.0), light), ([255; 3], false));
        }
        // Below the smallest normal number, and near the largest.
        assert_eq!(tri_back(Rgb::new(5e-324, 0.0, 0.0), 1.0), ([255, 0, 0], false));
        assert_eq!(tri_back(Rgb::new(1e308, 5e307, 0.0), 1.0), ([255, 128, 0], false));
    }

    #[cfg(any(feature = "obj", feature = "gltf"))]
    #[test]
    fn srgb_meets_the_published_anchors() {
        // IEC 61966-2-1: black and white are fixed, and code 188 is within half a step of
        // middle radiance: ((188/255 + .055)/1.055)^2.4 = 0.502886…
        let table = Decoding::srgb();
        let rgb = table.decode([0, 255, 188]).0;
        assert_eq!(rgb[0], 0.0);
        assert!((rgb[1] - 1.0).abs() < 1e-15);
        assert!((rgb[2] - 0.502_886_458_032_569).abs() < 1e-12, "{}", rgb[2]);
        // The straight part: code 10 is 10/255/12.92.
        assert!((table.decode([10; 3]).0[0] - 10.0 / 255.0 / 12.92).abs() < 1e-18);
    }
}
