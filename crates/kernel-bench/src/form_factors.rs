//! Kernels of `form-factor`: each estimator where it is used and where it is not, and pairs of
//! triangles from far to touching.
//!
//! Distances are in edges of the triangles, which are all about 1 long.

use form_factor::{
    Occluders, Polygon, between, between_occluded, centroid_kernel, lambert, three_point_kernel,
};
use glam::DVec3;

use crate::count::count;
use crate::random::Random;

/// Points with a triangle each.
const POINTS: usize = 20_000;

/// Pairs of triangles, without and with occluders.
const PAIRS: usize = 1000;
const OCCLUDED: usize = 12;

/// The relative error asked of a pair.
const TOLERANCE: f64 = 1e-2;

/// Beyond ten edges one point of the triangle serves, at a tolerance of 1 %.
const FAR: [f64; 2] = [10.0, 30.0];
/// Beyond two edges, three.
const MIDDLE: [f64; 2] = [2.0, 10.0];
/// Nearer, the exact form.
const NEAR: [f64; 2] = [0.8, 2.0];

pub(crate) fn centroid_far() -> f64 {
    centroid(FAR)
}

pub(crate) fn centroid_near() -> f64 {
    centroid(NEAR)
}

pub(crate) fn three_points_far() -> f64 {
    three_points(MIDDLE)
}

pub(crate) fn three_points_near() -> f64 {
    three_points(NEAR)
}

pub(crate) fn lambert_far() -> f64 {
    exact(FAR, Place::normal)
}

pub(crate) fn lambert_near() -> f64 {
    exact(NEAR, Place::normal)
}

/// The horizon of each point runs through the middle of its triangle.
pub(crate) fn lambert_cut() -> f64 {
    exact(NEAR, Place::across)
}

pub(crate) fn between_far() -> f64 {
    pairs(&apart(FAR))
}

pub(crate) fn between_middle() -> f64 {
    pairs(&apart([3.0, 10.0]))
}

pub(crate) fn between_near() -> f64 {
    pairs(&apart(NEAR))
}

/// Pairs that share an edge, at angles of 30° to 150°.
pub(crate) fn between_touching() -> f64 {
    let mut random = Random(6);
    let touching = |_| {
        let (sin, cos) = (0.5 + 2.0 * random.unit()).sin_cos();
        let [x, y] = [random.unit(), 0.3 + random.unit()];
        let one = [DVec3::ZERO, DVec3::X, DVec3::new(x, y, 0.0)];
        let two = [DVec3::X, DVec3::ZERO, DVec3::new(y, x * cos + cos, sin + x * sin)];
        [one, two].map(|corners| Polygon::triangle(corners).expect("it has an area"))
    };
    pairs(&(0..PAIRS).map(touching).collect::<Vec<_>>())
}

/// Each pair has four triangles of its own around its middle.
pub(crate) fn between_blocked() -> f64 {
    let mut random = Random(7);
    let pairs = &apart([2.0, 4.0])[..OCCLUDED];
    let screens = pairs.iter().map(|[one, two]| {
        let middle = one.corners()[0].midpoint(two.corners()[0]);
        let mut screen = || {
            let at = middle + random.vector() * 0.5;
            [(); 3].map(|()| at + random.vector())
        };
        Occluders::build(&[(); 4].map(|()| screen()))
    });
    let screens: Vec<_> = screens.collect();
    count(|| {
        let all = pairs.iter().zip(&screens);
        all.map(|([a, b], screen)| between_occluded(a, b, screen, TOLERANCE).value).sum()
    })
}

fn centroid(distance: [f64; 2]) -> f64 {
    let places = places(distance);
    count(|| {
        let one = |p: &Place| {
            let centroid = (p.corners[0] + p.corners[1] + p.corners[2]) / 3.0;
            centroid_kernel(DVec3::ZERO, p.normal(), centroid, p.facing, p.area)
        };
        places.iter().map(one).sum()
    })
}

fn three_points(distance: [f64; 2]) -> f64 {
    let places = places(distance);
    count(|| {
        let one =
            |p: &Place| three_point_kernel(DVec3::ZERO, p.normal(), p.corners, p.facing, p.area);
        places.iter().map(one).sum()
    })
}

