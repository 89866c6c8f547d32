//! Sixteen segments from one origin against a triangle: which are surely blocked, which surely not.
//!
//! A segment crosses a triangle if its direction passes the three planes through the origin and the
//! edges on the same side, and the triangle's plane between its ends. The planes' normals depend on
//! the origin alone: what is left for a segment are four scalar products. Its answer is taken only
//! where rounding can neither change it nor make it differ from the exact test in `triangle.rs`;
//! the few segments left over are given to that test. So nobody can tell which of the two answered.
//!
//! # Bounds
//!
//! With e = 2⁻²⁴; A, B, C the corners less the origin, rounded as the exact test rounds them; M the
//! greatest coordinate among them, E the greatest among the three edge vectors; d a segment's
//! direction, H the greatest coordinate among the directions; s = d / |d|∞. Second-order terms are
//! in the slack between the sums and [`EDGE_ERROR`] and [`DEPTH_ERROR`].
//!
//! *Edges.* The sum m = B + A and the edge f = B − A give the normal m × f = 2 A × B and the value
//! 2w = s · (m × f). Inputs err by e of their size, so the normal by 5 e · 4 M E, which in three
//! terms of the product gives 60 e M E; the product's own roundings give 3 e · 12 M E; the rounding
//! of s along its longest axis 8 e M E. Together **104 e M E**.
//!
//! The exact test's corners are A, B and C sheared along the same s (it rounds the other two
//! components alike) with an error δ of at most 3 e M in each coordinate. If it accepts, the
//! segment's line meets the moved triangle, so its sheared corners are within 2 E + 2 δ of 0, and
//! its edge values differ from exact ones by at most 4 (2 E + 2 δ) δ + 2 δ², doubled
//! **48 e M E + 184 e² M²**. So where two values computed here are beyond
//! τ = [`EDGE_ERROR`] · M (E + 2 e M) on either side of 0, it does not accept. And where all three
//! are beyond τ on one side, exact values have that sign, the line meets the triangle itself, its
//! corners are within 2 E of 0, and the exact test's values have that sign, too.
//!
//! *Depth.* N = (B − A) × (C − A), with components of at most 2 E² that err by 5 e · 2 E². The
//! origin is f = N · A in front of the triangle's plane and the end f − N · d. Computed, they err by
//! 48 e E² M and 48 e E² H, and their difference by 6 e E² (M + H) more. If the exact test accepts
//! the line, the crossing at its parameter t is a mean of the moved corners, so t N · d differs from
//! f by no more than δ in two components, 12 e E² M, and t N · d itself by 8 e E² H through the
//! rounding of s. So with κ = [`DEPTH_ERROR`] · E² (M + H) > 67 e E² (M + H): if both ends are
//! beyond κ on the same side, t is outside (0, 1), and if they are on different sides, inside.
//!
//! Edges shorter than [`LEAST_EDGE`] make products that f32 may not hold to a relative precision:
//! nothing is sure about such a triangle.

use glam::Vec4;

use crate::block::Block;
use crate::lanes::{Lanes, Simd};

/// 192 e, above the sum of 104 e, 48 e and 184 e² / 2 e derived above.
const EDGE_ERROR: f32 = 192.0 / (1 << 24) as f32;

/// 80 e, above 67 e derived above.
const DEPTH_ERROR: f32 = 80.0 / (1 << 24) as f32;

/// The shortest edge with sure answers, in local units. Its square times [`DEPTH_ERROR`] times
/// itself is above 2⁻¹¹⁰, well within the range of normal numbers.
const LEAST_EDGE: f32 = 1.0 / (1 << 30) as f32;

/// Twice the rounding error of a number in [1, 2).
const TWO_E: f32 = 2.0 / (1 << 24) as f32;

/// Sixteen segments from one origin.
#[derive(Clone, Copy)]
pub(super) struct Rays<S: Simd> {
    /// Differences of the ends.
    pub(super) direction: [S::F16; 3],
    /// The same divided by their greatest component.
    unit: [S::F16; 3],
    /// No component of a direction is greater.
    longest: f32,
    /// Each component of `unit` is within `spread` of `middle`.
    middle: [f32; 3],
    spread: [f32; 3],
}

impl<S: Simd> Rays<S> {
    #[inline(always)]
    pub(super) fn of(simd: S, direction: [S::F16; 3]) -> Self {
        let size = direction[0].abs().max(direction[1].abs()).max(direction[2].abs());
        let scale = S::F16::splat(simd, 1.0).div(size);
        let unit = [direction[0].mul(scale), direction[1].mul(scale), direction[2].mul(scale)];
        let (mut middle, mut spread) = ([0.0; 3], [0.0; 3]);
        let mut axis = 0;
        while axis < 3 {
            let (lo, hi) = (unit[axis].least(), unit[axis].greatest());
            middle[axis] = 0.5 * (lo + hi);
            spread[axis] = 0.5 * (hi - lo);
            axis += 1;
        }
        Self { direction, unit, longest: size.greatest(), middle, spread }
    }
}

/// The planes through an origin and the edges of four triangles, and the triangles' own planes.
#[derive(Clone, Copy)]
pub(super) struct Planes {
    /// By edge, then axis.
    edges: [[Vec4; 3]; 3],
    normal: [Vec4; 3],
    /// How far in front of the plane the origin is, in units of the normal.
    front: Vec4,
    edge_error: Vec4,
    /// To be multiplied by M + H.
    depth_error: Vec4,
    /// The greatest coordinate M.
    far: Vec4,
}

