//! The seam between those who ask for visibility and the structures that answer.

use glam::DVec3;

use crate::proof::Outlook;
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

    /// Looks out from the front of a triangle, to tell of many segments at once; `None` if nothing is
    /// known of them but one by one.
    fn look_from(&self, surface: [DVec3; 3]) -> Option<Outlook<'_>> {
        let _ = surface;
        None
    }

    /// A number of the sealed space that a place lies in: places of different spaces do not see each
    /// other. `None` if that is not known of it.
    fn space(&self, place: DVec3) -> Option<u64> {
        let _ = place;
        None
    }
}
