//! Rooms whose light has a published formula, in the manner of CIE 171:2006.
//!
//! That report, "Test cases to assess the accuracy of lighting computer programs", is for sale, and what is
//! here was not copied from it: rooms and measures are ours, formulas come from the sources named beside
//! them, and a case is "after" the report in its subject alone. Of its test cases 5.7, 5.8 and 5.11
//! Ashdown's public errata say more (CIE 171:2006 errata, Lighting Analysts, 2016).

mod area_source;
mod closed_room;
mod obstruction;
mod opening;

use accel::{Bvh, BvhConfig};
use glam::DVec3;
use radiosity_core::{
    Asked, Needs, Probe, RefineConfig, Refined, Sequential, ShootingConfig, refine,
};
use scene::{GroupId, Material, Rgb, Scene, SceneBuilder, Sides};

use crate::Error;

/// What one form factor may be off by: the tolerance that the solver is asked for.
const FORM_FACTOR: f64 = 1e-2;

/// Cells of a shooter are split until one brings no more than this share of the scene's mean irradiance:
/// the solver's own choice.
const COARSE: f64 = 0.05;

/// As good as nothing: every element is then split as far as the solver does, into cells of a quarter
/// of its width. Each is seen wholly or not at all.
const FINE: f64 = 1e-12;

/// How much narrower than an element its finest cells are.
const FINEST: f64 = 0.25;

/// Unshot share at which the solver stops, far below all tolerances.
const UNSHOT: f64 = 1e-7;

/// A number of a formula, and the solver's.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The case.
    pub case: &'static str,
    /// The formula's author, year and number.
    pub source: &'static str,
    /// What is compared, where.
    pub place: String,
    /// By the formula: irradiance, W·m⁻².
    pub expected: f64,
    /// By the solver.
    pub got: f64,
    /// How far the two may be apart, as a share of what is expected.
    pub tolerance: f64,
}

impl Comparison {
    /// How far they are apart, as a share of what is expected.
    #[must_use]
    pub fn error(&self) -> f64 {
        (self.got - self.expected).abs() / self.expected
    }
}

/// All cases, each computed anew: seconds in the development profile.
///
/// # Errors
/// If a scene cannot be built, which a test excludes.
pub fn comparisons() -> Result<Vec<Comparison>, Error> {
    let cases = [
        area_source::comparisons()?,
        obstruction::comparisons()?,
        closed_room::comparisons()?,
        opening::comparisons()?,
    ];
    Ok(cases.concat())
}

/// The sky through a roof opening without what [`comparisons`] does for it: one rectangle for a sky, and
/// cells of the solver's own choice. No test holds it to its tolerance, which it misses: it shows what
/// is weak (docs/numerics.md).
///
/// # Errors
/// As for [`comparisons`].
pub fn weak() -> Result<Vec<Comparison>, Error> {
    opening::as_drawn()
}

/// A scene of rectangles in the making.
struct Room {
    builder: SceneBuilder,
}

impl Room {
    fn new() -> Self {
        let mut builder = SceneBuilder::new();
        builder.group("room");
        Self { builder }
    }

    /// Adds a rectangle from a corner and two sides; its front is where `u` × `v` points.
    fn rectangle(
        &mut self,
        sides: [DVec3; 3],
        reflectance: f64,
        emittance: f64,
    ) -> Result<(), Error> {
        self.grid(sides, [1, 1], reflectance, emittance)
    }

    /// The same as a grid of so many cells along its two sides.
    fn grid(
        &mut self,
        [corner, u, v]: [DVec3; 3],
        [columns, rows]: [u32; 2],
        reflectance: f64,
        emittance: f64,
    ) -> Result<(), Error> {
        let refused = |error| Error::caused("rectangle", error);
        let material = Material {
            name: format!("reflects {reflectance}, emits {emittance}"),
            reflectance: Rgb::splat(reflectance),
            emittance: Rgb::splat(emittance),
            sides: Sides::Front,
        };
        let material = self.builder.material(material).map_err(refused)?;
        let (u, v) = (u / f64::from(columns), v / f64::from(rows));
        for row in 0..rows {
            for column in 0..columns {
                let at = corner + u * f64::from(column) + v * f64::from(row);
                let [a, b, c, d] = [at, at + u, at + u + v, at + v].map(|p| self.builder.vertex(p));
                for triangle in [[a, b, c], [a, c, d]] {
                    self.builder.triangle(triangle, material, GroupId(0)).map_err(refused)?;
                }
            }
        }
        Ok(())
    }

    /// Adds the walls of a black box, seen from inside, but for its ceiling.
    fn black_walls(&mut self, low: DVec3, high: DVec3) -> Result<(), Error> {
        let [x, y, z] = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| axis * (high - low));
        for sides in [[low, x, y], [low, y, z], [low, z, x], [high, -z, -y], [high, -x, -z]] {
            self.rectangle(sides, 0.0, 0.0)?;
        }
        Ok(())
    }

    fn finish(self) -> Scene {
        self.builder.finish()
    }
}

/// The light on a mesh of about so many elements, no fewer than there are triangles, and at places in the
/// open, in cells of this share.
fn light(scene: &Scene, elements: usize, cell_share: f64, places: &[(DVec3, DVec3)]) -> Refined {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::DEFAULT);
    let needs = Needs { black: false, ..Needs::EVERYTHING };
    let config = ShootingConfig {
        needs,
        tolerance: FORM_FACTOR,
        cell_share,
        ..ShootingConfig::until(UNSHOT)
    };
    let refining = RefineConfig::until(Asked::Unstated(elements));
    let free = |&(position, normal): &(DVec3, DVec3)| Probe::Free { position, normal };
    let probes: Vec<_> = places.iter().map(free).collect();
    refine(scene, &bvh, &bvh, &Sequential, config, refining, &probes, &mut ())
}

/// A place as a table shows it.
fn named(what: &str, place: DVec3) -> String {
    format!("{what} ({}, {}, {})", place.x, place.y, place.z)
}
