//! Which samples a triangle covers, and how its corners weigh in each of them.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::View;

/// A triangle on the sample grid, in front of the eye.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ScreenTriangle {
    /// Samples from the left and from the top.
    at: [DVec2; 3],
    /// 1 / distance along the view: linear across the grid, as nothing else is.
    inverse_depth: [f64; 3],
    /// What the corners carry.
    pub(crate) light: [[f64; 3]; 3],
    /// Twice the area in samples, positive seen from the front.
    area: f64,
}

/// A covered sample.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Hit {
    pub(crate) column: usize,
    pub(crate) row: usize,
    /// Larger is nearer.
    pub(crate) inverse_depth: f64,
    /// Perspective-correct shares of the corners.
    pub(crate) weights: [f64; 3],
}

#[derive(Clone, Copy, Debug, Default)]
struct Corner {
    seen: DVec3,
    light: [f64; 3],
}

impl ScreenTriangle {
    /// Cuts a triangle at the near plane and hands on the one or two pieces that land in
    /// the picture with some area.
    pub(crate) fn project(
        view: &View,
        corners: [DVec3; 3],
        light: [[f64; 3]; 3],
        mut piece: impl FnMut(Self),
    ) {
        let corners = [0, 1, 2].map(|i| Corner { seen: view.seen(corners[i]), light: light[i] });
        let (polygon, count) = cut(corners, view.near);
        for last in 2..count {
            let corners = [polygon[0], polygon[last - 1], polygon[last]];
            let at = corners.map(|c| view.project(c.seen));
            // The grid runs downwards, which turns the winding round.
            let area = -(at[1] - at[0]).perp_dot(at[2] - at[0]);
            let triangle = Self {
                at,
                inverse_depth: corners.map(|c| 1.0 / c.seen.z),
                light: corners.map(|c| c.light),
                area,
            };
            let [columns, rows] = triangle.extent(view);
            // A corner so far aside that it overflows has no finite area either.
            if area.is_finite() && area != 0.0 && !columns.is_empty() && !rows.is_empty() {
                piece(triangle);
            }
        }
    }

    /// Whether the eye sees the front.
    pub(crate) fn faces_the_eye(&self) -> bool {
        self.area > 0.0
    }

    /// The columns and rows whose samples may be covered.
    pub(crate) fn extent(&self, view: &View) -> [Range<usize>; 2] {
        let low = self.at[0].min(self.at[1]).min(self.at[2]);
        let high = self.at[0].max(self.at[1]).max(self.at[2]);
        // Samples lie at the middle of their cells. The casts saturate.
        let range = |low: f64, high: f64, size: u32| {
            (low - 0.5).ceil() as usize..((high + 0.5).floor() as usize).min(size as usize)
        };
        [range(low.x, high.x, view.width), range(low.y, high.y, view.height)]
    }

    /// Visits the covered samples within `rows`. A sample on an edge belongs to the
    /// triangles on both sides of it, so that no gap opens between them.
    pub(crate) fn cover(&self, view: &View, rows: Range<usize>, mut visit: impl FnMut(Hit)) {
        let [columns, own_rows] = self.extent(view);
        let edges = [1, 2, 0].map(|i| Edge::new(self.at[i], self.at[(i + 1) % 3]));
        let turn = -self.area.signum();
        for row in own_rows.start.max(rows.start)..own_rows.end.min(rows.end) {
            for column in columns.clone() {
                let sample = DVec2::new(column as f64 + 0.5, row as f64 + 0.5);
                let sides = edges.map(|edge| turn * edge.side(sample));
                let total = sides[0] + sides[1] + sides[2];
                if sides.iter().any(|s| *s < 0.0) || total <= 0.0 {
                    continue;
                }
                let shares = [0, 1, 2].map(|i| sides[i] * self.inverse_depth[i]);
                let sum = shares[0] + shares[1] + shares[2];
                visit(Hit {
                    column,
                    row,
                    inverse_depth: sum / total,
                    weights: shares.map(|s| s / sum),
                });
            }
        }
    }
}

/// A directed edge whose sides have the same bits, but for the sign, in both directions.
#[derive(Clone, Copy)]
struct Edge {
    from: DVec2,
    along: DVec2,
    sign: f64,
}

impl Edge {
    fn new(from: DVec2, to: DVec2) -> Self {
        if (from.x, from.y) <= (to.x, to.y) {
            Self { from, along: to - from, sign: 1.0 }
        } else {
            Self { from: to, along: from - to, sign: -1.0 }
        }
    }

    fn side(&self, sample: DVec2) -> f64 {
        self.sign * self.along.perp_dot(sample - self.from)
    }
}

/// The part of a triangle beyond the near plane: none or three or four corners.
fn cut(corners: [Corner; 3], near: f64) -> ([Corner; 4], usize) {
    let mut kept = [Corner::default(); 4];
    let mut count = 0;
    let mut keep = |corner| {
        kept[count] = corner;
        count += 1;
    };
    for i in 0..3 {
        let (here, next) = (corners[i], corners[(i + 1) % 3]);
        if here.seen.z >= near {
            keep(here);
        }
        // Always from the kept end, so that neighbours cut their common edge alike.
        match (here.seen.z >= near, next.seen.z >= near) {
            (true, false) => keep(crossing(here, next, near)),
            (false, true) => keep(crossing(next, here, near)),
            _ => {}
        }
    }
    (kept, count)
}

fn crossing(kept: Corner, lost: Corner, near: f64) -> Corner {
    let t = (near - kept.seen.z) / (lost.seen.z - kept.seen.z);
    let mut seen = kept.seen.lerp(lost.seen, t);
    seen.z = near;
    let light = [0, 1, 2].map(|c| kept.light[c] + t * (lost.light[c] - kept.light[c]));
    Corner { seen, light }
}
