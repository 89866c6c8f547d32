//! How a BVH is built.

/// What the build of a [`crate::Bvh`] may choose; no choice changes an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BvhConfig {
    /// Bins per axis in which a split is sought; clamped to 2..=32. More bins find slightly better
    /// splits and take longer.
    pub bins: usize,
}

impl BvhConfig {
    /// Sixteen bins. From 8 to 32 the speed of questions varies by less than timing noise (bench
    /// `occluded`) while the build takes a fifth to a half longer (bench `build`).
    pub const DEFAULT: Self = Self { bins: 16 };
}

impl Default for BvhConfig {
    fn default() -> Self {
        Self::DEFAULT
    }
}
