//! What a computation of a form factor says.

/// A form factor, how far off it may be, and what it took.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The form factor F a→b: the share of the light leaving `a` that reaches `b`; in 0..=1.
    pub value: f64,
    /// How far `value` may be from the truth, absolute: estimated, on the safe side.
    pub error: f64,
    /// Integrand values taken: kernels, edge integrals or points.
    pub effort: u32,
    /// Whether something may stand in between, so that visibility had to be computed.
    pub visibility: bool,
}

impl Estimate {
    /// No light at all, known without computing.
    pub const NOTHING: Self = Self { value: 0.0, error: 0.0, effort: 0, visibility: false };
}
