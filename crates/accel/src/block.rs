//! Four triangles side by side, tested together.

use glam::{Vec3A, Vec4};

use crate::NO_TRIANGLE;
use crate::frame::LocalTriangle;
use crate::local::LocalSegment;
use crate::triangle::{Crossing, Sheared};

/// Triangles per block.
pub(crate) const LANES: usize = 4;

/// Up to four triangles, one per lane. Empty lanes hold NaN, which no comparison accepts.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Block {
    /// By vertex, then axis.
    vertices: [[Vec4; 3]; 3],
    /// Indices in the input; [`NO_TRIANGLE`] in empty lanes.
    pub(crate) indices: [u32; LANES],
}

impl Block {
    pub(crate) const EMPTY: Self =
        Self { vertices: [[Vec4::NAN; 3]; 3], indices: [NO_TRIANGLE; LANES] };

    /// Packs at most [`LANES`] triangles.
    pub(crate) fn of<'a>(triangles: impl IntoIterator<Item = &'a LocalTriangle>) -> Self {
        let mut block = Self::EMPTY;
        for (lane, triangle) in triangles.into_iter().enumerate() {
            block.indices[lane] = triangle.index;
            for (vertex, position) in triangle.vertices.iter().enumerate() {
                for (axis, coordinate) in position.iter().enumerate() {
                    block.vertices[vertex][axis][lane] = *coordinate;
                }
            }
        }
        block
    }

    /// Packs copies of the triangles at four positions, which may repeat.
    #[inline(always)]
    pub(crate) fn gather(triangles: &[LocalTriangle], positions: [u32; LANES]) -> Self {
        let [a, b, c, d] = positions.map(|position| &triangles[position as usize]);
        let row = |vertex: usize, axis: usize| {
            let pick = |t: &LocalTriangle| t.vertices[vertex][axis];
            Vec4::new(pick(a), pick(b), pick(c), pick(d))
        };
        Self {
            vertices: [0, 1, 2].map(|vertex| [0, 1, 2].map(|axis| row(vertex, axis))),
            indices: [a.index, b.index, c.index, d.index],
        }
    }

    /// The vertices, four triangles to a vector; by vertex, then axis.
    #[inline(always)]
    pub(crate) fn vertices(&self) -> &[[Vec4; 3]; 3] {
        &self.vertices
    }

    /// The corners of the triangle in a lane.
    #[inline]
    pub(crate) fn corners(&self, lane: usize) -> [Vec3A; 3] {
        self.vertices.map(|[x, y, z]| Vec3A::new(x[lane], y[lane], z[lane]))
    }

    /// Whether the triangle in a lane crosses `segment`, which may ignore it.
    pub(crate) fn crosses(&self, lane: usize, segment: &LocalSegment) -> bool {
        let vertices = self.vertices.map(|v| v.map(|axis| axis[lane]));
        Sheared::of(&vertices, segment, |x| x).crosses(segment)
    }

    /// The triangles in this block, as they were packed.
    pub(crate) fn triangles(&self) -> impl Iterator<Item = LocalTriangle> {
        (0..LANES).filter(|&lane| self.indices[lane] != NO_TRIANGLE).map(|lane| LocalTriangle {
            vertices: self.vertices.map(|v| v.map(|axis| axis[lane])),
            index: self.indices[lane],
        })
    }

    /// Whether a triangle that `segment` does not ignore crosses it, by the exact test alone.
    pub(crate) fn crosses_any(&self, segment: &LocalSegment) -> bool {
        let asked = |lane: &usize| !segment.ignores(self.indices[*lane]);
        (0..LANES).filter(asked).any(|lane| self.crosses(lane, segment))
    }

    /// The lane of a triangle that `segment` does not ignore and that crosses it.
    #[inline(always)]
    pub(crate) fn blocking(&self, segment: &LocalSegment) -> Option<usize> {
        let sheared = Sheared::of(&self.vertices, segment, Vec4::splat);
        let verdict = sheared.judge(segment);
        let mut candidates = verdict.possible;
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize & (LANES - 1);
            candidates &= candidates - 1;
            if !segment.ignores(self.indices[lane])
                && (verdict.sure >> lane & 1 == 1 || sheared.lane(lane).crosses(segment))
            {
                return Some(lane);
            }
        }
        None
    }

    /// The triangles as the segment sees them, and those that f32 does not rule out.
    #[inline(always)]
    fn sieve(&self, segment: &LocalSegment) -> (Sheared<Vec4>, u32) {
        let sheared = Sheared::of(&self.vertices, segment, Vec4::splat);
        let [u, v, w] = sheared.edge_functions();
        let (least, greatest) = (u.min(v).min(w), u.max(v).max(w));
        // In an empty lane all three are NaN, hence both extremes, and the lane fails.
        (sheared, (least.cmpge(Vec4::ZERO) | greatest.cmple(Vec4::ZERO)).bitmask())
    }

    /// Every crossing with a triangle that `segment` does not ignore, with the triangle's index.
    #[inline(always)]
    pub(crate) fn crossings(
        &self,
        segment: &LocalSegment,
    ) -> impl Iterator<Item = (u32, Crossing)> {
        let (sheared, mut candidates) = self.sieve(segment);
        std::iter::from_fn(move || {
            while candidates != 0 {
                let lane = candidates.trailing_zeros() as usize;
                candidates &= candidates - 1;
                let index = self.indices[lane];
                if segment.ignores(index) {
                    continue;
                }
                if let Some(crossing) = sheared.lane(lane).crossing(segment) {
                    return Some((index, crossing));
                }
            }
            None
        })
    }
}

