//! A document that this project has lit, as it was before: its own materials, and the colours it
//! had where the light now stands.

use std::collections::HashMap;

use serde_json::{Map, Value};

/// The member of `extras` that is ours.
const KEY: &str = "radiosity";

/// Materials that are shown as they are, without lamps.
const UNLIT: &str = "KHR_materials_unlit";

/// The document as it was before it was lit, but for its light if that is kept; `None` where none was
/// put in by this project, or where the text is no JSON, which whoever reads it next will say better.
pub(super) fn restore(json: &[u8], keep_light: bool) -> Option<Vec<u8>> {
    // Most files are not ours, and need not be read twice.
    let marked = json.windows(KEY.len()).any(|word| word == KEY.as_bytes());
    let mut root: Value = if marked { serde_json::from_slice(json).ok()? } else { return None };
    if root.pointer("/asset/extras/radiosity/litDocument") != Some(&Value::Bool(true)) {
        return None;
    }
    if !keep_light {
        take_ours(root.get_mut("asset")?);
    }
    let lit_forms = restore_materials(&mut root);
    for mesh in list(&mut root, "meshes") {
        if let Some(primitives) = mesh.get_mut("primitives").and_then(Value::as_array_mut) {
            primitives.retain(|primitive| keep_light || !is_back(primitive));
            primitives.iter_mut().for_each(|p| unlight(p, &lit_forms, keep_light));
        }
    }
    forget_unlit(&mut root);
    serde_json::to_vec(&root).ok()
}

/// Gives each material back what it was. Those at the end that are lit forms of others go, and are
/// returned by their numbers: with whose form they are, or nothing where there was no material.
fn restore_materials(root: &mut Value) -> HashMap<u64, Value> {
    let mut lit_forms = HashMap::new();
    let Some(materials) = root.get_mut("materials").and_then(Value::as_array_mut) else {
        return lit_forms;
    };
    for (number, material) in (0..).zip(materials.iter_mut()) {
        let mut ours = take_ours(material).unwrap_or_default();
        if let Some(original) = ours.remove("original") {
            *material = original;
        } else if let Some(of) = ours.remove("litFormOf") {
            lit_forms.insert(number, of);
        }
    }
    while lit_forms.contains_key(&(materials.len() as u64).wrapping_sub(1)) {
        materials.pop();
    }
    let none_left = materials.is_empty();
    if let (true, Some(root)) = (none_left, root.as_object_mut()) {
        // The format forbids empty arrays.
        root.remove("materials");
    }
    lit_forms
}

/// Whether a primitive shows the back of another.
fn is_back(primitive: &Value) -> bool {
    primitive.pointer("/extras/radiosity/face").and_then(Value::as_str) == Some("back")
}

/// Gives a primitive its own colours and material back, and takes the light out unless it is kept.
fn unlight(primitive: &mut Value, lit_forms: &HashMap<u64, Value>, keep_light: bool) {
    if primitive.pointer("/extras/radiosity/lit") != Some(&Value::Bool(true)) {
        return;
    }
    if !keep_light {
        take_ours(primitive);
    }
    if let Some(attributes) = primitive.get_mut("attributes").and_then(Value::as_object_mut) {
        attributes.remove("COLOR_0");
        if !keep_light {
            attributes.remove("_RADIOSITY");
        }
        // The document's own colours were moved on by one.
        let lit = std::mem::take(attributes);
        attributes.extend(lit.into_iter().map(|(name, values)| (moved_back(&name), values)));
    }
    let material = primitive.get("material").and_then(Value::as_u64);
    match material.and_then(|material| lit_forms.get(&material)) {
        Some(Value::Null) => drop(primitive.as_object_mut().map(|p| p.remove("material"))),
        Some(of) => primitive["material"] = of.clone(),
        None => {}
    }
}

/// `COLOR_1` was `COLOR_0` before there was light, and so on.
fn moved_back(name: &str) -> String {
    let number = name.strip_prefix("COLOR_").and_then(|number| number.parse::<u32>().ok());
    match number.and_then(|number| number.checked_sub(1)) {
        Some(before) => format!("COLOR_{before}"),
        None => name.to_owned(),
    }
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
