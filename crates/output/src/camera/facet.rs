//! What the choice of a camera needs to know of a triangle.

use glam::DVec3;
use scene::{Scene, Sides};

/// An input triangle with some area.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facet {
    pub(super) corners: [DVec3; 3],
    pub(super) middle: DVec3,
    /// Unit normal of the front.
    pub(super) normal: DVec3,
    pub(super) area: f64,
    pub(super) both_sides: bool,
    /// Emitted power, all channels, one side.
    pub(super) power: f64,
}

pub(super) fn facets(scene: &Scene) -> Vec<Facet> {
    let facet = |id| {
        let corners: [DVec3; 3] = scene.corners(id);
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).try_normalize()?;
        let area = scene.area(id);
        let material = scene.material_of(id);
        Some(Facet {
            corners,
            middle: (a + b + c) / 3.0,
            normal,
            area,
            both_sides: material.sides == Sides::Both,
            power: area * material.emittance.sum(),
        })
    };
    scene.ids().filter_map(facet).collect()
}
