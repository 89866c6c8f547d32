//! Four boxes side by side, tested together: those of a leaf's blocks, or of four cells.

use glam::{Vec3A, Vec4};

use super::leaf::Path;
use super::packet::Beam;
use crate::aabb::Aabb;

/// Boxes per group.
pub(super) const FOUR: usize = 4;

/// Where empty boxes are put, a point in all three axes: coordinates of cells and segments are
/// below 1.1, so nothing comes near it.
const NOWHERE: f32 = 8.0;

/// Up to four boxes; the others are empty.
#[derive(Clone, Copy, Debug)]
pub(super) struct Boxes {
    /// By axis.
    lo: [Vec4; 3],
    hi: [Vec4; 3],
}

impl Boxes {
    pub(super) fn of(boxes: &[Aabb]) -> Self {
        let row = |corner: fn(&Aabb) -> Vec3A, axis: usize| {
            let at = |lane: usize| match boxes.get(lane) {
                Some(found) if found.lo.x <= found.hi.x => corner(found)[axis],
                _ => NOWHERE,
            };
            Vec4::new(at(0), at(1), at(2), at(3))
        };
        Self {
            lo: [0, 1, 2].map(|axis| row(|b| b.lo, axis)),
            hi: [0, 1, 2].map(|axis| row(|b| b.hi, axis)),
        }
    }

    /// What holds all four.
    pub(super) fn hull(&self) -> Aabb {
        let mut hull = Aabb::EMPTY;
        for lane in (0..FOUR).filter(|&lane| self.lo[0][lane] < NOWHERE) {
            let [lo, hi] = [self.lo, self.hi].map(|corner| corner.map(|axis| axis[lane]).into());
            hull.join(&Aabb { lo, hi });
        }
        hull
    }

    /// The boxes that the segment meets, one bit each (Kay & Kajiya 1986).
    #[inline(always)]
    pub(super) fn met_by(&self, path: &Path) -> u32 {
        let (mut enter, mut leave) = (Vec4::ZERO, Vec4::ONE);
        for axis in 0..3 {
            let origin = Vec4::splat(path.origin[axis]);
            let inverse = Vec4::splat(path.inverse[axis]);
            let a = (self.lo[axis] - origin) * inverse;
            let b = (self.hi[axis] - origin) * inverse;
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
        }
        enter.cmple(leave).bitmask()
    }

    /// The boxes that a segment of the beam may meet, one bit each.
    ///
    /// [`Self::met_by`] in interval arithmetic; where directions go both ways along an axis, only
    /// the bounds of all segments count.
    #[inline(always)]
    pub(super) fn met_by_any(&self, beam: &Beam) -> u32 {
        let (mut enter, mut leave) = (Vec4::ZERO, Vec4::ONE);
        let mut outside = 0;
        for axis in 0..3 {
            let (lo, hi) = (self.lo[axis], self.hi[axis]);
            outside |= (lo.cmpgt(Vec4::splat(beam.hi[axis]))
                | hi.cmplt(Vec4::splat(beam.lo[axis])))
            .bitmask();
            if beam.mixed[axis] {
                continue;
            }
            let (near, far) = if beam.forward[axis] { (lo, hi) } else { (hi, lo) };
            let origin = Vec4::splat(beam.origin[axis]);
            let (least, most) = (Vec4::splat(beam.least[axis]), Vec4::splat(beam.most[axis]));
            let (near, far) = (near - origin, far - origin);
            enter = enter.max((near * least).min(near * most));
            leave = leave.min((far * least).max(far * most));
        }
        enter.cmple(leave).bitmask() & !outside
    }
}