/// Which of sixteen segments a triangle blocks, one bit each.
#[derive(Clone, Copy)]
pub(super) struct Verdict {
    /// Not ruled out.
    pub(super) possible: u32,
    /// Blocked for sure; among `possible`.
    pub(super) sure: u32,
}

impl Planes {
    #[inline(always)]
    pub(super) fn of(block: &Block, origin: [f32; 3]) -> Self {
        let o = origin.map(Vec4::splat);
        let [a, b, c] = block.vertices().map(|v| [v[0] - o[0], v[1] - o[1], v[2] - o[2]]);
        let (ab, ac, bc) = (sub(b, a), sub(c, a), sub(c, b));
        let edge_planes = [cross(add(b, a), ab), cross(add(c, b), bc), cross(ac, add(a, c))];
        let normal = cross(ab, ac);
        let front = normal[0] * a[0] + normal[1] * a[1] + normal[2] * a[2];
        let far = greatest(a).max(greatest(b)).max(greatest(c));
        let edge = greatest(ab).max(greatest(ac)).max(greatest(bc));
        let fine = edge.cmplt(Vec4::splat(LEAST_EDGE));
        let unsure = Vec4::INFINITY;
        let edge_error = Vec4::splat(EDGE_ERROR) * far * (edge + Vec4::splat(TWO_E) * far);
        let depth_error = Vec4::splat(DEPTH_ERROR) * edge * edge;
        Self {
            edges: edge_planes,
            normal,
            front,
            edge_error: Vec4::select(fine, unsure, edge_error),
            depth_error: Vec4::select(fine, unsure, depth_error),
            far,
        }
    }

    /// The triangles, one bit each, that some segment of a packet may cross.
    ///
    /// A value n · s is within n · middle ± |n| · spread. Middles and spreads together are at most
    /// 1, so this errs as one scalar product does but for the roundings of the middle, the spread
    /// and the sum, 3 e · 12 M E more: 140 e M E, and 48 e M E for the exact test, are within τ.
    #[inline(always)]
    pub(super) fn candidates<S: Simd>(&self, rays: &Rays<S>) -> u32 {
        let [mx, my, mz] = rays.middle.map(Vec4::splat);
        let [sx, sy, sz] = rays.spread.map(Vec4::splat);
        // How far beyond the three planes all segments are, on one side and on the other.
        let (mut highest, mut lowest) = (Vec4::NEG_INFINITY, Vec4::INFINITY);
        let mut k = 0;
        while k < 3 {
            let [x, y, z] = self.edges[k];
            let value = x * mx + y * my + z * mz;
            let around = x.abs() * sx + y.abs() * sy + z.abs() * sz;
            highest = highest.max(value - around);
            lowest = lowest.min(value + around);
            k += 1;
        }
        !(highest.cmpgt(self.edge_error) & lowest.cmplt(-self.edge_error)).bitmask() & 0xf
    }

    /// Judges the segments in `active` against the triangle in a lane.
    #[inline(always)]
    pub(super) fn judge<S: Simd>(
        &self,
        simd: S,
        lane: usize,
        rays: &Rays<S>,
        active: u32,
    ) -> Verdict {
        let u = dot(simd, &self.edges[0], lane, &rays.unit);
        let v = dot(simd, &self.edges[1], lane, &rays.unit);
        let w = dot(simd, &self.edges[2], lane, &rays.unit);
        let (least, greatest) = (u.min(v).min(w), u.max(v).max(w));
        let error = self.edge_error[lane];
        let (plus, minus) = (S::F16::splat(simd, error), S::F16::splat(simd, -error));
        let possible = active & !(least.lt(minus) & plus.lt(greatest));
        if possible == 0 {
            return Verdict { possible, sure: 0 };
        }
        let front = self.front[lane];
        let beyond = S::F16::splat(simd, front).sub(dot(simd, &self.normal, lane, &rays.direction));
        let error = self.depth_error[lane] * (self.far[lane] + rays.longest);
        let ahead = S::F16::splat(simd, error).lt(beyond);
        let behind = beyond.lt(S::F16::splat(simd, -error));
        let (same, other) = if front > error {
            (ahead, behind)
        } else if front < -error {
            (behind, ahead)
        } else {
            (0, 0)
        };
        let inside = plus.lt(least) | greatest.lt(minus);
        Verdict { possible: possible & !same, sure: possible & other & inside }
    }
}

#[inline(always)]
fn dot<S: Simd>(simd: S, plane: &[Vec4; 3], lane: usize, d: &[S::F16; 3]) -> S::F16 {
    let z = S::F16::splat(simd, plane[2][lane]).mul(d[2]);
    let y = S::F16::splat(simd, plane[1][lane]).mul_add(d[1], z);
    S::F16::splat(simd, plane[0][lane]).mul_add(d[0], y)
}

#[inline(always)]
fn add(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
fn sub(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
fn cross(a: [Vec4; 3], b: [Vec4; 3]) -> [Vec4; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The greatest size of a component.
#[inline(always)]
fn greatest(a: [Vec4; 3]) -> Vec4 {
    a[0].abs().max(a[1].abs()).max(a[2].abs())
}
