//! The scene's own document, lit: every node, name, texture and animation stays, and meshes get
//! the solver's elements for their triangles, with the light in their vertices.
//!
//! What is changed is kept in `extras.radiosity`, from which scene-import restores the document.

mod accessor;
mod attribute;
mod extensions;
mod faces;
mod material;
mod meshes;
mod place;
mod primitive;
mod slots;
mod whole;

use std::collections::BTreeMap;
use std::io::Write;

use scene::{Document, Scene, Shape, Solution};
use serde_json::{Map, Value, json};

use self::accessor::Accessors;
use self::faces::Light;
use self::material::Materials;
use self::meshes::Meshes;
use self::slots::Slots;
use super::container;
use crate::{Error, ErrorKind};

/// The member of `extras` that no other program uses.
const KEY: &str = "radiosity";

/// Writes the document with light.
pub(crate) fn write(
    out: &mut dyn Write,
    document: &Document,
    scene: &Scene,
    solution: &Solution,
    scale: f64,
) -> Result<(), Error> {
    let mut root = parse(document)?;
    let light = Light { scene, solution, scale };
    let materials = Materials::new(&root, &document.shapes);
    let mut meshes = Meshes::default();
    let accessors = Accessors::new(&root, document);
    for shapes in document.shapes.chunk_by(|a, b| a.node == b.node) {
        let mut lit = BTreeMap::new();
        for shape in shapes {
            let faces = primitive::lit(&root, &accessors, shape, &light, &materials)?;
            if !faces.is_empty() {
                lit.insert(shape.primitive, faces);
            }
        }
        let Some(Shape { node, mesh, .. }) = shapes.first() else { continue };
        meshes.add(*node, *mesh, lit);
    }
    let mut slots = Slots::new(&root, &meshes.vanishing(&root));
    meshes.put(&mut root, &materials, &mut slots);
    materials.put(&mut root);
    let sections = slots.put(&mut root, document)?;
    extensions::renew(&mut root);
    mark(&mut root, scale);
    let sections: Vec<&[u8]> = sections.iter().map(AsRef::as_ref).collect();
    container::write(out, &Value::Object(root), &sections)
}

/// Whether light can be put into a document: what [`write`] would refuse whatever the light.
///
/// # Errors
/// [`ErrorKind::Document`] for an attribute that the reader of the scene had no need of and that
/// does not lie within its buffer.
pub fn check(document: &Document) -> Result<(), Error> {
    let root = parse(document)?;
    let accessors = Accessors::new(&root, document);
    document.shapes.iter().try_for_each(|shape| primitive::check(&root, &accessors, shape))
}

fn parse(document: &Document) -> Result<Map<String, Value>, Error> {
    serde_json::from_str(&document.json)
        .map_err(|cause| Error::caused(ErrorKind::Document("no JSON object".into()), cause))
}

/// Says who put the light in, and how bright its colours are.
fn mark(root: &mut Map<String, Value>, scale: f64) {
    let asset = root.entry("asset").or_insert_with(|| json!({}));
    asset["generator"] = json!(super::document::GENERATOR);
    let ours = json!({ "exposureScale": scale, "litDocument": true });
    add_extras(asset, ours);
}

/// Puts our member into an object's extras, beside what else they hold.
fn add_extras(object: &mut Value, ours: Value) {
    match object.get_mut("extras").and_then(Value::as_object_mut) {
        Some(extras) => drop(extras.insert(KEY.to_owned(), ours)),
        // Extras may be any value; one that can have no members gives way.
        None => object["extras"] = json!({ KEY: ours }),
    }
}

/// The entries of an array of the document; none where there is none.
fn list<'v>(root: &'v Map<String, Value>, name: &str) -> &'v [Value] {
    root.get(name).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

/// A member that is an index.
fn index(object: &Value, name: &str) -> Option<usize> {
    object.get(name).and_then(Value::as_u64).and_then(|n| usize::try_from(n).ok())
}
