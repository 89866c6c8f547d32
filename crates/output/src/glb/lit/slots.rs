//! The document's accessors and buffer views: those that nothing needs any more give their numbers
//! to new ones, so that all other numbers stay as they were.

use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};

use scene::Document;
use serde_json::{Map, Value, json};

use super::accessor::{FLOAT, view_bytes};
use super::{index, list};
use crate::glb::container::ALIGNMENT;
use crate::{Error, ErrorKind};

const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// Extensions of documents whose accessors are named by meshes, skins and animations alone, but for
/// those of materials, which name none. In a document with any other, every number stays.
const HARMLESS: &[&str] = &[
    "KHR_draco_mesh_compression",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_texture_basisu",
    "KHR_texture_transform",
    "KHR_xmp_json_ld",
    "EXT_texture_webp",
];

/// Accessors and buffer views in the making.
pub(super) struct Slots {
    accessors: Vec<Value>,
    views: Vec<View>,
    free_accessors: Vec<usize>,
    free_views: Vec<usize>,
}

/// A buffer view: one of the document, or bytes of its own.
struct View {
    value: Value,
    bytes: Option<Vec<u8>>,
}

/// The values of an attribute for all vertices.
pub(super) struct Numbers {
    /// The number that glTF has for the component's type, whether it is normalised, the shape.
    pub(super) spelling: (u32, bool, &'static str),
    pub(super) stride: usize,
    pub(super) count: usize,
    pub(super) bytes: Vec<u8>,
}

impl Slots {
    /// Those of a document in which some primitives, by mesh, give way to others.
    pub(super) fn new(root: &Map<String, Value>, vanishing: &BTreeSet<(usize, usize)>) -> Self {
        let accessors = list(root, "accessors").to_vec();
        let view = |value: &Value| View { value: value.clone(), bytes: None };
        let views: Vec<_> = list(root, "bufferViews").iter().map(view).collect();
        let (free_accessors, free_views) = free(root, vanishing);
        Self { accessors, views, free_accessors, free_views }
    }

    /// Adds the values of an attribute; places come with their bounds.
    pub(super) fn vertices(&mut self, numbers: Numbers, is_place: bool) -> usize {
        let Numbers { spelling: (component, normalized, shape), stride, count, bytes } = numbers;
        let mut accessor = json!({ "componentType": component, "count": count, "type": shape });
        if normalized {
            accessor["normalized"] = json!(true);
        }
        if is_place && component == FLOAT {
            let [low, high] = bounds(&bytes);
            (accessor["min"], accessor["max"]) = (json!(low), json!(high));
        }
        let view = json!({ "byteStride": stride, "target": ARRAY_BUFFER });
        self.add(accessor, view, bytes)
    }

    /// Adds indices.
    pub(super) fn indices(&mut self, indices: &[u32]) -> usize {
        let count = indices.len();
        let accessor = json!({ "componentType": UNSIGNED_INT, "count": count, "type": "SCALAR" });
        let bytes = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        self.add(accessor, json!({ "target": ELEMENT_ARRAY_BUFFER }), bytes)
    }

    fn add(&mut self, mut accessor: Value, view: Value, bytes: Vec<u8>) -> usize {
        accessor["bufferView"] = json!(self.view(view, bytes));
        let free = self.free_accessors.pop();
        let at = free.unwrap_or(self.accessors.len());
        match self.accessors.get_mut(at) {
            Some(slot) => *slot = accessor,
            None => self.accessors.push(accessor),
        }
        at
    }

    fn view(&mut self, value: Value, bytes: Vec<u8>) -> usize {
        let view = View { value, bytes: Some(bytes) };
        let free = self.free_views.pop();
        let at = free.unwrap_or(self.views.len());
        match self.views.get_mut(at) {
            Some(slot) => *slot = view,
            None => self.views.push(view),
        }
        at
    }

    /// Puts accessors, views, images from other files and one buffer into the document, and gives
    /// the sections of that buffer.
    pub(super) fn put<'d>(
        mut self,
        root: &mut Map<String, Value>,
        document: &'d Document,
    ) -> Result<Vec<Cow<'d, [u8]>>, Error> {
        self.take_in_images(root, document);
        // What is still free is shown by nothing, but must be valid.
        if let Some(valid) = self.accessors.iter().find(|a| a.get("bufferView").is_some()).cloned()
        {
            for free in std::mem::take(&mut self.free_accessors) {
                self.accessors[free] = valid.clone();
            }
        }
        let mut sections: Vec<Cow<'d, [u8]>> = Vec::new();
        let mut length = 0;
        // Views of the same bytes still share them.
        let mut known: HashMap<(usize, usize, usize), usize> = HashMap::new();
        let mut views = Vec::new();
        for (number, View { mut value, bytes }) in self.views.into_iter().enumerate() {
            let old = bytes.is_none().then(|| identity(&value)).flatten();
            let section = match bytes {
                Some(bytes) => Cow::Owned(bytes),
                None => Cow::Borrowed(view_bytes(document, &value).ok_or_else(|| {
                    let what = format!("bufferViews[{number}]: expected bytes within a buffer");
                    Error::new(ErrorKind::Document(what))
                })?),
            };
            value["byteLength"] = json!(section.len());
            let start = match old.and_then(|old| known.get(&old)) {
                Some(start) => *start,
                None => {
                    let start = length;
                    let padded = section.len().next_multiple_of(ALIGNMENT);
                    let padding = &[0; ALIGNMENT][..padded - section.len()];
                    length += padded;
                    sections.extend([section, Cow::Owned(padding.to_vec())]);
                    start
                }
            };
            if let Some(old) = old {
                known.insert(old, start);
            }
            (value["buffer"], value["byteOffset"]) = (json!(0), json!(start));
            views.push(value);
        }
        let buffers = if length > 0 { vec![json!({ "byteLength": length })] } else { vec![] };
        for (name, values) in
            [("accessors", self.accessors), ("bufferViews", views), ("buffers", buffers)]
        {
            // The format forbids empty arrays.
            if values.is_empty() {
                root.remove(name);
            } else {
                root.insert(name.to_owned(), Value::Array(values));
            }
        }
        Ok(sections)
    }

    /// Images that lay beside the document go into it. One of a kind that glTF does not know stays
    /// where it is.
    fn take_in_images(&mut self, root: &mut Map<String, Value>, document: &Document) {
        let images = root.get_mut("images").and_then(Value::as_array_mut);
        // Images of one file share its bytes, and so a view.
        let mut known: HashMap<*const u8, usize> = HashMap::new();
        for (image, bytes) in images.into_iter().flatten().zip(&document.images) {
            let Some((bytes, kind)) = bytes.as_ref().and_then(|b| Some((b, mime_type(b)?))) else {
                continue;
            };
            let view = *known
                .entry(bytes.as_ptr())
                .or_insert_with(|| self.view(json!({}), bytes.to_vec()));
            if let Some(members) = image.as_object_mut() {
                members.remove("uri");
                members.insert("mimeType".to_owned(), json!(kind));
                members.insert("bufferView".to_owned(), json!(view));
            }
        }
    }
}

