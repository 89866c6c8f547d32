//! What `solve` works towards, and what ends the work before.

use std::time::Duration;

use radiosity_core::Asked;

use super::DEFAULT_ELEMENTS;

/// What `solve` works towards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Goal {
    /// Until the stated error is at most this.
    Error(f64),
    /// On one mesh, until this share of the power is unshot; `stated` with coarser meshes
    /// beside it, to say how wrong it is.
    Mesh { elements: Option<usize>, converge: f64, stated: bool },
}

/// What ends the work before its goal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Limits {
    pub(crate) time: Option<Duration>,
    pub(crate) elements: Option<usize>,
    pub(crate) memory: Option<u64>,
}

/// Stated error asked for when the command line does not say.
pub(crate) const DEFAULT_ERROR: f64 = 0.01;

/// Unshot share on a fixed mesh when the command line does not say.
pub(crate) const DEFAULT_CONVERGE: f64 = 1e-3;

impl Goal {
    /// In the solver's terms, for a scene of so many triangles.
    pub(crate) fn asked(&self, triangles: usize) -> Asked {
        match *self {
            Self::Error(target) => Asked::Error(target),
            Self::Mesh { elements, stated, .. } => {
                let elements = elements.unwrap_or(DEFAULT_ELEMENTS.max(2 * triangles));
                if stated { Asked::Elements(elements) } else { Asked::Unstated(elements) }
            }
        }
    }

    /// The unshot share at which shooting stops; refinement sets its own.
    pub(crate) fn converge(&self) -> f64 {
        match *self {
            Self::Error(_) => DEFAULT_CONVERGE,
            Self::Mesh { converge, .. } => converge,
        }
    }
}
