//! Pieces of the smaller polygon, what they add up to, and which comes next.

use std::cmp::Ordering;

use glam::DVec3;

use crate::kink::Kink;

/// Errors of pieces have either sign and partly cancel: so many times the root of the sum of their
/// squares counts, and so much of their sum, and where one sign prevails in how the sums change,
/// that too; together no more than their sum.
const SPREAD: f64 = 3.0;
const BIAS: f64 = 0.1;

/// A piece of the smaller polygon, and integrals over it.
pub(crate) struct Piece {
    pub(crate) corners: [DVec3; 3],
    /// A line across which the edges of shadows cut the larger polygon in another way.
    pub(crate) kink: Option<Kink>,
    /// Whether there is one pattern of shadows, and no steep change from light to shadow.
    pub(crate) settled: bool,
    /// Whether the sums are not from probes: nothing stands in between, or a wall that covers all.
    pub(crate) proved: bool,
    /// Whether its parts count in its place.
    pub(crate) is_split: bool,
    /// Indices of the blockers that matter to it.
    pub(crate) blockers: Vec<u32>,
    pub(crate) sums: Sums,
    /// How far the sums may be off by what lies between the probes, whatever the parts say.
    pub(crate) doubts: Sums,
    /// How far the sums may be off; at first a guess from how much the probes differ.
    pub(crate) errors: Sums,
    /// The share of the errors that has a sign: what the sums changed by when the piece was cut.
    pub(crate) drift: Sums,
}

/// Exchange areas: of what is visible, and of what is hidden.
#[derive(Clone, Copy, Default)]
pub(crate) struct Sums {
    pub(crate) visible: f64,
    pub(crate) hidden: f64,
}

impl Sums {
    pub(crate) fn map(self, other: Self, f: impl Fn(f64, f64) -> f64) -> Self {
        Self { visible: f(self.visible, other.visible), hidden: f(self.hidden, other.hidden) }
    }
}

/// What the pieces come to.
#[derive(Default)]
pub(crate) struct Total {
    pub(crate) sums: Sums,
    pub(crate) errors: Sums,
    /// Of the errors.
    pub(crate) squares: Sums,
    pub(crate) drift: Sums,
}

impl Total {
    pub(crate) fn of(pieces: &[Piece]) -> Self {
        let mut total = Self::default();
        pieces.iter().filter(|piece| !piece.is_split).for_each(|piece| total.add(piece, 1.0));
        total
    }

    pub(crate) fn add(&mut self, piece: &Piece, sign: f64) {
        self.sums = self.sums.map(piece.sums, |sum, one| sum + sign * one);
        self.errors = self.errors.map(piece.errors, |sum, one| sum + sign * one);
        self.drift = self.drift.map(piece.drift, |sum, one| sum + sign * one);
        self.squares = self.squares.map(piece.errors, |sum, one| sum + sign * one * one);
    }

    pub(crate) fn error(&self, of: fn(&Sums) -> f64) -> f64 {
        let (sum, squares) = (of(&self.errors), of(&self.squares));
        sum.min(SPREAD * squares.max(0.0).sqrt() + BIAS * sum + of(&self.drift).abs())
    }
}

/// A piece that may be halved; the worst one comes first, and of equals the oldest.
pub(crate) struct Ranked {
    pub(crate) error: f64,
    pub(crate) at: usize,
}

impl Ord for Ranked {
    fn cmp(&self, other: &Self) -> Ordering {
        self.error.total_cmp(&other.error).then(other.at.cmp(&self.at))
    }
}

impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ranked {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Ranked {}
