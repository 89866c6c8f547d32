//! The hull of two boxes, as planes that what is between them lies behind (Haines & Wallace 1991,
//! "Shaft culling for efficient ray-traced radiosity").

use glam::DVec3;

/// All that lies between two boxes.
pub(super) struct Shaft {
    low: DVec3,
    high: DVec3,
    /// Outward normals and offsets, of which the first `count` are in use.
    planes: [(DVec3, f64); 6],
    count: usize,
}

impl Shaft {
    /// Between a box and another.
    pub(super) fn between(a: [DVec3; 2], b: [DVec3; 2]) -> Self {
        let mut shaft = Self {
            low: a[0].min(b[0]),
            high: a[1].max(b[1]),
            planes: [(DVec3::ZERO, 0.0); 6],
            count: 0,
        };
        // Along each axis the boxes are two rectangles; their hull has at most two edges that join
        // like corners of both.
        for (u, v) in [(0, 1), (1, 2), (2, 0)] {
            for (high_u, high_v) in [(0, 0), (1, 0), (0, 1), (1, 1)] {
                let (au, av) = (a[high_u][u], a[high_v][v]);
                let (du, dv) = (b[high_u][u] - au, b[high_v][v] - av);
                let outward = |x: f64, high: usize| if high == 1 { x > 0.0 } else { x < 0.0 };
                for (nu, nv) in [(dv, -du), (-dv, du)] {
                    if outward(nu, high_u) && outward(nv, high_v) && shaft.count < 6 {
                        let mut normal = DVec3::ZERO;
                        (normal[u], normal[v]) = (nu, nv);
                        shaft.planes[shaft.count] = (normal, nu * au + nv * av);
                        shaft.count += 1;
                    }
                }
            }
        }
        shaft
    }

    /// Whether a box lies outside.
    pub(super) fn misses(&self, low: DVec3, high: DVec3) -> bool {
        low.cmpgt(self.high).any()
            || high.cmplt(self.low).any()
            || self.planes[..self.count]
                .iter()
                .any(|(normal, offset)| (*normal * low).min(*normal * high).element_sum() > *offset)
    }
}

#[cfg(test)]
mod tests {
    use glam::dvec3;

    use super::*;

    #[test]
    fn what_lies_beside_the_way_between_two_boxes_is_missed() {
        // From a unit box at the origin to one ten units along the diagonal.
        let unit = |at: DVec3| [at, at + DVec3::ONE];
        let shaft = Shaft::between(unit(DVec3::ZERO), unit(DVec3::splat(10.0)));
        let misses = |at| shaft.misses(unit(at)[0], unit(at)[1]);
        assert!(!misses(DVec3::splat(5.0)) && !misses(DVec3::ZERO));
        assert!(!misses(dvec3(6.5, 5.0, 5.0)), "its corner (6.5, 6, 6) is within");
        assert!(misses(dvec3(8.0, 2.0, 5.0)), "within the bounds of both, beside the diagonal");
        assert!(misses(DVec3::splat(-1.5)) && misses(dvec3(5.0, 5.0, 11.5)));
    }

    #[test]
    fn nothing_on_the_way_is_missed() {
        // Points of segments between random places of two boxes.
        let mut state = 1u64;
        let mut random = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 53) as f64
        };
        let mut point = || dvec3(random(), random(), random());
        for _ in 0..200 {
            let mut a_box = || {
                let (p, q) = (point() * 4.0, point());
                [p, p + q]
            };
            let (a, b) = (a_box(), a_box());
            let shaft = Shaft::between(a, b);
            for _ in 0..50 {
                let p = a[0] + (a[1] - a[0]) * point();
                let q = b[0] + (b[1] - b[0]) * point();
                let on_the_way = p.lerp(q, point().x);
                assert!(!shaft.misses(on_the_way - 1e-12, on_the_way + 1e-12));
            }
        }
    }
}
