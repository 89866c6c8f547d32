//! Light as bytes, little-endian, as `web/src/light.js` reads them.
//!
//! Arrays of four-byte numbers, then the header: JSON that names each with its type, offset and count.
//! Then the header's length, a u32.

use scene::{Camera, Face, Material};
use serde_json::{Value, json};

use crate::{Error, Means, Shown};

/// Packs a lit scene; `progress` is what the page is told of light on its way, else null.
///
/// Positions are relative to the middle of the scene and to its size before they are narrowed to f32, so a
/// scene far from the origin keeps its shape.
///
/// # Errors
/// A solution that does not belong to the scene, numbers that are not finite or too large for f32, a
/// camera that looks nowhere.
pub fn frame(shown: &Shown<'_>, progress: &Value) -> Result<Vec<u8>, Error> {
    shown.check()?;
    let (scene, solution) = (shown.scene, shown.solution);
    let (centre, scale) = shown.extent();
    let counts =
        3 * solution.vertices.len() + 18 * solution.elements.len() + 2 * scene.triangles().len();
    let mut arrays = Arrays { named: Vec::new(), bytes: Vec::with_capacity(4 * counts) };
    arrays.floats(
        "positions",
        solution.vertices.iter().flat_map(|p| ((*p - centre) / scale).to_array()),
    );
    let elements = &solution.elements;
    arrays.integers("vertices", elements.iter().flat_map(|e| e.vertices.map(|v| v.0)));
    arrays.floats("exitance", elements.iter().flat_map(|e| e.exitance.0));
    arrays.floats(
        "cornerExitance",
        elements.iter().flat_map(|e| e.corner_exitance).flat_map(|light| light.0),
    );
    // In the page's unit: a file's unit may make areas too large for f32.
    arrays.floats("areas", elements.iter().map(|e| solution.area(e) / scale / scale));
    arrays.integers("triangles", elements.iter().map(|e| e.triangle.0));
    arrays.integers("backs", elements.iter().map(|e| u32::from(e.face == Face::Back)));
    arrays.integers("triangleMaterials", scene.triangles().iter().map(|t| t.material.0));
    arrays.integers("triangleGroups", scene.triangles().iter().map(|t| t.group.0));
    let header = json!({
        "arrays": arrays.named,
        "centre": centre.to_array(),
        "scale": scale,
        "unit": shown.unit,
        "exposure": shown.exposure,
        "cornersOnly": shown.means == Means::OfCorners,
        "materials": scene.materials().iter().map(material).collect::<Vec<_>>(),
        "groups": scene.groups(),
        "cameras": shown.cameras().map(camera).collect::<Vec<_>>(),
        "progress": progress,
    });
    let header = header.to_string();
    let length = u32::try_from(header.len())
        .map_err(|_| Error::new("names of more than 4 GiB are too large for a page"))?;
    let mut bytes = arrays.bytes;
    bytes.extend(header.as_bytes());
    bytes.extend(length.to_le_bytes());
    Ok(bytes)
}

/// Arrays one after the other, and where each lies.
struct Arrays {
    named: Vec<Value>,
    bytes: Vec<u8>,
}

impl Arrays {
    fn floats(&mut self, name: &str, values: impl Iterator<Item = f64>) {
        self.put(name, "f32", values.map(|v| (v as f32).to_le_bytes()));
    }

    fn integers(&mut self, name: &str, values: impl Iterator<Item = u32>) {
        self.put(name, "u32", values.map(u32::to_le_bytes));
    }

    fn put(&mut self, name: &str, kind: &str, values: impl Iterator<Item = [u8; 4]>) {
        let offset = self.bytes.len();
        self.bytes.extend(values.flatten());
        let count = (self.bytes.len() - offset) / 4;
        self.named.push(json!({ "name": name, "type": kind, "offset": offset, "count": count }));
    }
}

fn material(material: &Material) -> Value {
    json!({
        "name": material.name,
        "reflectance": material.reflectance.0,
        "emittance": material.emittance.0,
    })
}

fn camera(camera: &Camera) -> Value {
    json!({
        "name": camera.name,
        "position": camera.position.to_array(),
        "target": camera.target.to_array(),
        "up": camera.up.to_array(),
        "fov": camera.vertical_fov,
    })
}
