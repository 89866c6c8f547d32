//! The JSON half: who is who, and where in the binary half the numbers lie.

use glam::{DMat3, DQuat, DVec3};
use scene::{Camera, Face, Material, Scene, Sides};
use serde_json::{Map, Value, json};

use super::buffer::{Geometry, Primitive, SECTIONS};
use crate::basis::basis;
use crate::{Error, ErrorKind};

const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
/// Viewers clip what is nearer to the eye than this share of the distance to the target:
/// near enough to lose no wall, far enough for a 24-bit depth buffer.
const NEAR_SHARE: f64 = 1e-3;

/// The program that wrote the file.
pub(crate) const GENERATOR: &str = concat!("radiosity ", env!("CARGO_PKG_VERSION"));

/// What glTF has no place for, under a name that no other program uses.
fn extras(ours: Value) -> Value {
    json!({ "radiosity": ours })
}

/// Builds the glTF document of a scene whose numbers lie in `geometry`.
pub(crate) fn build(scene: &Scene, geometry: &Geometry, scale: f64) -> Result<Value, Error> {
    let mut root = Map::new();
    let mut put = |name: &str, value: Vec<Value>| {
        // The format forbids empty arrays.
        if !value.is_empty() {
            root.insert(name.to_owned(), Value::Array(value));
        }
    };
    let nodes = nodes(scene, geometry)?;
    // A scene must have nodes, so without any there is none.
    let roots = nodes.roots;
    let scenes = if roots.is_empty() { vec![] } else { vec![json!({ "nodes": roots })] };
    let shown = !scenes.is_empty();
    put("scenes", scenes);
    put("nodes", nodes.list);
    put("meshes", nodes.meshes);
    put("materials", scene.materials().iter().map(material).collect());
    put("cameras", scene.cameras().iter().map(camera).collect());
    put("accessors", geometry.primitives.iter().flat_map(accessors).collect());
    put("bufferViews", views(geometry));
    let bytes: usize = geometry.sections().iter().map(|s| s.len()).sum();
    put("buffers", if bytes > 0 { vec![json!({ "byteLength": bytes })] } else { vec![] });
    if !scene.materials().is_empty() {
        put("extensionsUsed", vec![json!("KHR_materials_unlit")]);
    }
    if shown {
        root.insert("scene".into(), json!(0));
    }
    root.insert(
        "asset".into(),
        json!({
            "version": "2.0",
            "generator": GENERATOR,
            "extras": extras(json!({ "exposureScale": scale })),
        }),
    );
    Ok(Value::Object(root))
}

struct Nodes {
    list: Vec<Value>,
    meshes: Vec<Value>,
    /// The nodes without a parent.
    roots: Vec<usize>,
}

/// A node per group, then one per camera, then a root above them where the scene lies
/// too far from the origin.
fn nodes(scene: &Scene, geometry: &Geometry) -> Result<Nodes, Error> {
    let mut list = Vec::new();
    let mut meshes = Vec::new();
    for (group, name) in scene.groups().iter().enumerate() {
        // Primitives are in the order of their groups.
        let first = geometry.primitives.partition_point(|p| (p.group as usize) < group);
        let mine = geometry.primitives[first..].iter().take_while(|p| p.group as usize == group);
        let primitives: Vec<Value> =
            mine.enumerate().map(|(i, p)| primitive(first + i, p)).collect();
        let mut node = json!({ "name": name });
        if !primitives.is_empty() {
            node["mesh"] = json!(meshes.len());
            meshes.push(json!({ "name": name, "primitives": primitives }));
        }
        list.push(node);
    }
    for (index, camera) in scene.cameras().iter().enumerate() {
        let [right, up, forward] = basis(camera)?;
        // A glTF camera looks along its own -z.
        let turn = DQuat::from_mat3(&DMat3::from_cols(right, up, -forward)).normalize();
        let translation = camera.position - geometry.centre;
        if translation.abs().max_element() > f64::from(f32::MAX) {
            return Err(Error::new(ErrorKind::TooLarge("a camera farther out than f32 can hold")));
        }
        let translation = translation.to_array();
        list.push(json!({
            "name": camera.name,
            "camera": index,
            "translation": translation,
            "rotation": turn.to_array(),
            "extras": extras(json!({ "translation": translation, "rotation": turn.to_array() })),
        }));
    }
    let mut roots: Vec<usize> = (0..list.len()).collect();
    if geometry.centre != DVec3::ZERO && !roots.is_empty() {
        list.push(json!({
            "name": "offset from the origin",
            "translation": geometry.centre.to_array(),
            "children": roots,
            // Readers narrow the numbers of glTF itself to f32.
            "extras": extras(json!({ "translation": geometry.centre.to_array() })),
        }));
        roots = vec![list.len() - 1];
    }
    Ok(Nodes { list, meshes, roots })
}

