//! The watertight triangle test (Woop, Benthin & Wald 2013), which decides every answer: quicker
//! tests (`block.rs`, `bvh/planes.rs`, `bvh/level.rs`) answer only where it would say the same.
//!
//! Vertices are moved so that the segment starts at the origin and sheared so that it runs along
//! its longest axis; the triangle is then crossed if the origin of the plane is inside the
//! projected triangle. A vertex is sheared the same way in whichever triangle it occurs, and the
//! signs of the edge functions are exact for the sheared vertices: f32 rounding keeps the order of
//! two products, and what it does not rule out is computed again in f64, in which products of f32
//! numbers are exact. So two triangles never disagree about a shared edge, and edges and
//! vertices belong to the triangle: nothing leaks between neighbours.
//!
//! The parameter of the crossing is computed in f64 from the exact edge functions, so the crossing
//! lies on the triangle of the sheared vertices to f64 precision. In local units, where coordinates
//! differ by at most 2.07 and with u = 2⁻²³, the subtraction of the start errs by u in each
//! coordinate, which the shear (slopes within [-1, 1]) may add once more; the slope and its product
//! err by 3 u, the last subtraction by u. An accepted crossing is therefore within 6 u <
//! [`HIT_ERROR`] of the narrowed triangle: this is what traversals must be conservative to.

use std::ops::{Mul, Sub};

use crate::local::LocalSegment;

/// How far an accepted crossing may lie from its triangle, in local units; derived above.
pub(crate) const HIT_ERROR: f32 = 1.0 / (1 << 20) as f32;

/// Where a segment crosses a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    /// The parameter along the segment, in (0, 1).
    pub(crate) t: f64,
    /// Whether the front was met.
    pub(crate) front: bool,
}

/// A triangle's vertices relative to a segment; `T` is one f32 or several lanes.
///
/// Indexed by vertex: the sheared coordinates `x`, `y`, and `z` along the longest axis.
#[derive(Clone, Copy)]
pub(crate) struct Sheared<T> {
    pub(crate) x: [T; 3],
    pub(crate) y: [T; 3],
    pub(crate) z: [T; 3],
}

impl<T: Copy + Sub<Output = T> + Mul<Output = T>> Sheared<T> {
    /// Shears `vertices` (by vertex, then axis); `splat` copies a number to every lane.
    #[inline(always)]
    pub(crate) fn of(
        vertices: &[[T; 3]; 3],
        segment: &LocalSegment,
        splat: impl Fn(f32) -> T,
    ) -> Self {
        let axes = segment.axes;
        let origin = |axis: usize| splat(segment.origin[axis]);
        let (ox, oy, oz) = (origin(axes.x), origin(axes.y), origin(axes.z));
        let (sx, sy) = (splat(segment.shear[0]), splat(segment.shear[1]));
        let z = vertices.map(|v| v[axes.z] - oz);
        let x = [0, 1, 2].map(|i| (vertices[i][axes.x] - ox) - sx * z[i]);
        let y = [0, 1, 2].map(|i| (vertices[i][axes.y] - oy) - sy * z[i]);
        Self { x, y, z }
    }

    /// Twice the signed areas of the triangles that the plane's origin makes with each edge;
    /// component i belongs to the edge opposite vertex i.
    #[inline(always)]
    pub(crate) fn edge_functions(&self) -> [T; 3] {
        let Self { x, y, .. } = self;
        [x[2] * y[1] - y[2] * x[1], x[0] * y[2] - y[0] * x[2], x[1] * y[0] - y[1] * x[0]]
    }
}

impl Sheared<f32> {
    /// Decides, in f64, a triangle whose f32 edge functions do not rule it out.
    #[inline]
    pub(crate) fn crossing(&self, segment: &LocalSegment) -> Option<Crossing> {
        let (depth, whole) = self.depth(segment)?;
        let t = depth / whole;
        let front = (whole > 0.0) == (segment.direction[segment.axes.z] > 0.0); // as the sum
        (t > 0.0 && t < 1.0).then_some(Crossing { t, front })
    }

    /// Whether there is a crossing; the same decision without a division.
    ///
    /// A quotient of f64 numbers rounds to 1 or more only if the first is no less than the second,
    /// and these are far from where quotients vanish.
    #[inline(always)]
    pub(crate) fn crosses(&self, segment: &LocalSegment) -> bool {
        let Some((depth, whole)) = self.depth(segment) else { return false };
        let depth = depth * 1.0_f64.copysign(whole);
        depth > 0.0 && depth < whole.abs()
    }

    /// The parameter at which the segment's line crosses the triangle, as a fraction; `None` if it
    /// passes the triangle by.
    #[inline(always)]
    fn depth(&self, segment: &LocalSegment) -> Option<(f64, f64)> {
        let wide = Sheared {
            x: self.x.map(f64::from),
            y: self.y.map(f64::from),
            z: self.z.map(f64::from),
        };
        let [u, v, w] = wide.edge_functions();
        if u.min(v).min(w) < 0.0 && u.max(v).max(w) > 0.0 {
            return None;
        }
        let sum = u + v + w;
        if sum == 0.0 {
            return None; // the triangle is seen edge-on: its neighbours decide
        }
        let depth = u * wide.z[0] + v * wide.z[1] + w * wide.z[2];
        Some((depth, sum * f64::from(segment.direction[segment.axes.z])))
    }
}
