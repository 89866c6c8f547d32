//! Sixteen segments from one origin on their way through the hierarchy.
//!
//! A node's eight boxes are tested against the packet's beam at once, each box met against the
//! segments one by one, and triangles by `planes.rs`.

use glam::Vec3A;

use super::batch::Shooter;
use super::beam::{Beam, Extremes};
use super::build::MAX_DEPTH;
use super::chunk::Sixteen;
use super::group::Start;
use super::node::{LEAF, Node, WIDTH};
use super::planes::Rays;
use super::segment::blocked;
use crate::block::LANES;
use crate::lanes::{Lanes, Simd};
use crate::local::{LEAST_SLOPE, LocalSegment};
use crate::{Bvh, NO_TRIANGLE};

/// Segments per packet.
pub(super) const PACKET: usize = 16;

/// A packet on its way.
pub(super) struct Packet<'a, S: Simd> {
    sixteen: &'a Sixteen,
    rays: Rays<S>,
    /// Reciprocal directions, and the parameters at which coordinates are 0: see `slabs.rs`.
    inverse: [S::F16; 3],
    offset: [S::F16; 3],
    /// Segments without an answer, one bit each.
    active: u32,
}

impl<'a, S: Simd> Packet<'a, S> {
    #[inline(always)]
    pub(super) fn new(simd: S, origin: [f32; 3], sixteen: &'a Sixteen) -> Self {
        let direction = [
            S::F16::load(simd, &sixteen.directions[0]),
            S::F16::load(simd, &sixteen.directions[1]),
            S::F16::load(simd, &sixteen.directions[2]),
        ];
        let (mut inverse, mut offset) = (direction, direction);
        let (one, least) = (S::F16::splat(simd, 1.0), S::F16::splat(simd, LEAST_SLOPE));
        let mut axis = 0;
        while axis < 3 {
            let slope = direction[axis].abs().max(least).copysign(direction[axis]);
            inverse[axis] = one.div(slope);
            offset[axis] = inverse[axis].mul(S::F16::splat(simd, -origin[axis]));
            axis += 1;
        }
        let active = 0xffff >> (PACKET - sixteen.len);
        Self { sixteen, rays: Rays::of(simd, direction), inverse, offset, active }
    }

    /// Returns the segments that are blocked, one bit each.
    #[inline(always)]
    pub(super) fn answer(mut self, shooter: &mut Shooter<S>, start: &Start) -> u32 {
        let all = self.active;
        if let Some(last) = shooter.last {
            self.block(shooter, last, all);
        }
        if self.active != 0 {
            match self.beam(shooter.simd, shooter.origin) {
                Some(beam) => self.descend(shooter, &beam, start),
                None => self.one_by_one(shooter),
            }
        }
        all & !self.active
    }

    #[inline(always)]
    fn beam(&self, simd: S, origin: [f32; 3]) -> Option<Beam<S>> {
        let [x, y, z] = self.rays.direction;
        let ends = Extremes {
            lo: [x.least(), y.least(), z.least()],
            hi: [x.greatest(), y.greatest(), z.greatest()],
        };
        let axis = ends.axis()?;
        let along = self.rays.direction[axis];
        let u = self.rays.direction[(axis + 1) % 3].div(along);
        let v = self.rays.direction[(axis + 2) % 3].div(along);
        let slopes = ([u.least(), v.least()], [u.greatest(), v.greatest()]);
        Beam::new(simd, origin, axis, slopes, &ends)
    }

