//! A document that this project has lit, as it was before: its own materials, and the colours it
//! had where the light now stands.

use serde_json::{Map, Value};

/// The member of `extras` that is ours.
const KEY: &str = "radiosity";

/// Materials that are shown as they are, without lamps.
const UNLIT: &str = "KHR_materials_unlit";

/// The document without its light; `None` where none was put in by this project, or where the text
/// is no JSON, which whoever reads it next will say better.
pub(super) fn restore(json: &[u8]) -> Option<Vec<u8>> {
    // Most files are not ours, and need not be read twice.
    let marked = json.windows(KEY.len()).any(|word| word == KEY.as_bytes());
    let mut root: Value = if marked { serde_json::from_slice(json).ok()? } else { return None };
    let lit = take_ours(root.get_mut("asset")?)?.get("litDocument") == Some(&Value::Bool(true));
    if !lit {
        return None;
    }
    for material in list(&mut root, "materials") {
        if let Some(original) = take_ours(material).and_then(|mut ours| ours.remove("original")) {
            *material = original;
        }
    }
    for mesh in list(&mut root, "meshes") {
        if let Some(primitives) = mesh.get_mut("primitives").and_then(Value::as_array_mut) {
            primitives.retain_mut(|primitive| {
                take_ours(primitive).is_none_or(|ours| unlight(primitive, &ours))
            });
        }
    }
    forget_unlit(&mut root);
    serde_json::to_vec(&root).ok()
}

/// Takes the light out of a primitive; `false` for one that shows the back of another.
fn unlight(primitive: &mut Value, ours: &Map<String, Value>) -> bool {
    if ours.get("face").and_then(Value::as_str) == Some("back") {
        return false;
    }
    if ours.get("lit") != Some(&Value::Bool(true)) {
        return true;
    }
    if let Some(attributes) = primitive.get_mut("attributes").and_then(Value::as_object_mut) {
        attributes.remove("COLOR_0");
        attributes.remove("_RADIOSITY");
        if let Some(colours) = attributes.remove("_COLOR_0") {
            attributes.insert("COLOR_0".to_owned(), colours);
        }
    }
    let none = ours.get("material").and_then(Value::as_str) == Some("none");
    if let (true, Some(primitive)) = (none, primitive.as_object_mut()) {
        primitive.remove("material");
    }
    true
}

/// Our member of an object's extras, taken out of them.
fn take_ours(value: &mut Value) -> Option<Map<String, Value>> {
    let extras = value.get_mut("extras")?.as_object_mut()?;
    let Some(Value::Object(ours)) = extras.remove(KEY) else { return None };
    if let (true, Some(value)) = (extras.is_empty(), value.as_object_mut()) {
        value.remove("extras");
    }
    Some(ours)
}

/// Takes `KHR_materials_unlit` off the list of what is used, if nothing uses it any more.
fn forget_unlit(root: &mut Value) {
    let unlit = |m: &mut Value| m.get("extensions").is_some_and(|e| e.get(UNLIT).is_some());
    if list(root, "materials").any(unlit) {
        return;
    }
    let Some(root) = root.as_object_mut() else { return };
    let used = root.get_mut("extensionsUsed").and_then(Value::as_array_mut);
    let none_left = used.is_some_and(|used| {
        used.retain(|name| name != UNLIT);
        used.is_empty()
    });
    // The format forbids empty arrays.
    if none_left {
        root.remove("extensionsUsed");
    }
}

/// The entries of an array of the document; none where there is none.
fn list<'v>(root: &'v mut Value, name: &str) -> impl Iterator<Item = &'v mut Value> {
    root.get_mut(name).and_then(Value::as_array_mut).into_iter().flatten()
}
