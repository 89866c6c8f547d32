//! Numbers that look random and are the same in every run: SplitMix64 (Steele, Lea & Flood 2014).

use glam::DVec3;

pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform in [0, 1).
    pub(crate) fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [−½, ½).
    pub(crate) fn signed(&mut self) -> f64 {
        self.unit() - 0.5
    }

    pub(crate) fn below(&mut self, bound: usize) -> usize {
        (self.unit() * bound as f64) as usize
    }

    /// Uniform in the cube of side 1 around the origin.
    pub(crate) fn vector(&mut self) -> DVec3 {
        DVec3::new(self.signed(), self.signed(), self.signed())
    }

    /// Uniform on a triangle.
    pub(crate) fn on(&mut self, [a, b, c]: [DVec3; 3]) -> DVec3 {
        let (u, v) = (self.unit(), self.unit());
        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
        a + (b - a) * u + (c - a) * v
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The reference implementation's first numbers from seed 0.
    #[test]
    fn the_numbers_are_those_of_the_reference() {
        let mut random = Random(0);
        let first = [(); 3].map(|()| random.bits());
        assert_eq!(first, [0xe220_a839_7b1d_cdaf, 0x6e78_9e6a_a1b9_65f4, 0x06c4_5d18_8009_454f]);
    }
}
