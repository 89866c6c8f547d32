//! Three colour channels in f64, with the arithmetic that light needs.

use std::ops::{Add, AddAssign, Div, Index, Mul, Sub, SubAssign};

/// Three channels, red, green, blue: linear and unclamped.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb(pub [f64; 3]);

impl Rgb {
    /// No light.
    pub const ZERO: Self = Self([0.0; 3]);

    /// One value per channel.
    #[must_use]
    pub const fn new(r: f64, g: f64, b: f64) -> Self {
        Self([r, g, b])
    }

    /// The same value in every channel.
    #[must_use]
    pub const fn splat(value: f64) -> Self {
        Self([value; 3])
    }

    /// Applies `f` to each channel.
    #[must_use]
    pub fn map(self, f: impl FnMut(f64) -> f64) -> Self {
        Self(self.0.map(f))
    }

    /// The sum of the channels: what shooters are ranked by.
    #[must_use]
    pub fn sum(self) -> f64 {
        self.0[0] + self.0[1] + self.0[2]
    }

    /// The largest channel.
    #[must_use]
    pub fn max_channel(self) -> f64 {
        self.0[0].max(self.0[1]).max(self.0[2])
    }

    /// The smallest channel.
    #[must_use]
    pub fn min_channel(self) -> f64 {
        self.0[0].min(self.0[1]).min(self.0[2])
    }

    /// Each channel's absolute value.
    #[must_use]
    pub fn abs(self) -> Self {
        self.map(f64::abs)
    }

    /// Channel by channel: what share of `whole` this is; 0 where `whole` is 0 or less.
    #[must_use]
    pub fn share_of(self, whole: Self) -> Self {
        let share = |c: usize| if whole.0[c] > 0.0 { self.0[c] / whole.0[c] } else { 0.0 };
        Self([0, 1, 2].map(share))
    }

    /// Whether every channel is a finite number.
    #[must_use]
    pub fn is_finite(self) -> bool {
        self.0.iter().all(|c| c.is_finite())
    }
}

impl From<[f64; 3]> for Rgb {
    fn from(channels: [f64; 3]) -> Self {
        Self(channels)
    }
}

impl Index<usize> for Rgb {
    type Output = f64;

    fn index(&self, channel: usize) -> &f64 {
        &self.0[channel]
    }
}

impl Add for Rgb {
    type Output = Self;

    #[inline]
    fn add(self, o: Self) -> Self {
        Self([self.0[0] + o.0[0], self.0[1] + o.0[1], self.0[2] + o.0[2]])
    }
}

impl Sub for Rgb {
    type Output = Self;

    #[inline]
    fn sub(self, o: Self) -> Self {
        Self([self.0[0] - o.0[0], self.0[1] - o.0[1], self.0[2] - o.0[2]])
    }
}

/// Channel by channel: reflectance times irradiance.
impl Mul for Rgb {
    type Output = Self;

    #[inline]
    fn mul(self, o: Self) -> Self {
        Self([self.0[0] * o.0[0], self.0[1] * o.0[1], self.0[2] * o.0[2]])
    }
}

impl Mul<f64> for Rgb {
    type Output = Self;

    #[inline]
    fn mul(self, k: f64) -> Self {
        self.map(|c| c * k)
    }
}

impl Div<f64> for Rgb {
    type Output = Self;

    #[inline]
    fn div(self, k: f64) -> Self {
        self.map(|c| c / k)
    }
}

impl AddAssign for Rgb {
    #[inline]
    fn add_assign(&mut self, o: Self) {
        *self = *self + o;
    }
}

impl SubAssign for Rgb {
    #[inline]
    fn sub_assign(&mut self, o: Self) {
        *self = *self - o;
    }
}

impl std::iter::Sum for Rgb {
    fn sum<I: Iterator<Item = Self>>(iter: I) -> Self {
        iter.fold(Self::ZERO, Add::add)
    }
}