/// What tells a view of the document from others.
fn identity(view: &Value) -> Option<(usize, usize, usize)> {
    let start = index(view, "byteOffset").unwrap_or(0);
    Some((index(view, "buffer")?, start, index(view, "byteLength")?))
}

/// The kind of an encoded image, by its first bytes.
fn mime_type(bytes: &[u8]) -> Option<&'static str> {
    match bytes {
        [0x89, b'P', b'N', b'G', ..] => Some("image/png"),
        [0xff, 0xd8, 0xff, ..] => Some("image/jpeg"),
        [b'R', b'I', b'F', b'F', _, _, _, _, b'W', b'E', b'B', b'P', ..] => Some("image/webp"),
        [0xab, b'K', b'T', b'X', b' ', b'2', b'0', 0xbb, ..] => Some("image/ktx2"),
        _ => None,
    }
}

/// The smallest and largest of three coordinates.
fn bounds(bytes: &[u8]) -> [[f32; 3]; 2] {
    let mut bounds = [[f32::INFINITY; 3], [f32::NEG_INFINITY; 3]];
    for (i, four) in bytes.chunks_exact(4).enumerate() {
        let value = f32::from_le_bytes([four[0], four[1], four[2], four[3]]);
        let [low, high] = &mut bounds;
        low[i % 3] = low[i % 3].min(value);
        high[i % 3] = high[i % 3].max(value);
    }
    bounds
}

/// The accessors and views that only vanishing primitives use.
fn free(
    root: &Map<String, Value>,
    vanishing: &BTreeSet<(usize, usize)>,
) -> (Vec<usize>, Vec<usize>) {
    let harmless = |name: &Value| {
        let name = name.as_str().unwrap_or_default();
        HARMLESS.contains(&name) || name.starts_with("KHR_materials_")
    };
    if !list(root, "extensionsUsed").iter().all(harmless) {
        return (Vec::new(), Vec::new());
    }
    let (mut gone, mut kept) = (BTreeSet::new(), BTreeSet::new());
    for (m, mesh) in list(root, "meshes").iter().enumerate() {
        let primitives = mesh.get("primitives").and_then(Value::as_array);
        for (p, primitive) in primitives.into_iter().flatten().enumerate() {
            let users = if vanishing.contains(&(m, p)) { &mut gone } else { &mut kept };
            let targets = primitive.get("targets").and_then(Value::as_array);
            let sets = primitive.get("attributes").into_iter().chain(targets.into_iter().flatten());
            let values = sets.filter_map(Value::as_object).flat_map(Map::values);
            users.extend(values.chain(primitive.get("indices")).filter_map(Value::as_u64));
        }
    }
    for skin in list(root, "skins") {
        kept.extend(skin.get("inverseBindMatrices").and_then(Value::as_u64));
    }
    for animation in list(root, "animations") {
        let samplers = animation.get("samplers").and_then(Value::as_array);
        for sampler in samplers.into_iter().flatten() {
            let ends = [sampler.get("input"), sampler.get("output")];
            kept.extend(ends.into_iter().flatten().filter_map(Value::as_u64));
        }
    }
    let gone: BTreeSet<usize> = gone.difference(&kept).map(|n| *n as usize).collect();
    let accessors = list(root, "accessors").iter().enumerate();
    let (mut free, mut needed) = (BTreeSet::new(), BTreeSet::new());
    for (number, accessor) in accessors {
        let sparse = accessor.get("sparse");
        let parts = ["indices", "values"].map(|part| sparse.and_then(|sparse| sparse.get(part)));
        let holders = parts.into_iter().flatten().chain([accessor]);
        let users = if gone.contains(&number) { &mut free } else { &mut needed };
        users.extend(holders.filter_map(|holder| index(holder, "bufferView")));
    }
    needed.extend(list(root, "images").iter().filter_map(|image| index(image, "bufferView")));
    let views = free.difference(&needed).copied().collect();
    (gone.into_iter().collect(), views)
}