fn exact(distance: [f64; 2], normal: impl Fn(&Place) -> DVec3) -> f64 {
    let places = places(distance);
    count(|| places.iter().map(|p| lambert(DVec3::ZERO, normal(p), p.corners).form_factor).sum())
}

fn pairs(pairs: &[[Polygon; 2]]) -> f64 {
    count(|| pairs.iter().map(|[a, b]| between(a, b, TOLERANCE).value).sum())
}

/// A triangle as the origin sees it.
struct Place {
    corners: [DVec3; 3],
    /// Its normal, on the origin's side.
    facing: DVec3,
    area: f64,
    /// The directions of the origin's normal: to the triangle, and at right angles.
    to: DVec3,
    across: DVec3,
}

impl Place {
    fn normal(&self) -> DVec3 {
        self.to
    }

    fn across(&self) -> DVec3 {
        self.across
    }
}

/// Triangles at distances between two.
fn places(distance: [f64; 2]) -> Vec<Place> {
    let mut random = Random(8);
    (0..POINTS)
        .map(|_| {
            let to = random.vector().normalize();
            let at = to * between_ends(distance, random.unit());
            let triangle = triangle(&mut random, at, DVec3::ZERO);
            let corners: [DVec3; 3] = triangle.corners().try_into().expect("it is a triangle");
            let to = (corners[0] + corners[1] + corners[2]).normalize();
            Place {
                corners,
                facing: triangle.normal(),
                area: triangle.area(),
                to,
                across: to.any_orthonormal_vector(),
            }
        })
        .collect()
}

/// Pairs that face one another at distances between two.
fn apart(distance: [f64; 2]) -> Vec<[Polygon; 2]> {
    let mut random = Random(9);
    (0..PAIRS)
        .map(|_| {
            let at = random.vector().normalize() * between_ends(distance, random.unit());
            [triangle(&mut random, DVec3::ZERO, at), triangle(&mut random, at, DVec3::ZERO)]
        })
        .collect()
}

fn between_ends([least, most]: [f64; 2], share: f64) -> f64 {
    least + (most - least) * share
}

/// A triangle of edges near 1 around a place, turned towards another place.
fn triangle(random: &mut Random, at: DVec3, towards: DVec3) -> Polygon {
    loop {
        let [p, q, r] = [(); 3].map(|()| at + random.vector());
        // A tenth of an edge squared: no slivers, which are a case of their own.
        let Some(triangle) = Polygon::triangle([p, q, r]).filter(|t| t.area() > 0.1) else {
            continue;
        };
        if triangle.normal().dot(towards - at) > 0.0 {
            return triangle;
        }
        return Polygon::triangle([p, r, q]).expect("it has the same area");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 1 % where each is used, in the sum, and the same things where it is not.
    #[test]
    fn estimators_agree_where_they_are_used() {
        let off = |value: f64, exact: f64| (value / exact - 1.0).abs();
        assert!(off(centroid_far(), lambert_far()) < 1e-2);
        assert!(off(three_points_far(), exact(MIDDLE, Place::normal)) < 1e-2);
        assert!(off(centroid_near(), lambert_near()) < 0.1);
        assert!(off(three_points_near(), lambert_near()) < 0.1);
    }

    /// A horizon through the middle of a triangle leaves less of it than one that spares it.
    #[test]
    fn a_horizon_takes_light() {
        let share = lambert_cut() / lambert_near();
        assert!(share > 0.05 && share < 0.5, "{share}");
    }

    /// The farther, the less light; behind screens less than without.
    #[test]
    fn pairs_exchange_less_where_they_are_far_or_hidden() {
        let [far, middle, near] = [between_far(), between_middle(), between_near()];
        assert!(0.0 < far && far < middle && middle < near && near < PAIRS as f64);
        let clear: f64 =
            apart([2.0, 4.0])[..OCCLUDED].iter().map(|[a, b]| between(a, b, TOLERANCE).value).sum();
        let blocked = between_blocked();
        assert!(0.0 < blocked && blocked < clear && between_touching() > near);
    }
}
