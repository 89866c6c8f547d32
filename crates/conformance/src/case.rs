//! A scene whose light is known, read from a JSON file.

use std::collections::BTreeMap;

use scene::{Face, Material, Rgb, Scene, Sides, Solution};
use serde::Deserialize;

use crate::solve::{Engine, ExecutorKind, OccluderKind};
use crate::{Error, Geometry};

/// The surface of all groups that [`Case::surfaces`] does not name.
pub const OTHERS: &str = "*";

/// The files of the folder `cases`, inside the program so that it can run them anywhere.
macro_rules! files {
    ($($id:literal),* $(,)?) => {
        const FILES: &[(&str, &str)] =
            &[$(($id, include_str!(concat!("../cases/", $id, ".json")))),*];
    };
}

files! {
    "concentric_spheres_lamp",
    "concentric_spheres_shell",
    "dark",
    "general_furnace_box",
    "general_furnace_furnished",
    "integrating_sphere_port",
    "two_plates_half",
    "two_plates_two",
    "white_furnace_cube_bright",
    "white_furnace_cube_half",
    "white_furnace_furnished_bright",
    "white_furnace_furnished_half",
    "zero_reflectance",
}

/// A scene whose light is known.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Case {
    /// Its name, which is also its file's.
    pub id: String,
    /// The formula that the expected numbers come from.
    pub law: Law,
    /// Author, year and formula.
    pub source: String,
    /// The triangles.
    pub geometry: Geometry,
    /// Reflectance and emittance by group; [`OTHERS`] stands for all groups not named.
    pub surfaces: BTreeMap<String, Surface>,
    /// About how many elements to split into.
    pub elements: usize,
    /// Stop when unshot power over emitted power is at most this.
    pub unshot: f64,
    /// The light that must come out.
    pub expected: Vec<Expected>,
    /// Largest relative error of an expected number; 0 asks for the very bits.
    pub tolerance: f64,
    /// What bounds the error, and so explains the tolerance.
    pub bound: String,
    /// Engines that do not run the case.
    #[serde(default)]
    pub skips: Vec<Skip>,
}

/// The closed forms that the cases follow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Law {
    /// Closed, and every surface alike: B = E / (1 − ρ).
    WhiteFurnace,
    /// Closed, and E = 1 − ρ on every surface: B = 1.
    GeneralFurnace,
    /// A black lamp and a plate: B = ρ·F·E, with F of opposed squares.
    TwoPlates,
    /// F₁₂ = 1, F₂₁ = (r₁/r₂)², F₂₂ = 1 − F₂₁.
    ConcentricSpheres,
    /// A wall with a black port of area share f: B = E / (1 − ρ(1 − f)).
    IntegratingSphere,
    /// Nothing reflects, or nothing emits: B = E.
    EmittanceAlone,
}

/// How a group takes part.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Surface {
    /// Per channel, in [0, 1].
    pub reflectance: [f64; 3],
    /// Per channel, W·m⁻².
    pub emittance: [f64; 3],
}

/// The light of one group.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Expected {
    /// The group; [`OTHERS`] stands for all groups together.
    pub group: String,
    /// What the number is said of.
    pub of: Part,
    /// Exitance per channel, W·m⁻².
    pub exitance: [f64; 3],
}

/// What an expected number is said of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Part {
    /// The group's area mean.
    Mean,
    /// The area mean of each of its triangles.
    Triangles,
    /// Each of its elements, corners included.
    Elements,
}

/// An engine that does not run a case.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Skip {
    /// `bvh`, `octree`, `brute_force`, `sequential` or `pool`: all engines with that part.
    pub engine: EnginePart,
    /// Why.
    pub reason: String,
}

/// A part that engines have in common.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
#[expect(missing_docs, reason = "the names say it")]
pub enum EnginePart {
    Bvh,
    Octree,
    BruteForce,
    Sequential,
    Pool,
}

impl Case {
    /// One case of this crate, by its id.
    ///
    /// # Errors
    /// If there is no such case.
    pub fn load(id: &str) -> Result<Self, Error> {
        match FILES.iter().find(|(name, _)| *name == id) {
            Some((name, text)) => Self::parse(&format!("cases/{name}.json"), text),
            None => Err(Error::new(id, "expected the id of a case")),
        }
    }

    /// Reads a case from text; `place` names it in messages.
    ///
    /// # Errors
    /// With line and column, if the text is no case.
    pub fn parse(place: &str, text: &str) -> Result<Self, Error> {
        serde_json::from_str(text).map_err(|e| Error::caused(place, e))
    }

