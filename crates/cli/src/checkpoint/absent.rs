//! No checkpoints: what the work calls, with nothing behind it.

use std::path::Path;

use radiosity_core::{Checkpoint, Inconsistent, Kept, Probe, RefineConfig, ShootingConfig};
use scene::Scene;

use crate::absent;
use crate::failure::Failure;
use crate::settings::Keeping;

/// What no checkpoint belongs to.
pub(crate) struct Identity;

impl Identity {
    /// Of any work.
    pub(crate) fn of(
        _: &Scene,
        _: &str,
        _: &ShootingConfig,
        _: &RefineConfig,
        _: &[Probe],
    ) -> Self {
        Self
    }
}

/// What would write the state: there is none.
pub(crate) enum Keeper {}

impl Keeper {
    /// Never one.
    pub(crate) fn of(_: &Keeping, _: &Identity) -> Option<Self> {
        None
    }

    pub(crate) fn due(&self) -> bool {
        match *self {}
    }

    pub(crate) fn keep(&mut self, _: &Kept<'_>) {
        match *self {}
    }

    pub(crate) fn say_how_to_go_on(&self) {
        match *self {}
    }
}

/// Nothing is read: no flag leads here.
pub(crate) fn read(path: &Path, _: &Identity) -> Result<Checkpoint, Failure> {
    Err(inconsistent_with(path))
}

/// As [`read`].
pub(crate) fn inconsistent(path: &Path, _: Inconsistent) -> Failure {
    inconsistent_with(path)
}

fn inconsistent_with(path: &Path) -> Failure {
    absent::refused(&path.display().to_string(), "checkpoint")
}
