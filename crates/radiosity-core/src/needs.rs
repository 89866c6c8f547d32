//! What a solve has to do for a scene, and what it may leave out.

use scene::Rgb;

use crate::mesh::Root;

/// What the light of a scene needs; whoever knows the scene may leave the rest out.
///
/// Leaving out what a scene does not need changes no exitance, or what
/// [`Decision::error`](crate::plan::Decision) says. Leaving out what it does need gives wrong light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Needs {
    /// Segments between surfaces, since something may block them. Without, all that face each other
    /// see each other, and the occluder is not asked.
    pub segments: bool,
    /// Directions that are followed to where light ends up, since it may leave the scene or meet
    /// backs. Without, all light that is shot arrives, and the form factors' defect is all the rest.
    pub census: bool,
    /// The channels that differ from each other.
    pub channels: Channels,
    /// Light that arrives at surfaces which reflect none of it. Without, they receive nothing and stay
    /// unsplit; the books then hold a sample of what they absorb.
    pub black: bool,
    /// Receivers one by one. Without, blocks of them are left out where planes, walls and sealed
    /// spaces show that no light comes, and lit without segments where nothing is in between.
    pub singles: bool,
    /// A second estimate of form factors on each mesh. Without, it is left to meshes that may be the last:
    /// work that is stopped on the first one of more than a thousand elements then has no statement.
    pub early_estimates: bool,
}

impl Needs {
    /// Whatever the scene.
    pub const EVERYTHING: Self = Self {
        segments: true,
        census: true,
        channels: Channels::ALL,
        black: true,
        singles: true,
        early_estimates: true,
    };
}

impl Default for Needs {
    fn default() -> Self {
        Self::EVERYTHING
    }
}

/// Which channels are computed, and what the others are of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Channels {
    /// The one that is computed; `None` for all three.
    pub only: Option<usize>,
    /// How many times the light of that one each channel has.
    pub times: [f64; 3],
}

impl Channels {
    /// All three, each for itself.
    pub const ALL: Self = Self { only: None, times: [1.0; 3] };

    /// The light of all channels, from the computed ones.
    #[inline]
    pub(crate) fn spread<const N: usize>(&self, light: [f64; N]) -> Rgb {
        if N == 3 {
            return Rgb([light[0], light[1], light[2]]);
        }
        // Not times 0: that of a negative number is −0.
        Rgb(self.times.map(|k| if k == 0.0 { 0.0 } else { light[0] * k }))
    }

    /// The computed channels.
    #[inline]
    pub(crate) fn pick<const N: usize>(&self, light: Rgb) -> [f64; N] {
        let only = self.only.unwrap_or(0);
        std::array::from_fn(|i| if N == 3 { light[i] } else { light[only] })
    }

    /// How many are computed.
    pub(crate) fn count(&self) -> usize {
        if self.only.is_some() { 1 } else { 3 }
    }
}

/// The channels in which anything emits.
pub(crate) fn lit_channels(roots: &[Root]) -> [bool; 3] {
    [0, 1, 2].map(|c| roots.iter().any(|root| root.emittance[c] > 0.0))
}

/// Which roots reflect none of the light there is.
pub(crate) fn black(roots: &[Root]) -> Vec<bool> {
    let lit = lit_channels(roots);
    roots.iter().map(|root| (0..3).all(|c| !lit[c] || root.reflectance[c] == 0.0)).collect()
}
