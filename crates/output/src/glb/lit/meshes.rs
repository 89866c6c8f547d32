//! The meshes of the document with their lit faces: one for all the nodes on which the light is the
//! same, so that instances part only where it differs.

use std::collections::{BTreeMap, BTreeSet};

use scene::Face;
use serde_json::{Map, Value, json};

use super::attribute::{self, Name};
use super::faces::Faces;
use super::material::Materials;
use super::slots::{Numbers, Slots};
use super::{add_extras, index, list};

/// The lit faces of a mesh, by primitive.
type Lit = BTreeMap<usize, Vec<Faces>>;

/// The lit forms of each mesh of the document.
#[derive(Default)]
pub(super) struct Meshes {
    forms: BTreeMap<usize, Vec<Form>>,
}

/// A mesh as its light shows it, and the nodes that show it so.
struct Form {
    lit: Lit,
    nodes: Vec<usize>,
}

impl Meshes {
    /// Adds what a mesh became under a node.
    pub(super) fn add(&mut self, node: usize, mesh: usize, lit: Lit) {
        if lit.is_empty() {
            return;
        }
        let forms = self.forms.entry(mesh).or_default();
        match forms.iter_mut().find(|form| form.lit == lit) {
            Some(form) => form.nodes.push(node),
            None => forms.push(Form { lit, nodes: vec![node] }),
        }
    }

    /// The primitives, by mesh, that nothing will show any more.
    pub(super) fn vanishing(&self, root: &Map<String, Value>) -> BTreeSet<(usize, usize)> {
        let mut vanishing = BTreeSet::new();
        for (&mesh, forms) in self.forms.iter().filter(|(mesh, _)| self.is_all_lit(root, **mesh)) {
            let replaced = |form: &Form, primitive: &usize| {
                form.lit.get(primitive).is_some_and(|faces| faces.iter().all(|f| f.replaces))
            };
            let everywhere = |primitive: &&usize| forms.iter().all(|f| replaced(f, primitive));
            vanishing
                .extend(forms[0].lit.keys().filter(everywhere).map(|primitive| (mesh, *primitive)));
            let primitives = list(root, "meshes")[mesh].get("primitives").and_then(Value::as_array);
            let backs = primitives.into_iter().flatten().enumerate().filter(|(_, p)| is_back(p));
            vanishing.extend(backs.map(|(primitive, _)| (mesh, primitive)));
        }
        vanishing
    }

    /// Whether every node that shows a mesh shows it lit.
    fn is_all_lit(&self, root: &Map<String, Value>, mesh: usize) -> bool {
        let users = list(root, "nodes").iter().filter(|node| index(node, "mesh") == Some(mesh));
        let lit: usize = self.forms.get(&mesh).into_iter().flatten().map(|f| f.nodes.len()).sum();
        users.count() == lit
    }

    /// Puts the lit forms into the document: the first in the mesh's own place, unless something
    /// still shows it unlit, the others at the end.
    pub(super) fn put(
        self,
        root: &mut Map<String, Value>,
        materials: &Materials,
        slots: &mut Slots,
    ) {
        let in_place: BTreeSet<usize> =
            self.forms.keys().copied().filter(|mesh| self.is_all_lit(root, *mesh)).collect();
        for (mesh, forms) in self.forms {
            let original = list(root, "meshes")[mesh].clone();
            let mut own_place = in_place.contains(&mesh);
            for Form { lit, nodes } in forms {
                let value = lit_mesh(&original, lit, materials, slots);
                let Some(meshes) = root.get_mut("meshes").and_then(Value::as_array_mut) else {
                    continue;
                };
                let at = if std::mem::take(&mut own_place) { mesh } else { meshes.len() };
                match meshes.get_mut(at) {
                    Some(place) => *place = value,
                    None => meshes.push(value),
                }
                for node in nodes {
                    root["nodes"][node]["mesh"] = json!(at);
                }
            }
        }
    }
}

fn lit_mesh(original: &Value, mut lit: Lit, materials: &Materials, slots: &mut Slots) -> Value {
    let mut mesh = original.clone();
    let Some(primitives) = mesh.get_mut("primitives").and_then(Value::as_array_mut) else {
        return mesh;
    };
    let originals = std::mem::take(primitives);
    for (number, original) in originals.into_iter().enumerate() {
        match lit.remove(&number) {
            Some(sides) => {
                let lit = |faces| lit_primitive(&original, faces, materials, slots);
                primitives.extend(sides.into_iter().map(lit));
            }
            // The lit faces have their own backs.
            None if is_back(&original) => {}
            None => primitives.push(original),
        }
    }
    mesh
}

/// Whether a primitive shows the back of another, as in files of our own making.
fn is_back(primitive: &Value) -> bool {
    primitive.pointer("/extras/radiosity/face").and_then(Value::as_str) == Some("back")
}

fn lit_primitive(
    original: &Value,
    faces: Faces,
    materials: &Materials,
    slots: &mut Slots,
) -> Value {
    let mut primitive = original.clone();
    let Some(members) = primitive.as_object_mut() else { return primitive };
    // What follows are triangles, whatever they were.
    members.remove("mode");
    if let Some(extensions) = members.get_mut("extensions").and_then(Value::as_object_mut) {
        extensions.remove("KHR_draco_mesh_compression");
    }
    let attributes = members.entry("attributes").or_insert_with(|| json!({}));
    if faces.replaces {
        *attributes = json!({});
        let targets = members.get_mut("targets").and_then(Value::as_array_mut);
        targets.into_iter().flatten().for_each(|target| *target = json!({}));
    } else if let Some(attributes) = attributes.as_object_mut() {
        let own = std::mem::take(attributes);
        attributes.extend(own.into_iter().map(|(name, values)| (attribute::moved(&name), values)));
    }
    for column in faces.columns {
        let numbers = Numbers {
            spelling: column.spelling,
            stride: column.stride,
            count: faces.vertices,
            bytes: column.bytes,
        };
        match column.name {
            Name::Own(name) => {
                primitive["attributes"][&name] = json!(slots.vertices(numbers, name == "POSITION"));
            }
            Name::Target(target, name) => {
                let accessor = slots.vertices(numbers, name == "POSITION");
                primitive["targets"][target][&name] = json!(accessor);
            }
        }
    }
    if let Some(indices) = faces.indices {
        primitive["indices"] = json!(slots.indices(&indices));
    }
    let material = index(&primitive, "material");
    let mut ours = json!({ "lit": true });
    if faces.face == Face::Back {
        // A reader of surfaces already has this one: it is the back of another.
        ours["face"] = json!("back");
    }
    if let Some(place) = materials.place(material) {
        primitive["material"] = json!(place);
    }
    add_extras(&mut primitive, ours);
    primitive
}
