//! All segments of a packet at once against the eight boxes of a node.
//!
//! Segments from one origin that all go the same way along some axis lie in a pyramid: their slopes
//! against that axis are within bounds. Three pairs of planes through the origin enclose it, one
//! pair for each two axes, as separating a line from a box needs (Gottschalk, Lin & Manocha 1996),
//! and two planes across the axis at its ends.
//!
//! A box is passed over if it lies outside one of these planes. Computed in f32, with e = 2⁻²⁴,
//! coordinates of at most 1.02, slopes of at most [`STEEPEST`] = 4 and one rounding in each slope
//! (three in that between the two axes across), a plane errs by less than 8.4 e (25 e) for the
//! slope, 9.2 e for its constant and 9.2 e for the side of the box: 44 e at most. A segment that the
//! triangle test accepts passes within [`HIT_ERROR`] = 16 e of the triangle and boxes are padded by
//! four times that (see `BOX_PADDING`), which leaves 48 e: no such box is passed over, not even
//! where a sum is −0 and counts as outside.
//!
//! [`HIT_ERROR`]: crate::triangle::HIT_ERROR

use super::node::Boxes;
use crate::lanes::{Lanes, Simd};

/// The greatest slope of a plane; see above.
const STEEPEST: f32 = 4.0;

/// A pyramid around segments that share their origin.
#[derive(Clone, Copy)]
pub(super) struct Beam<S: Simd> {
    planes: [Plane<S>; 6],
    /// The axis along which all segments advance, and which side of a box they meet first.
    axis: usize,
    near: usize,
    /// Where the segments start and end on the axis, the sign turned so that they advance.
    sign: S::F8,
    start: S::F8,
    end: S::F8,
}

/// Half of space, `side · x[along] ≤ slope · x[base] + constant` in which sides are chosen so that
/// the corner of a box that lies deepest in it is tested.
#[derive(Clone, Copy)]
struct Plane<S: Simd> {
    along: usize,
    base: usize,
    /// 0 if the least coordinate along counts, 1 if the greatest.
    side: usize,
    base_side: usize,
    slope: S::F8,
    constant: S::F8,
    sign: S::F8,
}

/// The least and greatest component of all directions, by axis.
#[derive(Clone, Copy)]
pub(super) struct Extremes {
    pub(super) lo: [f32; 3],
    pub(super) hi: [f32; 3],
}

impl Extremes {
    /// The axis along which all directions go the same way, as far as possible from sideways;
    /// `None` if there is none or if a slope against it could be too steep.
    #[inline(always)]
    pub(super) fn axis(&self) -> Option<usize> {
        let mut best = (0.0, 0);
        for axis in 0..3 {
            let least = if self.lo[axis] > 0.0 {
                self.lo[axis]
            } else if self.hi[axis] < 0.0 {
                -self.hi[axis]
            } else {
                0.0
            };
            if least > best.0 {
                best = (least, axis);
            }
        }
        (best.0 > 0.0).then_some(best.1)
    }
}

impl<S: Simd> Beam<S> {
    /// The pyramid with slopes within `lo` and `hi` against `axis`, in cyclic order from the next
    /// axis; `None` if it is too wide.
    #[inline(always)]
    pub(super) fn new(
        simd: S,
        origin: [f32; 3],
        axis: usize,
        (lo, hi): ([f32; 2], [f32; 2]),
        ends: &Extremes,
    ) -> Option<Self> {
        let forward = ends.lo[axis] > 0.0;
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let steep = lo[0].min(lo[1]).min(-hi[0]).min(-hi[1]);
        if steep.is_nan() || steep < -STEEPEST {
            return None;
        }
        let plane = |along, base, slope, upper| Plane::new(simd, origin, along, base, slope, upper);
        // Against the axis the greater slope bounds from above, unless the axis is run backwards.
        let (below, above) = if forward { (lo, hi) } else { (hi, lo) };
        let [c, d] = cone(simd, origin, [u, v], forward, (lo, hi));
        let planes = [
            plane(u, axis, below[0], false),
            plane(u, axis, above[0], true),
            plane(v, axis, below[1], false),
            plane(v, axis, above[1], true),
            c,
            d,
        ];
        let o = origin[axis];
        let (sign, reach) = if forward { (1.0, ends.hi[axis]) } else { (-1.0, -ends.lo[axis]) };
        let splat = S::F8::splat;
        Some(Self {
            planes,
            axis,
            near: usize::from(!forward),
            sign: splat(simd, sign),
            start: splat(simd, sign * o),
            end: splat(simd, sign * o + reach),
        })
    }

