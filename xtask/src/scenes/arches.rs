//! Masonry: pointed arches, walls with openings, vaults and their ribs.
//!
//! A wall is drawn in its own plane: x to the right, y up, z towards the viewer, front towards
//! the viewer; [`Shape::placed`](super::mesh::Shape::placed) then stands it in the building.

use std::f64::consts::PI;

use super::mesh::{Point, Shape};
use super::shapes::{polygon, quad, ruled};

/// A pointed arch: its feet are at `left` and `right` on the height `spring`.
#[derive(Clone, Copy)]
pub(crate) struct Arch {
    pub(crate) left: f64,
    pub(crate) right: f64,
    pub(crate) spring: f64,
    /// Height of the apex above the spring; at least half the span (then the arch is round).
    pub(crate) rise: f64,
    /// Straight pieces on each side of the apex.
    pub(crate) pieces: u32,
}

/// A hole in a wall as two lines from left to right.
pub(crate) struct Opening {
    pub(crate) upper: Vec<[f64; 2]>,
    pub(crate) lower: Vec<[f64; 2]>,
}

impl Arch {
    /// The arch as points from the left foot over the apex to the right foot.
    pub(crate) fn line(&self) -> Vec<[f64; 2]> {
        let half = (self.right - self.left) / 2.0;
        // The circle about (left + radius, spring) that passes the left foot and the apex.
        let radius = (half * half + self.rise * self.rise) / (2.0 * half);
        let sweep = ((radius - half) / radius).acos();
        let rising = (0..self.pieces).map(|i| {
            let angle = PI - sweep * f64::from(i) / f64::from(self.pieces);
            [self.left + radius * (1.0 + angle.cos()), self.spring + radius * angle.sin()]
        });
        let mut line: Vec<_> = rising.collect();
        line[0] = [self.left, self.spring];
        line.push([self.left + half, self.spring + self.rise]);
        for i in (0..self.pieces as usize).rev() {
            line.push([self.left + self.right - line[i][0], line[i][1]]);
        }
        line
    }

    /// The arch with the same centres whose curve runs `by` further inside.
    pub(crate) fn inset(&self, by: f64) -> Arch {
        let half = (self.right - self.left) / 2.0;
        let radius = (half * half + self.rise * self.rise) / (2.0 * half);
        let rise = ((radius - by).powi(2) - (radius - half).powi(2)).sqrt();
        Arch { left: self.left + by, right: self.right - by, rise, ..*self }
    }

    /// The arch as an opening that starts at height `sill`.
    pub(crate) fn opening(&self, sill: f64) -> Opening {
        Opening { upper: self.line(), lower: vec![[self.left, sill], [self.right, sill]] }
    }
}

impl Opening {
    /// A regular polygon of `4 * quarter` corners.
    pub(crate) fn round(centre: [f64; 2], radius: f64, quarter: u32) -> Opening {
        let [x, y] = centre;
        let arch =
            Arch { left: x - radius, right: x + radius, spring: y, rise: radius, pieces: quarter };
        let upper = arch.line();
        let lower = upper.iter().map(|p| [p[0], 2.0 * y - p[1]]).collect();
        Opening { upper, lower }
    }

    /// The border, clockwise as seen from the front, closed.
    pub(crate) fn border(&self) -> Vec<[f64; 2]> {
        let mut border = self.upper.clone();
        border.extend(self.lower.iter().rev());
        border.push(self.upper[0]);
        border.dedup();
        border
    }

    /// A wall from `low` to `high` around the opening.
    pub(crate) fn wall(&self, low: [f64; 2], high: [f64; 2]) -> Shape {
        let (first, last) = (self.upper[0], self.upper[self.upper.len() - 1]);
        let mut heights = vec![low[1], self.lower[0][1], first[1], high[1]];
        heights.dedup();
        let upright = |x: f64| heights.iter().map(|&y| [x, y, 0.0]).collect::<Vec<_>>();
        let level =
            |line: &[[f64; 2]], y: f64| line.iter().map(|p| [p[0], y, 0.0]).collect::<Vec<_>>();
        let mut shapes = vec![
            ruled(&upright(first[0]), &upright(low[0])),
            ruled(&at(&self.upper, 0.0), &level(&self.upper, high[1])),
            ruled(&upright(high[0]), &upright(last[0])),
        ];
        if self.lower[0][1] > low[1] {
            shapes.push(ruled(&level(&self.lower, low[1]), &at(&self.lower, 0.0)));
        }
        Shape::all(shapes)
    }

