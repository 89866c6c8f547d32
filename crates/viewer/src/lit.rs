//! A .glb that this program lit, read back: its elements with their light.
//!
//! `scene_import` reads such a file as a scene to be lit again, and passes over the light. Here the light
//! is all that counts, so the reader takes files in exactly the form that `output` writes, and says of any
//! other what it misses.

mod binary;
mod document;

use glam::{DQuat, DVec3};
use scene::{
    Camera, Face, GroupId, Material, MaterialId, Rgb, Scene, SceneBuilder, Sides, Solution,
    SolutionElement,
};
use serde_json::Value;

use crate::Error;
use binary::{Binary, chunks};
use document::{array, index, text, triple};

/// What a lit file holds.
#[derive(Clone, Debug, PartialEq)]
pub struct Lit {
    /// Each element as a triangle of its own, seen from its lit side.
    pub scene: Scene,
    /// The light of the elements; their own exitance is the mean of their corners, as the file has no other.
    pub solution: Solution,
    /// Display light per exitance, as the file's colours were made.
    pub exposure: f64,
}

/// Reads a .glb that `radiosity solve` wrote.
///
/// # Errors
/// A file that is cut short, is no GLB, or lacks what such files have: `_RADIOSITY` on each primitive, the
/// surfaces in `extras.radiosity` of each material.
pub fn read_glb(bytes: &[u8]) -> Result<Lit, Error> {
    let (json, data) = chunks(bytes)?;
    let root: Value = serde_json::from_slice(json)
        .map_err(|e| Error::new(format!("the JSON chunk: {e}, expected a glTF document")))?;
    let mut reader = Reader {
        root: &root,
        binary: Binary { root: &root, data },
        builder: SceneBuilder::new(),
        materials: Vec::new(),
        offset: DVec3::ZERO,
        solution: Solution::default(),
    };
    reader.materials()?;
    reader.offset()?;
    for (i, node) in array(&root, "nodes").iter().enumerate() {
        let at = format!("nodes[{i}]");
        if node.get("mesh").is_some() {
            reader.group(node, &at)?;
        } else if node.get("camera").is_some() {
            reader.camera(node, &at)?;
        }
    }
    let exposure = root.pointer("/asset/extras/radiosity/exposureScale").and_then(Value::as_f64);
    let exposure = exposure.filter(|scale| scale.is_finite() && *scale > 0.0).ok_or_else(|| {
        Error::new("asset.extras.radiosity.exposureScale: expected a number above 0, as radiosity writes it")
    })?;
    Ok(Lit { scene: reader.builder.finish(), solution: reader.solution, exposure })
}

struct Reader<'a> {
    root: &'a Value,
    binary: Binary<'a>,
    builder: SceneBuilder,
    materials: Vec<MaterialId>,
    /// Added to all positions.
    offset: DVec3,
    solution: Solution,
}

