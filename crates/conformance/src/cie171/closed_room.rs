//! Light that goes round in a closed room of one reflectance: its indirect part.
//!
//! After the test cases of CIE 171:2006 for the internally reflected component, whose room is a cube
//! of 4 m. With a flux Φ, a surface S and a reflectance ρ the indirect irradiance is
//! Φ/S · ρ/(1 − ρ): on average in any closed room, and everywhere in a sphere.

use scene::{Material, Rgb, Scene, Sides};

use super::{COARSE, Comparison, FORM_FACTOR, light};
use crate::{Error, Geometry};

const CUBE: &str = "closed cube, average";
const SPHERE: &str = "closed sphere, worst facet";
const IN_A_CUBE: &str = "energy balance; Ashdown 2016, test case 5.8";
const IN_A_SPHERE: &str = "Gigahertz-Optik, ideal integrating sphere, 6.1";

const EXITANCE: f64 = 1000.0;

pub(super) fn comparisons() -> Result<Vec<Comparison>, Error> {
    let mut all = Vec::new();
    for reflectance in [0.2, 0.5, 0.8, 0.95] {
        all.push(cube(reflectance)?);
    }
    for reflectance in [0.5, 0.8] {
        all.push(sphere(reflectance)?);
    }
    Ok(all)
}

/// A closed scene in which one group emits, its flux, and its area.
fn closed(geometry: &Geometry, lamp: &str, reflectance: f64) -> Result<(Scene, f64, f64), Error> {
    let scene = geometry.scene(|group| {
        Ok(Material {
            name: group.to_owned(),
            reflectance: Rgb::splat(reflectance),
            emittance: Rgb::splat(if group == lamp { EXITANCE } else { 0.0 }),
            sides: Sides::Front,
        })
    })?;
    let area: f64 = scene.ids().map(|id| scene.area(id)).sum();
    let flux = scene.ids().map(|id| scene.area(id) * scene.material_of(id).emittance[0]).sum();
    Ok((scene, flux, area))
}

/// A cube of 4 with a lamp of 0.2 free in its middle, of the same reflectance: the balance of the
/// whole scene is then exact.
fn cube(reflectance: f64) -> Result<Comparison, Error> {
    let geometry = Geometry::Furnished { size: [4.0; 3], low: [1.9; 3], high: [2.1; 3] };
    let (scene, flux, area) = closed(&geometry, "inner", reflectance)?;
    let lit = light(&scene, 1000, COARSE, &[]);
    let solution = &lit.solution;
    let received = |e: &scene::SolutionElement| {
        let emitted = scene.material_of(e.triangle).emittance;
        solution.area(e) * (e.exitance - emitted)[0] / reflectance
    };
    let arrives: f64 = solution.elements.iter().map(received).sum();
    Ok(Comparison {
        case: CUBE,
        source: IN_A_CUBE,
        place: format!("reflectance {reflectance}"),
        expected: flux / area * reflectance / (1.0 - reflectance),
        got: (arrives - flux) / area,
        // Rows that sum to 1 + δ give 1 / (1 − ρ(1 + δ)) of the light, and that counts in full where
        // only a ρth of it is compared.
        tolerance: FORM_FACTOR / (reflectance * (1.0 - reflectance)),
    })
}

/// A sphere of 1280 facets, a twentieth of which shines.
fn sphere(reflectance: f64) -> Result<Comparison, Error> {
    let geometry = Geometry::IntegratingSphere { level: 3, port_faces: 1 };
    let (scene, flux, area) = closed(&geometry, "port", reflectance)?;
    let lit = light(&scene, 1280, COARSE, &[]);
    let exitance = lit.solution.triangle_exitance(&scene);
    let dark = scene.ids().filter(|id| !scene.material_of(*id).emits());
    let direct = flux / area;
    let expected = direct * reflectance / (1.0 - reflectance);
    let indirect = dark.map(|id| exitance[id.index()][0] / reflectance - direct);
    let off = |e: f64| (e - expected).abs();
    let worst = indirect.fold(expected, |worst, e| if off(e) > off(worst) { e } else { worst });
    Ok(Comparison {
        case: SPHERE,
        source: IN_A_SPHERE,
        place: format!("reflectance {reflectance}"),
        expected,
        got: worst,
        // As for the cube, and a facet lies within the sphere by the square of its angle.
        tolerance: (FORM_FACTOR + facet_angle(&scene).powi(2))
            / (reflectance * (1.0 - reflectance)),
    })
}

/// The largest angle, radians, between the middle of a facet and one of its corners.
fn facet_angle(scene: &Scene) -> f64 {
    let of = |corners: [glam::DVec3; 3]| {
        let middle = (corners[0] + corners[1] + corners[2]) / 3.0;
        corners.map(|p| p.angle_between(middle)).into_iter().fold(0.0, f64::max)
    };
    scene.ids().map(|id| of(scene.corners(id))).fold(0.0, f64::max)
}