    /// The sides of the hole from the wall's face to `back`, the opening at depth `depth`.
    pub(crate) fn reveal(&self, back: &Opening, depth: f64) -> Shape {
        ruled(&at(&back.border(), -depth), &at(&self.border(), 0.0))
    }

    /// What fills the hole at a depth: its front faces the viewer.
    pub(crate) fn pane(&self, depth: f64) -> Shape {
        let mut border = at(&self.border(), -depth);
        border.pop();
        border.reverse();
        polygon(&border)
    }
}

/// Points of a line in the plane z.
pub(crate) fn at(line: &[[f64; 2]], z: f64) -> Vec<Point> {
    line.iter().map(|p| [p[0], p[1], z]).collect()
}

/// A barrel vault along z with its front inside, cut into `cells` along its length.
pub(crate) fn vault(arch: &Arch, from: f64, to: f64, cells: u32) -> Shape {
    let line = arch.line();
    Shape::all((0..cells).map(|i| {
        let z = |i: u32| from + (to - from) * f64::from(i) / f64::from(cells);
        ruled(&at(&line, z(i)), &at(&line, z(i + 1)))
    }))
}

/// A rib under a vault from `from` to `to` along z; what touches the vault is left out.
pub(crate) fn rib(arch: &Arch, depth: f64, from: f64, to: f64) -> Shape {
    let (outer, inner) = (arch.line(), arch.inset(depth).line());
    Shape::all([
        ruled(&at(&inner, from), &at(&inner, to)),
        ruled(&at(&outer, from), &at(&inner, from)),
        ruled(&at(&inner, to), &at(&outer, to)),
    ])
}

/// The wall that closes a vault at `z`, from the floor at `y` = 0 to the vault; it faces +z.
pub(crate) fn end_wall(arch: &Arch, z: f64) -> Shape {
    let (l, r, y) = (arch.left, arch.right, arch.spring);
    Shape::all([quad([[l, 0.0, z], [r, 0.0, z], [r, y, z], [l, y, z]]), lunette(arch, z)])
}

/// The part of an end wall above the spring; it faces +z.
pub(crate) fn lunette(arch: &Arch, z: f64) -> Shape {
    let mut line = at(&arch.line(), z);
    line.reverse();
    polygon(&line)
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTED: Arch = Arch { left: -3.0, right: 3.0, spring: 2.0, rise: 5.0, pieces: 4 };

    #[test]
    fn every_point_of_an_arch_lies_on_one_of_its_two_circles() {
        let radius = (9.0 + 25.0) / 6.0;
        for [x, y] in POINTED.line() {
            let centre = if x <= 0.0 { -3.0 + radius } else { 3.0 - radius };
            assert!(((x - centre).hypot(y - 2.0) - radius).abs() < 1e-12, "{x} {y}");
        }
        assert_eq!(POINTED.line().len(), 9);
    }

    #[test]
    fn an_inset_arch_keeps_its_distance() {
        let (outer, inner) = (POINTED.line(), POINTED.inset(0.5).line());
        // On the crown's sides the two circles share a centre, so the feet are 0.5 apart
        // and the apex is lower by more than 0.5, because the arch is pointed.
        assert!((inner[0][0] - outer[0][0] - 0.5).abs() < 1e-12);
        assert!(outer[4][1] - inner[4][1] > 0.5);
    }

    #[test]
    fn wall_and_pane_together_fill_the_rectangle() {
        let window = POINTED.opening(-1.0);
        let area = |shape: &Shape| -> f64 {
            let cross_z = |t: &[Point; 3]| {
                (t[1][0] - t[0][0]) * (t[2][1] - t[0][1])
                    - (t[1][1] - t[0][1]) * (t[2][0] - t[0][0])
            };
            // Signed: a cell with its back to the viewer would count against the sum.
            shape.0.iter().map(|t| cross_z(t) / 2.0).sum()
        };
        let sum = area(&window.wall([-5.0, -2.0], [5.0, 8.0])) + area(&window.pane(0.0));
        assert!((sum - 100.0).abs() < 1e-12, "{sum}");
    }
}
