//! Repeatable random numbers: SplitMix64 (Steele, Lea & Flood 2014).

use glam::DVec3;

/// The same seed gives the same numbers on every machine.
pub(crate) struct Rng(pub(crate) u64);

impl Rng {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in the box between two corners.
    pub(crate) fn point(&mut self, lo: DVec3, hi: DVec3) -> DVec3 {
        lo + (hi - lo) * DVec3::new(self.unit(), self.unit(), self.unit())
    }

    /// Uniform on a triangle.
    pub(crate) fn on(&mut self, t: &crate::Triangle) -> DVec3 {
        let (u, v) = (self.unit(), self.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0])
    }
}
