//! A small writer of binary glTF 2.0: meshes by position, materials, textures, cameras, nodes.

use serde_json::{Map, Value, json};

use super::mesh::{Point, Shape};

/// glTF's numbers for what a buffer holds.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const NEAREST: u32 = 9728;

/// A material in the words of a diffuse solver.
pub(crate) struct Surface<'a> {
    pub(crate) name: &'a str,
    pub(crate) base_color: [f64; 3],
    pub(crate) base_texture: Option<usize>,
    pub(crate) metallic: f64,
    pub(crate) roughness: f64,
    pub(crate) radiance: [f64; 3],
    pub(crate) emissive_texture: Option<usize>,
    pub(crate) double_sided: bool,
}

impl Default for Surface<'_> {
    fn default() -> Self {
        Surface {
            name: "",
            base_color: [1.0; 3],
            base_texture: None,
            metallic: 0.0,
            roughness: 1.0,
            radiance: [0.0; 3],
            emissive_texture: None,
            double_sided: false,
        }
    }
}

/// Where a point of a mesh lies in its texture.
pub(crate) type TextureMap = fn(Point) -> [f64; 2];

/// The parts of a document so far; every method returns the index of what it added.
#[derive(Default)]
pub(crate) struct Glb {
    bytes: Vec<u8>,
    lists: Map<String, Value>,
    strength: bool,
}

impl Glb {
    pub(crate) fn material(&mut self, surface: &Surface<'_>) -> usize {
        let [r, g, b] = surface.base_color;
        let mut pbr = json!({
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": surface.metallic,
            "roughnessFactor": surface.roughness,
        });
        if let Some(texture) = surface.base_texture {
            pbr["baseColorTexture"] = json!({ "index": texture });
        }
        let mut material = json!({ "name": surface.name, "pbrMetallicRoughness": pbr });
        let strength = surface.radiance.into_iter().fold(0.0, f64::max);
        if strength > 0.0 {
            // A factor is at most 1; what is brighter goes into the strength.
            let unit = strength.max(1.0);
            material["emissiveFactor"] = json!(surface.radiance.map(|x| x / unit));
            if unit > 1.0 {
                self.strength = true;
                material["extensions"] =
                    json!({ "KHR_materials_emissive_strength": { "emissiveStrength": unit } });
            }
        }
        if let Some(texture) = surface.emissive_texture {
            material["emissiveTexture"] = json!({ "index": texture });
        }
        if surface.double_sided {
            material["doubleSided"] = json!(true);
        }
        self.push("materials", material)
    }

    /// An embedded PNG, repeated and not smoothed.
    pub(crate) fn texture(&mut self, name: &str, png: &[u8]) -> usize {
        let view = self.view(png, None);
        let image = self
            .push("images", json!({ "name": name, "mimeType": "image/png", "bufferView": view }));
        let sampler = self.push("samplers", json!({ "magFilter": NEAREST, "minFilter": NEAREST }));
        self.push("textures", json!({ "name": name, "sampler": sampler, "source": image }))
    }

    /// The triangles of `shape` in their order, over vertices that each stand once.
    pub(crate) fn mesh(
        &mut self,
        name: &str,
        shape: &Shape,
        material: usize,
        texture_map: Option<TextureMap>,
    ) -> usize {
        let mut points: Vec<Point> = Vec::new();
        let mut indices = Vec::new();
        for corner in shape.0.iter().flatten() {
            let known = points.iter().position(|p| p == corner);
            let index = known.unwrap_or_else(|| {
                points.push(*corner);
                points.len() - 1
            });
            indices.push(u16::try_from(index).expect("bundled meshes have few vertices"));
        }
        let mut attributes = json!({ "POSITION": self.positions(&points) });
        if let Some(map) = texture_map {
            let uv: Vec<_> = points.iter().flat_map(|&p| map(p)).collect();
            let view = self.view(&narrow(&uv), Some(ARRAY_BUFFER));
            attributes["TEXCOORD_0"] = json!(self.push("accessors", json!({
                "bufferView": view, "componentType": FLOAT, "count": points.len(), "type": "VEC2",
            })));
        }
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        let view = self.view(&bytes, Some(ELEMENT_ARRAY_BUFFER));
        let indices = self.push(
            "accessors",
            json!({
                "bufferView": view, "componentType": UNSIGNED_SHORT,
                "count": indices.len(), "type": "SCALAR",
            }),
        );
        let primitive =
            json!({ "attributes": attributes, "indices": indices, "material": material });
        self.push("meshes", json!({ "name": name, "primitives": [primitive] }))
    }

