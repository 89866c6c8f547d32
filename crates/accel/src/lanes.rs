//! What a kernel is written over: numbers side by side, whatever the machine.
//!
//! A kernel is code over the traits [`Simd`] and [`Lanes`]; `simd.rs` compiles it for every width
//! and has the types of the wide machines. Here are those that every machine has.
//!
//! Everything is `#[inline(always)]`, in the kernels too, because only code that is inlined into a
//! function for a wider machine is compiled for it. Closures are not, so loops over wide types are
//! written out.

use glam::{DVec3, Vec4};

use crate::Target;

/// Code to be compiled for every width.
pub(crate) trait Kernel {
    type Output;

    /// Does the work; to be marked `#[inline(always)]`.
    fn run<S: Simd>(self, simd: S) -> Self::Output;
}

/// The types of one width. A value is the token that lets them be used.
pub(crate) trait Simd: Copy {
    type F8: Lanes<Token = Self>;
    type F16: Lanes<Token = Self>;

    /// Narrows (p − centre) · scale for the points of sixteen targets, by axis, and says for which of
    /// them it is within ± limit along every axis, one bit each; not where a coordinate is NaN.
    fn narrow(
        self,
        targets: &[Target; 16],
        centre: DVec3,
        scale: f64,
        limit: DVec3,
    ) -> ([Self::F16; 3], u32);
}

/// `COUNT` numbers treated alike. Comparisons answer with one bit per lane, the first lane lowest.
pub(crate) trait Lanes: Copy {
    const COUNT: usize;
    type Token: Copy;

    fn splat(token: Self::Token, x: f32) -> Self;
    /// Reads the first `COUNT` numbers.
    fn load(token: Self::Token, from: &[f32]) -> Self;
    /// Writes the first `COUNT` numbers.
    fn store(self, to: &mut [f32]);
    fn sub(self, other: Self) -> Self;
    fn mul(self, other: Self) -> Self;
    fn div(self, other: Self) -> Self;
    /// `self * factor + term`, rounded once or twice: an error bound allows for two roundings.
    fn mul_add(self, factor: Self, term: Self) -> Self;
    fn abs(self) -> Self;
    /// The size of `self` with the sign of another.
    fn copysign(self, sign: Self) -> Self;
    /// The lesser; either if one is NaN.
    fn min(self, other: Self) -> Self;
    /// The greater; either if one is NaN.
    fn max(self, other: Self) -> Self;
    /// The lesser if it is above 0, else a number below 0 or a zero: as [`Self::min`] for who asks
    /// no more, and quicker, because bit patterns are compared. Not for NaN.
    fn min_above_0(self, other: Self) -> Self;
    /// The greater if it is not negative, else a negative number; see [`Self::min_above_0`].
    fn max_above_0(self, other: Self) -> Self;
    /// Where `self <= other` for what is not negative in `self`, save that +0 is above −0; see
    /// [`Self::min_above_0`].
    fn le_above_0(self, other: Self) -> u32;
    /// Negative where either is; nothing else is promised of the sum of the two.
    fn either_negative(self, other: Self) -> Self;
    /// Where the sign is a minus.
    fn negative(self) -> u32;
    /// Where `self <= other`; not where one is NaN.
    fn le(self, other: Self) -> u32;
    /// Where `self < other`; not where one is NaN.
    fn lt(self, other: Self) -> u32;
    /// The least of all lanes, none of which is NaN.
    fn least(self) -> f32;
    /// The greatest of all lanes, none of which is NaN.
    fn greatest(self) -> f32;
}

/// What every machine has.
#[derive(Clone, Copy)]
pub(crate) struct Four;

impl Simd for Four {
    type F8 = Pair<Vec4>;
    type F16 = Pair<Pair<Vec4>>;

    #[inline(always)]
    fn narrow(
        self,
        targets: &[Target; 16],
        centre: DVec3,
        scale: f64,
        limit: DVec3,
    ) -> ([Self::F16; 3], u32) {
        let (mut rows, mut inside) = ([[0.0; 16]; 3], 0);
        for (i, target) in targets.iter().enumerate() {
            let local = (target.point - centre) * scale;
            inside |= u32::from(local.abs().cmple(limit).all()) << i;
            for axis in 0..3 {
                rows[axis][i] = local[axis] as f32;
            }
        }
        (rows.map(|row| Self::F16::load(self, &row)), inside)
    }
}

