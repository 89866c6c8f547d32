//! A GLB taken apart, without the crates that wrote or read it.

use std::path::Path;

use serde_json::Value;

/// The JSON and the binary chunk.
pub(crate) struct Glb {
    pub(crate) json: Value,
    binary: Vec<u8>,
}

fn word(bytes: &[u8], at: usize) -> usize {
    u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize
}

pub(crate) fn index(value: &Value) -> usize {
    usize::try_from(value.as_u64().unwrap()).unwrap()
}

impl Glb {
    pub(crate) fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        assert_eq!((&bytes[..4], word(&bytes, 8)), (&b"glTF"[..], bytes.len()));
        let length = word(&bytes, 12);
        let json = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
        let binary = bytes[20 + length + 8..].to_vec();
        Self { json, binary }
    }

    /// The bytes of a buffer view.
    pub(crate) fn view(&self, view: usize) -> &[u8] {
        let view = &self.json["bufferViews"][view];
        assert_eq!(view["buffer"], 0);
        let start = index(&view["byteOffset"]);
        &self.binary[start..start + index(&view["byteLength"])]
    }

    /// The entries of an accessor as numbers, normalised ones in [0, 1].
    pub(crate) fn entries(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let accessor = &self.json["accessors"][index(accessor)];
        let view = index(&accessor["bufferView"]);
        let (size, full) = match index(&accessor["componentType"]) {
            5121 => (1, 255.0),
            5123 => (2, 65535.0),
            5125 => (4, 1.0),
            5126 => (4, 0.0),
            other => panic!("component type {other}"),
        };
        let parts = match accessor["type"].as_str().unwrap() {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            "VEC4" => 4,
            "MAT4" => 16,
            other => panic!("type {other}"),
        };
        let stride = self.json["bufferViews"][view].get("byteStride").map_or(size * parts, index);
        let bytes = &self.view(view)[accessor.get("byteOffset").map_or(0, index)..];
        let scale = if accessor["normalized"] == true { full } else { 1.0 };
        let number = |bytes: &[u8]| match (size, full) {
            (1, _) => f64::from(bytes[0]) / scale,
            (2, _) => f64::from(u16::from_le_bytes(bytes.try_into().unwrap())) / scale,
            (_, 0.0) => f64::from(f32::from_le_bytes(bytes.try_into().unwrap())),
            _ => f64::from(u32::from_le_bytes(bytes.try_into().unwrap())),
        };
        let entry = |i: usize| {
            (0..parts).map(|k| number(&bytes[i * stride + k * size..][..size])).collect()
        };
        (0..index(&accessor["count"])).map(entry).collect()
    }

    /// A node by its name.
    pub(crate) fn node(&self, name: &str) -> &Value {
        self.json["nodes"].as_array().unwrap().iter().find(|n| n["name"] == name).unwrap()
    }

    /// The primitives of the mesh that a node shows.
    pub(crate) fn primitives(&self, node: &str) -> &[Value] {
        let mesh = index(&self.node(node)["mesh"]);
        self.json["meshes"][mesh]["primitives"].as_array().unwrap()
    }

    /// An attribute of a primitive.
    pub(crate) fn attribute(&self, primitive: &Value, name: &str) -> Vec<Vec<f64>> {
        self.entries(&primitive["attributes"][name])
    }

    /// The faces of a primitive: three vertices each.
    pub(crate) fn faces(&self, primitive: &Value) -> Vec<[usize; 3]> {
        let indices = self.entries(&primitive["indices"]);
        indices.chunks_exact(3).map(|c| [0, 1, 2].map(|i| c[i][0] as usize)).collect()
    }
}
