//! Textures, and their mean over a triangle's footprint.

use std::io::Cursor;

use image::{ImageReader, Limits};
use scene::Rgb;

use crate::units::Decoding;

/// Most texels that all textures of a scene may have together: 400 MB of RGB.
const MAX_TEXELS: u64 = 1 << 27;

/// Texels any scene may have, besides those that its bytes justify: a picture of 1024 × 1024.
const FREE_TEXELS: u64 = 1 << 20;

/// Texels that a byte of the scene justifies. The fullest PNG has a byte for 1032 of its own
/// (deflate), and so of one colour a byte for some 350 texels of RGB; JPEG and pictures with
/// something on them have far less. More would be header without a picture.
const TEXELS_PER_BYTE: u64 = 1 << 10;

/// Memory a decoder may use for one image, several times its RGB bytes for 16-bit RGBA.
const MAX_DECODER_BYTES: u64 = 1 << 30;

/// Samples per texel along the longest edge of a footprint: two make the grid fall evenly
/// on texels that the edges are aligned with.
const SAMPLES_PER_TEXEL: f64 = 2.0;

/// Fewest and most samples along an edge.
const EDGE_SAMPLES: (u32, u32) = (8, 512);

/// Samples that one mesh may cost in all; 2²⁸ take 7 s on one core (half a million
/// triangles with footprints of 10⁶ texels). It bounds what a file can ask for.
const MAX_SAMPLES: u64 = 1 << 28;

/// An image of 8-bit RGB texels, the first row on top.
pub(crate) struct Texture {
    width: i64,
    height: i64,
    /// Three bytes each.
    texels: Vec<u8>,
}

/// What lies outside the unit square of texture coordinates.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(not(any(feature = "gltf", test)), expect(dead_code, reason = "OBJ only repeats"))]
pub(crate) enum Wrap {
    /// The image again.
    Repeat,
    /// The image again, every other one mirrored.
    Mirror,
    /// The texels of the border.
    Clamp,
}

/// How many texels the images of a scene have so far.
pub(crate) struct TexelBudget(u64);

impl TexelBudget {
    /// None so far.
    pub(crate) fn new() -> Self {
        Self(0)
    }

    /// Adds the texels of an image to a scene of which `behind` bytes were read so far.
    fn take(&mut self, texels: u64, behind: usize) -> Result<(), String> {
        let justified = TEXELS_PER_BYTE.saturating_mul(behind as u64).saturating_add(FREE_TEXELS);
        self.0 = self.0.saturating_add(texels);
        if self.0 > MAX_TEXELS {
            Err(format!("all textures together have more than {MAX_TEXELS} texels"))
        } else if self.0 > justified {
            Err("it has more texels than the size of its file can justify".to_owned())
        } else {
            Ok(())
        }
    }
}

impl Texture {
    /// Decodes a PNG or JPEG; the error is half a sentence. Alpha is dropped, and 16-bit
    /// channels are rounded to 8. Of the scene `behind` bytes were read so far, this image's
    /// included.
    pub(crate) fn decode(
        bytes: &[u8],
        behind: usize,
        budget: &mut TexelBudget,
    ) -> Result<Self, String> {
        let reader = || {
            let mut reader = ImageReader::new(Cursor::new(bytes)).with_guessed_format()?;
            let mut limits = Limits::default();
            limits.max_alloc = Some(MAX_DECODER_BYTES);
            reader.limits(limits);
            Ok::<_, std::io::Error>(reader)
        };
        let failed = |cause: image::ImageError| cause.to_string();
        let (width, height) =
            reader().map_err(|cause| cause.to_string())?.into_dimensions().map_err(failed)?;
        budget.take(u64::from(width) * u64::from(height), behind)?;
        let image =
            reader().map_err(|cause| cause.to_string())?.decode().map_err(failed)?.into_rgb8();
        if image.is_empty() {
            return Err("it has no texels".to_owned());
        }
        let (width, height) = (i64::from(width), i64::from(height));
        Ok(Self { width, height, texels: image.into_raw() })
    }

    /// The linear colour of the texel at `uv`, v counted downwards from the top.
    pub(crate) fn at(&self, [u, v]: [f64; 2], wrap: [Wrap; 2], decoding: &Decoding) -> Rgb {
        let x = wrap[0].texel(u, self.width);
        let y = wrap[1].texel(v, self.height);
        let at = 3 * (y * self.width + x) as usize;
        decoding.decode([self.texels[at], self.texels[at + 1], self.texels[at + 2]])
    }

    /// The longest edge of a footprint, in texels.
    pub(crate) fn extent(&self, footprint: [[f64; 2]; 3]) -> f64 {
        let edge = |[au, av]: [f64; 2], [bu, bv]: [f64; 2]| {
            ((bu - au) * self.width as f64).hypot((bv - av) * self.height as f64)
        };
        let [a, b, c] = footprint;
        edge(a, b).max(edge(b, c)).max(edge(c, a))
    }
}

impl Wrap {
    /// The texel index at a coordinate. The conversion saturates and turns NaN into 0, so
    /// every coordinate finds a texel.
    fn texel(self, coordinate: f64, count: i64) -> i64 {
        let index = (coordinate * count as f64).floor() as i64;
        match self {
            Self::Repeat => index.rem_euclid(count),
            Self::Clamp => index.clamp(0, count - 1),
            Self::Mirror => {
                let folded = index.rem_euclid(2 * count);
                if folded < count { folded } else { 2 * count - 1 - folded }
            }
        }
    }
}

