//! The lists of extensions, after materials and meshes have changed.

use std::collections::BTreeSet;

use serde_json::{Map, Value, json};

/// Brings the lists of the extensions that are used and required up to date.
pub(super) fn renew(root: &mut Map<String, Value>) {
    let views = root.get_mut("bufferViews").and_then(Value::as_array_mut);
    for view in views.into_iter().flatten() {
        // The views hold the plain bytes that such a view falls back to.
        let members = view.as_object_mut();
        let extensions = members.and_then(|m| m.get_mut("extensions"));
        if let Some(extensions) = extensions.and_then(Value::as_object_mut) {
            extensions.remove("EXT_meshopt_compression");
        }
    }
    let mut found = BTreeSet::new();
    root.values().for_each(|value| gather(value, &mut found));
    for name in ["extensionsUsed", "extensionsRequired"] {
        let mut listed: Vec<Value> =
            root.remove(name).and_then(|list| list.as_array().cloned()).unwrap_or_default();
        let stays = |extension: &Value| {
            let extension = extension.as_str().unwrap_or_default();
            !may_have_gone(extension) || found.contains(extension)
        };
        listed.retain(stays);
        if name == "extensionsUsed" {
            let missing: Vec<_> =
                found.iter().filter(|name| !listed.contains(&json!(name))).collect();
            listed.extend(missing.into_iter().map(|name| json!(name)));
        }
        // The format forbids empty arrays.
        if !listed.is_empty() {
            root.insert(name.to_owned(), Value::Array(listed));
        }
    }
}

/// Whether putting light in can have taken the last use of an extension. Others may be used without
/// a member of their own.
fn may_have_gone(extension: &str) -> bool {
    extension.starts_with("KHR_materials_")
        || ["KHR_draco_mesh_compression", "EXT_meshopt_compression"].contains(&extension)
}

/// The extensions with a member somewhere; extras are free to look alike.
fn gather(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Array(values) => values.iter().for_each(|value| gather(value, found)),
        Value::Object(members) => {
            for (name, value) in members.iter().filter(|(name, _)| *name != "extras") {
                if let ("extensions", Some(extensions)) = (name.as_str(), value.as_object()) {
                    found.extend(extensions.keys().cloned());
                }
                gather(value, found);
            }
        }
        _ => {}
    }
}
