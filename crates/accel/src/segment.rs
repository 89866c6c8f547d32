//! The question an occluder answers: a segment between two points, and what it may pass through.

use glam::DVec3;

/// The index that stands for no triangle at all.
pub const NO_TRIANGLE: u32 = u32::MAX;

/// A segment that may be blocked between its two ends.
///
/// The ends are used as given: a caller whose points lie on surfaces moves them off, or names the
/// triangles they lie on in `ignore`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// The first end, in scene units.
    pub from: DVec3,
    /// The second end, in scene units.
    pub to: DVec3,
    /// Triangles, by their index when the occluder was built, that never block this segment;
    /// [`NO_TRIANGLE`] for none.
    pub ignore: [u32; 2],
}

impl Segment {
    /// Makes a segment that any triangle may block.
    pub const fn new(from: DVec3, to: DVec3) -> Self {
        Self { from, to, ignore: [NO_TRIANGLE; 2] }
    }
}

/// The far end of one segment of a batch whose segments share their first end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// The second end, in scene units.
    pub point: DVec3,
    /// A triangle that never blocks the segment to this target; [`NO_TRIANGLE`] for none.
    pub ignore: u32,
}
