//! A small .gltf with all that should survive: textures beside the file, instances, a mirror, a
//! strip, lines, vertex colours, both sides, morph targets, a skin, animations, a second scene.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::{Value, json};

/// The buffer and the accessors of a document in the making.
#[derive(Default)]
struct Data {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Data {
    fn view(&mut self, bytes: &[u8]) -> usize {
        let start = self.bytes.len();
        self.bytes.extend_from_slice(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let view = json!({ "buffer": 0, "byteOffset": start, "byteLength": bytes.len() });
        self.views.push(view);
        self.views.len() - 1
    }

    fn add(&mut self, bytes: &[u8], component: u32, shape: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.accessors.push(json!({
            "bufferView": view, "componentType": component, "type": shape, "count": count,
        }));
        self.accessors.len() - 1
    }

    fn floats<const N: usize>(&mut self, shape: &str, entries: &[[f32; N]]) -> usize {
        let bytes: Vec<u8> = entries.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        let number = self.add(&bytes, 5126, shape, entries.len());
        let bound = |pick: fn(f32, f32) -> f32, start| {
            let fold =
                |i| entries.iter().fold(start, |most, entry: &[f32; N]| pick(most, entry[i]));
            (0..N).map(fold).collect::<Vec<f32>>()
        };
        self.accessors[number]["min"] = json!(bound(f32::min, f32::INFINITY));
        self.accessors[number]["max"] = json!(bound(f32::max, f32::NEG_INFINITY));
        number
    }

    fn shorts(&mut self, indices: &[u16]) -> usize {
        let bytes: Vec<u8> = indices.iter().flat_map(|i| i.to_le_bytes()).collect();
        self.add(&bytes, 5123, "SCALAR", indices.len())
    }
}

/// A unit square in the plane y = 0 that faces up, its corners in order round it.
const SQUARE: [[f32; 3]; 4] = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 0.0, 0.0]];
const CORNERS: [u16; 6] = [0, 1, 2, 0, 2, 3];
const UP: [[f32; 3]; 4] = [[0.0, 1.0, 0.0]; 4];
const UV: [[f32; 2]; 4] = [[0.0, 0.0], [0.0, 1.0], [1.0, 1.0], [1.0, 0.0]];

