//! From a primitive of the document to its lit faces.

use scene::{Face, Shape};
use serde_json::{Map, Value};

use super::accessor::Accessors;
use super::attribute;
use super::faces::{Faces, Light};
use super::material::Materials;
use super::{index, list};
use crate::{Error, ErrorKind};

/// The lit faces of a shape: the front's, then the back's, as far as there are any.
pub(super) fn lit(
    root: &Map<String, Value>,
    accessors: &Accessors<'_>,
    shape: &Shape,
    light: &Light<'_>,
    materials: &Materials,
) -> Result<Vec<Faces>, Error> {
    let primitive = find(root, shape)?;
    let look = materials.look(primitive);
    let mut lit = Vec::new();
    if attribute::is_skinned(primitive) {
        let vertices = vertex_count(primitive, accessors)?;
        for face in [Face::Front, Face::Back] {
            lit.extend(light.whole(shape, face, vertices, look));
        }
        return Ok(lit);
    }
    let attributes = attribute::of(primitive, accessors)?;
    for face in [Face::Front, Face::Back] {
        lit.extend(light.faces(shape, face, &attributes, look)?);
    }
    Ok(lit)
}

/// Whether the attributes of a shape can be read.
pub(super) fn check(
    root: &Map<String, Value>,
    accessors: &Accessors<'_>,
    shape: &Shape,
) -> Result<(), Error> {
    let primitive = find(root, shape)?;
    if attribute::is_skinned(primitive) {
        return vertex_count(primitive, accessors).map(drop);
    }
    attribute::of(primitive, accessors).map(drop)
}

fn find<'r>(root: &'r Map<String, Value>, shape: &Shape) -> Result<&'r Value, Error> {
    let mesh = list(root, "meshes").get(shape.mesh);
    let primitives = mesh.and_then(|mesh| mesh.get("primitives")).and_then(Value::as_array);
    primitives.and_then(|primitives| primitives.get(shape.primitive)).ok_or_else(|| {
        let (mesh, primitive) = (shape.mesh, shape.primitive);
        Error::new(ErrorKind::Document(format!("expected meshes[{mesh}].primitives[{primitive}]")))
    })
}

/// How many vertices a primitive has.
fn vertex_count(primitive: &Value, accessors: &Accessors<'_>) -> Result<usize, Error> {
    let positions = primitive.get("attributes").and_then(|a| index(a, "POSITION"));
    Ok(accessors.read(positions.unwrap_or(usize::MAX))?.count)
}
