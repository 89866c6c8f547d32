//! Segments that share an origin, answered in packets.

use glam::DVec3;

use super::Bvh;
use super::chunk::{CHUNK, Chunk, Sixteen};
use super::group::{GROUP, Start};
use super::packet::Packet;
use super::planes::Planes;
use super::segment::blocked;
use crate::Target;
use crate::lanes::{Kernel, Simd};
use crate::local::LocalSegment;

/// Blocks of which the planes are kept (example `mrays`: 128 take longer to set up than they save).
const KEPT: usize = 32;

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
        if !bvh.frame.holds(from) || bvh.nodes.is_empty() {
            for (target, answer) in targets.iter().zip(blocked) {
                *answer = alone(simd, bvh, from, ignore, target);
            }
            return;
        }
        let mut shooter = Shooter::new(simd, bvh, from.as_vec3().to_array(), ignore);
        let mut chunk = Chunk::new(targets.len());
        for (targets, blocked) in targets.chunks(CHUNK).zip(blocked.chunks_mut(CHUNK)) {
            blocked.fill(false);
            chunk.fill(simd, &bvh.frame, shooter.origin, targets, |place| {
                blocked[place] = alone(simd, bvh, from, ignore, &targets[place]);
            });
            let mut first = 0;
            while first < chunk.packets() {
                shooter.group(&chunk, first, blocked);
                first += GROUP;
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
    /// The block in which a triangle blocked a segment last: neighbours tend to hide behind the
    /// same triangles.
    pub(super) last: Option<u32>,
    /// Planes of the blocks met lately, each in the place of its number's remainder.
    kept: [Planes; KEPT],
    kept_for: [u32; KEPT],
}

impl<'a, S: Simd> Shooter<'a, S> {
    #[inline(always)]
    fn new(simd: S, bvh: &'a Bvh, origin: [f32; 3], ignore: u32) -> Self {
        let (kept, kept_for) = ([Planes::NONE; KEPT], [u32::MAX; KEPT]);
        Self { simd, bvh, origin, ignore, last: None, kept, kept_for }
    }

    /// Answers a chunk's packets from `first` on, as many as make a group.
    #[inline(always)]
    fn group(&mut self, chunk: &Chunk, first: usize, blocked: &mut [bool]) {
        let mut packets = [Sixteen::EMPTY; GROUP];
        let packets = &mut packets[..GROUP.min(chunk.packets() - first)];
        for (i, packet) in packets.iter_mut().enumerate() {
            chunk.packet(first + i, packet);
        }
        let start = Start::of(self.simd, self.bvh, self.origin, packets);
        for sixteen in packets {
            let mut answers = Packet::new(self.simd, self.origin, sixteen).answer(self, &start);
            while answers != 0 {
                let lane = answers.trailing_zeros() as usize % sixteen.places.len();
                answers &= answers - 1;
                blocked[sixteen.places[lane] as usize] = true;
            }
        }
    }

    /// The planes of a block's triangles.
    #[inline(always)]
    pub(super) fn planes(&mut self, block: u32) -> &Planes {
        let place = block as usize % KEPT;
        if self.kept_for[place] != block {
            self.kept_for[place] = block;
            self.kept[place] = Planes::of(&self.bvh.blocks[block as usize], self.origin);
        }
        &self.kept[place]
    }
}
