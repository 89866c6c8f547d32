//! What the project's own GLB files state in `extras.radiosity`, which glTF has no place for
//! or which its readers narrow to f32.

use std::collections::BTreeMap;

use glam::DVec3;
use gltf::Document;
use gltf::json::Extras;
use scene::{Rgb, Sides};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;
use serde_json::value::RawValue;

use crate::assembler::Assembler;
use crate::{DiagnosticKind, Error, ErrorKind};

/// The member of `extras` that is ours.
const KEY: &str = "radiosity";

/// The extras of a document, each read once however often it is used. Malformed ones are
/// warned about and count as absent; numbers that f64 cannot hold are refused.
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
    face: Option<Side>,
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
    pub(super) fn new(
        document: &Document,
        file: &str,
        assembler: &mut Assembler<'_>,
    ) -> Result<Self, Error> {
        let root = document.as_json();
        let meshes = root.meshes.iter().enumerate();
        let mut each = Reading { file, assembler };
        Ok(Self {
            surfaces: each.list("materials", root.materials.iter().map(|m| &m.extras))?,
            faces: meshes
                .map(|(m, mesh)| {
                    let path = format!("meshes[{m}].primitives");
                    each.list(&path, mesh.primitives.iter().map(|p| &p.extras))
                })
                .collect::<Result<_, _>>()?,
            nodes: each.list("nodes", root.nodes.iter().map(|n| &n.extras))?,
            cameras: each.list("cameras", root.cameras.iter().map(|c| &c.extras))?,
        })
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
        self.faces[mesh][primitive].as_ref().is_some_and(|face| face.face == Some(Side::Back))
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

/// What reading needs besides the extras.
struct Reading<'r, 'a> {
    file: &'r str,
    assembler: &'r mut Assembler<'a>,
}

impl Reading<'_, '_> {
    /// What each entry of a list states.
    fn list<'e, T: DeserializeOwned>(
        &mut self,
        path: &str,
        extras: impl Iterator<Item = &'e Extras>,
    ) -> Result<Vec<Option<T>>, Error> {
        let list = extras.enumerate();
        list.map(|(index, extras)| self.entry(extras, || format!("{path}[{index}]"))).collect()
    }

    fn entry<T: DeserializeOwned>(
        &mut self,
        extras: &Extras,
        path: impl Fn() -> String,
    ) -> Result<Option<T>, Error> {
        let Some(ours) = extras.as_ref().and_then(|extras| member(extras.get())) else {
            return Ok(None);
        };
        let value: Value = serde_json::from_str(ours.get()).map_err(|cause| {
            // It is JSON, as all of the file is, so what cannot be read is a number.
            let text = cause.to_string();
            let text = text.split(" at line ").next().unwrap_or_default();
            let message =
                format!("{}.extras.{KEY}: expected numbers that f64 can hold: {text}", path());
            Error::new(ErrorKind::Invalid, self.file, message).because(cause)
        })?;
        match serde_json::from_value(value) {
            Ok(stated) => Ok(Some(stated)),
            Err(cause) => {
                let what = format!("extras.{KEY}: {cause}");
                self.assembler.warn(DiagnosticKind::Ignored { what }, None, path());
                Ok(None)
            }
        }
    }
}

/// Our member of extras. They may be any JSON; those without it are none of ours.
fn member(extras: &str) -> Option<&RawValue> {
    let mut members: BTreeMap<String, &RawValue> = serde_json::from_str(extras).ok()?;
    members.remove(KEY)
}
