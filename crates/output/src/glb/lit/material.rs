//! Materials that show the light in the vertices, and add none.

use std::collections::{BTreeMap, BTreeSet};

use scene::Shape;
use serde_json::{Map, Value, json};

use super::{add_extras, index, list};

/// How a material lets the light in its vertices show.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Look {
    /// White: the colours of the vertices are what is seen.
    Plain,
    /// A texture multiplies them. This is how much of its mean the reflectance is: 1 − metallic.
    Textured(f64),
}

impl Look {
    /// The colour of a vertex for which `shown` is seen, on a triangle of this reflectance. A
    /// texture can only darken: what would need more than white stays white.
    pub(super) fn tint(self, shown: f64, reflectance: f64) -> f64 {
        match self {
            Self::Plain => shown,
            // Where nothing is reflected the texture is black, whatever multiplies it.
            Self::Textured(_) if reflectance == 0.0 => f64::from(u8::from(shown > 0.0)),
            Self::Textured(diffuse) => (shown * diffuse / reflectance).min(1.0),
        }
    }
}

/// The materials of a document, as its lit primitives use them.
pub(super) struct Materials {
    looks: Vec<Look>,
    /// Of those that lit primitives use, where their lit form goes. Primitives without a material
    /// are among them as `None`.
    places: BTreeMap<Option<usize>, usize>,
}

impl Materials {
    /// A material keeps its place, unless something that is not lit uses it too; its lit form then
    /// goes to the end.
    pub(super) fn new(root: &Map<String, Value>, shapes: &[Shape]) -> Self {
        let materials = list(root, "materials");
        let lit: BTreeSet<_> = shapes.iter().map(|shape| (shape.mesh, shape.primitive)).collect();
        let (mut used, mut elsewhere) = (BTreeSet::new(), BTreeSet::new());
        for (m, mesh) in list(root, "meshes").iter().enumerate() {
            let primitives = mesh.get("primitives").and_then(Value::as_array);
            for (p, primitive) in primitives.into_iter().flatten().enumerate() {
                let users = if lit.contains(&(m, p)) { &mut used } else { &mut elsewhere };
                users.insert(index(primitive, "material"));
            }
        }
        let mut next = materials.len();
        let mut place = |material: Option<usize>| match material {
            Some(index) if !elsewhere.contains(&material) => (material, index),
            _ => {
                next += 1;
                (material, next - 1)
            }
        };
        let places = used.into_iter().map(&mut place).collect();
        Self { looks: materials.iter().map(look).collect(), places }
    }

    /// How a primitive's material lets light show.
    pub(super) fn look(&self, primitive: &Value) -> &Look {
        let material = index(primitive, "material");
        material.and_then(|material| self.looks.get(material)).unwrap_or(&Look::Plain)
    }

    /// Where the lit form of a material stands.
    pub(super) fn place(&self, material: Option<usize>) -> Option<usize> {
        self.places.get(&material).copied()
    }

    /// Puts the lit forms in their places.
    pub(super) fn put(&self, root: &mut Map<String, Value>) {
        if self.places.is_empty() {
            return;
        }
        let materials = root.entry("materials").or_insert_with(|| json!([]));
        let Some(materials) = materials.as_array_mut() else { return };
        let mut lit: Vec<_> = self.places.iter().map(|(from, to)| (*to, *from)).collect();
        lit.sort_unstable();
        for (to, from) in lit {
            let original = from.and_then(|from| materials.get(from)).cloned();
            let original = original.unwrap_or_else(|| json!({}));
            let mut lit = shown(&original);
            match materials.get_mut(to) {
                Some(place) => {
                    add_extras(&mut lit, json!({ "original": original }));
                    *place = lit;
                }
                None => {
                    // Whose lit form it is; nothing's, for what had no material.
                    add_extras(&mut lit, json!({ "litFormOf": from }));
                    materials.push(lit);
                }
            }
        }
    }
}

fn look(material: &Value) -> Look {
    let surface = material.get("pbrMetallicRoughness");
    let member = |name: &str| surface.and_then(|surface| surface.get(name));
    if member("baseColorTexture").is_none() {
        return Look::Plain;
    }
    // A texture of its own says what is metal; its mean is not known here, and counts as none.
    let metallic = match member("metallicRoughnessTexture") {
        Some(_) => 0.0,
        None => member("metallicFactor").and_then(Value::as_f64).unwrap_or(1.0),
    };
    Look::Textured(1.0 - metallic)
}

/// The lit form of a material: unlit, so that a viewer shows the light in the vertices and adds
/// none, and white unless a texture colours it. `doubleSided` goes, as the back of a surface has
/// light of its own and is there as faces of its own. The extensions for surfaces must not stand
/// beside unlit.
fn shown(original: &Value) -> Value {
    let mut lit = original.clone();
    let Some(members) = lit.as_object_mut() else { return json!({}) };
    members.remove("doubleSided");
    let textured = look(original) != Look::Plain;
    let surface = members.entry("pbrMetallicRoughness").or_insert_with(|| json!({}));
    if !textured {
        let alpha = surface.pointer("/baseColorFactor/3").and_then(Value::as_f64).unwrap_or(1.0);
        surface["baseColorFactor"] = json!([1.0, 1.0, 1.0, alpha]);
    }
    let extensions = members.entry("extensions").or_insert_with(|| json!({}));
    if let Some(extensions) = extensions.as_object_mut() {
        extensions.retain(|name, _| !name.starts_with("KHR_materials_"));
        extensions.insert("KHR_materials_unlit".to_owned(), json!({}));
    }
    lit
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_texture_times_the_tint_is_what_is_seen() {
        assert_eq!(Look::Plain.tint(0.4, 0.2), 0.4);
        assert_eq!(Look::Textured(1.0).tint(0.1, 0.5), 0.2);
        assert_eq!(Look::Textured(1.0).tint(0.9, 0.5), 1.0);
        assert_eq!(Look::Textured(0.25).tint(0.1, 0.125), 0.2);
        assert_eq!(Look::Textured(1.0).tint(0.0, 0.0), 0.0);
    }

    #[test]
    fn a_lit_material_keeps_what_does_not_contradict_it() {
        let original = json!({
            "name": "red", "doubleSided": true, "alphaMode": "BLEND",
            "pbrMetallicRoughness": { "baseColorFactor": [0.8, 0.1, 0.1, 0.5] },
            "extensions": { "KHR_materials_emissive_strength": {}, "EXT_other": {} },
            "extras": { "mine": 1 },
        });
        let lit = shown(&original);
        assert_eq!(lit["name"], "red");
        assert_eq!(lit["alphaMode"], "BLEND");
        assert_eq!(lit.get("doubleSided"), None);
        assert_eq!(lit["pbrMetallicRoughness"]["baseColorFactor"], json!([1.0, 1.0, 1.0, 0.5]));
        assert_eq!(lit["extensions"], json!({ "KHR_materials_unlit": {}, "EXT_other": {} }));
        assert_eq!(lit["extras"], json!({ "mine": 1 }));
    }
}