/// Which of four triangles a segment crosses, one bit each, as far as f32 tells.
struct Verdict {
    /// Not ruled out.
    possible: u32,
    /// Crossed for sure; among `possible`.
    sure: u32,
}

/// 44 e with e = 2⁻²⁴; see `Sheared::judge`.
const DEPTH_ERROR: f32 = 44.0 / (1 << 24) as f32;

/// Triangles and segments no greater make products that f32 may not hold to a relative precision.
const LEAST_SIZE: f32 = 1.0 / (1 << 30) as f32;

impl Sheared<Vec4> {
    /// Judges four triangles as `Sheared::crosses` judges each, where rounding cannot matter.
    ///
    /// An edge function that is not 0 in f32 has the right sign, since rounding keeps the order of
    /// the two products. Let m be the greatest size among the sheared coordinates of a triangle and
    /// Z that of its coordinates along the segment. Edge functions are sums of products of at most
    /// m² and err by 4 e m²; their sum weighted with coordinates, T, by 12 e m² Z and 24 e m² Z for
    /// its own roundings; D, their sum times the segment's length d, by as much with d for Z. So T
    /// and D − T err by at most 36 e m² (Z + d) and a rounding of the difference, 6 e m² (Z + d),
    /// which is within κ = [`DEPTH_ERROR`] m² (Z + d). The segment is crossed if T and D − T have
    /// the sign of D.
    #[inline(always)]
    fn judge(&self, segment: &LocalSegment) -> Verdict {
        let [u, v, w] = self.edge_functions();
        let (least, greatest) = (u.min(v).min(w), u.max(v).max(w));
        // In an empty lane all three are NaN, hence both extremes, and the lane fails.
        let met = least.cmpge(Vec4::ZERO) | greatest.cmple(Vec4::ZERO);
        if !met.any() {
            return Verdict { possible: 0, sure: 0 };
        }
        let [x, y, z] = [self.x, self.y, self.z];
        let size = |[a, b, c]: [Vec4; 3]| a.abs().max(b.abs()).max(c.abs());
        let along = Vec4::splat(segment.direction[segment.axes.z]);
        let wide = size(x).max(size(y));
        let error = Vec4::splat(DEPTH_ERROR) * (wide * wide) * (size(z) + along.abs());
        let fine = wide.min(along.abs()).cmple(Vec4::splat(LEAST_SIZE));
        let error = Vec4::select(fine, Vec4::INFINITY, error);
        let whole = (u + v + w) * along;
        let depth = u * z[0] + v * z[1] + w * z[2];
        let sign = Vec4::ONE.copysign(whole);
        let (before, after) = (depth * sign, (whole - depth) * sign);
        let nearer = before.min(after);
        let clear = whole.abs().cmpgt(error) & nearer.cmplt(-error);
        let inside = least.cmpgt(Vec4::ZERO) | greatest.cmplt(Vec4::ZERO);
        let sure = inside & nearer.cmpgt(error);
        let possible = met & !clear;
        Verdict { possible: possible.bitmask(), sure: (sure & met).bitmask() }
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> Sheared<f32> {
        let pick = |rows: [Vec4; 3]| rows.map(|row| row[lane]);
        Sheared { x: pick(self.x), y: pick(self.y), z: pick(self.z) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::near_miss::NearMisses;

    #[test]
    fn what_f32_tells_is_what_f64_tells() {
        let mut counts = [0; 4];
        for miss in NearMisses::new().take(400_000) {
            let block = miss.block();
            let Some(segment) = miss.segment() else { continue };
            let verdict = Sheared::of(&block.vertices, &segment, Vec4::splat).judge(&segment);
            let (possible, sure) = (verdict.possible & 1 == 1, verdict.sure & 1 == 1);
            let crosses = block.crosses(0, &segment);
            assert!(possible || !crosses, "{miss:?}");
            assert!(crosses || !sure, "{miss:?}");
            counts[usize::from(possible) + 2 * usize::from(sure)] += 1;
        }
        let [out, unsure, impossible, sure] = counts;
        assert_eq!(impossible, 0);
        assert!([out, unsure, sure].iter().all(|&count| count > 50_000), "{counts:?}");
    }
}
