//! Whether a triangle touches a box, in the build, with the techniques of the build as switches.

use glam::{Vec3, Vec3A, Vec4};

use super::switches::Reject;

/// A triangle with what all boxes share.
pub(super) struct Candidate {
    vertices: [Vec3A; 3],
    /// The vertices by axis; the last lane repeats the first vertex.
    lanes: [Vec4; 3],
    lo: Vec3A,
    hi: Vec3A,
    normal: Vec3A,
}

impl Candidate {
    pub(super) fn of(vertices: &[Vec3; 3]) -> Self {
        let [a, b, c] = vertices.map(Vec3A::from);
        Self {
            vertices: [a, b, c],
            lanes: [0, 1, 2].map(|axis| Vec4::new(a[axis], b[axis], c[axis], a[axis])),
            lo: a.min(b).min(c),
            hi: a.max(b).max(c),
            normal: (b - a).cross(c - a),
        }
    }

    /// Whether all of the triangle lies in the box.
    pub(super) fn within(&self, centre: Vec3A, half: f32) -> bool {
        (self.lo - centre).cmpge(Vec3A::splat(-half)).all()
            && (self.hi - centre).cmple(Vec3A::splat(half)).all()
    }

    /// Whether the triangle and a cube have a point in common (Akenine-Möller 2001).
    #[inline(always)]
    pub(super) fn touches(&self, reject: Reject, short: bool, centre: Vec3A, half: f32) -> bool {
        let known = match reject {
            Reject::Nothing => {
                let inside = || self.bounds(centre, half).is_ok();
                return if short {
                    self.plane(centre, half) && self.edges::<true>(centre, half) && inside()
                } else {
                    self.plane(centre, half) & self.edges::<false>(centre, half) & inside()
                };
            }
            Reject::Bounds => self.bounds(centre, half),
            Reject::Outcodes => self.outcodes(centre, half),
            Reject::WideOutcodes => self.wide_outcodes(centre, half),
        };
        match known {
            Err(answer) => answer,
            Ok(()) if short => self.plane(centre, half) && self.edges::<true>(centre, half),
            Ok(()) => self.plane(centre, half) & self.edges::<false>(centre, half),
        }
    }

    /// The answer, if bounds tell it.
    #[inline(always)]
    fn bounds(&self, centre: Vec3A, half: f32) -> Result<(), bool> {
        let half = Vec3A::splat(half);
        let apart = (self.lo - centre).cmpgt(half) | (self.hi - centre).cmplt(-half);
        if apart.any() { Err(false) } else { Ok(()) }
    }

    /// The answer, if outcodes tell it: no, if all vertices lie beyond one face; yes, if one lies
    /// beyond none.
    #[inline(always)]
    fn outcodes(&self, centre: Vec3A, half: f32) -> Result<(), bool> {
        let mut common = 0b11_1111;
        for vertex in self.vertices {
            let p = vertex - centre;
            let mut code = 0;
            for axis in 0..3 {
                if p[axis] < -half {
                    code |= 1 << (2 * axis);
                } else if p[axis] > half {
                    code |= 2 << (2 * axis);
                }
            }
            if code == 0 {
                return Err(true);
            }
            common &= code;
        }
        if common != 0 { Err(false) } else { Ok(()) }
    }

    /// [`Self::outcodes`] with a vertex to a lane.
    #[inline(always)]
    fn wide_outcodes(&self, centre: Vec3A, half: f32) -> Result<(), bool> {
        let (low, high) = (centre - half, centre + half);
        let mut beyond_any = 0;
        let mut all_beyond = false;
        for axis in 0..3 {
            let below = self.lanes[axis].cmplt(Vec4::splat(low[axis])).bitmask();
            let above = self.lanes[axis].cmpgt(Vec4::splat(high[axis])).bitmask();
            all_beyond |= below == 0b1111 || above == 0b1111;
            beyond_any |= below | above;
        }
        if all_beyond {
            Err(false)
        } else if beyond_any != 0b1111 {
            Err(true)
        } else {
            Ok(())
        }
    }

    /// Whether the triangle's plane meets the box.
    #[inline(always)]
    fn plane(&self, centre: Vec3A, half: f32) -> bool {
        let distance = self.normal.dot(self.vertices[0] - centre);
        distance.abs() <= self.normal.abs().element_sum() * half
    }

    /// Whether none of the products of an edge with an axis separates.
    #[inline(always)]
    fn edges<const SHORT: bool>(&self, centre: Vec3A, half: f32) -> bool {
        let relative = self.vertices.map(|v| v - centre);
        let mut touching = true;
        for i in 0..3 {
            let (end, opposite) = (relative[i], relative[(i + 2) % 3]);
            let edge = relative[(i + 1) % 3] - end;
            let (p, q) = (edge.cross(end), edge.cross(opposite));
            let e = edge.abs();
            let radius = Vec3A::new(e.y + e.z, e.z + e.x, e.x + e.y) * half;
            let apart = p.min(q).cmpgt(radius) | p.max(q).cmplt(-radius);
            if SHORT && apart.any() {
                return false;
            }
            touching &= !apart.any();
        }
        touching
    }
}