    /// The ids of all cases of this crate, in order.
    pub fn ids() -> impl Iterator<Item = &'static str> {
        FILES.iter().map(|(id, _)| *id)
    }

    /// The scene, with a group for each part of the geometry.
    ///
    /// # Errors
    /// If a group has no surface, a surface no group, or the scene refuses a number.
    pub fn scene(&self) -> Result<Scene, Error> {
        let groups = self.geometry.groups()?;
        let known = |name: &str| name == OTHERS || groups.iter().any(|g| g.0 == name);
        let named = self.surfaces.keys().chain(self.expected.iter().map(|e| &e.group));
        if let Some(name) = named.into_iter().find(|name| !known(name)) {
            return Err(Error::new(&self.id, format!("the geometry has no group {name}")));
        }
        self.geometry.scene(|group| {
            let surface = self.surface(group).ok_or_else(|| {
                Error::new(&self.id, format!("expected a surface for group {group}"))
            })?;
            Ok(Material {
                name: group.into(),
                reflectance: Rgb(surface.reflectance),
                emittance: Rgb(surface.emittance),
                sides: Sides::Front,
            })
        })
    }

    /// The surface of a group.
    #[must_use]
    pub fn surface(&self, group: &str) -> Option<&Surface> {
        self.surfaces.get(group).or_else(|| self.surfaces.get(OTHERS))
    }

    /// Why an engine does not run this case; `None` if it does.
    #[must_use]
    pub fn skipped(&self, engine: Engine) -> Option<&str> {
        let has = |part| match part {
            EnginePart::Bvh => engine.occluder == OccluderKind::Bvh,
            EnginePart::Octree => engine.occluder == OccluderKind::Octree,
            EnginePart::BruteForce => engine.occluder == OccluderKind::BruteForce,
            EnginePart::Sequential => engine.executor == ExecutorKind::Sequential,
            EnginePart::Pool => engine.executor != ExecutorKind::Sequential,
        };
        self.skips.iter().find(|s| has(s.engine)).map(|s| s.reason.as_str())
    }

    /// The number of a solution that is furthest from what is expected; anything but 0 where 0
    /// is expected, and what is no number, counts as infinitely wrong.
    #[must_use]
    pub fn worst(&self, scene: &Scene, solution: &Solution) -> Worst<'_> {
        let mut worst: Option<Worst> = None;
        for expected in &self.expected {
            for light in lights(expected, scene, solution) {
                for (ours, exact) in light.0.into_iter().zip(expected.exitance) {
                    let error = relative(ours, exact);
                    if worst.as_ref().is_none_or(|w| error > w.error) {
                        worst = Some(Worst { group: &expected.group, exact, ours, error });
                    }
                }
            }
        }
        worst.unwrap_or(Worst { group: "", exact: 0.0, ours: 0.0, error: 0.0 })
    }

    /// The largest relative error, and of which group; see [`Case::worst`].
    #[must_use]
    pub fn error(&self, scene: &Scene, solution: &Solution) -> (f64, &str) {
        let worst = self.worst(scene, solution);
        (worst.error, if worst.error > 0.0 { worst.group } else { "" })
    }
}

/// An expected number and what came in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Worst<'a> {
    /// Of which group.
    pub group: &'a str,
    /// What was expected.
    pub exact: f64,
    /// What came.
    pub ours: f64,
    /// How far off that is, relative.
    pub error: f64,
}

fn relative(b: f64, exact: f64) -> f64 {
    if b == exact {
        0.0
    } else if exact == 0.0 || b.is_nan() {
        f64::INFINITY
    } else {
        (b / exact - 1.0).abs()
    }
}

/// The light that an expectation speaks of.
fn lights(expected: &Expected, scene: &Scene, solution: &Solution) -> Vec<Rgb> {
    let within = |triangle: usize| {
        let group = scene.triangles()[triangle].group;
        expected.group == OTHERS || scene.groups()[group.index()] == expected.group
    };
    match expected.of {
        Part::Mean => {
            let light = solution.triangle_exitance(scene);
            let mut sums = (Rgb::ZERO, 0.0);
            for id in scene.ids().filter(|id| within(id.index())) {
                let area = scene.area(id);
                sums = (sums.0 + light[id.index()] * area, sums.1 + area);
            }
            vec![sums.0 / sums.1]
        }
        Part::Triangles => {
            let light = solution.triangle_exitance(scene);
            let all = light.into_iter().enumerate();
            all.filter(|(triangle, _)| within(*triangle)).map(|(_, b)| b).collect()
        }
        Part::Elements => {
            let elements = solution.elements.iter();
            let fronts = elements.filter(|e| e.face == Face::Front && within(e.triangle.index()));
            fronts
                .flat_map(|e| {
                    let [a, b, c] = e.corner_exitance;
                    [e.exitance, a, b, c]
                })
                .collect()
        }
    }
}
