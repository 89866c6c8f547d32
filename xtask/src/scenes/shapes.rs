//! The solids and sheets that the scenes are built from: quads, grids, boxes, prisms, shells.
//!
//! Fronts face outwards unless the function says otherwise. A face that touches another solid is
//! left out by its owner, so that nothing hidden is written and nothing coincides.

use std::ops::{BitOr, Sub};

use super::mesh::{Point, Shape, add, scale};

/// A set of the six faces of a box.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) struct Faces(u8);

impl Faces {
    pub(crate) const LEFT: Faces = Faces(1); // -x
    pub(crate) const RIGHT: Faces = Faces(2); // +x
    pub(crate) const BOTTOM: Faces = Faces(4); // -y
    pub(crate) const TOP: Faces = Faces(8); // +y
    pub(crate) const BACK: Faces = Faces(16); // -z
    pub(crate) const FRONT: Faces = Faces(32); // +z
    pub(crate) const ALL: Faces = Faces(63);
    /// Of a thing that stands on something.
    pub(crate) const STANDING: Faces = Faces(63 - 4);
    /// Of a thing that hangs from something.
    pub(crate) const HANGING: Faces = Faces(63 - 8);
    /// Of a thing held between a floor and a ceiling: a leg, a shaft.
    pub(crate) const AROUND: Faces = Faces(63 - 4 - 8);

    fn has(self, face: Faces) -> bool {
        self.0 & face.0 != 0
    }
}

impl BitOr for Faces {
    type Output = Faces;
    fn bitor(self, other: Faces) -> Faces {
        Faces(self.0 | other.0)
    }
}

impl Sub for Faces {
    type Output = Faces;
    fn sub(self, other: Faces) -> Faces {
        Faces(self.0 & !other.0)
    }
}

/// A parallelogram of `nu` by `nv` cells from `origin` along `u` and `v`; its front faces u × v.
pub(crate) fn grid(origin: Point, u: Point, v: Point, nu: u32, nv: u32) -> Shape {
    let at = |i: u32, j: u32| {
        let along = scale(u, f64::from(i) / f64::from(nu));
        add(origin, add(along, scale(v, f64::from(j) / f64::from(nv))))
    };
    let cells = (0..nv).flat_map(|j| (0..nu).map(move |i| (i, j)));
    Shape::all(cells.map(|(i, j)| quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])))
}

/// A quadrilateral, counter-clockwise as seen from the front, cut from corner 0 to corner 2.
pub(crate) fn quad([a, b, c, d]: [Point; 4]) -> Shape {
    Shape(vec![[a, b, c], [a, c, d]])
}

/// A convex polygon, counter-clockwise as seen from the front, as a fan about its first corner.
pub(crate) fn polygon(corners: &[Point]) -> Shape {
    Shape(corners[1..].windows(2).map(|pair| [corners[0], pair[0], pair[1]]).collect())
}

/// The surface between two polylines of equally many points. Its front is the side from which
/// a₀ → a₁ → b₁ → b₀ runs counter-clockwise; where both lines share a point the cell is a triangle.
pub(crate) fn ruled(a: &[Point], b: &[Point]) -> Shape {
    assert_eq!(a.len(), b.len(), "both lines of a ruled surface have equally many points");
    let mut shape = Shape::default();
    for i in 1..a.len() {
        let (a0, a1, b0, b1) = (a[i - 1], a[i], b[i - 1], b[i]);
        if a1 != b1 {
            shape.0.push([a0, a1, b1]);
        }
        if a0 != b0 {
            shape.0.push([a0, b1, b0]);
        }
    }
    shape
}

/// A box between two corners.
pub(crate) fn cuboid(min: Point, max: Point, faces: Faces) -> Shape {
    cells(min, max, [1, 1, 1], faces)
}

/// The inside of a box: fronts face inwards, each wall cut into cells along x, y and z.
pub(crate) fn shell(min: Point, max: Point, counts: [u32; 3], faces: Faces) -> Shape {
    cells(min, max, counts, faces).flipped()
}

fn cells(min: Point, max: Point, [nx, ny, nz]: [u32; 3], faces: Faces) -> Shape {
    let x = [max[0] - min[0], 0.0, 0.0];
    let y = [0.0, max[1] - min[1], 0.0];
    let z = [0.0, 0.0, max[2] - min[2]];
    let sides = [
        (Faces::LEFT, grid(min, z, y, nz, ny)),
        (Faces::RIGHT, grid(add(min, x), y, z, ny, nz)),
        (Faces::BOTTOM, grid(min, x, z, nx, nz)),
        (Faces::TOP, grid(add(min, y), z, x, nz, nx)),
        (Faces::BACK, grid(min, y, x, ny, nx)),
        (Faces::FRONT, grid(add(min, z), x, y, nx, ny)),
    ];
    Shape::all(sides.into_iter().filter(|(face, _)| faces.has(*face)).map(|(_, shape)| shape))
}

