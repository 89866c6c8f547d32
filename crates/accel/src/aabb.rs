//! Axis-aligned boxes in the local frame.

use glam::Vec3A;

/// A box given by its least and greatest corner; empty while `lo` exceeds `hi`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Aabb {
    pub(crate) lo: Vec3A,
    pub(crate) hi: Vec3A,
}

impl Aabb {
    /// The box that contains nothing and leaves any other unchanged when joined to it.
    pub(crate) const EMPTY: Self = Self { lo: Vec3A::INFINITY, hi: Vec3A::NEG_INFINITY };

    pub(crate) fn of_triangle(triangle: &[[f32; 3]; 3]) -> Self {
        let [a, b, c] = triangle.map(Vec3A::from);
        Self { lo: a.min(b).min(c), hi: a.max(b).max(c) }
    }

    pub(crate) fn include(&mut self, point: Vec3A) {
        self.lo = self.lo.min(point);
        self.hi = self.hi.max(point);
    }

    pub(crate) fn join(&mut self, other: &Self) {
        self.lo = self.lo.min(other.lo);
        self.hi = self.hi.max(other.hi);
    }

    pub(crate) fn padded(&self, padding: f32) -> Self {
        Self { lo: self.lo - Vec3A::splat(padding), hi: self.hi + Vec3A::splat(padding) }
    }

    pub(crate) fn contains(&self, other: &Self) -> bool {
        self.lo.cmple(other.lo).all() && self.hi.cmpge(other.hi).all()
    }

    /// Half the surface area: proportional to the chance that a random line crosses the box.
    /// 0 for the empty box.
    pub(crate) fn half_area(&self) -> f32 {
        let side = (self.hi - self.lo).max(Vec3A::ZERO);
        side.x * side.y + side.y * side.z + side.z * side.x
    }
}
