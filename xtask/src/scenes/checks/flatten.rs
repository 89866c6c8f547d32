//! Reads a GLB back as triangles in the scene's coordinates, by the glTF 2.0 specification and
//! without the code that wrote it.

use serde_json::Value;

use super::{Point, Triangle, add, cross, dot, scale};

/// Columns of a node's linear part, and its translation.
#[derive(Clone, Copy)]
struct Transform([Point; 3], Point);

/// Every triangle with whether its material is double-sided.
pub(super) fn triangles(file: &[u8]) -> Vec<(Triangle, bool)> {
    let word = |at: usize| u32::from_le_bytes(file[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!(&file[..4], b"glTF");
    assert_eq!((word(4), word(8)), (2, file.len()));
    let text = &file[20..20 + word(12)];
    let start = 20 + word(12);
    assert_eq!((&file[16..20], &file[start + 4..start + 8]), (&b"JSON"[..], &b"BIN\0"[..]));
    let bytes = &file[start + 8..start + 8 + word(start)];
    let document = Document { json: serde_json::from_slice(text).unwrap(), bytes };

    let mut found = Vec::new();
    let identity = Transform([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], [0.0; 3]);
    for root in document.json["scenes"][0]["nodes"].as_array().unwrap() {
        document.visit(index(root), identity, &mut found);
    }
    found
}

struct Document<'a> {
    json: Value,
    bytes: &'a [u8],
}

impl Document<'_> {
    fn visit(&self, node: usize, parent: Transform, found: &mut Vec<(Triangle, bool)>) {
        let node = &self.json["nodes"][node];
        let here = parent.then(&local(node));
        if let Some(mesh) = node["mesh"].as_u64() {
            for primitive in self.json["meshes"][mesh as usize]["primitives"].as_array().unwrap() {
                self.add(primitive, here, found);
            }
        }
        for child in node["children"].as_array().into_iter().flatten() {
            self.visit(index(child), here, found);
        }
    }

    fn add(&self, primitive: &Value, here: Transform, found: &mut Vec<(Triangle, bool)>) {
        let floats: Vec<f64> = self
            .accessor(&primitive["attributes"]["POSITION"], 3 * 4)
            .chunks(4)
            .map(|b| f64::from(f32::from_le_bytes(b.try_into().unwrap())))
            .collect();
        let points: Vec<Point> = floats.chunks(3).map(|p| here.at(p.try_into().unwrap())).collect();
        let indices: Vec<usize> = self
            .accessor(&primitive["indices"], 2)
            .chunks(2)
            .map(|b| usize::from(u16::from_le_bytes(b.try_into().unwrap())))
            .collect();
        let material = &self.json["materials"][index(&primitive["material"])];
        let two_sided = material["doubleSided"].as_bool().unwrap_or(false);
        for corner in indices.chunks(3) {
            let [a, b, c] = [points[corner[0]], points[corner[1]], points[corner[2]]];
            // A mirroring transform turns the winding, and with it the front (glTF 2.0, §3.7.4).
            let triangle = if here.mirrors() { [a, c, b] } else { [a, b, c] };
            found.push((triangle, two_sided));
        }
    }

    fn accessor(&self, number: &Value, stride: usize) -> &[u8] {
        let accessor = &self.json["accessors"][index(number)];
        let view = &self.json["bufferViews"][index(&accessor["bufferView"])];
        let start = index(&view["byteOffset"]);
        &self.bytes[start..start + stride * index(&accessor["count"])]
    }
}

impl Transform {
    fn at(&self, p: Point) -> Point {
        add(self.turn(p), self.1)
    }

    fn turn(&self, [x, y, z]: Point) -> Point {
        let [a, b, c] = self.0;
        add(scale(a, x), add(scale(b, y), scale(c, z)))
    }

    fn then(&self, inner: &Transform) -> Transform {
        Transform(inner.0.map(|column| self.turn(column)), self.at(inner.1))
    }

    fn mirrors(&self) -> bool {
        let [a, b, c] = self.0;
        dot(cross(a, b), c) < 0.0
    }
}

/// A node's own translation · rotation · scale.
fn local(node: &Value) -> Transform {
    let [tx, ty, tz] = numbers(&node["translation"], [0.0; 3]);
    let [x, y, z, w] = numbers(&node["rotation"], [0.0, 0.0, 0.0, 1.0]);
    let [sx, sy, sz] = numbers(&node["scale"], [1.0; 3]);
    let columns = [
        [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + z * w), 2.0 * (x * z - y * w)],
        [2.0 * (x * y - z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + x * w)],
        [2.0 * (x * z + y * w), 2.0 * (y * z - x * w), 1.0 - 2.0 * (x * x + y * y)],
    ];
    let [a, b, c] = columns;
    Transform([scale(a, sx), scale(b, sy), scale(c, sz)], [tx, ty, tz])
}

fn numbers<const N: usize>(value: &Value, default: [f64; N]) -> [f64; N] {
    match value.as_array() {
        None => default,
        Some(list) => std::array::from_fn(|i| list[i].as_f64().unwrap()),
    }
}

fn index(value: &Value) -> usize {
    value.as_u64().unwrap() as usize
}
