//! Kernels on the instructions of the machine at hand: the only file with `unsafe`.
//!
//! [`Found::run`] compiles a kernel once for every width and calls the one that was chosen when the
//! structure was built, so that a plain build is as fast as one for a given machine. The pattern is
//! that of the crate `pulp`.
//!
//! A value of a wide type can only be made with a token, and a token only by [`Found::run`] after
//! the machine was found to have the instructions. So to hold one is to be allowed to use them.

#![allow(unsafe_code, reason = "the instructions of a wider machine cannot be called otherwise")]

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::*;
use std::sync::OnceLock;

#[cfg(target_arch = "x86_64")]
use glam::{DVec3, Vec4};

#[cfg(target_arch = "x86_64")]
use crate::Target;
use crate::lanes::{Four, Kernel};
#[cfg(target_arch = "x86_64")]
use crate::lanes::{Lanes, Pair, Simd};

/// How many f32 numbers the machine treats at once. No choice changes an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Width {
    /// Four: SSE2, NEON, or plain code. Every machine has it.
    Four,
    /// Eight: AVX2 with FMA, and counts of bits (BMI1, POPCNT).
    Eight,
    /// Sixteen: AVX-512 (F, VL, BW and DQ).
    Sixteen,
}

impl Width {
    /// Every width, from the narrowest.
    pub const ALL: [Self; 3] = [Self::Four, Self::Eight, Self::Sixteen];

    /// Returns the widest that this machine has.
    pub fn widest() -> Self {
        static WIDEST: OnceLock<Width> = OnceLock::new();
        *WIDEST.get_or_init(|| {
            #[cfg(target_arch = "x86_64")]
            if is_x86_feature_detected!("avx2")
                && is_x86_feature_detected!("fma")
                && is_x86_feature_detected!("bmi1")
                && is_x86_feature_detected!("popcnt")
            {
                let wide = is_x86_feature_detected!("avx512f")
                    && is_x86_feature_detected!("avx512vl")
                    && is_x86_feature_detected!("avx512bw")
                    && is_x86_feature_detected!("avx512dq");
                return if wide { Self::Sixteen } else { Self::Eight };
            }
            Self::Four
        })
    }

    /// Returns the width in which questions are answered unless another is chosen.
    ///
    /// Sixteen lanes are no faster than eight, where both were measured (Sapphire Rapids): bringing
    /// a comparison from a mask register costs about what the wider arithmetic saves.
    pub fn fastest() -> Self {
        Self::widest().min(Self::Eight)
    }
}

/// A width that the machine was found to have.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Found(Width);

impl Found {
    /// A width, or the widest that the machine has if that is less.
    pub(crate) fn of(width: Width) -> Self {
        Self(width.min(Width::widest()))
    }

    pub(crate) fn width(self) -> Width {
        self.0
    }

    /// Runs a kernel in this width.
    #[inline]
    pub(crate) fn run<K: Kernel>(self, kernel: K) -> K::Output {
        #[cfg(target_arch = "x86_64")]
        match self.0 {
            Width::Four => {}
            // SAFETY: the machine was found to have what `run_eight` asks for.
            Width::Eight => return unsafe { run_eight(kernel) },
            // SAFETY: the machine was found to have what `run_sixteen` asks for.
            Width::Sixteen => return unsafe { run_sixteen(kernel) },
        }
        kernel.run(Four)
    }
}

/// AVX2, FMA, BMI1 and POPCNT.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
pub(crate) struct Eight(());

#[cfg(target_arch = "x86_64")]
impl Simd for Eight {
    type F8 = M256<Self>;
    type F16 = Pair<M256<Self>>;

    #[inline(always)]
    fn narrow(
        self,
        targets: &[Target; 16],
        centre: DVec3,
        scale: f64,
        limit: DVec3,
    ) -> ([Self::F16; 3], u32) {
        // SAFETY: the token shows that the instructions exist.
        let (rows, inside) = unsafe { narrow_eights(targets, centre, scale, limit) };
        (rows.map(|[lo, hi]| Pair(M256::new(lo), M256::new(hi))), inside)
    }
}

