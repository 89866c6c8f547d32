//! A diverging map: blue for too dark, red for too bright, nearly white for no difference.

use crate::picture::Picture;
use crate::tone::{BACKGROUND, srgb_byte};

/// The ends and the middle, sRGB.
///
/// # References
/// Moreland (2009), the cool to warm map: its ends and its middle.
const DARK: [f64; 3] = [59.0, 76.0, 192.0];
const SAME: [f64; 3] = [221.0, 221.0, 221.0];
const BRIGHT: [f64; 3] = [180.0, 4.0, 38.0];

/// What has no difference: lamps, and rows that are ambiguous. Darker than any colour near no difference.
const UNKNOWN: f64 = 128.0;

/// The colour of a difference as a share of the range; beyond that, an end.
pub(super) fn colour(share: f64) -> [f64; 3] {
    let share = share.clamp(-1.0, 1.0);
    let end = if share < 0.0 { DARK } else { BRIGHT };
    [0, 1, 2].map(|c| SAME[c] + (end[c] - SAME[c]) * share.abs())
}

/// A picture of differences, red, and of where they are known, green, as sRGB bytes.
pub(super) fn shown(picture: &Picture, range: f64) -> Vec<u8> {
    let nothing = f64::from(srgb_byte(BACKGROUND));
    let pixel = |pixel: &crate::picture::Pixel| {
        let covered = f64::from(pixel.surface.share + pixel.lamp.share);
        let [sum, known, _] = pixel.light().0;
        let found = if known > 0.0 { colour(sum / known / range) } else { [UNKNOWN; 3] };
        found.map(|c| {
            let mixed = known * c + (covered - known) * UNKNOWN + (1.0 - covered) * nothing;
            mixed.round() as u8
        })
    };
    picture.pixels().iter().flat_map(pixel).collect()
}
