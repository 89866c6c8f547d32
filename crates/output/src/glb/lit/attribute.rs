//! What the vertices of a primitive carry, and what a vertex inside a triangle carries then.

use serde_json::Value;

use super::accessor::{Accessors, Entries, FLOAT};
use crate::Error;

/// An attribute of a primitive, or of one of its morph targets.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Attribute {
    pub(super) name: Name,
    blend: Blend,
    entries: Entries,
}

/// Where an attribute stands in a primitive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Name {
    /// Among its own.
    Own(String),
    /// In a morph target.
    Target(usize, String),
}

/// How the values of three corners make one between them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Blend {
    /// By their shares.
    Linear,
    /// By their shares, then to unit length.
    Direction,
    /// As `Direction`, but the fourth component is a sign that all corners have in common.
    Tangent,
    /// As at the nearest corner: between the numbers of two things there is nothing.
    Nearest,
}

/// Whether a primitive follows a skeleton. Joints cannot be interpolated, so its triangles stay
/// whole.
pub(super) fn is_skinned(primitive: &Value) -> bool {
    let attributes = primitive.get("attributes").and_then(Value::as_object);
    attributes.is_some_and(|a| a.keys().any(|k| k.starts_with("JOINTS_")))
}

/// The name that an attribute has beside the light, which takes the place of `COLOR_0`: each set of
/// colours goes on under the next number. Blender 5.0 fails on some files with a second attribute
/// of a name that is not glTF's own, so none is made up.
pub(super) fn moved(name: &str) -> String {
    let number = name.strip_prefix("COLOR_").and_then(|number| number.parse::<u32>().ok());
    match number.and_then(|number| number.checked_add(1)) {
        Some(next) => format!("COLOR_{next}"),
        None => name.to_owned(),
    }
}

/// The attributes of a primitive, but for light that is there already.
pub(super) fn of(primitive: &Value, accessors: &Accessors<'_>) -> Result<Vec<Attribute>, Error> {
    let mut attributes = Vec::new();
    let own = primitive.get("attributes").and_then(Value::as_object);
    for (name, accessor) in own.into_iter().flatten() {
        if name == "_RADIOSITY" {
            continue;
        }
        let entries = read(accessor, accessors)?;
        let blend = match name.as_str() {
            "NORMAL" => Blend::Direction,
            "TANGENT" => Blend::Tangent,
            _ if entries.layout.is_continuous() || is_geometry(name) => Blend::Linear,
            _ => Blend::Nearest,
        };
        attributes.push(Attribute { name: Name::Own(moved(name)), blend, entries });
    }
    let targets = primitive.get("targets").and_then(Value::as_array);
    for (number, target) in targets.into_iter().flatten().enumerate() {
        for (name, accessor) in target.as_object().into_iter().flatten() {
            let entries = read(accessor, accessors)?;
            let name = Name::Target(number, name.clone());
            attributes.push(Attribute { name, blend: Blend::Linear, entries });
        }
    }
    Ok(attributes)
}

/// Whether an attribute is a length or a place whatever its integers look like, as
/// `KHR_mesh_quantization` allows.
fn is_geometry(name: &str) -> bool {
    name == "POSITION" || name.starts_with("TEXCOORD_")
}

fn read(accessor: &Value, accessors: &Accessors<'_>) -> Result<Entries, Error> {
    // The document is valid, so an attribute is an index; any other value is none of an accessor.
    let number = accessor.as_u64().and_then(|n| usize::try_from(n).ok()).unwrap_or(usize::MAX);
    accessors.read(number)
}

impl Attribute {
    /// The number of glTF for the component, whether it is normalised, and the shape, as
    /// [`write`](Self::write) spells it.
    pub(super) fn spelling(&self) -> (u32, bool, &'static str) {
        let layout = self.entries.layout;
        match self.blend {
            Blend::Nearest => (layout.component, layout.normalized, layout.name()),
            _ => (FLOAT, false, layout.name()),
        }
    }

    /// Bytes of an entry: a multiple of four, as vertices must have.
    pub(super) fn stride(&self) -> usize {
        match self.blend {
            Blend::Nearest => self.entries.layout.size().next_multiple_of(4),
            _ => 4 * self.entries.layout.components(),
        }
    }

    /// Adds the value at a point with these shares of three vertices, turned round for a back.
    pub(super) fn write(
        &self,
        out: &mut Vec<u8>,
        corners: [u32; 3],
        shares: [f64; 3],
        is_back: bool,
    ) {
        let corners = corners.map(|corner| corner as usize);
        let largest = (0..3).fold(0, |best, i| if shares[i] > shares[best] { i } else { best });
        if self.blend == Blend::Nearest {
            let start = out.len();
            out.extend_from_slice(self.entries.raw(corners[largest]).unwrap_or(&[]));
            out.resize(start + self.stride(), 0);
            return;
        }
        let components = self.entries.layout.components();
        let mut values: Vec<f64> = (0..components)
            .map(|i| (0..3).map(|k| shares[k] * self.corner(corners[k], i, shares[k])).sum())
            .collect();
        let turns = matches!(self.blend, Blend::Direction | Blend::Tangent);
        if turns {
            let length = values.iter().take(3).map(|c| c * c).sum::<f64>().sqrt();
            let side = if is_back && self.blend == Blend::Direction { -1.0 } else { 1.0 };
            if length > 0.0 {
                values.iter_mut().take(3).for_each(|c| *c *= side / length);
            }
        }
        if let (Blend::Tangent, Some(sign)) = (self.blend, values.get_mut(3)) {
            *sign = self.entries.number(corners[largest], 3);
        }
        // Adding 0 makes the two zeros one.
        out.extend(values.iter().flat_map(|c| (*c as f32 + 0.0).to_le_bytes()));
    }

    /// A corner's number; what has no share is not looked at, so that a value that is not finite
    /// stays where it is.
    fn corner(&self, corner: usize, i: usize, share: f64) -> f64 {
        if share > 0.0 { self.entries.number(corner, i) } else { 0.0 }
    }
}