/// AVX-512.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
pub(crate) struct Sixteen(());

#[cfg(target_arch = "x86_64")]
impl Simd for Sixteen {
    type F8 = M256<Self>;
    type F16 = M512;

    #[inline(always)]
    fn narrow(
        self,
        targets: &[Target; 16],
        centre: DVec3,
        scale: f64,
        limit: DVec3,
    ) -> ([Self::F16; 3], u32) {
        // SAFETY: the token shows that the instructions exist.
        let (rows, inside) = unsafe { narrow_eights(targets, centre, scale, limit) };
        let join = |[lo, hi]: [__m256; 2]| {
            // SAFETY: the token shows that the instructions exist.
            M512(unsafe { _mm512_insertf32x8::<1>(_mm512_castps256_ps512(lo), hi) })
        };
        (rows.map(join), inside)
    }
}

/// The tokens that vouch for AVX2 and FMA.
#[cfg(target_arch = "x86_64")]
pub(crate) trait HasAvx2: Copy {}

#[cfg(target_arch = "x86_64")]
impl HasAvx2 for Eight {}

#[cfg(target_arch = "x86_64")]
impl HasAvx2 for Sixteen {}

/// Eight lanes, made with a token of either wide machine.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
pub(crate) struct M256<T>(__m256, std::marker::PhantomData<T>);

/// Sixteen lanes.
#[cfg(target_arch = "x86_64")]
#[derive(Clone, Copy)]
pub(crate) struct M512(__m512);

/// The methods that are one instruction on two registers.
#[cfg(target_arch = "x86_64")]
macro_rules! binary {
    ($make:expr; $($method:ident $instruction:ident),*) => {$(
        #[inline(always)]
        fn $method(self, other: Self) -> Self {
            // SAFETY: a value of this type exists only where the instructions do.
            $make(unsafe { $instruction(self.0, other.0) })
        }
    )*};
}

/// The methods that are one instruction on bit patterns.
#[cfg(target_arch = "x86_64")]
macro_rules! integers {
    ($make:expr, $to:ident, $back:ident; $($method:ident $instruction:ident),*) => {$(
        #[inline(always)]
        fn $method(self, other: Self) -> Self {
            // SAFETY: a value of this type exists only where the instructions do.
            $make(unsafe { $back($instruction($to(self.0), $to(other.0))) })
        }
    )*};
}

#[cfg(target_arch = "x86_64")]
impl<T: HasAvx2> M256<T> {
    #[inline(always)]
    fn new(value: __m256) -> Self {
        Self(value, std::marker::PhantomData)
    }
}

#[cfg(target_arch = "x86_64")]
impl<T: HasAvx2> Lanes for M256<T> {
    const COUNT: usize = 8;
    type Token = T;

