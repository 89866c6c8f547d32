//! Where the packets of a group start.
//!
//! Sixteen packets in a row take nearly the same way, too. They go down first as one beam, as long
//! as the boxes it meets are few, and each packet starts from these: a shaft (Haines & Wallace
//! 1991). Where receivers are many to an occluder, hardly anything is left to go through.

use super::Bvh;
use super::beam::{Beam, Extremes};
use super::chunk::Sixteen;
use super::node::{Boxes, LEAF, WIDTH};
use crate::lanes::{Lanes, Simd};

/// Packets per group (example `mrays`: 8 and 32 are slower by up to a tenth).
pub(super) const GROUP: usize = 16;

/// Nodes of eight boxes each that a group hands to its packets, at most (example `mrays`: with
/// twice or four times as many the packets' own tests of them cost more than they save).
const NODES: usize = 3;

/// See [`Start::few`] (example `mrays`: with 4 and 16 `church_unsplit` is slower by a few per cent).
const FEW_BOXES: usize = 10;

/// The boxes that a group meets, in nodes of their own.
pub(super) struct Start {
    boxes: [Boxes; NODES],
    children: [[u32; WIDTH]; NODES],
    count: usize,
    /// Whether the boxes are so few that a packet need not look for those near it first.
    pub(super) few: bool,
}

impl Start {
    /// Goes down with the whole group while the boxes met are few.
    #[inline(always)]
    pub(super) fn of<S: Simd>(simd: S, bvh: &Bvh, origin: [f32; 3], packets: &[Sixteen]) -> Self {
        let root = &bvh.nodes[0];
        let beam = if packets.len() > 1 { beam(simd, origin, packets) } else { None };
        let Some(beam) = beam else {
            let mut start = Self { few: false, ..Self::EMPTY };
            start.boxes[0] = root.boxes;
            for lane in root.lanes() {
                start.children[0][lane] = root.child(lane);
            }
            start.count = root.lanes().len();
            return start;
        };
        // Children, by their parent and lane; those before `at` are leaves.
        let mut list = [(0_u32, 0_usize); NODES * WIDTH];
        let mut count = 0;
        let mut at = 0;
        let mut node = 0;
        let mut met = beam.meets(simd, &root.boxes);
        loop {
            while met != 0 {
                list[count] = (node, met.trailing_zeros() as usize % WIDTH);
                met &= met - 1;
                count += 1;
            }
            while at < count && child(bvh, list[at]) & LEAF != 0 {
                at += 1;
            }
            if at == count {
                break;
            }
            // The next inner one gives its place to the last, and its children follow.
            node = child(bvh, list[at]);
            met = beam.meets(simd, &bvh.nodes[node as usize].boxes);
            if count - 1 + met.count_ones() as usize > list.len() {
                break;
            }
            count -= 1;
            list[at] = list[count];
        }
        let mut start = Self { count, few: count <= FEW_BOXES, ..Self::EMPTY };
        for (i, &(parent, lane)) in list[..count].iter().enumerate() {
            let parent = &bvh.nodes[parent as usize];
            start.boxes[i / WIDTH].copy(i % WIDTH, &parent.boxes, lane);
            start.children[i / WIDTH][i % WIDTH] = parent.child(lane);
        }
        start
    }

    const EMPTY: Self =
        Self { boxes: [Boxes::EMPTY; NODES], children: [[0; WIDTH]; NODES], count: 0, few: true };

    /// The boxes, eight at a time, with how many there are and what is in them.
    #[inline(always)]
    pub(super) fn eights(&self) -> impl Iterator<Item = (&Boxes, usize, &[u32; WIDTH])> {
        let first = (0..self.count).step_by(WIDTH);
        let eights = self.boxes.iter().zip(&self.children);
        eights
            .zip(first)
            .map(|((boxes, children), first)| (boxes, WIDTH.min(self.count - first), children))
    }
}

#[inline(always)]
fn child(bvh: &Bvh, (parent, lane): (u32, usize)) -> u32 {
    bvh.nodes[parent as usize].child(lane)
}

/// The beam around all segments of some packets.
#[inline(always)]
fn beam<S: Simd>(simd: S, origin: [f32; 3], packets: &[Sixteen]) -> Option<Beam<S>> {
    let mut ends = Extremes { lo: [0.0; 3], hi: [0.0; 3] };
    for axis in 0..3 {
        let mut lo = S::F16::splat(simd, f32::INFINITY);
        let mut hi = S::F16::splat(simd, f32::NEG_INFINITY);
        for packet in packets {
            let next = S::F16::load(simd, &packet.directions[axis]);
            lo = lo.min(next);
            hi = hi.max(next);
        }
        ends.lo[axis] = lo.least();
        ends.hi[axis] = hi.greatest();
    }
    let axis = ends.axis()?;
    let (mut least, mut greatest) = ([0.0; 2], [0.0; 2]);
    for k in 0..2 {
        let across = (axis + 1 + k) % 3;
        let mut lo = S::F16::splat(simd, f32::INFINITY);
        let mut hi = S::F16::splat(simd, f32::NEG_INFINITY);
        for packet in packets {
            let along = S::F16::load(simd, &packet.directions[axis]);
            let slope = S::F16::load(simd, &packet.directions[across]).div(along);
            lo = lo.min(slope);
            hi = hi.max(slope);
        }
        least[k] = lo.least();
        greatest[k] = hi.greatest();
    }
    Beam::new(simd, origin, axis, (least, greatest), &ends)
}
