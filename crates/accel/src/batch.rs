//! Segments that share an origin, answered one after the other with the last blocker retried.

use glam::DVec3;

use crate::Target;
use crate::frame::Frame;
use crate::local::LocalSegment;

/// Answers a batch: `search` finds what blocks a segment, and `retry` asks what blocked an
/// earlier one again, since neighbouring targets tend to hide behind the same triangles.
/// Either finds only what truly blocks, so the answers do not depend on the order.
pub(crate) fn with_last_blocker<B: Copy>(
    frame: &Frame,
    (from, ignore): (DVec3, u32),
    targets: &[Target],
    blocked: &mut [bool],
    retry: impl Fn(&LocalSegment, B) -> bool,
    search: impl Fn(&LocalSegment) -> Option<B>,
) {
    assert_eq!(targets.len(), blocked.len(), "one answer per target");
    let from = frame.local(from);
    let mut last = None;
    for (target, answer) in targets.iter().zip(blocked) {
        let to = frame.local(target.point);
        let local = LocalSegment::from_local(frame, from, to, [ignore, target.ignore]);
        *answer = local.is_some_and(|local| {
            if last.is_some_and(|last| retry(&local, last)) {
                return true;
            }
            let found = search(&local);
            last = found.or(last);
            found.is_some()
        });
    }
}
