//! Whether a triangle touches a box (Akenine-Möller 2001), cheapest and most decisive tests first.

use glam::DVec3;

/// A triangle with what all boxes it is tested against share.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    vertices: [DVec3; 3],
    lo: DVec3,
    hi: DVec3,
    edges: [DVec3; 3],
    normal: DVec3,
}

impl Candidate {
    pub(super) fn of(vertices: &[[f32; 3]; 3]) -> Self {
        let [a, b, c] = vertices.map(|v| DVec3::from_array(v.map(f64::from)));
        Self {
            vertices: [a, b, c],
            lo: a.min(b).min(c),
            hi: a.max(b).max(c),
            edges: [b - a, c - b, a - c],
            normal: (b - a).cross(c - a),
        }
    }

    /// Whether the triangle and the closed box around `centre` have a point in common.
    ///
    /// A separating axis, if there is one, is among thirteen: three box normals, the triangle's
    /// normal, and nine products of an edge with an axis. The first four reject nearly all, so
    /// they come first. Computed in f64 on f32 vertices: its rounding, about 1e-15, vanishes in the
    /// padding that callers add to `half`.
    pub(super) fn touches(&self, centre: DVec3, half: DVec3) -> bool {
        // Bounds.
        if (self.lo - centre).cmpgt(half).any() || (self.hi - centre).cmplt(-half).any() {
            return false;
        }
        // Plane.
        let distance = self.normal.dot(self.vertices[0] - centre);
        if distance.abs() > self.normal.abs().dot(half) {
            return false;
        }
        // Edges: the axis e × (unit axis) has two components, so the projections are 2D.
        let relative = self.vertices.map(|v| v - centre);
        for (i, edge) in self.edges.iter().enumerate() {
            // The edge's own ends project alike: one of them and the opposite vertex suffice.
            let (end, opposite) = (relative[i], relative[(i + 2) % 3]);
            let e = edge.abs();
            let crosses = |v: DVec3| {
                DVec3::new(
                    edge.y * v.z - edge.z * v.y,
                    edge.z * v.x - edge.x * v.z,
                    edge.x * v.y - edge.y * v.x,
                )
            };
            let (p, q) = (crosses(end), crosses(opposite));
            let radius = DVec3::new(
                e.y * half.z + e.z * half.y,
                e.z * half.x + e.x * half.z,
                e.x * half.y + e.y * half.x,
            );
            if p.min(q).cmpgt(radius).any() || p.max(q).cmplt(-radius).any() {
                return false;
            }
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An independent answer: clips the triangle by the six planes of the box (Sutherland & Hodgman
    /// 1974); what is left is empty if and only if they do not touch.
    fn clipped_is_left(t: &[[f32; 3]; 3], centre: DVec3, half: DVec3) -> bool {
        let mut polygon: Vec<DVec3> =
            t.iter().map(|v| DVec3::from_array(v.map(f64::from)) - centre).collect();
        for axis in 0..3 {
            for sign in [-1.0, 1.0] {
                let inside = |p: DVec3| half[axis] - sign * p[axis];
                let mut kept = Vec::new();
                for (i, &p) in polygon.iter().enumerate() {
                    let q = polygon[(i + 1) % polygon.len()];
                    let (a, b) = (inside(p), inside(q));
                    if a >= 0.0 {
                        kept.push(p);
                    }
                    if (a < 0.0) != (b < 0.0) {
                        kept.push(p + (q - p) * (a / (a - b)));
                    }
                }
                polygon = kept;
            }
        }
        !polygon.is_empty()
    }

    #[test]
    fn agrees_with_clipping() {
        // Weyl's sequence: coordinates in [-1, 1] that repeat from run to run.
        let mut k = 0_u32;
        let mut next = || {
            k = k.wrapping_add(0x9e37_79b9);
            (k >> 8) as f32 / (1 << 23) as f32 - 1.0
        };
        let (mut touching, mut close) = (0, 0);
        let count = 50_000;
        for _ in 0..count {
            let t = [(); 3].map(|()| [next(), next(), next()]);
            let centre = DVec3::new(0.2, -0.1, 0.3);
            let half = DVec3::new(0.3, 0.2, 0.4);
            let candidate = Candidate::of(&t);
            let touches = candidate.touches(centre, half);
            touching += usize::from(touches);
            // Rounding may decide where a hair more or less of box changes the answer.
            let hair = DVec3::splat(1e-9);
            if candidate.touches(centre, half - hair) != candidate.touches(centre, half + hair) {
                close += 1;
            } else {
                assert_eq!(touches, clipped_is_left(&t, centre, half), "{t:?}");
            }
        }
        assert!(touching > count / 10 && touching < count / 2 && close < 10, "{touching} {close}");
    }

    #[test]
    fn a_touch_counts() {
        let floor = Candidate::of(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert!(floor.touches(DVec3::new(0.25, 0.25, 0.5), DVec3::splat(0.5)));
        assert!(floor.touches(DVec3::new(-0.5, -0.5, 0.0), DVec3::splat(0.5)));
        assert!(!floor.touches(DVec3::new(-0.5, -0.5, 0.0), DVec3::splat(0.499)));
    }
}
