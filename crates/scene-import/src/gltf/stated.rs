//! What the project's own GLB files state in `extras.radiosity`, which glTF has no place for
//! or which its readers narrow to f32.

use glam::DVec3;
use gltf::Document;
use gltf::json::Extras;
use scene::{Rgb, Sides};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::DiagnosticKind;
use crate::assembler::Assembler;

/// The member of `extras` that is ours.
const KEY: &str = "radiosity";

/// The extras of a document, each read once however often it is used. Malformed ones are
/// warned about and count as absent.
pub(super) struct Stated {
    surfaces: Vec<Option<Surface>>,
    /// By mesh and primitive.
    faces: Vec<Vec<Option<Face>>>,
    nodes: Vec<Option<Motion>>,
    cameras: Vec<Option<Lens>>,
}

/// A material's values, in the scene's units.
#[derive(Deserialize)]
pub(super) struct Surface {
    reflectance: [f64; 3],
    emittance: [f64; 3],
    sides: Which,
}

#[derive(Deserialize)]
#[serde(rename_all = "lowercase")]
enum Which {
    Front,
    Both,
}

/// The side of a surface that a primitive shows.
#[derive(Deserialize)]
struct Face {
    face: Side,
}

#[derive(Deserialize, PartialEq)]
#[serde(rename_all = "lowercase")]
enum Side {
    Front,
    Back,
}

/// A node's own transform in f64.
#[derive(Deserialize)]
struct Motion {
    translation: Option<[f64; 3]>,
    rotation: Option<[f64; 4]>,
}

/// A camera's numbers in f64.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Lens {
    yfov: Option<f64>,
    target_distance: Option<f64>,
}

impl Stated {
    pub(super) fn new(document: &Document, assembler: &mut Assembler<'_>) -> Self {
        let root = document.as_json();
        let meshes = root.meshes.iter().enumerate();
        Self {
            surfaces: each("materials", root.materials.iter().map(|m| &m.extras), assembler),
            faces: meshes
                .map(|(m, mesh)| {
                    let path = format!("meshes[{m}].primitives");
                    each(&path, mesh.primitives.iter().map(|p| &p.extras), assembler)
                })
                .collect(),
            nodes: each("nodes", root.nodes.iter().map(|n| &n.extras), assembler),
            cameras: each("cameras", root.cameras.iter().map(|c| &c.extras), assembler),
        }
    }

    /// The surface that a material states.
    pub(super) fn surface(&self, material: usize) -> Option<&Surface> {
        self.surfaces[material].as_ref()
    }

    /// Whether every material states its surface.
    pub(super) fn all_surfaces(&self) -> bool {
        self.surfaces.iter().all(Option::is_some)
    }

    /// Whether a primitive shows the back of surfaces whose front is there as well.
    pub(super) fn is_back(&self, mesh: usize, primitive: usize) -> bool {
        self.faces[mesh][primitive].as_ref().is_some_and(|face| face.face == Side::Back)
    }

    /// A node's translation.
    pub(super) fn translation(&self, node: usize, narrow: [f32; 3]) -> [f64; 3] {
        refined(narrow, self.nodes[node].as_ref().and_then(|node| node.translation))
    }

    /// A node's rotation, a quaternion.
    pub(super) fn rotation(&self, node: usize, narrow: [f32; 4]) -> [f64; 4] {
        refined(narrow, self.nodes[node].as_ref().and_then(|node| node.rotation))
    }

    /// A camera's vertical field of view.
    pub(super) fn yfov(&self, camera: usize, narrow: f32) -> f64 {
        let stated = self.cameras[camera].as_ref().and_then(|lens| lens.yfov);
        refined([narrow], stated.map(|yfov| [yfov]))[0]
    }

    /// A camera's target, in the camera's own coordinates, in which it looks along −z.
    pub(super) fn target(&self, camera: usize) -> Option<DVec3> {
        let distance = self.cameras[camera].as_ref()?.target_distance?;
        Some(DVec3::NEG_Z * distance)
    }
}

impl Surface {
    pub(super) fn reflectance(&self) -> Rgb {
        Rgb(self.reflectance)
    }

    pub(super) fn emittance(&self) -> Rgb {
        Rgb(self.emittance)
    }

    pub(super) fn sides(&self) -> Sides {
        match self.sides {
            Which::Front => Sides::Front,
            Which::Both => Sides::Both,
        }
    }
}

/// The stated doubles, unless another program has changed the numbers that they narrow to.
fn refined<const N: usize>(narrow: [f32; N], stated: Option<[f64; N]>) -> [f64; N] {
    stated.filter(|wide| wide.map(|c| c as f32) == narrow).unwrap_or(narrow.map(f64::from))
}

/// What each entry of a list states.
fn each<'e, T: DeserializeOwned>(
    path: &str,
    extras: impl Iterator<Item = &'e Extras>,
    assembler: &mut Assembler<'_>,
) -> Vec<Option<T>> {
    let mut stated = |(index, extras): (usize, &Extras)| match parse(extras.as_ref()?.get()) {
        Ok(ours) => ours,
        Err(cause) => {
            let what = format!("extras.{KEY}: {cause}");
            assembler.warn(DiagnosticKind::Ignored { what }, None, format!("{path}[{index}]"));
            None
        }
    };
    extras.enumerate().map(&mut stated).collect()
}

/// Extras may be any JSON; those without our member are none of ours.
fn parse<T: DeserializeOwned>(extras: &str) -> Result<Option<T>, serde_json::Error> {
    let mut extras: Value = serde_json::from_str(extras)?;
    match extras.get_mut(KEY) {
        Some(ours) => serde_json::from_value(ours.take()).map(Some),
        None => Ok(None),
    }
}