    pub(crate) fn camera(
        &mut self,
        name: &str,
        vertical_fov: f64,
        aspect: f64,
        near: f64,
        far: f64,
    ) -> usize {
        let perspective =
            json!({ "yfov": vertical_fov, "aspectRatio": aspect, "znear": near, "zfar": far });
        let camera = json!({ "name": name, "type": "perspective", "perspective": perspective });
        self.push("cameras", camera)
    }

    pub(crate) fn node(&mut self, node: Value) -> usize {
        self.push("nodes", node)
    }

    /// The finished file: header, JSON chunk padded with blanks, binary chunk padded with zeros.
    pub(crate) fn finish(mut self, scene: &str, roots: &[usize]) -> Vec<u8> {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut document = Value::Object(self.lists);
        document["asset"] = json!({ "version": "2.0", "generator": "cargo xtask scenes" });
        document["scene"] = json!(0);
        document["scenes"] = json!([{ "name": scene, "nodes": roots }]);
        document["buffers"] = json!([{ "byteLength": self.bytes.len() }]);
        if self.strength {
            document["extensionsUsed"] = json!(["KHR_materials_emissive_strength"]);
        }
        // Another crate in the build may ask serde_json to keep the order of insertion.
        document.sort_all_objects();
        let mut text = document.to_string().into_bytes();
        text.resize(text.len().next_multiple_of(4), b' ');

        let mut file = Vec::new();
        file.extend(b"glTF");
        file.extend(2_u32.to_le_bytes());
        file.extend(len_u32(12 + 8 + text.len() + 8 + self.bytes.len()));
        for (kind, chunk) in [(b"JSON", &text), (b"BIN\0", &self.bytes)] {
            file.extend(len_u32(chunk.len()));
            file.extend(kind);
            file.extend(chunk);
        }
        file
    }

    fn positions(&mut self, points: &[Point]) -> usize {
        let flat: Vec<f64> = points.iter().flatten().copied().collect();
        let view = self.view(&narrow(&flat), Some(ARRAY_BUFFER));
        // The bounds are those of the stored numbers, so they are narrowed like them.
        let bound = |pick: fn(f32, f32) -> f32, start: f32| {
            [0, 1, 2].map(|axis| {
                let values = points.iter().map(|p| p[axis] as f32);
                f64::from(values.fold(start, pick))
            })
        };
        let (min, max) = (bound(f32::min, f32::INFINITY), bound(f32::max, f32::NEG_INFINITY));
        self.push(
            "accessors",
            json!({
                "bufferView": view, "componentType": FLOAT, "count": points.len(), "type": "VEC3",
                "min": min, "max": max,
            }),
        )
    }

    fn view(&mut self, bytes: &[u8], target: Option<u32>) -> usize {
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let mut view =
            json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.bytes.extend(bytes);
        self.push("bufferViews", view)
    }

    fn push(&mut self, list: &str, value: Value) -> usize {
        let entry = self.lists.entry(list).or_insert_with(|| json!([]));
        let array = entry.as_array_mut().expect("every list is created as an array above");
        array.push(value);
        array.len() - 1
    }
}

/// glTF stores lengths and counts in 32 bits.
fn len_u32(len: usize) -> [u8; 4] {
    u32::try_from(len).expect("bundled scenes are small").to_le_bytes()
}

fn narrow(values: &[f64]) -> Vec<u8> {
    values.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect()
}