    /// Follows the beam through the hierarchy until every segment is blocked.
    #[inline(always)]
    fn descend(&mut self, shooter: &mut Shooter<S>, beam: &Beam<S>, start: &Start) {
        let (simd, bvh) = (shooter.simd, shooter.bvh);
        for top in start.nodes() {
            // Nodes with children still to visit, and which.
            let mut stack = [(top, 0_u32); MAX_DEPTH + 1];
            let mut depth = 0;
            let (mut node, mut met) = (top, beam.meets(simd, top));
            loop {
                if met == 0 {
                    if depth == 0 {
                        break;
                    }
                    depth -= 1;
                    (node, met) = stack[depth];
                    continue;
                }
                let lane = met.trailing_zeros() as usize % WIDTH;
                met &= met - 1;
                let meeting = self.meeting(simd, node, lane);
                if meeting == 0 {
                    continue;
                }
                let child = node.children[lane];
                if child & LEAF != 0 {
                    self.block(shooter, child & !LEAF, meeting);
                    if self.active == 0 {
                        return;
                    }
                    continue;
                }
                if met != 0 {
                    stack[depth] = (node, met);
                    depth += 1;
                }
                node = &bvh.nodes[child as usize];
                met = beam.meets(simd, node);
            }
        }
    }

    /// The segments without an answer that meet a child's box; the slab test of `slabs.rs`.
    #[inline(always)]
    fn meeting(&self, simd: S, node: &Node, lane: usize) -> u32 {
        let mut enter = S::F16::splat(simd, 0.0);
        let mut leave = S::F16::splat(simd, 1.0);
        let mut axis = 0;
        while axis < 3 {
            let (inverse, offset) = (self.inverse[axis], self.offset[axis]);
            let [lo, hi] = &node.bounds[axis];
            let a = S::F16::splat(simd, lo[lane]).mul_add(inverse, offset);
            let b = S::F16::splat(simd, hi[lane]).mul_add(inverse, offset);
            enter = enter.max(a.min(b));
            leave = leave.min(a.max(b));
            axis += 1;
        }
        enter.le(leave) & self.active
    }

    /// Tests the triangles of a block against some segments.
    #[inline(always)]
    fn block(&mut self, shooter: &mut Shooter<S>, index: u32, meeting: u32) {
        let (simd, bvh, origin, ignore) =
            (shooter.simd, shooter.bvh, shooter.origin, shooter.ignore);
        let indices = &bvh.blocks[index as usize].indices;
        let planes = shooter.planes(index);
        let mut found = false;
        let mut candidates = planes.candidates(&self.rays);
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize % LANES;
            candidates &= candidates - 1;
            let triangle = indices[lane];
            if triangle == NO_TRIANGLE {
                break; // empty lanes come last
            }
            let verdict = planes.judge(simd, lane, &self.rays, self.active & meeting);
            let mut possible = verdict.possible;
            if possible == 0 || triangle == ignore {
                continue;
            }
            while possible != 0 {
                let ray = possible.trailing_zeros() as usize % PACKET;
                possible &= possible - 1;
                if self.sixteen.ignore[ray] != triangle
                    && (verdict.sure >> ray & 1 == 1
                        || crosses(bvh, origin, self.sixteen.direction(ray), (index, lane)))
                {
                    self.active &= !(1 << ray);
                    found = true;
                }
            }
            if self.active == 0 {
                break;
            }
        }
        if found {
            shooter.last = Some(index);
        }
    }

    /// For a packet that is too wide for a beam.
    #[inline(always)]
    fn one_by_one(&mut self, shooter: &Shooter<S>) {
        let mut waiting = self.active;
        while waiting != 0 {
            let ray = waiting.trailing_zeros() as usize % PACKET;
            waiting &= waiting - 1;
            let ignore = [shooter.ignore, self.sixteen.ignore[ray]];
            let (origin, direction) = (shooter.origin.into(), self.sixteen.direction(ray));
            if let Some(segment) = LocalSegment::of(origin, direction, ignore)
                && blocked(shooter.simd, shooter.bvh, &segment)
            {
                self.active &= !(1 << ray);
            }
        }
    }
}

/// The exact test of one segment against a triangle, given by block and lane.
#[inline(never)] // rare, and much code
fn crosses(bvh: &Bvh, origin: [f32; 3], direction: Vec3A, (block, lane): (u32, usize)) -> bool {
    LocalSegment::of(origin.into(), direction, [NO_TRIANGLE; 2])
        .is_some_and(|segment| bvh.blocks[block as usize].crosses(lane, &segment))
}