/// glam chooses SSE2, NEON or plain code when it is compiled.
impl Lanes for Vec4 {
    const COUNT: usize = 4;
    type Token = Four;

    #[inline(always)]
    fn splat(_: Four, x: f32) -> Self {
        Self::splat(x)
    }
    #[inline(always)]
    fn load(_: Four, from: &[f32]) -> Self {
        Self::from_slice(from)
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.write_to_slice(to);
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self - other
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self * other
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self / other
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        self * factor + term // a fused product is a function call where it is not an instruction
    }
    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.copysign(sign)
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.min(other)
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.max(other)
    }
    #[inline(always)]
    fn min_above_0(self, other: Self) -> Self {
        self.min(other)
    }
    #[inline(always)]
    fn max_above_0(self, other: Self) -> Self {
        self.max(other)
    }
    #[inline(always)]
    fn le_above_0(self, other: Self) -> u32 {
        self.cmple(other).bitmask()
    }
    #[inline(always)]
    fn either_negative(self, other: Self) -> Self {
        self.min(other)
    }
    #[inline(always)]
    fn negative(self) -> u32 {
        self.is_negative_bitmask()
    }
    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        self.cmple(other).bitmask()
    }
    #[inline(always)]
    fn lt(self, other: Self) -> u32 {
        self.cmplt(other).bitmask()
    }
    #[inline(always)]
    fn least(self) -> f32 {
        self.min_element()
    }
    #[inline(always)]
    fn greatest(self) -> f32 {
        self.max_element()
    }
}

/// Twice as many lanes as the machine treats at once.
#[derive(Clone, Copy)]
pub(crate) struct Pair<L>(pub(crate) L, pub(crate) L);

impl<L: Lanes> Lanes for Pair<L> {
    const COUNT: usize = 2 * L::COUNT;
    type Token = L::Token;

    #[inline(always)]
    fn splat(token: L::Token, x: f32) -> Self {
        Self(L::splat(token, x), L::splat(token, x))
    }
    #[inline(always)]
    fn load(token: L::Token, from: &[f32]) -> Self {
        Self(L::load(token, from), L::load(token, &from[L::COUNT..]))
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        self.0.store(to);
        self.1.store(&mut to[L::COUNT..]);
    }
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self(self.0.sub(other.0), self.1.sub(other.1))
    }
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        Self(self.0.mul(other.0), self.1.mul(other.1))
    }
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        Self(self.0.div(other.0), self.1.div(other.1))
    }
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        Self(self.0.mul_add(factor.0, term.0), self.1.mul_add(factor.1, term.1))
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0), self.1.copysign(sign.1))
    }
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self(self.0.min(other.0), self.1.min(other.1))
    }
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self(self.0.max(other.0), self.1.max(other.1))
    }
    #[inline(always)]
    fn min_above_0(self, other: Self) -> Self {
        Self(self.0.min_above_0(other.0), self.1.min_above_0(other.1))
    }
    #[inline(always)]
    fn max_above_0(self, other: Self) -> Self {
        Self(self.0.max_above_0(other.0), self.1.max_above_0(other.1))
    }
    #[inline(always)]
    fn le_above_0(self, other: Self) -> u32 {
        self.0.le_above_0(other.0) | self.1.le_above_0(other.1) << L::COUNT
    }
    #[inline(always)]
    fn either_negative(self, other: Self) -> Self {
        Self(self.0.either_negative(other.0), self.1.either_negative(other.1))
    }
    #[inline(always)]
    fn negative(self) -> u32 {
        self.0.negative() | self.1.negative() << L::COUNT
    }
    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        self.0.le(other.0) | self.1.le(other.1) << L::COUNT
    }
    #[inline(always)]
    fn lt(self, other: Self) -> u32 {
        self.0.lt(other.0) | self.1.lt(other.1) << L::COUNT
    }
    #[inline(always)]
    fn least(self) -> f32 {
        self.0.min(self.1).least()
    }
    #[inline(always)]
    fn greatest(self) -> f32 {
        self.0.max(self.1).greatest()
    }
}
