//! The seam between those who ask for visibility and the structures that answer.

use glam::DVec3;

use crate::{Segment, Target};

/// Says whether any triangle blocks a segment.
///
/// An answer is a pure function of the segment and of the triangles the occluder was built over: it
/// depends on no earlier call, so threads may share one occluder and a batch may be cut anywhere.
pub trait Occluder: Sync {
    /// Returns whether a triangle that `segment` does not ignore crosses its inside, from either
    /// side.
    ///
    /// A segment with no length, or with an end that is not finite, is not blocked.
    fn occluded(&self, segment: &Segment) -> bool;

    /// Answers segments that share the end `from`: `blocked[i]` becomes what [`Self::occluded`]
    /// returns for the segment to `targets[i]` that ignores `ignore` and `targets[i].ignore`.
    ///
    /// # Panics
    /// Panics if `targets` and `blocked` differ in length.
    fn occluded_batch(&self, from: DVec3, ignore: u32, targets: &[Target], blocked: &mut [bool]) {
        assert_eq!(targets.len(), blocked.len(), "one answer per target");
        for (target, answer) in targets.iter().zip(blocked) {
            let segment = Segment { from, to: target.point, ignore: [ignore, target.ignore] };
            *answer = self.occluded(&segment);
        }
    }
}
