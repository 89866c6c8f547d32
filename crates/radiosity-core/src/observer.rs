//! What a caller hears after each shot, and how it can stop the solver.

use crate::refine::Statement;

/// The state after a shot.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct StepReport {
    /// Shots so far.
    pub shots: u64,
    /// Segments tested for occluders so far.
    pub rays: u64,
    /// Form factors evaluated so far.
    pub form_factors: u64,
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
    /// Stop after this shot; the solution so far is valid.
    Stop,
}

/// Hears of every shot. Nothing it does changes the light.
pub trait Observer {
    /// Called once after each shot.
    fn step(&mut self, report: &StepReport) -> Control;

    /// Called once after each level of refinement.
    fn level(&mut self, _: &LevelReport) {}
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
