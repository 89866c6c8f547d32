//! For tests: segments that end near a triangle, down to where f32 rounds them across its plane or
//! its edges.

use glam::Vec3A;

use crate::NO_TRIANGLE;
use crate::block::Block;
use crate::frame::LocalTriangle;
use crate::local::LocalSegment;

/// A segment and a triangle, in local units.
#[derive(Clone, Copy, Debug)]
pub(crate) struct NearMiss {
    pub(crate) origin: Vec3A,
    pub(crate) direction: Vec3A,
    pub(crate) corners: [Vec3A; 3],
    /// How far the end is from the plane; above 0 on the side of the origin.
    pub(crate) in_front: f32,
}

impl NearMiss {
    pub(crate) fn block(&self) -> Block {
        Block::of(&[LocalTriangle { vertices: self.corners.map(|v| v.to_array()), index: 0 }])
    }

    pub(crate) fn segment(&self) -> Option<LocalSegment> {
        LocalSegment::of(self.origin, self.direction, [NO_TRIANGLE; 2])
    }
}

/// Numbers that repeat from run to run (Marsaglia 2003, "Xorshift RNGs").
pub(crate) struct NearMisses {
    state: u32,
    round: i32,
}

impl NearMisses {
    pub(crate) fn new() -> Self {
        Self { state: 1, round: 0 }
    }

    /// In [-1, 1).
    fn number(&mut self) -> f32 {
        self.state ^= self.state << 13;
        self.state ^= self.state >> 17;
        self.state ^= self.state << 5;
        (self.state >> 8) as f32 / (1 << 23) as f32 - 1.0
    }

    fn point(&mut self) -> Vec3A {
        Vec3A::new(self.number(), self.number(), self.number())
    }
}

impl Iterator for NearMisses {
    type Item = NearMiss;

    /// No two are alike; triangles so thin that f32 does not tell their normals are left out.
    fn next(&mut self) -> Option<NearMiss> {
        loop {
            self.round += 1;
            let origin = self.point();
            let size = 0.5_f32.powi(self.round % 12);
            let at = 0.5 * self.point();
            let corners = [(); 3].map(|()| at + size * self.point());
            let [ab, ac] = [corners[1] - corners[0], corners[2] - corners[0]];
            let normal = ab.cross(ac);
            if normal.length() < 0.1 * size * size {
                continue;
            }
            let normal = normal.normalize();
            // A point in the triangle, every fourth time on an edge, moved off the plane by a
            // tenth or by next to nothing.
            let (u, mut v) = (0.25 + 0.2 * self.number(), 0.25 + 0.2 * self.number());
            if self.round % 4 == 0 {
                v = 1e-7 * self.number();
            }
            let on = corners[0] + u * ab + v * ac;
            let off = 0.1_f32.powf(4.0 + 3.0 * self.number()) * self.number().signum();
            let direction = on + off * normal - origin;
            let in_front = off * (origin - on).dot(normal).signum();
            return Some(NearMiss { origin, direction, corners, in_front });
        }
    }
}
