//! Random numbers, places, turns and polygons.

use form_factor::Polygon;
use glam::{DQuat, DVec3};
use proptest::prelude::*;

/// A place in the unit cube.
pub(crate) fn place() -> impl Strategy<Value = DVec3> {
    [0.0..1.0, 0.0..1.0, 0.0..1.0f64].prop_map(DVec3::from)
}

/// A direction.
fn direction() -> impl Strategy<Value = DVec3> {
    // From the cylinder around the sphere (Archimedes).
    (-1.0..1.0f64, 0.0..std::f64::consts::TAU).prop_map(|(z, angle)| {
        let r = (1.0 - z * z).sqrt();
        DVec3::new(r * angle.cos(), r * angle.sin(), z)
    })
}

/// A turn about any axis.
pub(crate) fn turn() -> impl Strategy<Value = DQuat> {
    (direction(), 0.0..std::f64::consts::TAU).prop_map(|(axis, a)| DQuat::from_axis_angle(axis, a))
}

/// A triangle of reasonable shape: its area is at least a hundredth of its longest edge squared.
pub(crate) fn triangle() -> impl Strategy<Value = [DVec3; 3]> {
    [place(), place(), place()].prop_filter("a triangle with an area", |[a, b, c]| {
        let longest = a.distance(*b).max(b.distance(*c)).max(c.distance(*a));
        (*b - *a).cross(*c - *a).length() > 0.02 * longest * longest && longest > 0.05
    })
}

/// A convex polygon of three to five corners: points on an ellipse.
fn polygon() -> impl Strategy<Value = Polygon> {
    let corners = (3..6usize, 0.3..1.0f64, 0.0..1.0f64);
    (corners, turn(), place(), 0.05..0.6f64).prop_map(|((n, flat, phase), turn, at, size)| {
        let corner = |i: usize| {
            let angle = std::f64::consts::TAU * (i as f64 + phase) / n as f64;
            at + turn * (DVec3::new(angle.cos(), flat * angle.sin(), 0.0) * size)
        };
        Polygon::new(&(0..n).map(corner).collect::<Vec<_>>()).unwrap()
    })
}

/// Two polygons, each of which has a corner in front of the other.
pub(crate) fn pair() -> impl Strategy<Value = (Polygon, Polygon)> {
    let sees = |a: &Polygon, b: &Polygon| {
        b.corners().iter().any(|c| a.normal().dot(*c - a.corners()[0]) > 0.0)
    };
    (polygon(), polygon())
        .prop_filter("two that see one another", move |(a, b)| sees(a, b) && sees(b, a))
}

/// Triangles that may stand in between.
pub(crate) fn occluders() -> impl Strategy<Value = Vec<[DVec3; 3]>> {
    prop::collection::vec(triangle(), 1..4)
}

/// A polygon turned, scaled and moved.
pub(crate) fn moved(polygon: &Polygon, to: impl Fn(DVec3) -> DVec3) -> Polygon {
    Polygon::new(&polygon.corners().iter().map(|&c| to(c)).collect::<Vec<_>>()).unwrap()
}