impl Reader<'_> {
    fn materials(&mut self) -> Result<(), Error> {
        for (i, material) in array(self.root, "materials").iter().enumerate() {
            let at = format!("materials[{i}].extras.radiosity");
            let surface = material.pointer("/extras/radiosity").unwrap_or(&Value::Null);
            let sides = match surface.get("sides").and_then(Value::as_str) {
                Some("front") => Sides::Front,
                Some("both") => Sides::Both,
                _ => return Err(Error::new(format!("{at}.sides: expected \"front\" or \"both\""))),
            };
            let id = self.builder.material(Material {
                name: text(material, "name"),
                reflectance: Rgb(triple(surface, "reflectance", &at)?),
                emittance: Rgb(triple(surface, "emittance", &at)?),
                sides,
            });
            self.materials.push(id.map_err(|e| Error::new(e.to_string()))?);
        }
        Ok(())
    }

    /// The one node with children moves the whole scene.
    fn offset(&mut self) -> Result<(), Error> {
        let nodes = array(self.root, "nodes");
        if let Some(i) = nodes.iter().position(|node| node.get("children").is_some()) {
            let at = format!("nodes[{i}]");
            let exact = nodes[i].pointer("/extras/radiosity").unwrap_or(&nodes[i]);
            self.offset = DVec3::from_array(triple(exact, "translation", &at)?);
        }
        Ok(())
    }

    fn group(&mut self, node: &Value, at: &str) -> Result<(), Error> {
        if ["matrix", "translation", "rotation", "scale"].iter().any(|key| node.get(key).is_some())
        {
            let message = "a surface was moved after it was lit, so its light is not its own";
            return Err(Error::new(format!("{at}: {message}")));
        }
        let group = self.builder.group(text(node, "name"));
        let mesh = index(node, "mesh", at)?;
        let found = array(self.root, "meshes").get(mesh);
        let mesh_at = format!("meshes[{mesh}]");
        let found = found.ok_or_else(|| Error::new(format!("{at}: there is no {mesh_at}")))?;
        for (i, primitive) in array(found, "primitives").iter().enumerate() {
            self.primitive(primitive, group, &format!("{mesh_at}.primitives[{i}]"))?;
        }
        Ok(())
    }

    fn primitive(&mut self, primitive: &Value, group: GroupId, at: &str) -> Result<(), Error> {
        let material = index(primitive, "material", at)?;
        let material = *self
            .materials
            .get(material)
            .ok_or_else(|| Error::new(format!("{at}: there is no materials[{material}]")))?;
        let back = primitive.pointer("/extras/radiosity/face").and_then(Value::as_str);
        let face = if back == Some("back") { Face::Back } else { Face::Front };
        let attributes = primitive.get("attributes").unwrap_or(&Value::Null);
        if attributes.get("_RADIOSITY").is_none() {
            let expected = "expected a .glb that `radiosity solve` wrote";
            return Err(Error::new(format!("{at} has no _RADIOSITY: {expected}")));
        }
        let positions = self.binary.triples(index(attributes, "POSITION", at)?)?;
        let light = self.binary.triples(index(attributes, "_RADIOSITY", at)?)?;
        let indices = self.binary.indices(index(primitive, "indices", at)?)?;
        if light.len() != positions.len() {
            return Err(Error::new(format!("{at}: expected as many _RADIOSITY as POSITION")));
        }
        let ids: Vec<_> = positions
            .iter()
            .map(|p| {
                let place = DVec3::from_array(p.map(f64::from)) + self.offset;
                self.solution.vertices.push(place);
                self.builder.vertex(place)
            })
            .collect();
        let (faces, rest) = indices.as_chunks::<3>();
        if !rest.is_empty() {
            return Err(Error::new(format!("{at}: expected three indices a triangle")));
        }
        for face_indices in faces {
            if let Some(i) = face_indices.iter().find(|i| **i as usize >= ids.len()) {
                return Err(Error::new(format!(
                    "{at}: index {i}, expected less than {}",
                    ids.len()
                )));
            }
            let corner_exitance = face_indices.map(|i| Rgb(light[i as usize].map(f64::from)));
            let vertices = face_indices.map(|i| ids[i as usize]);
            let triangle = self.builder.triangle(vertices, material, group);
            self.solution.elements.push(SolutionElement {
                vertices,
                triangle: triangle.map_err(|e| Error::new(format!("{at}: {e}")))?,
                face,
                exitance: corner_exitance.into_iter().sum::<Rgb>() / 3.0,
                corner_exitance,
            });
        }
        Ok(())
    }

    fn camera(&mut self, node: &Value, at: &str) -> Result<(), Error> {
        let number = index(node, "camera", at)?;
        let at_camera = format!("cameras[{number}]");
        let camera = array(self.root, "cameras").get(number);
        let camera = camera.ok_or_else(|| Error::new(format!("{at}: there is no {at_camera}")))?;
        let exact = node.pointer("/extras/radiosity").unwrap_or(node);
        let position = DVec3::from_array(triple(exact, "translation", at)?) + self.offset;
        let turn = exact.get("rotation").and_then(Value::as_array);
        let turn = turn.and_then(|q| q.iter().map(Value::as_f64).collect::<Option<Vec<_>>>());
        let Some(&[x, y, z, w]) = turn.as_deref() else {
            return Err(Error::new(format!("{at}.rotation: expected four numbers")));
        };
        let turn = DQuat::from_xyzw(x, y, z, w);
        let exact = |name: &str| {
            let value =
                camera.pointer("/extras/radiosity").and_then(|ours| ours.get(name)?.as_f64());
            value.ok_or_else(|| {
                Error::new(format!("{at_camera}.extras.radiosity.{name}: expected a number"))
            })
        };
        self.builder.camera(Camera {
            name: text(camera, "name"),
            position,
            target: position + turn * DVec3::NEG_Z * exact("targetDistance")?,
            up: turn * DVec3::Y,
            vertical_fov: exact("yfov")?,
        });
        Ok(())
    }
}
