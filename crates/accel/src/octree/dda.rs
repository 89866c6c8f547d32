//! The 3D-DDA walk: from leaf to leaf along a segment.
//!
//! Places are counted in cells of the finest level, as integers; a leaf of any size is left in one
//! step. After each step the next leaf is found by going down from the lowest cell that holds both.
//!
//! Why no triangle is missed. Write P(t) for the segment's point at t, and e for a bound on the
//! rounding of one position: e < 2⁻²⁰ in local units, because faces are exact, coordinates and
//! differences are at most 2.1, and each takes a subtraction, a product and a sum with relative
//! errors of 2⁻²⁴. The walk holds a leaf and a parameter t such that P(t) is within e of the leaf:
//! on the axes just crossed because t is at or past those faces, on the others because the cell
//! was computed from P(t), or was kept inside the old leaf's range by a clamp that moves the place
//! by no more than e. The exit parameter is the least over the three axes, so until then no
//! coordinate of P passes the leaf's far faces by more than e; where rounding puts the exit before
//! t, the walk stays at t. Boxes are convex, so the whole piece of the segment between the two
//! parameters is within e of the leaf, and the pieces cover (0, 1). Lists hold every triangle
//! within `CELL_PADDING` > e + `HIT_ERROR` of the leaf. A segment that runs exactly in a face, an
//! edge or a corner of cells is one of these cases. A step crosses every face whose computed
//! parameter is reached, one at least, in the segment's direction, and none against it, so the walk
//! ends.

use super::leaf::Path;
use super::{Cell, DEPTH_LIMIT, INNER, Octree, batch};
use crate::local::LocalSegment;
use crate::{Occluder, Segment, Target};

use glam::{DVec3, Vec3A};

/// Every block of a group.
const ALL: u32 = 0b1111;

impl Octree {
    /// A block with a triangle that blocks the segment.
    #[inline]
    pub(super) fn blocking(&self, segment: &LocalSegment) -> Option<u32> {
        let path = Path::of(segment);
        let mut found = None;
        self.walk(&path, |leaf| {
            let mut groups = self.groups(leaf).iter();
            found = groups.find_map(|group| group.blocking(self, &path, segment, ALL));
            found.is_some()
        });
        found
    }

    /// Shows `visit` the leaves along the segment, in order, until it returns true.
    #[inline(always)]
    fn walk(&self, path: &Path, mut visit: impl FnMut(Cell) -> bool) {
        let &Path { origin, direction, inverse } = path;
        let depth = self.depth as usize;
        let side = 1_i32 << depth;
        let size = 2.0 * self.half / side as f32;
        let per_size = side as f32 / (2.0 * self.half);
        let forward = inverse.cmpgt(Vec3A::ZERO);
        let [fx, fy, fz] = [forward.test(0), forward.test(1), forward.test(2)];
        // Truncation is floor here: places are not negative but for rounding, which clamps to 0.
        let place = |t: f32| {
            let p = (origin + t * direction + self.half) * per_size;
            [p.x as i32, p.y as i32, p.z as i32]
        };

        let mut at = place(0.0).map(|a| a.clamp(0, side - 1));
        let mut t = 0.0_f32;
        let mut parents = [0_u32; DEPTH_LIMIT as usize + 1];
        let mut level = 0;
        loop {
            // Down to the leaf that holds `at`.
            let mut cell = self.cells[parents[level] as usize];
            while cell.count == INNER {
                let shift = depth - 1 - level;
                let bit = |axis: usize| (at[axis] >> shift & 1) as u32;
                level += 1;
                parents[level] = cell.first + (bit(0) | bit(1) << 1 | bit(2) << 2);
                cell = self.cells[parents[level] as usize];
            }
            if cell.count != 0 && visit(cell) {
                return;
            }

            // Where the segment leaves it.
            let span = 1_i32 << (depth - level);
            let low = at.map(|a| a & !(span - 1));
            let face = |axis: usize, forward: bool| {
                (low[axis] + if forward { span } else { 0 }) as f32 * size - self.half
            };
            let faces = Vec3A::new(face(0, fx), face(1, fy), face(2, fz));
            let exits = (faces - origin) * inverse;
            t = t.max(exits.min_element());
            if t >= 1.0 {
                return;
            }

            // Into the next: over every face that is reached by then.
            let crossed = exits.cmple(Vec3A::splat(t));
            let inside = place(t);
            let step = |axis: usize, forward: bool| {
                let (low, high) = (low[axis], low[axis] + span);
                let over = if forward { high } else { low - 1 };
                if crossed.test(axis) { over } else { inside[axis].clamp(low, high - 1) }
            };
            let old = at;
            at = [step(0, fx), step(1, fy), step(2, fz)];
            // A place below 0 has the highest bit, one beyond the side has that of the side.
            if (at[0] | at[1] | at[2]) as u32 >= side as u32 {
                return;
            }
            // The highest bit in which the two places differ tells the lowest common cell.
            let differ = (old[0] ^ at[0]) | (old[1] ^ at[1]) | (old[2] ^ at[2]);
            level = depth - (i32::BITS - differ.leading_zeros()) as usize;
        }
    }
}

impl Occluder for Octree {
    fn occluded(&self, segment: &Segment) -> bool {
        LocalSegment::between(&self.frame, segment.from, segment.to, segment.ignore)
            .is_some_and(|local| self.blocking(&local).is_some())
    }

    fn occluded_batch(&self, from: DVec3, ignore: u32, targets: &[Target], blocked: &mut [bool]) {
        batch::answer(self, (from, ignore), targets, blocked);
    }
}
