//! No live viewer: what the work calls, with nothing behind it.

use radiosity_core::StepReport;
use scene::Solution;
use scene_import::Imported;

use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::settings::Solve;

/// What would serve the light on its way: there is none.
pub(crate) struct Live<'a>(std::convert::Infallible, std::marker::PhantomData<&'a ()>);

impl<'a> Live<'a> {
    /// Never one: no flag leads here.
    pub(crate) fn start(
        _: &Solve,
        _: &str,
        _: &'a Imported,
        _: &output::Options,
    ) -> Result<Option<Self>, Failure> {
        Ok(None)
    }

    pub(crate) fn heed(&self, _: &Interrupt) {
        match self.0 {}
    }

    pub(crate) fn wants(&self) -> bool {
        match self.0 {}
    }

    pub(crate) fn show(&mut self, _: &StepReport, _: &Solution) {
        match self.0 {}
    }

    pub(crate) fn finish(&mut self, _: &StepReport, _: &Solution) {
        match self.0 {}
    }
}