    #[inline(always)]
    fn splat(_: T, x: f32) -> Self {
        // SAFETY: the token shows that the instructions exist.
        Self::new(unsafe { _mm256_set1_ps(x) })
    }
    #[inline(always)]
    fn load(_: T, from: &[f32]) -> Self {
        let from = &from[..8];
        // SAFETY: the token shows that the instructions exist, the slice that 8 numbers do.
        Self::new(unsafe { _mm256_loadu_ps(from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..8];
        // SAFETY: a value of this type exists only where the instructions do; `to` has 8 places.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) }
    }
    binary!(Self::new; sub _mm256_sub_ps, mul _mm256_mul_ps, div _mm256_div_ps,
            min _mm256_min_ps, max _mm256_max_ps, either_negative _mm256_or_ps);
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: a value of this type exists only where the instructions do.
        Self::new(unsafe { _mm256_fmadd_ps(self.0, factor.0, term.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: a value of this type exists only where the instructions do.
        Self::new(unsafe { _mm256_andnot_ps(_mm256_set1_ps(-0.0), self.0) })
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        // SAFETY: a value of this type exists only where the instructions do.
        let sign = unsafe { _mm256_and_ps(_mm256_set1_ps(-0.0), sign.0) };
        // SAFETY: a value of this type exists only where the instructions do.
        Self::new(unsafe { _mm256_or_ps(self.abs().0, sign) })
    }
    integers!(Self::new, _mm256_castps_si256, _mm256_castsi256_ps;
              min_above_0 _mm256_min_epi32, max_above_0 _mm256_max_epi32);
    #[inline(always)]
    fn le_above_0(self, other: Self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        let above = unsafe {
            _mm256_cmpgt_epi32(_mm256_castps_si256(self.0), _mm256_castps_si256(other.0))
        };
        // SAFETY: a value of this type exists only where the instructions do.
        0xff ^ unsafe { _mm256_movemask_ps(_mm256_castsi256_ps(above)) as u32 }
    }
    #[inline(always)]
    fn negative(self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        unsafe { _mm256_movemask_ps(self.0) as u32 }
    }
    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LE_OQ>(self.0, other.0)) as u32 }
    }
    #[inline(always)]
    fn lt(self, other: Self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        unsafe { _mm256_movemask_ps(_mm256_cmp_ps::<_CMP_LT_OQ>(self.0, other.0)) as u32 }
    }
    #[inline(always)]
    fn least(self) -> f32 {
        // SAFETY: a value of this type exists only where the instructions do.
        let halves =
            unsafe { (_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0)) };
        Vec4::from(halves.0).min(Vec4::from(halves.1)).min_element()
    }
    #[inline(always)]
    fn greatest(self) -> f32 {
        // SAFETY: a value of this type exists only where the instructions do.
        let halves =
            unsafe { (_mm256_castps256_ps128(self.0), _mm256_extractf128_ps::<1>(self.0)) };
        Vec4::from(halves.0).max(Vec4::from(halves.1)).max_element()
    }
}

#[cfg(target_arch = "x86_64")]
impl Lanes for M512 {
    const COUNT: usize = 16;
    type Token = Sixteen;