fn primitive(index: usize, primitive: &Primitive) -> Value {
    let first = SECTIONS.len() * index;
    let mut attributes = Map::new();
    let mut value = json!({ "material": primitive.material });
    for (offset, section) in SECTIONS.iter().enumerate() {
        match section.attribute {
            Some(name) => drop(attributes.insert(name.into(), json!(first + offset))),
            None => value["indices"] = json!(first + offset),
        }
    }
    value["attributes"] = Value::Object(attributes);
    if primitive.face == Face::Back {
        // A reader of surfaces already has this one: it is the back of another.
        value["extras"] = extras(json!({ "face": "back" }));
    }
    value
}

/// One accessor per section, in the order of the sections.
fn accessors(primitive: &Primitive) -> Vec<Value> {
    let accessor = |(view, section): (usize, &super::buffer::Section)| {
        let (first, count) =
            if section.attribute.is_some() { primitive.vertices } else { primitive.indices };
        let (component, shape) = match section.attribute {
            Some("COLOR_0") => (UNSIGNED_SHORT, "VEC4"),
            Some(_) => (FLOAT, "VEC3"),
            None => (UNSIGNED_INT, "SCALAR"),
        };
        let mut value = json!({
            "bufferView": view,
            "byteOffset": first * section.stride,
            "componentType": component,
            "count": count,
            "type": shape,
        });
        if component == UNSIGNED_SHORT {
            value["normalized"] = json!(true);
        }
        if section.attribute == Some("POSITION") {
            value["min"] = json!(primitive.low);
            value["max"] = json!(primitive.high);
        }
        value
    };
    SECTIONS.iter().enumerate().map(accessor).collect()
}

fn views(geometry: &Geometry) -> Vec<Value> {
    let sections = geometry.sections();
    if sections[0].is_empty() {
        return Vec::new();
    }
    let mut start = 0;
    let view = |(bytes, section): (&&[u8], &super::buffer::Section)| {
        let mut value = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() });
        start += bytes.len();
        // Only vertices may state a stride, and they must where accessors share a view.
        if section.attribute.is_some() {
            value["byteStride"] = json!(section.stride);
            value["target"] = json!(ARRAY_BUFFER);
        } else {
            value["target"] = json!(ELEMENT_ARRAY_BUFFER);
        }
        value
    };
    sections.iter().zip(&SECTIONS).map(view).collect()
}

/// White and unlit, so that a viewer shows the light in the vertices and adds none; what
/// the surface does with light is kept beside it. `KHR_materials_emissive_strength` must
/// not stand beside unlit, so the emittance is kept there too.
fn material(material: &Material) -> Value {
    let sides = match material.sides {
        Sides::Front => "front",
        Sides::Both => "both",
    };
    json!({
        "name": material.name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [1.0, 1.0, 1.0, 1.0],
            "metallicFactor": 0.0,
            "roughnessFactor": 1.0,
        },
        // The back of a two-sided surface is there as faces of its own.
        "doubleSided": false,
        "extensions": { "KHR_materials_unlit": {} },
        "extras": extras(json!({
            "emittance": material.emittance.0,
            "reflectance": material.reflectance.0,
            "sides": sides,
        })),
    })
}

fn camera(camera: &Camera) -> Value {
    let distance = (camera.target - camera.position).length();
    json!({
        "name": camera.name,
        "type": "perspective",
        "perspective": { "yfov": camera.vertical_fov, "znear": NEAR_SHARE * distance },
        "extras": extras(json!({ "targetDistance": distance, "yfov": camera.vertical_fov })),
    })
}
