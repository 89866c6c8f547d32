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

    /// Whether a triangle that `segment` does not ignore crosses it.
    #[inline(always)]
    pub(crate) fn blocks(&self, segment: &LocalSegment) -> bool {
        self.blocking(segment).is_some()
    }

    /// The lane of a triangle that `segment` does not ignore and that crosses it.
    #[inline(always)]
    pub(crate) fn blocking(&self, segment: &LocalSegment) -> Option<usize> {
        let (sheared, mut candidates) = self.sieve(segment);
        while candidates != 0 {
            let lane = candidates.trailing_zeros() as usize & (LANES - 1);
            candidates &= candidates - 1;
            if !segment.ignores(self.indices[lane]) && sheared.lane(lane).crosses(segment) {
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

impl Sheared<Vec4> {
    #[inline(always)]
    fn lane(&self, lane: usize) -> Sheared<f32> {
        let pick = |rows: [Vec4; 3]| rows.map(|row| row[lane]);
        Sheared { x: pick(self.x), y: pick(self.y), z: pick(self.z) }
    }
}
