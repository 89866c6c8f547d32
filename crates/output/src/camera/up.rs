//! Which way is up: +y or +z.

use glam::DVec3;

use super::Facet;

/// A surface faces up when its normal is within about 18° of the axis (this cosine):
/// a ramp still counts, a roof does not.
const UPWARD_COSINE: f64 = 0.95;
/// How much of the emission that goes down speaks for an axis, against the area that
/// faces up. Lamps hang from ceilings, but some shine sideways: a quarter lets them
/// decide between the walls and the floor of a box, and not against furniture.
const EMISSION_WEIGHT: f64 = 0.25;

/// The axis along which most area faces up and most emission goes down; +y of equals.
pub(super) fn up(facets: &[Facet]) -> DVec3 {
    let area: f64 = facets.iter().map(|f| f.area).sum();
    let power: f64 = facets.iter().map(|f| f.power).sum();
    let share = |part: f64, whole: f64| if whole > 0.0 { part / whole } else { 0.0 };
    let speaks_for = |axis: DVec3| {
        let upward = |f: &&Facet| f.normal.dot(axis) > UPWARD_COSINE;
        let faces: f64 = facets.iter().filter(upward).map(|f| f.area).sum();
        // What a two-sided lamp sends up and down cancels.
        let one_sided = facets.iter().filter(|f| !f.both_sides);
        let down: f64 = one_sided.map(|f| -f.power * f.normal.dot(axis)).sum();
        share(faces, area) + EMISSION_WEIGHT * share(down, power).max(0.0)
    };
    if speaks_for(DVec3::Z) > speaks_for(DVec3::Y) { DVec3::Z } else { DVec3::Y }
}
