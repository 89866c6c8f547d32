//! Segments that share an origin, answered in packets.

use glam::DVec3;

use super::Bvh;
use super::build::MAX_DEPTH;
use super::chunk::{CHUNK, Chunk, Sixteen};
use super::group::{GROUP, Start};
use super::packet::{PACKET, Packet};
use super::planes::Planes;
use super::segment::blocked;
use crate::Target;
use crate::lanes::{Kernel, Simd};
use crate::local::LocalSegment;

/// Blocks of which the planes are kept (example `mrays`: 128 take longer to set up than they save).
const KEPT: usize = 32;

/// So few targets are answered one by one: a packet takes longer to set up. Half of the batches of
/// a radiosity shot near its shooter are that small; shots of a room gain 5 %.
const FEW: usize = 4;

/// Answers a batch.
pub(super) struct Batch<'a> {
    pub(super) bvh: &'a Bvh,
    pub(super) from: DVec3,
    pub(super) ignore: u32,
    pub(super) targets: &'a [Target],
    pub(super) blocked: &'a mut [bool],
}

impl Kernel for Batch<'_> {
    type Output = ();

    #[inline(always)]
    fn run<S: Simd>(self, simd: S) {
        let Self { bvh, from, ignore, targets, blocked } = self;
        let from = bvh.frame.local(from);
        if targets.len() <= FEW || !bvh.frame.holds(from) || bvh.nodes.is_empty() {
            for (target, answer) in targets.iter().zip(blocked) {
                *answer = alone(simd, bvh, from, ignore, target);
            }
            return;
        }
        let mut shooter = Shooter::new(simd, bvh, from.as_vec3().to_array(), ignore);
        let mut chunk = Chunk::new(targets.len());
        for (targets, blocked) in targets.chunks(CHUNK).zip(blocked.chunks_mut(CHUNK)) {
            chunk.fill(simd, &bvh.frame, shooter.origin, targets, |place| {
                blocked[place] = alone(simd, bvh, from, ignore, &targets[place]);
            });
            for group in chunk.packets().chunks(GROUP) {
                shooter.group(group, blocked);
            }
        }
    }
}

/// One segment, by the test for single segments.
#[inline(always)]
fn alone<S: Simd>(simd: S, bvh: &Bvh, from: DVec3, ignore: u32, target: &Target) -> bool {
    let to = bvh.frame.local(target.point);
    match LocalSegment::from_local(&bvh.frame, from, to, [ignore, target.ignore]) {
        Some(segment) => blocked(simd, bvh, &segment),
        None => false,
    }
}

/// What all segments of a batch share, and what earlier ones leave for later ones. The latter
/// saves work and changes no answer.
pub(super) struct Shooter<'a, S: Simd> {
    pub(super) simd: S,
    pub(super) bvh: &'a Bvh,
    pub(super) origin: [f32; 3],
    pub(super) ignore: u32,
    /// The triangle that blocked a segment last, by block and lane: neighbours tend to hide behind
    /// the same triangles.
    pub(super) last: Option<(u32, usize)>,
    /// Planes of the blocks met lately.
    kept: Vec<Planes>,
    /// For each remainder of a block's number, which block's planes are kept, and where.
    kept_for: [u32; KEPT],
    kept_at: [u8; KEPT],
    /// Nodes with children still to visit, and which.
    pub(super) stack: [(u32, u32); MAX_DEPTH + 1],
}

impl<'a, S: Simd> Shooter<'a, S> {
    #[inline(always)]
    fn new(simd: S, bvh: &'a Bvh, origin: [f32; 3], ignore: u32) -> Self {
        Self {
            simd,
            bvh,
            origin,
            ignore,
            last: None,
            kept: Vec::with_capacity(KEPT),
            kept_for: [u32::MAX; KEPT],
            kept_at: [u8::MAX; KEPT],
            stack: [(0, 0); MAX_DEPTH + 1],
        }
    }

    /// Answers a group of packets.
    #[inline(always)]
    fn group(&mut self, packets: &[Sixteen], blocked: &mut [bool]) {
        let start = Start::of(self.simd, self.bvh, self.origin, packets);
        for sixteen in packets {
            let mut packet = Packet::new(self.simd, sixteen);
            let answers = packet.answer(self, &start);
            // Most packets are sixteen targets in a row: their answers are written side by side.
            let first = sixteen.places[0];
            if sixteen.places == std::array::from_fn(|lane| first + lane as u16)
                && let Some(blocked) = blocked.get_mut(first as usize..first as usize + PACKET)
            {
                for (lane, blocked) in blocked.iter_mut().enumerate() {
                    *blocked = answers >> lane & 1 == 1;
                }
                continue;
            }
            for (lane, &place) in sixteen.places[..sixteen.len].iter().enumerate() {
                blocked[place as usize] = answers >> lane & 1 == 1;
            }
        }
    }

    /// The planes of a block's triangles.
    #[inline(always)]
    pub(super) fn planes(&mut self, block: u32) -> &Planes {
        let place = block as usize % KEPT;
        if self.kept_for[place] != block {
            self.kept_for[place] = block;
            let planes = Planes::of(&self.bvh.blocks[block as usize], self.origin);
            let used = self.kept_at[place] as usize;
            if used < self.kept.len() {
                self.kept[used] = planes;
            } else {
                self.kept_at[place] = self.kept.len() as u8;
                self.kept.push(planes);
            }
        }
        &self.kept[self.kept_at[place] as usize]
    }
}
