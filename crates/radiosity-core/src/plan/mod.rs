//! What a scene needs, and what a solve of it leaves out: a pure step between scene and solver.
//!
//! [`Facts`] are read off the scene; [`Plan::of`] decides by them and by predicted work. Each
//! [`Decision`] says what is done, by which fact, what that spares and what error it can add.

mod cost;
mod decide;
mod decision;
mod facts;
mod predict;

use accel::Proofs;

use crate::config::{Correction, Exchange};
use crate::needs::Needs;
pub use decision::{Decision, Effect, Topic};
pub use facts::Facts;
pub use predict::Work;

/// What a plan is made for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanConfig {
    /// Elements of the last mesh; `None` if the error asked for decides.
    pub elements: Option<usize>,
    /// The error asked for, where that decides.
    pub error: f64,
    /// Unshot share at which the last mesh is done.
    pub unshot: f64,
    /// Who exchanges light with whom.
    pub exchange: Exchange,
    /// Whether corrections may be made.
    pub correction: Correction,
    /// What finds occluders; `None` for what the plan finds best.
    pub structure: Option<Structure>,
    /// Threads asked for; `None` for as many as pay.
    pub threads: Option<usize>,
    /// Threads that the machine can run at once.
    pub available: usize,
    /// Whether a time limit may end the work at any moment.
    pub timed: bool,
    /// Leave nothing out.
    pub everything: bool,
}

impl PlanConfig {
    /// For a refinement to this error on one thread.
    #[must_use]
    pub fn until(error: f64) -> Self {
        Self {
            elements: None,
            error,
            unshot: 1e-3,
            exchange: Exchange::OneSided,
            correction: Correction::Auto,
            structure: None,
            threads: None,
            available: 1,
            timed: false,
            everything: false,
        }
    }
}

/// What finds what blocks a segment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Structure {
    /// Nothing can block.
    None,
    /// [`accel::Octree`].
    Octree,
    /// [`accel::Bvh`].
    Bvh,
}

impl Structure {
    /// Its name on the command line.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Octree => "octree",
            Self::Bvh => "bvh",
        }
    }
}

/// What a solve does and leaves out.
#[derive(Clone, Debug)]
pub struct Plan {
    /// What was read off the scene.
    pub facts: Facts,
    /// Each decision, in the order of the way of the light.
    pub decisions: Vec<Decision>,
    /// What the solver has to do.
    pub needs: Needs,
    /// What finds occluders.
    pub structure: Structure,
    /// Triangles are in the structure whether they may block or not.
    all_block: bool,
    /// What is known of many segments at once, to go in front of the structure.
    pub proofs: Proofs,
    /// Whether corrections may be made.
    pub correction: Correction,
    /// How many threads take part.
    pub threads: usize,
    /// The work foreseen with this plan.
    pub planned: Work,
    /// The work foreseen if nothing were left out.
    pub everything: Work,
}

impl Plan {
    /// Whether a triangle of the scene belongs into what finds occluders.
    ///
    /// # Panics
    /// If the scene has no such triangle.
    #[must_use]
    pub fn in_structure(&self, triangle: usize) -> bool {
        self.all_block || self.facts.blocking[triangle]
    }

    /// Whether all of them do: each may block, nothing is left out, or those that may not are too small to
    /// matter.
    #[must_use]
    pub fn whole_structure(&self) -> bool {
        self.all_block
    }

    /// How many triangles may block.
    #[must_use]
    pub fn blockers(&self) -> usize {
        self.facts.blocking.iter().filter(|b| **b).count()
    }
}
