//! From exitance to what a screen shows: one scale, one shoulder, the sRGB transfer.

use scene::{Rgb, Scene, Solution};

use crate::{Error, ErrorKind};

/// The share of the lit, non-emitting area that [`Exposure::Auto`] puts below
/// [`AUTO_LEVEL`].
pub const AUTO_PERCENTILE: f64 = 0.9;
/// The display light that the percentile is brought to, 1 = full white.
pub const AUTO_LEVEL: f64 = 0.7;
/// The display light up to which [`curve`] changes nothing.
pub const KNEE: f64 = 0.8;
/// The display light of a pixel that shows nothing: a neutral dark grey, sRGB 48 of 255.
pub const BACKGROUND: f64 = 0.03;
/// More stops than this leave the range in which scaled light means anything.
const MAX_STOPS: f64 = 64.0;

/// How exitance is scaled to display light, in which 1 is full white.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Exposure {
    /// The [`AUTO_PERCENTILE`] of what does not emit, by its largest channel and weighed
    /// by area (of the picture, or of the elements where there is none), comes to
    /// [`AUTO_LEVEL`].
    #[default]
    Auto,
    /// So many times twice as bright as [`Auto`](Self::Auto); within ±64.
    Stops(f64),
    /// Display light = this number × exitance; finite and above 0.
    Scale(f64),
}

impl Exposure {
    pub(crate) fn check(self) -> Result<(), Error> {
        let (good, range) = match self {
            Self::Auto => (true, ""),
            Self::Stops(s) => (s.abs() <= MAX_STOPS, "an exposure within 64 stops of automatic"),
            Self::Scale(k) => (k.is_finite() && k > 0.0, "an exposure scale that is above 0"),
        };
        if good { Ok(()) } else { Err(Error::new(ErrorKind::Option(range))) }
    }

    /// The scale, given what an automatic exposure would meter.
    pub(crate) fn scale(self, metered: impl FnOnce() -> Vec<Reading>) -> f64 {
        match self {
            Self::Auto => automatic(metered()),
            Self::Stops(stops) => automatic(metered()) * stops.exp2(),
            Self::Scale(scale) => scale,
        }
    }

    /// The scale for colours of vertices, metered by the area of the elements.
    #[must_use]
    pub fn scale_for(self, scene: &Scene, solution: &Solution) -> f64 {
        self.scale(|| {
            let reading = |e: &scene::SolutionElement| Reading {
                light: e.exitance.max_channel(),
                weight: solution.area(e),
                emits: scene.material_of(e.triangle).emits(),
            };
            solution.elements.iter().map(reading).collect()
        })
    }
}

/// A piece of what an automatic exposure looks at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Reading {
    /// Largest channel of its exitance.
    pub(crate) light: f64,
    /// Its area, in any unit.
    pub(crate) weight: f64,
    /// Emitters count only where nothing else is lit.
    pub(crate) emits: bool,
}

fn automatic(mut readings: Vec<Reading>) -> f64 {
    readings.retain(|r| r.light > 0.0 && r.weight > 0.0);
    if readings.iter().any(|r| !r.emits) {
        readings.retain(|r| !r.emits);
    }
    readings.sort_unstable_by(|a, b| a.light.total_cmp(&b.light));
    let total: f64 = readings.iter().map(|r| r.weight).sum();
    let mut below = 0.0;
    let found = readings.iter().find(|r| {
        below += r.weight;
        below >= AUTO_PERCENTILE * total
    });
    // A dark scene stays dark at any scale.
    found.map_or(1.0, |r| AUTO_LEVEL / r.light)
}

/// Bends display light above [`KNEE`] into the room left below 1: continuous with its
/// slope, and never quite white.
///
/// # References
/// The shoulder is x/(1+x) of Reinhard, Stark, Shirley & Ferwerda (2002), eq. 3, moved
/// to the knee.
#[must_use]
pub fn curve(light: f64) -> f64 {
    if light <= KNEE {
        return light.max(0.0);
    }
    let room = 1.0 - KNEE;
    let over = (light - KNEE) / room;
    // Written so that infinite light gives 1 and not NaN.
    1.0 - room / (1.0 + over)
}

/// The sRGB transfer of display light in [0, 1].
///
/// # References
/// IEC 61966-2-1:1999.
#[must_use]
pub fn srgb(light: f64) -> f64 {
    if light <= 0.003_130_8 { 12.92 * light } else { 1.055 * light.powf(1.0 / 2.4) - 0.055 }
}

/// Display light in [0, 1] as the byte that a screen expects.
#[must_use]
pub fn srgb_byte(light: f64) -> u8 {
    // A float-to-integer cast saturates, and the transfer of [0, 1] is [0, 1].
    (255.0 * srgb(light)).round() as u8
}

/// Exitance as a screen colour.
#[must_use]
pub fn screen(exitance: Rgb, scale: f64) -> [u8; 3] {
    exitance.0.map(|c| srgb_byte(curve(c * scale)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shoulder_joins_with_its_slope_and_stays_below_white() {
        let h = 1e-6;
        let slope = (curve(KNEE + h) - curve(KNEE)) / h;
        assert!((slope - 1.0).abs() < 1e-5, "{slope}");
        assert_eq!(curve(-3.0), 0.0);
        // t/(1+t) at t = 1 is a half: half of the room above the knee is used up.
        assert!((curve(1.0) - 0.9).abs() < 1e-15);
        assert_eq!(curve(f64::INFINITY), 1.0);
    }

    #[test]
    fn srgb_bytes_match_the_standard() {
        // Mid grey of 18 % is 117.6 of 255 by the standard's formula, by hand.
        assert_eq!([0.0, 0.18, 1.0].map(srgb_byte), [0, 118, 255]);
        assert_eq!(srgb_byte(BACKGROUND), 48);
    }

    #[test]
    fn automatic_meters_area_and_leaves_lamps_out() {
        let reading = |light, weight, emits| Reading { light, weight, emits };
        let dim = reading(2.0, 89.0, false);
        let bright = reading(7.0, 11.0, false);
        let lamp = reading(1e4, 1e4, true);
        assert_eq!(automatic(vec![lamp, bright, dim]), AUTO_LEVEL / 7.0);
        let few = reading(7.0, 9.0, false);
        assert_eq!(automatic(vec![few, reading(2.0, 91.0, false)]), AUTO_LEVEL / 2.0);
        assert_eq!(automatic(vec![lamp, reading(0.0, 1.0, false)]), AUTO_LEVEL / 1e4);
        assert_eq!(automatic(vec![]), 1.0);
    }
}
