//! What a caller hears after each step, and how it can stop the solver.

use std::sync::Arc;

use scene::Solution;

use crate::checkpoint::Kept;
use crate::mesh::Mesh;
use crate::refine::Statement;

/// The state after a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Shots so far.
    pub shots: u64,
    /// Segments tested for occluders so far.
    pub rays: u64,
    /// Form factors evaluated so far.
    pub form_factors: u64,
    /// Directions followed to see where light ends up, at least: one for each of a patch's samples, and
    /// one a receiver point.
    pub directions: u64,
    /// Unshot power over emitted power, worst channel.
    pub unshot: f64,
}

/// A level of refinement that is done.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LevelReport {
    /// Elements of its mesh.
    pub elements: usize,
    /// Patches of its mesh.
    pub patches: usize,
    /// The work on this level and all before.
    pub work: StepReport,
    /// How wrong its light may be; infinite mesh parts on the first level.
    pub statement: Option<Statement>,
}

/// What the solver does next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Control {
    /// Go on.
    Continue,
    /// Stop after this step; the solution so far is valid.
    Stop,
}

/// Asked now and then inside a step and between them, by several threads: `true` ends the work at
/// once, and stays. The step then counts for nothing; the light before it is the result.
pub type Stopper = Arc<dyn Fn() -> bool + Send + Sync>;

/// What a solve is busy with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Stage {
    /// Splitting the scene into elements.
    Mesh,
    /// Sampling where the light of each element ends up.
    Census,
    /// Choosing shooters, foreseeing what they will still receive, and the books.
    Select,
    /// Laying out shooters as cells, and points in the elements near them.
    Prepare,
    /// Form factors and occlusion from shooters to receivers.
    Transfer,
    /// Adding what arrived to elements and patches.
    Commit,
    /// Ambient corrections.
    Correct,
    /// What the light may be wrong by: bounds, second estimates, comparison of levels.
    Statement,
}

impl Stage {
    /// All, in the order of the work.
    pub const ALL: [Self; 8] = [
        Self::Mesh,
        Self::Census,
        Self::Select,
        Self::Prepare,
        Self::Transfer,
        Self::Commit,
        Self::Correct,
        Self::Statement,
    ];
}

/// Hears of every step. Nothing it does changes the light, but that it may end early.
pub trait Observer {
    /// Called once after each step: one shot, or as many as the schedule puts together.
    fn step(&mut self, report: &StepReport) -> Control;

    /// Called when work of another kind begins, which lasts until the next call: for a clock.
    fn stage(&mut self, _: Stage) {}

    /// Called once after each level of refinement.
    fn level(&mut self, _: &LevelReport) {}

    /// What may end a step before it is done; asked for before the first.
    fn stopper(&self) -> Option<Stopper> {
        None
    }

    /// How many elements the next level may have, of those planned; asked before each. Fewer make
    /// it coarser, or leave it out where it would no longer be finer than the one before.
    fn elements(&mut self, planned: usize) -> usize {
        planned
    }

    /// Whether the light after this step is wanted; asked after each.
    fn wants_solution(&mut self, _: &StepReport) -> bool {
        false
    }

    /// The light that was wanted, unshot light included, on the present level's mesh.
    fn solution(&mut self, _: &StepReport, _: &Mesh, _: &Solution) {}

    /// Whether the state is to be kept now; asked after each step, and where one was stopped on
    /// the way.
    fn keeps(&mut self) -> bool {
        false
    }

    /// The state that was to be kept, from which [`crate::resume`] goes on. It is whole only
    /// within [`crate::refine`] and [`crate::resume`].
    fn keep(&mut self, _: &Kept<'_>) {}
}

/// Hears nothing, stops nothing.
impl Observer for () {
    fn step(&mut self, _: &StepReport) -> Control {
        Control::Continue
    }
}

impl<F: FnMut(&StepReport) -> Control> Observer for F {
    fn step(&mut self, report: &StepReport) -> Control {
        self(report)
    }
}