/// Writes `studio.gltf`, `studio.bin` and `checker.png` into a folder.
pub(crate) fn write(folder: &Path) -> PathBuf {
    let mut data = Data::default();
    let square = data.floats("VEC3", &SQUARE);
    let corners = data.shorts(&CORNERS);
    let up = data.floats("VEC3", &UP);
    let uv = data.floats("VEC2", &UV);
    let numbers = data.add(&[0, 0, 0, 0, 1, 0, 0, 0, 2, 0, 0, 0, 3, 0, 0, 0], 5123, "VEC2", 4);
    let strip = data.shorts(&[0, 1, 3, 2]);
    let line = data.shorts(&[0, 2]);
    // Unsigned bytes, normalised: a warm white that fades.
    let colours = [[255, 255, 255, 255], [255, 128, 64, 255], [255, 128, 64, 255], [255; 4]];
    let colours = data.add(&colours.concat(), 5121, "VEC4", 4);
    data.accessors[colours]["normalized"] = json!(true);
    let raised = data.floats("VEC3", &[[0.0, 1.0, 0.0], [0.0; 3], [0.0, 0.5, 0.0], [0.0; 3]]);
    let joints = data.add(&[0_u8; 16], 5121, "VEC4", 4);
    let weights = data.floats("VEC4", &[[1.0, 0.0, 0.0, 0.0]; 4]);
    let identity = [1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
    let rest = data.floats("MAT4", &[identity]);
    let times = data.floats("SCALAR", &[[0.0], [1.0]]);
    let moves = data.floats("VEC3", &[[0.0, 1.0, 0.0], [0.0, 2.0, 0.0]]);
    let morphs = data.floats("SCALAR", &[[0.0], [1.0]]);
    let plate = |material: usize| {
        json!({
            "attributes": { "POSITION": square, "NORMAL": up },
            "indices": corners, "material": material,
        })
    };
    let document = json!({
        "asset": { "version": "2.0", "copyright": "nobody", "extras": { "kept": true } },
        "scene": 0,
        "scenes": [
            { "name": "main", "nodes": [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 12] },
            { "name": "other", "nodes": [10] },
        ],
        "nodes": [
            { "name": "floor", "mesh": 0, "translation": [-2.0, 0.0, -2.0], "scale": [4.0, 1.0, 4.0] },
            { "name": "lamp", "mesh": 1, "translation": [-0.5, 3.0, 0.5], "rotation": [1.0, 0.0, 0.0, 0.0] },
            { "name": "near", "mesh": 2, "translation": [0.2, 0.5, 0.1], "extras": { "price": 3 } },
            { "name": "mirror", "mesh": 2, "translation": [-0.6, 0.7, 0.1], "scale": [-1.0, 1.0, 1.0] },
            { "name": "dark one", "mesh": 3, "translation": [5.0, -3.0, 0.0], "rotation": [1.0, 0.0, 0.0, 0.0] },
            { "name": "dark two", "mesh": 3, "translation": [8.0, -3.0, 0.0], "rotation": [1.0, 0.0, 0.0, 0.0] },
            { "name": "sheet", "mesh": 4, "translation": [-1.8, 1.5, -1.0], "rotation": [0.0, 0.0, 0.6, 0.8] },
            { "name": "rising", "mesh": 5, "translation": [1.0, 1.0, -1.5] },
            { "name": "puppet", "mesh": 6, "skin": 0, "translation": [0.5, 0.3, -1.9] },
            { "name": "lights", "children": [11], "translation": [0.0, 1.0, 0.0] },
            { "name": "elsewhere", "mesh": 2 },
            { "name": "spot", "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "name": "eye", "camera": 0, "translation": [0.0, 1.6, 5.0] },
        ],
        "meshes": [
            { "name": "floor", "primitives": [{
                "attributes": { "POSITION": square, "NORMAL": up, "TEXCOORD_0": uv, "_ID": numbers },
                "indices": corners, "material": 0,
            }] },
            { "name": "lamp", "primitives": [{
                "attributes": { "POSITION": square }, "indices": strip, "mode": 5, "material": 1,
            }] },
            { "name": "plate", "extras": { "kept": 1 }, "primitives": [
                plate(2),
                { "attributes": { "POSITION": square }, "indices": line, "mode": 1, "material": 2 },
            ] },
            { "name": "dark", "primitives": [plate(2)] },
            { "name": "sheet", "primitives": [{
                "attributes": { "POSITION": square, "COLOR_0": colours },
                "indices": corners, "material": 3,
            }] },
            { "name": "rising", "weights": [0.0], "primitives": [{
                "attributes": { "POSITION": square }, "indices": corners, "material": 2,
                "targets": [{ "POSITION": raised }],
            }] },
            { "name": "puppet", "primitives": [{
                "attributes": { "POSITION": square, "JOINTS_0": joints, "WEIGHTS_0": weights },
                "indices": corners,
            }] },
        ],
        "materials": [
            { "name": "checker", "pbrMetallicRoughness": {
                "baseColorTexture": { "index": 0 }, "metallicFactor": 0.0,
            } },
            { "name": "glow", "emissiveFactor": [1.0, 0.9, 0.8],
              "pbrMetallicRoughness": { "baseColorFactor": [0.5, 0.5, 0.5, 1.0], "metallicFactor": 0.0 },
              "extensions": { "KHR_materials_emissive_strength": { "emissiveStrength": 10.0 } } },
            { "name": "red", "pbrMetallicRoughness": {
                "baseColorFactor": [0.8, 0.2, 0.1, 1.0], "metallicFactor": 0.0,
            }, "extras": { "maker": "us" } },
            { "name": "paper", "doubleSided": true, "pbrMetallicRoughness": {
                "baseColorFactor": [0.7, 0.7, 0.7, 1.0], "metallicFactor": 0.0,
            } },
        ],
        "textures": [{ "name": "checker", "source": 0, "sampler": 0 }],
        "samplers": [{ "magFilter": 9728, "minFilter": 9728, "wrapS": 10497, "wrapT": 10497 }],
        "images": [{ "name": "checker", "uri": "checker.png" }],
        "skins": [{ "joints": [9], "inverseBindMatrices": rest }],
        "animations": [{
            "name": "rise",
            "samplers": [{ "input": times, "output": moves }, { "input": times, "output": morphs }],
            "channels": [
                { "sampler": 0, "target": { "node": 9, "path": "translation" } },
                { "sampler": 1, "target": { "node": 7, "path": "weights" } },
            ],
        }],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 0.7, "znear": 0.01, "aspectRatio": 1.25 } }],
        "extensions": { "KHR_lights_punctual": { "lights": [{ "name": "spot", "type": "point" }] } },
        "extensionsUsed": ["KHR_lights_punctual", "KHR_materials_emissive_strength"],
        "buffers": [{ "uri": "studio.bin", "byteLength": data.bytes.len() }],
        "bufferViews": data.views,
        "accessors": data.accessors,
    });
    std::fs::write(folder.join("studio.bin"), &data.bytes).unwrap();
    std::fs::write(folder.join("checker.png"), CHECKER).unwrap();
    let path = folder.join("studio.gltf");
    std::fs::write(&path, document.to_string()).unwrap();
    path
}

/// Two by two texels: sRGB 230 and 120, grey. Made with Python's zlib and struct.
const CHECKER: &[u8] = include_bytes!("checker.png");

/// Solves a scene file into a folder: the lit GLB, and the light of each triangle.
pub(crate) fn solve(scene: &Path, folder: &Path, flags: &[&str]) -> [PathBuf; 2] {
    let outputs = ["lit.glb", "lit.csv"].map(|name| folder.join(name));
    let done = Command::new(env!("CARGO_BIN_EXE_radiosity"))
        .arg("solve")
        .arg(scene)
        .args(outputs.iter().flat_map(|path| ["-o".as_ref(), path.as_os_str()]))
        .args(flags)
        .output()
        .unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stderr));
    outputs
}