/// A regular grid over triangles, fine enough for a footprint of a given extent.
#[derive(Clone, Copy)]
pub(crate) struct SampleGrid {
    most: u32,
}

impl SampleGrid {
    /// The grid for a mesh of this many triangles.
    pub(crate) fn for_triangles(count: usize) -> Self {
        let fair = (MAX_SAMPLES / count.max(1) as u64).isqrt();
        let (least, most) = EDGE_SAMPLES;
        Self { most: u32::try_from(fair).unwrap_or(most).clamp(least, most) }
    }

    /// The mean of `value` over a triangle whose footprint is `extent` texels wide: at the
    /// centroids of n² equal parts, given as barycentric coordinates.
    pub(crate) fn mean(self, extent: f64, mut value: impl FnMut([f64; 3]) -> Rgb) -> Rgb {
        // A NaN extent comes out as 0, and so as the coarsest grid.
        let n = ((SAMPLES_PER_TEXEL * extent).ceil() as u32).clamp(EDGE_SAMPLES.0, self.most);
        let scale = 1.0 / f64::from(3 * n);
        let mut sum = Rgb::ZERO;
        for row in 0..n {
            for column in 0..n - row {
                // The centroid of the part at (row, column) is a third into it; that of its
                // upside-down neighbour two thirds.
                for third in 1..=if column + 1 < n - row { 2 } else { 1 } {
                    let (b, c) = (f64::from(3 * column + third), f64::from(3 * row + third));
                    let [b, c] = [b * scale, c * scale];
                    sum += value([1.0 - b - c, b, c]);
                }
            }
        }
        sum / (f64::from(n) * f64::from(n))
    }
}

/// The point with barycentric coordinates `at` among three texture coordinates.
pub(crate) fn interpolate(at: [f64; 3], [a, b, c]: [[f64; 2]; 3]) -> [f64; 2] {
    [0, 1].map(|k| at[0] * a[k] + at[1] * b[k] + at[2] * c[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn checker() -> Texture {
        let (white, black) = ([255; 3], [0; 3]);
        Texture { width: 2, height: 2, texels: [white, black, black, white].concat() }
    }

    fn mean(texture: &Texture, footprint: [[f64; 2]; 3], wrap: Wrap) -> f64 {
        let decoding = Decoding::srgb();
        let at = |bary| texture.at(interpolate(bary, footprint), [wrap; 2], &decoding);
        SampleGrid::for_triangles(1).mean(texture.extent(footprint), at).0[0]
    }

    #[test]
    fn wraps_follow_their_definitions() {
        let texels =
            |wrap: Wrap| [-3, -2, -1, 0, 1, 2, 3, 4].map(|i| wrap.texel(i as f64 / 2.0 + 0.1, 2));
        assert_eq!(texels(Wrap::Repeat), [1, 0, 1, 0, 1, 0, 1, 0]);
        assert_eq!(texels(Wrap::Mirror), [1, 1, 0, 0, 1, 1, 0, 0]);
        assert_eq!(texels(Wrap::Clamp), [0, 0, 0, 0, 1, 1, 1, 1]);
        for hostile in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300] {
            for wrap in [Wrap::Repeat, Wrap::Mirror, Wrap::Clamp] {
                assert!((0..3).contains(&wrap.texel(hostile, 3)));
            }
        }
    }

    #[test]
    fn the_grid_covers_each_part_once() {
        // The mean of a linear function is its value at the centroid, for every n.
        for extent in [0.0, 3.2, 7.0, 100.0, f64::NAN, f64::INFINITY] {
            let mut count = 0;
            let mean = SampleGrid { most: 64 }.mean(extent, |[a, b, c]| {
                count += 1;
                assert!(a > 0.0 && b > 0.0 && c > 0.0);
                Rgb::new(a, 2.0 * b, 3.0 * c)
            });
            assert_eq!(f64::from(count).sqrt().fract(), 0.0);
            for (channel, expected) in mean.0.into_iter().zip([1.0 / 3.0, 2.0 / 3.0, 1.0]) {
                assert!((channel - expected).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_checker_averages_by_area() {
        let checker = checker();
        // Half the square holds half of two white texels and all of one black: 1/2. Half of
        // it the other way round: two halves of black and one white, again 1/2.
        let lower = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]];
        let across = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        assert!((mean(&checker, lower, Wrap::Repeat) - 0.5).abs() < 1e-12);
        // Along the other diagonal: of area 1/2, white has 1/4 (one texel) and black two
        // halves of 1/8 each, so white is 1/2 as well; within the white texel alone it is 1.
        assert!((mean(&checker, across, Wrap::Repeat) - 0.5).abs() < 1e-12);
        let inside = across.map(|uv| uv.map(|c| 0.45 * c));
        assert!((mean(&checker, inside, Wrap::Repeat) - 1.0).abs() < 1e-12);
        // Texel 3 along the row is texel 1 repeated, texel 0 mirrored, texel 1 clamped.
        let shifted = inside.map(|[u, v]| [u + 1.5, v]);
        assert!(mean(&checker, shifted, Wrap::Repeat).abs() < 1e-12);
        assert!(mean(&checker, shifted, Wrap::Clamp).abs() < 1e-12);
        assert!((mean(&checker, shifted, Wrap::Mirror) - 1.0).abs() < 1e-12);
    }

    #[test]
    fn many_triangles_share_the_samples() {
        assert_eq!(SampleGrid::for_triangles(0).most, 512);
        assert_eq!(SampleGrid::for_triangles(1 << 20).most, 16);
        assert_eq!(SampleGrid::for_triangles(usize::MAX).most, 8);
    }
}