    #[inline(always)]
    fn splat(_: Sixteen, x: f32) -> Self {
        // SAFETY: the token shows that the instructions exist.
        Self(unsafe { _mm512_set1_ps(x) })
    }
    #[inline(always)]
    fn load(_: Sixteen, from: &[f32]) -> Self {
        let from = &from[..16];
        // SAFETY: the token shows that the instructions exist, the slice that 16 numbers do.
        Self(unsafe { _mm512_loadu_ps(from.as_ptr()) })
    }
    #[inline(always)]
    fn store(self, to: &mut [f32]) {
        let to = &mut to[..16];
        // SAFETY: a value of this type exists only where the instructions do; `to` has 16 places.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), self.0) }
    }
    binary!(Self; sub _mm512_sub_ps, mul _mm512_mul_ps, div _mm512_div_ps,
            min _mm512_min_ps, max _mm512_max_ps, either_negative _mm512_or_ps);
    #[inline(always)]
    fn mul_add(self, factor: Self, term: Self) -> Self {
        // SAFETY: a value of this type exists only where the instructions do.
        Self(unsafe { _mm512_fmadd_ps(self.0, factor.0, term.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: a value of this type exists only where the instructions do.
        Self(unsafe { _mm512_abs_ps(self.0) })
    }
    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        // SAFETY: a value of this type exists only where the instructions do.
        let sign = unsafe { _mm512_and_ps(_mm512_set1_ps(-0.0), sign.0) };
        // SAFETY: a value of this type exists only where the instructions do.
        Self(unsafe { _mm512_or_ps(self.abs().0, sign) })
    }
    integers!(Self, _mm512_castps_si512, _mm512_castsi512_ps;
              min_above_0 _mm512_min_epi32, max_above_0 _mm512_max_epi32);
    #[inline(always)]
    fn le_above_0(self, other: Self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        u32::from(unsafe {
            _mm512_cmple_epi32_mask(_mm512_castps_si512(self.0), _mm512_castps_si512(other.0))
        })
    }
    #[inline(always)]
    fn negative(self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        u32::from(unsafe { _mm512_movepi32_mask(_mm512_castps_si512(self.0)) })
    }
    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        u32::from(unsafe { _mm512_cmp_ps_mask::<_CMP_LE_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn lt(self, other: Self) -> u32 {
        // SAFETY: a value of this type exists only where the instructions do.
        u32::from(unsafe { _mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, other.0) })
    }
    #[inline(always)]
    fn least(self) -> f32 {
        // SAFETY: a value of this type exists only where the instructions do.
        unsafe { _mm512_reduce_min_ps(self.0) }
    }
    #[inline(always)]
    fn greatest(self) -> f32 {
        // SAFETY: a value of this type exists only where the instructions do.
        unsafe { _mm512_reduce_max_ps(self.0) }
    }
}

/// [`Simd::narrow`], four f64 at a time; by axis, the first eight and the last.
///
/// # Safety
/// The machine has AVX.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
unsafe fn narrow_eights(
    targets: &[Target; 16],
    centre: DVec3,
    scale: f64,
    limit: DVec3,
) -> ([[__m256; 2]; 3], u32) {
    // SAFETY: the machine has AVX; two of a point's three coordinates are read.
    unsafe {
        let (centre, limit) = (centre.to_array(), limit.to_array());
        let mut rows = [[_mm_setzero_ps(); 4]; 3];
        let mut inside = 0;
        let mut four = 0;
        while four < 4 {
            let [p, q, r, s] = [0, 1, 2, 3].map(|i| &targets[4 * four + i].point);
            let [a, b, c, d] = [p, q, r, s].map(|point| _mm_loadu_pd(point.as_ref().as_ptr()));
            let (ac, bd) = (_mm256_set_m128d(c, a), _mm256_set_m128d(d, b));
            let z = _mm256_setr_pd(p.z, q.z, r.z, s.z);
            let axes = [_mm256_unpacklo_pd(ac, bd), _mm256_unpackhi_pd(ac, bd), z];
            let mut held = 0b1111;
            let mut axis = 0;
            while axis < 3 {
                let moved = _mm256_sub_pd(axes[axis], _mm256_set1_pd(centre[axis]));
                let local = _mm256_mul_pd(moved, _mm256_set1_pd(scale));
                let size = _mm256_andnot_pd(_mm256_set1_pd(-0.0), local);
                let within = _mm256_cmp_pd::<_CMP_LE_OQ>(size, _mm256_set1_pd(limit[axis]));
                held &= _mm256_movemask_pd(within);
                rows[axis][four] = _mm256_cvtpd_ps(local);
                axis += 1;
            }
            inside |= (held as u32) << (4 * four);
            four += 1;
        }
        let eights = |[a, b, c, d]: [__m128; 4]| [_mm256_set_m128(b, a), _mm256_set_m128(d, c)];
        ([eights(rows[0]), eights(rows[1]), eights(rows[2])], inside)
    }
}

/// Compiles a kernel for AVX2.
///
/// # Safety
/// The machine has the features named.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,popcnt")]
unsafe fn run_eight<K: Kernel>(kernel: K) -> K::Output {
    kernel.run(Eight(()))
}

/// Compiles a kernel for AVX-512.
///
/// # Safety
/// The machine has the features named.
#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,fma,bmi1,popcnt,avx512f,avx512vl,avx512bw,avx512dq")]
unsafe fn run_sixteen<K: Kernel>(kernel: K) -> K::Output {
    kernel.run(Sixteen(()))
}
