//! Which blocks of receivers a shooter reaches, and whether it has to ask.

use accel::Sight;
use accel::proof::Plane;

use super::blocks::Block;
use super::transfer::{IN_PLANE, Shot};
use crate::config::Exchange;

/// What light of a shooter a block gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Reach {
    /// None: one lies behind the other's plane.
    Behind,
    /// None: they lie in different sealed spaces.
    Apart,
    /// None: a wall hides one from the other.
    Hidden,
    /// All that its receivers face.
    Open,
    /// Each receiver has to be asked for.
    Asked,
}

/// A receiver is left out by its box only this share below the limit for single receivers: the two
/// are computed in other ways, and must agree.
const SURE: f64 = 0.5;

impl Shot<'_> {
    /// What light of this shot a block gets.
    pub(super) fn reach(&self, block: &Block) -> Reach {
        let asked = if self.segments { Reach::Asked } else { Reach::Open };
        if self.singles || self.exchange == Exchange::Paired {
            return asked;
        }
        let in_plane = IN_PLANE * self.extent * SURE;
        let plane = Plane::through(self.corners[0], self.normal);
        if plane.heights(block.low, block.high)[1] <= in_plane {
            return Reach::Behind;
        }
        if let Some(plane) = &block.plane
            && self.corners.iter().all(|c| plane.height(*c) <= in_plane)
        {
            return Reach::Behind;
        }
        if !self.segments {
            return Reach::Open;
        }
        if let (Some(own), Some(there)) = (self.space, block.space)
            && own != there
        {
            return Reach::Apart;
        }
        match &self.outlook {
            None => asked,
            Some(outlook) => match outlook.sight(block.low, block.high, block.plane.as_ref()) {
                Sight::Open => Reach::Open,
                Sight::Blocked => Reach::Hidden,
                Sight::Unknown => asked,
            },
        }
    }
}
