//! The container of a GLB, and the numbers that its accessors lead to.

use serde_json::Value;

use super::document::{array, index};
use crate::Error;

const MAGIC: &[u8] = b"glTF";
const VERSION: u32 = 2;
const JSON: &[u8] = b"JSON";
const BINARY: &[u8] = b"BIN\0";
const FLOAT: u64 = 5126;
const UNSIGNED_INT: u64 = 5125;

/// The JSON chunk, and the binary one, empty where there is none.
pub(super) fn chunks(bytes: &[u8]) -> Result<(&[u8], &[u8]), Error> {
    let short = || Error::new("the file is cut short: expected a GLB, version 2");
    if bytes.get(..4).ok_or_else(short)? != MAGIC || number(bytes, 4).ok_or_else(short)? != VERSION
    {
        return Err(Error::new("expected a GLB, version 2, which begins with glTF"));
    }
    let length = number(bytes, 8).ok_or_else(short)? as usize;
    let mut rest = bytes.get(12..length).ok_or_else(short)?;
    let mut next = |kind: &[u8]| -> Result<&[u8], Error> {
        let size = number(rest, 0).ok_or_else(short)? as usize;
        if rest.get(4..8).ok_or_else(short)? != kind {
            let kind = String::from_utf8_lossy(kind).trim_end_matches('\0').to_owned();
            return Err(Error::new(format!("expected a chunk of type {kind}")));
        }
        let chunk = rest.get(8..).and_then(|after| after.get(..size)).ok_or_else(short)?;
        rest = &rest[8 + size..];
        Ok(chunk)
    };
    let json = next(JSON)?;
    let whole = 20 + json.len() == length;
    Ok((json, if whole { &[] } else { next(BINARY)? }))
}

fn number(bytes: &[u8], at: usize) -> Option<u32> {
    Some(u32::from_le_bytes(*bytes.get(at..)?.first_chunk()?))
}

/// The binary chunk, with the document that says what lies where.
pub(super) struct Binary<'a> {
    pub(super) root: &'a Value,
    pub(super) data: &'a [u8],
}

impl Binary<'_> {
    /// Three floats for each entry of an accessor.
    pub(super) fn triples(&self, accessor: usize) -> Result<Vec<[f32; 3]>, Error> {
        let entries = self.entries::<12>(accessor, FLOAT, "VEC3")?;
        let float = |bytes: &[u8; 12], c: usize| {
            f32::from_le_bytes([bytes[4 * c], bytes[4 * c + 1], bytes[4 * c + 2], bytes[4 * c + 3]])
        };
        Ok(entries.iter().map(|entry| [0, 1, 2].map(|c| float(entry, c))).collect())
    }

    /// One index for each entry of an accessor.
    pub(super) fn indices(&self, accessor: usize) -> Result<Vec<u32>, Error> {
        let entries = self.entries::<4>(accessor, UNSIGNED_INT, "SCALAR")?;
        Ok(entries.into_iter().map(u32::from_le_bytes).collect())
    }

    fn entries<const N: usize>(
        &self,
        number: usize,
        component: u64,
        shape: &str,
    ) -> Result<Vec<[u8; N]>, Error> {
        let at = format!("accessors[{number}]");
        let accessor = array(self.root, "accessors").get(number);
        let accessor = accessor.ok_or_else(|| Error::new(format!("there is no {at}")))?;
        let kind = accessor.get("componentType").and_then(Value::as_u64);
        if kind != Some(component) || accessor.get("type").and_then(Value::as_str) != Some(shape) {
            return Err(Error::new(format!(
                "{at}: expected {shape} of component type {component}"
            )));
        }
        let view_number = index(accessor, "bufferView", &at)?;
        let view_at = format!("bufferViews[{view_number}]");
        let view = array(self.root, "bufferViews").get(view_number);
        let view = view.ok_or_else(|| Error::new(format!("{at}: there is no {view_at}")))?;
        let optional = |value: &Value, name: &str, at: &str, default: usize| match value.get(name) {
            None => Ok(default),
            Some(_) => index(value, name, at),
        };
        let start = optional(view, "byteOffset", &view_at, 0)?;
        let length = index(view, "byteLength", &view_at)?;
        let stride = optional(view, "byteStride", &view_at, N)?;
        let first = optional(accessor, "byteOffset", &at, 0)?;
        let count = index(accessor, "count", &at)?;
        let outside = || Error::new(format!("{at}: reaches beyond {view_at} or the file"));
        let bytes = start.checked_add(length).and_then(|end| self.data.get(start..end));
        let bytes = bytes.and_then(|bytes| bytes.get(first..)).ok_or_else(outside)?;
        // Before anything is reserved for them.
        if stride < N || count.checked_sub(1).is_some_and(|last| last > bytes.len() / stride) {
            return Err(outside());
        }
        (0..count)
            .map(|i| {
                bytes.get(i * stride..).and_then(|b| b.first_chunk()).copied().ok_or_else(outside)
            })
            .collect()
    }
}
