//! What was decided, and why.

use super::predict::Work;

/// What a decision is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Topic {
    /// Whether segments are asked for at all, and which triangles they may meet.
    Blocking,
    /// What finds occluders.
    Structure,
    /// Blocks of receivers behind planes.
    Planes,
    /// Coplanar triangles as large walls that hide what is behind them.
    Walls,
    /// Sealed spaces that no light joins.
    Spaces,
    /// Ways that nothing rises into.
    Ways,
    /// Directions that are followed to where light ends up.
    Census,
    /// Channels.
    Channels,
    /// Surfaces that reflect nothing.
    Black,
    /// Where elements are split.
    Splitting,
    /// Ambient corrections.
    Corrections,
    /// Second estimates of form factors.
    Estimates,
    /// Single or double precision.
    Precision,
    /// Threads.
    Threads,
}

impl Topic {
    /// Its name in reports: one lower-case word.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Blocking => "blocking",
            Self::Structure => "structure",
            Self::Planes => "planes",
            Self::Walls => "walls",
            Self::Spaces => "spaces",
            Self::Ways => "ways",
            Self::Census => "census",
            Self::Channels => "channels",
            Self::Black => "black",
            Self::Splitting => "splitting",
            Self::Corrections => "corrections",
            Self::Estimates => "estimates",
            Self::Precision => "precision",
            Self::Threads => "threads",
        }
    }
}

/// What a decision can do to the light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Effect {
    /// The same light, to the bit, on the same mesh.
    Exact,
    /// The same light but for the rounding of f64.
    Rounding,
    /// Other meshes or other shots: within the error that is stated.
    Stated,
}

impl Effect {
    /// In words.
    #[must_use]
    pub fn text(self) -> &'static str {
        match self {
            Self::Exact => "none: the same bits on the same mesh",
            Self::Rounding => "rounding of f64, 1e-15",
            Self::Stated => "other meshes or shots, within the stated error",
        }
    }
}

/// One decision.
#[derive(Clone, Debug, PartialEq)]
pub struct Decision {
    /// What it is about.
    pub topic: Topic,
    /// What is done.
    pub choice: String,
    /// Whether that leaves something out.
    pub leaves_out: bool,
    /// The fact that it follows from.
    pub why: String,
    /// Work that it is foreseen to spare.
    pub saves: Work,
    /// What it can do to the light.
    pub effect: Effect,
}