    /// The lanes whose boxes may be met.
    #[inline(always)]
    pub(super) fn meets(&self, simd: S, boxes: &Boxes) -> u32 {
        let near = S::F8::load(simd, &boxes.bounds[self.axis][self.near & 1]).mul(self.sign);
        let far = S::F8::load(simd, &boxes.bounds[self.axis][self.near & 1 ^ 1]).mul(self.sign);
        let mut room = self.end.sub(near).either_negative(far.sub(self.start));
        let mut i = 0;
        while i < 6 {
            room = room.either_negative(self.planes[i].room(simd, boxes));
            i += 1;
        }
        0xff ^ room.negative()
    }
}

/// The pair of planes for the two axes across the beam: the slope of one against the other, if the
/// beam keeps clear of both being 0; planes that hold everything otherwise.
#[inline(always)]
fn cone<S: Simd>(
    simd: S,
    origin: [f32; 3],
    [u, v]: [usize; 2],
    forward: bool,
    (lo, hi): ([f32; 2], [f32; 2]),
) -> [Plane<S>; 2] {
    let clear = |i: usize| if lo[i] > 0.0 { lo[i] } else { -hi[i] };
    let (base, along) = if clear(0) >= clear(1) { (0, 1) } else { (1, 0) };
    if clear(base) > 0.0 {
        // Slopes of the four corners of the rectangle.
        let (a, b) = (lo[along] / lo[base], lo[along] / hi[base]);
        let (c, d) = (hi[along] / lo[base], hi[along] / hi[base]);
        let (least, greatest) = (a.min(b).min(c.min(d)), a.max(b).max(c.max(d)));
        if -least.min(-greatest) <= STEEPEST {
            let onward = (lo[base] > 0.0) == forward;
            let (below, above) = if onward { (least, greatest) } else { (greatest, least) };
            let (along, base) = ([u, v][along], [u, v][base]);
            return [
                Plane::new(simd, origin, along, base, below, false),
                Plane::new(simd, origin, along, base, above, true),
            ];
        }
    }
    [Plane::everything(simd), Plane::everything(simd)]
}

impl<S: Simd> Plane<S> {
    /// What lies below (`upper`) or above the plane through the origin with a slope.
    #[inline(always)]
    fn new(simd: S, origin: [f32; 3], along: usize, base: usize, slope: f32, upper: bool) -> Self {
        let constant = origin[along] - slope * origin[base];
        let splat = S::F8::splat;
        let rising = slope > 0.0;
        // Below: least coordinate along ≤ slope · (base side that raises the bound) + constant.
        let sign = if upper { 1.0 } else { -1.0 };
        Self {
            along,
            base,
            side: usize::from(!upper),
            base_side: usize::from(rising == upper),
            slope: splat(simd, sign * slope),
            constant: splat(simd, sign * constant),
            sign: splat(simd, -sign),
        }
    }

    #[inline(always)]
    fn everything(simd: S) -> Self {
        let mut plane = Self::new(simd, [0.0; 3], 0, 0, 0.0, true);
        plane.constant = S::F8::splat(simd, f32::INFINITY);
        plane.sign = S::F8::splat(simd, 0.0);
        plane
    }

    /// How deep the boxes reach into the half space; negative outside.
    #[inline(always)]
    fn room(&self, simd: S, boxes: &Boxes) -> S::F8 {
        let base = S::F8::load(simd, &boxes.bounds[self.base][self.base_side & 1]);
        let along = S::F8::load(simd, &boxes.bounds[self.along][self.side & 1]);
        along.mul_add(self.sign, base.mul_add(self.slope, self.constant))
    }
}
