//! What a surface does with light, checked on entry.

use crate::{Error, ErrorKind, Rgb};

/// Which sides of a triangle emit, receive and reflect; every triangle blocks from both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Sides {
    /// The front alone: the side from which the vertices run counter-clockwise.
    #[default]
    Front,
    /// Both sides alike: two elements back to back over one occluder.
    Both,
}

/// A diffuse surface: its reflectance, its emittance and its sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// The file's name for it; need not be unique.
    pub name: String,
    /// Share of the arriving power that leaves again, in [0, 1] per channel.
    pub reflectance: Rgb,
    /// Self-emitted exitance, W·m⁻² per channel, at least 0.
    pub emittance: Rgb,
    /// Which sides take part.
    pub sides: Sides,
}

impl Material {
    /// Whether any channel emits.
    #[must_use]
    pub fn emits(&self) -> bool {
        self.emittance.max_channel() > 0.0
    }

    pub(crate) fn check(&self) -> Result<(), Error> {
        let at = || self.name.clone();
        let unit = 0.0..=1.0;
        if !self.reflectance.0.iter().all(|c| unit.contains(c)) {
            return Err(Error::new(ErrorKind::Reflectance(self.reflectance), at()));
        }
        if !self.emittance.0.iter().all(|c| c.is_finite() && *c >= 0.0) {
            return Err(Error::new(ErrorKind::Emittance(self.emittance), at()));
        }
        Ok(())
    }
}
