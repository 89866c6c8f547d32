//! Known answers, checked on the user's own machine.
//!
//! Each check compares one number with what it must be. Exact values come from closed forms
//! ([`crate::howell`], the case files); a bound says how far off may be, and is never a
//! measured value.

mod form_factors;
mod scenes;
mod solutions;

use std::fmt;

use scene::Scene;

/// What a check found.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outcome {
    /// What must come out.
    pub exact: f64,
    /// What came out.
    pub ours: f64,
    /// How far off that is, in the measure of the bound.
    pub error: f64,
    /// How far off it may be.
    pub bound: f64,
}

impl Outcome {
    /// Whether the error is a number within the bound.
    #[must_use]
    pub fn passed(&self) -> bool {
        self.error <= self.bound
    }

    /// Relative to the exact value, or absolute where that is 0.
    fn relative(exact: f64, ours: f64, bound: f64) -> Self {
        let scale = if exact == 0.0 { 1.0 } else { exact.abs() };
        Self { exact, ours, error: (ours - exact).abs() / scale, bound }
    }
}

/// One number to check, and how.
pub struct Check {
    /// What it is called.
    pub name: String,
    run: Box<dyn Fn() -> Outcome + Send + Sync>,
}

impl Check {
    fn new(name: impl Into<String>, run: impl Fn() -> Outcome + Send + Sync + 'static) -> Self {
        Self { name: name.into(), run: Box::new(run) }
    }

    /// Does the work, a fraction of a second to some seconds.
    #[must_use]
    pub fn run(&self) -> Outcome {
        (self.run)()
    }
}

impl fmt::Debug for Check {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Check").field("name", &self.name).finish_non_exhaustive()
    }
}

/// All exact cases: form factors, then whole solutions.
#[must_use]
pub fn checks() -> Vec<Check> {
    let mut checks = form_factors::checks();
    checks.extend(solutions::checks());
    checks
}

/// What must hold in a scene whose light nobody knows: the books balance, the bits do not
/// depend on threads or occluders, and the stated error covers the way to a finer mesh.
#[must_use]
pub fn scene_checks(name: &str, scene: Scene) -> Vec<Check> {
    scenes::checks(name, scene)
}
