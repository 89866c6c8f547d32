//! The 3D-DDA walk: from leaf to leaf along a segment.
//!
//! Places are counted in cells of the finest level, as integers; a leaf of any size is left in one
//! step. After each step the next leaf is found by going down from the lowest cell that holds both.
//!
//! Why no triangle is missed. Write P(t) for the segment's point at t, and e for a bound on the
//! rounding of one position: e < 2⁻²⁰ in local units, because faces are exact, coordinates and
//! differences are at most 2.1, and each takes a subtraction, a product and a sum with relative
//! errors of 2⁻²⁴. The walk holds a leaf and a parameter t such that P(t) is within e of the leaf:
//! on the axis just crossed because t was computed from that face, on the others because the cell
//! was computed from P(t), or was kept inside the old leaf's range by a clamp that moves the place
//! by no more than e. The exit parameter is the least over the three axes, so until then no
//! coordinate of P passes the leaf's far faces by more than e; where rounding puts the exit before
//! t, the walk stays at t. Boxes are convex, so the whole piece of the segment between the two
//! parameters is within e of the leaf, and the pieces cover (0, 1). Lists hold every triangle
//! within `CELL_PADDING` > e + `HIT_ERROR` of the leaf. A segment that runs exactly in a face, an
//! edge or a corner of cells is one of these cases. Each step moves one integer in the segment's
//! direction and none against it, so the walk ends.

use super::{Cell, DEPTH_LIMIT, INNER, Octree};
use crate::batch::with_last_blocker;
use crate::block::{Block, LANES};
use crate::local::LocalSegment;
use crate::{Occluder, Segment, Target};

use glam::DVec3;

impl Octree {
    /// The position of a triangle that blocks the segment.
    #[inline]
    fn blocking_triangle(&self, segment: &LocalSegment) -> Option<u32> {
        let mut found = None;
        self.walk(segment, |leaf| {
            for four in self.list(leaf).chunks(LANES) {
                // The first fills the gaps of a short run.
                let at = |lane: usize| *four.get(lane).unwrap_or(&four[0]);
                found = self.blocking_among(segment, [at(0), at(1), at(2), at(3)]);
                if found.is_some() {
                    return true;
                }
            }
            false
        });
        found
    }

    /// The first of four positions at which a triangle blocks the segment.
    #[inline(always)]
    fn blocking_among(&self, segment: &LocalSegment, positions: [u32; LANES]) -> Option<u32> {
        let block = Block::gather(&self.triangles, positions);
        let (index, _) = block.crossings(segment).next()?;
        positions.into_iter().find(|&p| self.triangles[p as usize].index == index)
    }

    /// Shows `visit` the leaves along the segment, in order, until it returns true.
    #[inline]
    fn walk(&self, segment: &LocalSegment, mut visit: impl FnMut(Cell) -> bool) {
        let (origin, direction) = (segment.origin, segment.direction);
        let side = 1_i32 << self.depth;
        let size = 2.0 * self.half / side as f32;
        let per_size = side as f32 / (2.0 * self.half);
        // Truncation is floor here: places are not negative but for rounding, which clamps to 0.
        let place = |coordinate: f32| ((coordinate + self.half) * per_size) as i32;
        let forward = segment.inverse.map(|slope| slope > 0.0);

        let mut at = origin.map(|o| place(o).clamp(0, side - 1));
        let mut t = 0.0_f32;
        let mut path = [0_u32; DEPTH_LIMIT as usize + 1];
        let mut level = 0;
        loop {
            // Down to the leaf that holds `at`.
            let mut cell = self.cells[path[level] as usize];
            while cell.count == INNER {
                let shift = self.depth as usize - 1 - level;
                let bit = |axis: usize| (at[axis] >> shift & 1) as u32;
                level += 1;
                path[level] = cell.first + (bit(0) | bit(1) << 1 | bit(2) << 2);
                cell = self.cells[path[level] as usize];
            }
            if cell.count != 0 && visit(cell) {
                return;
            }

            // Where the segment leaves it.
            let span = 1_i32 << (self.depth as usize - level);
            let low = at.map(|a| a & !(span - 1));
            let exit = |axis: usize| {
                let face = if forward[axis] { low[axis] + span } else { low[axis] };
                (face as f32 * size - self.half - origin[axis]) * segment.inverse[axis]
            };
            let exits = [exit(0), exit(1), exit(2)];
            let mut axis = usize::from(exits[1] < exits[0]);
            if exits[2] < exits[axis] {
                axis = 2;
            }
            t = t.max(exits[axis]);
            if t >= 1.0 {
                return;
            }

            // Into the next.
            let old = at;
            if span > 1 {
                for other in 0..3 {
                    let p = place(origin[other] + t * direction[other]);
                    at[other] = p.clamp(low[other], low[other] + span - 1);
                }
            }
            at[axis] = if forward[axis] { low[axis] + span } else { low[axis] - 1 };
            if at[axis] < 0 || at[axis] >= side {
                return;
            }
            // The highest bit in which the two places differ tells the lowest common cell.
            let differ = (old[0] ^ at[0]) | (old[1] ^ at[1]) | (old[2] ^ at[2]);
            level = self.depth as usize - (i32::BITS - differ.leading_zeros()) as usize;
        }
    }
}

impl Occluder for Octree {
    fn occluded(&self, segment: &Segment) -> bool {
        LocalSegment::between(&self.frame, segment.from, segment.to, segment.ignore)
            .is_some_and(|local| self.blocking_triangle(&local).is_some())
    }

    fn occluded_batch(&self, from: DVec3, ignore: u32, targets: &[Target], blocked: &mut [bool]) {
        with_last_blocker(
            &self.frame,
            (from, ignore),
            targets,
            blocked,
            |local, last| self.blocking_among(local, [last; LANES]).is_some(),
            |local| self.blocking_triangle(local),
        );
    }
}
