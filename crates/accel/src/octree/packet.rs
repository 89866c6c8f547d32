//! Segments from one origin on their way down together.
//!
//! Neighbouring targets mostly meet the same leaves, so a packet of them goes down from the root
//! once, past every box that none of its segments can meet, and each segment is asked in the leaves
//! that are left.
//!
//! Why no leaf is missed. The test is that of a single segment against a box (`Boxes::met_by`) in
//! interval arithmetic (Boulos, Wald & Shirley 2006): each of its f32 results lies between the two
//! computed for the packet, because rounding keeps order. The bounds of the packet's ends err by one
//! rounding, far less than boxes are padded by. So a box that one segment must meet the packet
//! meets; a cell's box holds those of its blocks. A crossing is within `HIT_ERROR` of its triangle
//! and in some leaf, which lists the triangle, so it is in the box of the triangle's block there.

use glam::Vec3A;

use super::boxes::FOUR;
use super::leaf::Path;
use super::{INNER, Octree};
use crate::local::LocalSegment;

/// Segments in a packet, at most (binary `occlusion-bench`: 16 are no faster).
pub(super) const PACKET: usize = 8;

/// A packet is sent down if its directions, scaled to their longest component, differ by no more
/// than this along any axis; others walk one by one (binary `occlusion-bench`: 2 is slower).
const SPREAD: f32 = 1.0;

/// Among many small cells a wide beam meets too many: it may be as wide as this, over as many
/// cells as a cube of them has along a side (scene `soup-1m`).
const SPREAD_IN_CELLS: f32 = 8.0;

/// Fewer segments than this walk one by one.
const FEWEST: usize = 3;

/// What bounds the segments of a packet.
pub(super) struct Beam {
    pub(super) origin: Vec3A,
    /// Reciprocal directions, the least and greatest.
    pub(super) least: Vec3A,
    pub(super) most: Vec3A,
    /// Bounds of the segments.
    pub(super) lo: Vec3A,
    pub(super) hi: Vec3A,
    /// Whether segments advance along an axis; whether they disagree.
    pub(super) forward: [bool; 3],
    pub(super) mixed: [bool; 3],
}

impl Beam {
    /// The beam around segments that share their origin; `None` if it is too wide to be of use.
    fn of(paths: &[Path], spread: f32) -> Option<Self> {
        let origin = paths[0].origin;
        let (mut least, mut most) = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
        let (mut low, mut high) = (least, most);
        let (mut lo, mut hi) = (origin, origin);
        for path in paths {
            if path.origin != origin {
                return None; // cut off where it enters the scene
            }
            least = least.min(path.inverse);
            most = most.max(path.inverse);
            let unit = path.direction / path.direction.abs().max_element();
            (low, high) = (low.min(unit), high.max(unit));
            let end = origin + path.direction;
            (lo, hi) = (lo.min(end), hi.max(end));
        }
        if (high - low).max_element() > spread {
            return None;
        }
        let forward = [0, 1, 2].map(|axis| most[axis] > 0.0);
        let mixed = [0, 1, 2].map(|axis| (least[axis] > 0.0) != (most[axis] > 0.0));
        Some(Self { origin, least, most, lo, hi, forward, mixed })
    }
}

impl Octree {
    /// How far directions in a packet may differ.
    pub(super) fn spread(&self) -> f32 {
        (SPREAD_IN_CELLS / (self.cells.len() as f32).cbrt()).min(SPREAD)
    }

    /// Finds which of at most [`PACKET`] segments are blocked, and calls `found` with the place of
    /// each and the block.
    pub(super) fn blocking_packet(
        &self,
        segments: &[LocalSegment],
        spread: f32,
        mut found: impl FnMut(usize, u32),
    ) {
        debug_assert!(segments.len() <= PACKET);
        let mut paths = [Path::NONE; PACKET];
        for (path, segment) in paths.iter_mut().zip(segments) {
            *path = Path::of(segment);
        }
        let paths = &paths[..segments.len()];
        let beam = if paths.len() < FEWEST { None } else { Beam::of(paths, spread) };
        let Some(beam) = beam else {
            for (place, segment) in segments.iter().enumerate() {
                if let Some(block) = self.blocking(segment) {
                    found(place, block);
                }
            }
            return;
        };
        let mut active = (1_u32 << segments.len()) - 1;
        // The order in which the beam meets children.
        let flip = (0..3).fold(0, |flip, axis| flip | u32::from(!beam.forward[axis]) << axis);
        let mut stack = [(0_u32, 0_u32); super::DEPTH_LIMIT as usize + 1];
        let mut depth = 0;
        let mut cell = self.cells[0];
        loop {
            if cell.count == INNER {
                let [low, high] = &self.boxes[(cell.first as usize - 1) / 8];
                let met = low.met_by_any(&beam) | high.met_by_any(&beam) << FOUR;
                stack[depth] = (cell.first, flipped(met, flip));
                depth += 1;
            } else if cell.count != 0 {
                for group in self.groups(cell) {
                    let met = group.boxes.met_by_any(&beam);
                    let mut waiting = if met == 0 { 0 } else { active };
                    while waiting != 0 {
                        let lane = waiting.trailing_zeros() as usize % PACKET;
                        waiting &= waiting - 1;
                        let (path, segment) = (&paths[lane], &segments[lane]);
                        if let Some(block) = group.blocking(self, path, segment, met) {
                            active &= !(1 << lane);
                            found(lane, block);
                        }
                    }
                }
                if active == 0 {
                    return;
                }
            }
            // The next child of the deepest cell that has one.
            loop {
                if depth == 0 {
                    return;
                }
                let (first, met) = &mut stack[depth - 1];
                if *met == 0 {
                    depth -= 1;
                    continue;
                }
                let child = met.trailing_zeros() ^ flip;
                *met &= *met - 1;
                cell = self.cells[(*first + child) as usize];
                break;
            }
        }
    }
}

/// Moves bit i to place i ^ `flip`, for eight bits.
#[inline(always)]
fn flipped(mut bits: u32, flip: u32) -> u32 {
    if flip & 1 != 0 {
        bits = (bits & 0x55) << 1 | (bits & 0xaa) >> 1;
    }
    if flip & 2 != 0 {
        bits = (bits & 0x33) << 2 | (bits & 0xcc) >> 2;
    }
    if flip & 4 != 0 {
        bits = (bits & 0x0f) << 4 | (bits & 0xf0) >> 4;
    }
    bits
}

#[cfg(test)]
mod tests {
    use super::flipped;

    #[test]
    fn bits_move() {
        for flip in 0..8 {
            for bit in 0..8 {
                assert_eq!(flipped(1 << bit, flip), 1 << (bit ^ flip));
            }
        }
    }
}
