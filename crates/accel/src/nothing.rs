//! The occluder of convex scenes.

use glam::DVec3;

use crate::{Occluder, Segment, Target};

/// Never blocks anything.
///
/// From inside a convex scene every triangle sees every other, so asking is a waste; a solver that
/// knows this passes `Nothing`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Nothing;

impl Occluder for Nothing {
    fn occluded(&self, _segment: &Segment) -> bool {
        false
    }

    fn occluded_batch(&self, _: DVec3, _: u32, targets: &[Target], blocked: &mut [bool]) {
        assert_eq!(targets.len(), blocked.len(), "one answer per target");
        blocked.fill(false);
    }
}