/// The side faces of an upright regular prism, or frustum, about the y axis; no caps.
pub(crate) fn drum(sides: u32, (y0, r0): (f64, f64), (y1, r1): (f64, f64)) -> Shape {
    ruled(&rim(sides, y0, r0), &rim(sides, y1, r1))
}

/// A regular polygon about the y axis, facing up.
pub(crate) fn disc(sides: u32, y: f64, radius: f64) -> Shape {
    polygon(&rim(sides, y, radius)[..sides as usize]).facing_up()
}

/// An upright tube about the y axis with walls of some thickness: outside, inside and both rims.
pub(crate) fn tube(
    sides: u32,
    (y0, r0): (f64, f64),
    (y1, r1): (f64, f64),
    thickness: f64,
) -> Shape {
    let (low, high) = (rim(sides, y0, r0), rim(sides, y1, r1));
    let (low_in, high_in) = (rim(sides, y0, r0 - thickness), rim(sides, y1, r1 - thickness));
    Shape::all([
        ruled(&low, &high),
        ruled(&high_in, &low_in),
        ruled(&high, &high_in),
        ruled(&low_in, &low),
    ])
}

/// A closed ring of corners at height `y`, the first repeated at the end, with flat sides square
/// to the axes; it runs so that a surface ruled from a lower to a higher rim faces outwards.
fn rim(sides: u32, y: f64, radius: f64) -> Vec<Point> {
    let step = std::f64::consts::TAU / f64::from(sides);
    let corner = |i: u32| {
        let (sin, cos) = (step * (f64::from(i % sides) + 0.5)).sin_cos();
        [radius * cos, y, -radius * sin]
    };
    (0..=sides).map(corner).collect()
}

impl Shape {
    fn facing_up(self) -> Shape {
        let up = |t: &[Point; 3]| {
            let (u, v) = (super::mesh::sub(t[1], t[0]), super::mesh::sub(t[2], t[0]));
            super::mesh::cross(u, v)[1] > 0.0
        };
        if self.0.first().is_some_and(up) { self } else { self.flipped() }
    }
}

#[cfg(test)]
mod tests {
    use super::super::mesh::{Triangle, cross, dot, sub};
    use super::*;

    /// Signed volume by the divergence theorem: positive when fronts face outwards.
    fn volume(shape: &Shape) -> f64 {
        shape.0.iter().map(|t: &Triangle| dot(t[0], cross(t[1], t[2])) / 6.0).sum()
    }

    #[test]
    fn a_cuboid_has_its_volume_and_faces_outwards() {
        let solid = cuboid([1.0, 2.0, 3.0], [3.0, 5.0, 7.0], Faces::ALL);
        assert_eq!(solid.0.len(), 12);
        assert!((volume(&solid) - 24.0).abs() < 1e-12);
        let inside = shell([1.0, 2.0, 3.0], [3.0, 5.0, 7.0], [2, 3, 4], Faces::ALL);
        assert!((volume(&inside) + 24.0).abs() < 1e-12);
    }

    #[test]
    fn a_capped_drum_has_the_volume_of_its_prism() {
        // A regular octagon of circumradius r has the area 2√2 r².
        let low = disc(8, 0.0, 2.0).flipped();
        let solid = Shape::all([drum(8, (0.0, 2.0), (5.0, 2.0)), disc(8, 5.0, 2.0), low]);
        assert!((volume(&solid) - 5.0 * 8.0 * 2.0_f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_tube_has_the_volume_of_its_wall() {
        // Square rims: circumradius r spans the area 2 r².
        let wall = tube(4, (0.0, 3.0), (2.0, 3.0), 1.0);
        assert!((volume(&wall) - 2.0 * (18.0 - 8.0)).abs() < 1e-12);
    }

    #[test]
    fn turning_keeps_handedness_and_length() {
        let turned = Shape(vec![[[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]]).turned(30.0);
        let [a, b, c] = turned.0[0];
        let third = 1.0 / 3.0_f64.sqrt();
        assert!((dot(a, a) - 1.0).abs() < 1e-15);
        let n = cross(sub(b, a), sub(c, a));
        assert!((n[1] / dot(n, n).sqrt() - third).abs() < 1e-12);
    }
}
