//! Sixteen segments from one origin on their way through the hierarchy.
//!
//! Boxes are tested by `box_test.rs`, triangles by `planes.rs`; where no more than two segments are
//! left to a node, `segment.rs` goes on with each.

use super::batch::Shooter;
use super::box_test::BoxTest;
use super::chunk::Sixteen;
use super::group::Start;
use super::level::Level;
use super::node::{LEAF, WIDTH};
use super::planes::Rays;
use super::segment::blocking;
use crate::block::LANES;
use crate::lanes::{Lanes, Simd};
use crate::local::LocalSegment;
use crate::{Bvh, NO_TRIANGLE};

/// Segments per packet.
pub(super) const PACKET: usize = 16;

/// Segments that meet a node's box go on one by one if they are no more.
const ALONE_BELOW: u32 = 2;

/// A packet on its way.
pub(super) struct Packet<'a, S: Simd> {
    sixteen: &'a Sixteen,
    rays: Rays<S>,
    /// Segments without an answer, one bit each.
    active: u32,
}

impl<'a, S: Simd> Packet<'a, S> {
    #[inline(always)]
    pub(super) fn new(simd: S, sixteen: &'a Sixteen) -> Self {
        let direction = [
            S::F16::load(simd, &sixteen.directions[0]),
            S::F16::load(simd, &sixteen.directions[1]),
            S::F16::load(simd, &sixteen.directions[2]),
        ];
        let active = 0xffff >> (PACKET - sixteen.len);
        Self { sixteen, rays: Rays::of(simd, direction), active }
    }

    /// Returns the segments that are blocked, one bit each.
    #[inline(always)]
    pub(super) fn answer(&mut self, shooter: &mut Shooter<S>, start: &Start) -> u32 {
        let all = self.active;
        if let Some(last) = shooter.last {
            self.triangle(shooter, last, all);
        }
        if self.active != 0 {
            let mut test = BoxTest::of(shooter.simd, shooter.origin, &self.rays);
            self.descend(shooter, &mut test, start);
        }
        all & !self.active
    }

    /// Goes through the hierarchy until every segment is blocked.
    #[inline(always)]
    fn descend(&mut self, shooter: &mut Shooter<S>, test: &mut BoxTest<S>, start: &Start) {
        let (simd, origin) = (shooter.simd, shooter.origin);
        for (boxes, count, children) in start.eights() {
            let used = (1 << count) - 1;
            let mut met =
                if start.few { used } else { test.near(simd, origin, &self.rays, (boxes, used)) };
            while met != 0 {
                let lane = met.trailing_zeros() as usize % WIDTH;
                met &= met - 1;
                let meeting = test.meeting(simd, boxes, lane) & self.active;
                if meeting == 0 {
                    continue;
                }
                let child = children[lane];
                if child & LEAF != 0 {
                    self.block(shooter, child & !LEAF, meeting);
                } else if meeting.count_ones() <= ALONE_BELOW {
                    self.alone_below(shooter, child, meeting);
                } else {
                    self.below(shooter, test, child);
                }
                if self.active == 0 {
                    return;
                }
            }
        }
    }

    /// Goes through what is below a node until every segment is blocked.
    #[inline(always)]
    fn below(&mut self, shooter: &mut Shooter<S>, test: &mut BoxTest<S>, mut number: u32) {
        let (simd, bvh, origin) = (shooter.simd, shooter.bvh, shooter.origin);
        let mut depth = 0;
        let mut node = &bvh.nodes[number as usize];
        let mut met = test.near(simd, origin, &self.rays, (&node.boxes, node.used()));
        loop {
            if met == 0 {
                if depth == 0 {
                    return;
                }
                depth -= 1;
                (number, met) = shooter.stack[depth];
                node = &bvh.nodes[number as usize];
                continue;
            }
            let lane = met.trailing_zeros() as usize % WIDTH;
            met &= met - 1;
            let meeting = test.meeting(simd, &node.boxes, lane) & self.active;
            if meeting == 0 {
                continue;
            }
            if lane as u32 >= node.inner {
                self.block(shooter, node.block(lane), meeting);
            } else if meeting.count_ones() <= ALONE_BELOW {
                self.alone_below(shooter, node.first_node + lane as u32, meeting);
            } else {
                if met != 0 {
                    shooter.stack[depth] = (number, met);
                    depth += 1;
                }
                number = node.first_node + lane as u32;
                node = &bvh.nodes[number as usize];
                met = test.near(simd, origin, &self.rays, (&node.boxes, node.used()));
                continue;
            }
            if self.active == 0 {
                return;
            }
        }
    }

