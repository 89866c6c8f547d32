//! Looks a finished scene over for triangles that are probably mistakes.

mod degenerate;
mod duplicate;
mod winding;

use scene::{Scene, Sides, TriangleId};

use crate::DiagnosticKind;

/// Reports degenerate, repeated and probably reversed triangles, each pass in the order of
/// the triangles. Those in `collapsed` (sorted) have been reported and are passed over.
///
/// O(n log n) in the triangles, about 150 bytes for each.
pub(crate) fn look_over(
    scene: &Scene,
    collapsed: &[TriangleId],
    report: &mut impl FnMut(TriangleId, DiagnosticKind),
) {
    let mut sound = Vec::with_capacity(scene.triangles().len());
    for id in scene.ids().filter(|id| collapsed.binary_search(id).is_err()) {
        if degenerate::is_degenerate(scene.corners(id)) {
            report(id, DiagnosticKind::Degenerate);
        } else {
            sound.push(id);
        }
    }
    // A repeated triangle would turn every edge it has into one with too many neighbours.
    let first = duplicate::firsts(scene, &sound);
    let mut surface = Vec::with_capacity(sound.len());
    for (&id, &of) in sound.iter().zip(&first) {
        if of != id {
            report(id, DiagnosticKind::Duplicate { of });
        } else if scene.material_of(id).sides == Sides::Front {
            // Which way a two-sided triangle runs makes no difference.
            surface.push(id);
        }
    }
    for id in winding::reversed(scene, &surface) {
        report(id, DiagnosticKind::ReversedWinding);
    }
}
