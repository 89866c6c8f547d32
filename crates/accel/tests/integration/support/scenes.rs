//! Scenes made in code.

use glam::{DVec3, dvec3};

use super::Triangle;
use super::rng::Rng;

/// The two triangles of a quadrilateral given in order around it.
fn quad(a: DVec3, b: DVec3, c: DVec3, d: DVec3) -> [Triangle; 2] {
    [[a, b, c], [a, c, d]]
}

/// The twelve triangles of an axis-parallel box, fronts outward.
pub(crate) fn cuboid(lo: DVec3, hi: DVec3) -> Vec<Triangle> {
    let p = |x: u8, y: u8, z: u8| {
        let pick = |i: u8, lo: f64, hi: f64| if i == 0 { lo } else { hi };
        dvec3(pick(x, lo.x, hi.x), pick(y, lo.y, hi.y), pick(z, lo.z, hi.z))
    };
    [
        quad(p(0, 0, 0), p(0, 0, 1), p(0, 1, 1), p(0, 1, 0)),
        quad(p(1, 0, 0), p(1, 1, 0), p(1, 1, 1), p(1, 0, 1)),
        quad(p(0, 0, 0), p(1, 0, 0), p(1, 0, 1), p(0, 0, 1)),
        quad(p(0, 1, 0), p(0, 1, 1), p(1, 1, 1), p(1, 1, 0)),
        quad(p(0, 0, 0), p(0, 1, 0), p(1, 1, 0), p(1, 0, 0)),
        quad(p(0, 0, 1), p(1, 0, 1), p(1, 1, 1), p(0, 1, 1)),
    ]
    .concat()
}

/// A room of 5 × 4 × 3 m, seen from inside, with a table, four legs and a cupboard, all a
/// centimetre apart: where faces coincide, an end on one lies in the other.
pub(crate) fn room() -> Vec<Triangle> {
    let mut scene: Vec<Triangle> = cuboid(DVec3::ZERO, dvec3(5.0, 4.0, 3.0));
    scene.iter_mut().for_each(|t| t.swap(1, 2)); // fronts inward
    scene.extend(cuboid(dvec3(1.5, 1.2, 0.7), dvec3(3.5, 2.2, 0.75)));
    for (x, y) in [(1.55, 1.25), (3.4, 1.25), (1.55, 2.1), (3.4, 2.1)] {
        scene.extend(cuboid(dvec3(x, y, 0.01), dvec3(x + 0.05, y + 0.05, 0.69)));
    }
    scene.extend(cuboid(dvec3(4.3, 0.5, 0.01), dvec3(4.95, 2.0, 2.1)));
    scene
}

/// A floor, a ceiling and `n` × `n` round columns of `sides` faces between them.
pub(crate) fn columns(n: usize, sides: usize) -> Vec<Triangle> {
    let (size, height, radius) = (n as f64, 2.0, 0.2);
    let mut scene = Vec::new();
    for z in [0.0, height] {
        let at = |x, y| dvec3(x, y, z);
        scene.extend(quad(at(0.0, 0.0), at(size, 0.0), at(size, size), at(0.0, size)));
    }
    for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let rim = |k: usize, z: f64| {
            let (sin, cos) = (std::f64::consts::TAU * (k % sides) as f64 / sides as f64).sin_cos();
            dvec3(i as f64 + 0.5 + radius * cos, j as f64 + 0.5 + radius * sin, z)
        };
        for k in 0..sides {
            scene.extend(quad(rim(k, 0.0), rim(k + 1, 0.0), rim(k + 1, height), rim(k, height)));
        }
    }
    scene
}

/// `count` triangles of random place, shape and a wide range of sizes in a unit cube.
pub(crate) fn soup(count: usize, seed: u64) -> Vec<Triangle> {
    let mut rng = Rng(seed);
    (0..count)
        .map(|_| {
            let centre = rng.point(DVec3::ZERO, DVec3::ONE);
            let size = 0.01 + 0.3 * rng.unit().powi(3);
            [(); 3].map(|()| centre + size * rng.point(DVec3::NEG_ONE, DVec3::ONE))
        })
        .collect()
}

/// A closed sphere of radius 1 around the origin: an octahedron whose faces are cut into `n` × `n`.
/// Neighbours share their vertices' exact coordinates.
pub(crate) fn sphere(n: usize) -> Vec<Triangle> {
    let mut scene = Vec::new();
    for octant in 0..8 {
        let sign = |bit: usize| if octant >> bit & 1 == 1 { 1.0 } else { -1.0 };
        let vertex = |i: usize, j: usize| {
            let k = n - i - j;
            // The zero is the same zero for every octant that has this vertex.
            let c =
                |count: usize, bit: usize| if count == 0 { 0.0 } else { sign(bit) * count as f64 };
            dvec3(c(i, 0), c(j, 1), c(k, 2)).normalize()
        };
        for i in 0..n {
            for j in 0..n - i {
                scene.push([vertex(i, j), vertex(i + 1, j), vertex(i, j + 1)]);
                if i + j + 1 < n {
                    scene.push([vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)]);
                }
            }
        }
    }
    scene
}

/// A closed cube from −1 to 1 whose faces are cut into `n` × `n` quadrilaterals.
pub(crate) fn cube(n: usize) -> Vec<Triangle> {
    let mut scene = Vec::new();
    let coordinate = |i: usize| 2.0 * i as f64 / n as f64 - 1.0;
    for (axis, side) in [(0, -1.0), (0, 1.0), (1, -1.0), (1, 1.0), (2, -1.0), (2, 1.0)] {
        let at = |i: usize, j: usize| {
            let mut p = DVec3::ZERO;
            p[axis] = side;
            p[(axis + 1) % 3] = coordinate(i);
            p[(axis + 2) % 3] = coordinate(j);
            p
        };
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            scene.extend(quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)));
        }
    }
    scene
}

/// The least and greatest corner of all vertices.
pub(crate) fn bounds(scene: &[Triangle]) -> (DVec3, DVec3) {
    scene
        .iter()
        .flatten()
        .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(lo, hi), v| (lo.min(*v), hi.max(*v)))
}