    /// Tests the triangles of a block against some segments.
    #[inline(always)]
    fn block(&mut self, shooter: &mut Shooter<S>, index: u32, meeting: u32) {
        let mut candidates = shooter.planes(index).candidates(&self.rays);
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize % LANES;
            candidates &= candidates - 1;
            self.triangle(shooter, (index, lane), meeting);
            if self.active == 0 {
                break;
            }
        }
    }

    /// Tests a triangle, given by block and lane, against some segments.
    #[inline(always)]
    fn triangle(&mut self, shooter: &mut Shooter<S>, (index, lane): (u32, usize), meeting: u32) {
        let (simd, bvh, origin) = (shooter.simd, shooter.bvh, shooter.origin);
        let triangle = bvh.blocks[index as usize].indices[lane];
        let verdict = shooter.planes(index).judge(simd, lane, &self.rays, self.active & meeting);
        if verdict.possible == 0 || triangle == shooter.ignore || triangle == NO_TRIANGLE {
            return;
        }
        let possible = verdict.possible & !self.sixteen.ignoring(triangle);
        let mut blocked = possible & verdict.sure;
        let unsure = possible & !verdict.sure;
        if unsure != 0 {
            blocked |= crossing(bvh, origin, self.sixteen, unsure, (index, lane));
        }
        if blocked != 0 {
            self.active &= !blocked;
            shooter.last = Some((index, lane));
        }
    }

    /// Asks segments one by one whether anything below a node is in their way.
    #[inline(always)]
    fn alone_below(&mut self, shooter: &mut Shooter<S>, node: u32, mut waiting: u32) {
        while waiting != 0 {
            let ray = waiting.trailing_zeros() as usize % PACKET;
            waiting &= waiting - 1;
            if let Some(segment) = self.segment(shooter, ray)
                && let Some(found) = blocking(shooter.simd, shooter.bvh, &segment, node)
            {
                self.active &= !(1 << ray);
                shooter.last = Some(found);
            }
        }
    }

    #[inline(always)]
    fn segment(&self, shooter: &Shooter<S>, ray: usize) -> Option<LocalSegment> {
        let ignore = [shooter.ignore, self.sixteen.ignore[ray]];
        LocalSegment::of(shooter.origin.into(), self.sixteen.direction(ray), ignore)
    }
}

/// Of some segments, those that cross a triangle, which is given by block and lane.
#[inline(never)] // not often, and much code
fn crossing(
    bvh: &Bvh,
    origin: [f32; 3],
    sixteen: &Sixteen,
    mut waiting: u32,
    (block, lane): (u32, usize),
) -> u32 {
    let (block, origin) = (&bvh.blocks[block as usize], origin.into());
    let level = Level::of(block.corners(lane).map(|corner| corner - origin));
    let mut crossing = 0;
    while waiting != 0 {
        let ray = waiting.trailing_zeros() as usize % PACKET;
        waiting &= waiting - 1;
        let direction = sixteen.direction(ray);
        if !level.clears(direction)
            && let Some(segment) = LocalSegment::of(origin, direction, [NO_TRIANGLE; 2])
            && block.crosses(lane, &segment)
        {
            crossing |= 1 << ray;
        }
    }
    crossing
}
