//! The numbers that a document's accessors stand for.

use scene::Document;
use serde_json::{Map, Value};

use super::{index, list};
use crate::{Error, ErrorKind};

/// Entries that an accessor without a buffer may stand for, as scene-import allows: it costs no
/// bytes of the file.
const MAX_ZEROS: usize = 1 << 22;

/// The accessors of a document, read when they are asked for.
pub(super) struct Accessors<'d> {
    accessors: &'d [Value],
    views: &'d [Value],
    document: &'d Document,
}

/// One accessor, whose entries lie one after another.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Entries {
    pub(super) layout: Layout,
    pub(super) count: usize,
    bytes: Vec<u8>,
}

/// How the entries of an accessor are spelt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Layout {
    /// The number that glTF has for the type of a component.
    pub(super) component: u32,
    pub(super) normalized: bool,
    /// Columns, and components in each.
    shape: (usize, usize),
}

pub(super) const FLOAT: u32 = 5126;

impl<'d> Accessors<'d> {
    pub(super) fn new(root: &'d Map<String, Value>, document: &'d Document) -> Self {
        let (accessors, views) = (list(root, "accessors"), list(root, "bufferViews"));
        Self { accessors, views, document }
    }

    /// Reads an accessor, sparse entries included.
    pub(super) fn read(&self, number: usize) -> Result<Entries, Error> {
        self.entries(number).ok_or_else(|| {
            let what =
                format!("accessors[{number}]: expected entries that lie within their buffer");
            Error::new(ErrorKind::Document(what))
        })
    }

    fn entries(&self, number: usize) -> Option<Entries> {
        let accessor = self.accessors.get(number)?;
        let layout = Layout::of(accessor)?;
        let (count, size) = (index(accessor, "count")?, layout.size());
        let mut bytes = match index(accessor, "bufferView") {
            None if count <= MAX_ZEROS => vec![0; count * size],
            None => return None,
            Some(view) => {
                let offset = index(accessor, "byteOffset").unwrap_or(0);
                let mut bytes = Vec::new();
                for entry in self.strided(view, offset, size, count)? {
                    bytes.extend_from_slice(entry);
                }
                bytes
            }
        };
        if let Some(sparse) = accessor.get("sparse") {
            let changed = index(sparse, "count")?;
            let (places, values) = (sparse.get("indices")?, sparse.get("values")?);
            let width = component_size(index(places, "componentType")?.try_into().ok()?)?;
            let part = |part: &Value, size| {
                let offset = index(part, "byteOffset").unwrap_or(0);
                self.strided(index(part, "bufferView")?, offset, size, changed)
            };
            for (place, value) in part(places, width)?.zip(part(values, size)?) {
                let mut wide = [0; 4];
                wide.get_mut(..width)?.copy_from_slice(place);
                let at = (u32::from_le_bytes(wide) as usize).checked_mul(size)?;
                bytes.get_mut(at..at.checked_add(size)?)?.copy_from_slice(value);
            }
        }
        Some(Entries { layout, count, bytes })
    }

    /// The entries of a view, each `size` bytes.
    fn strided(
        &self,
        view: usize,
        offset: usize,
        size: usize,
        count: usize,
    ) -> Option<impl Iterator<Item = &'d [u8]> + use<'d>> {
        let view = self.views.get(view)?;
        let data = view_bytes(self.document, view)?;
        let stride = index(view, "byteStride").unwrap_or(size);
        let length = match count.checked_sub(1) {
            None => 0,
            Some(gaps) => gaps.checked_mul(stride)?.checked_add(size)?,
        };
        let data = data.get(offset..offset.checked_add(length)?)?;
        (stride >= size && size > 0)
            .then(|| data.chunks(stride).take(count).map(move |entry| &entry[..size]))
    }
}

/// The bytes of a buffer view.
pub(super) fn view_bytes<'d>(document: &'d Document, view: &Value) -> Option<&'d [u8]> {
    let start = index(view, "byteOffset").unwrap_or(0);
    let end = start.checked_add(index(view, "byteLength")?)?;
    document.buffers.get(index(view, "buffer")?)?.get(start..end)
}

impl Layout {
    fn of(accessor: &Value) -> Option<Self> {
        let shape = match accessor.get("type")?.as_str()? {
            "SCALAR" => (1, 1),
            "VEC2" => (1, 2),
            "VEC3" => (1, 3),
            "VEC4" => (1, 4),
            "MAT2" => (2, 2),
            "MAT3" => (3, 3),
            "MAT4" => (4, 4),
            _ => return None,
        };
        let component = index(accessor, "componentType")?.try_into().ok()?;
        component_size(component)?;
        let normalized = accessor.get("normalized").and_then(Value::as_bool).unwrap_or(false);
        Some(Self { component, normalized, shape })
    }

    /// Numbers in an entry.
    pub(super) fn components(self) -> usize {
        self.shape.0 * self.shape.1
    }

    /// The name of the shape.
    pub(super) fn name(self) -> &'static str {
        match self.shape {
            (1, 1) => "SCALAR",
            (1, 2) => "VEC2",
            (1, 3) => "VEC3",
            (1, _) => "VEC4",
            (2, _) => "MAT2",
            (3, _) => "MAT3",
            _ => "MAT4",
        }
    }

    /// Bytes of an entry. The columns of a matrix begin on a multiple of four.
    pub(super) fn size(self) -> usize {
        (self.shape.0 - 1) * self.column() + self.shape.1 * self.width()
    }

    /// Whether interpolated entries mean something: floats and shares do, numbers of things do not.
    pub(super) fn is_continuous(self) -> bool {
        self.component == FLOAT || self.normalized
    }

    fn width(self) -> usize {
        component_size(self.component).unwrap_or(4)
    }

    fn column(self) -> usize {
        let bytes = self.shape.1 * self.width();
        if self.shape.0 > 1 { bytes.next_multiple_of(4) } else { bytes }
    }
}

/// Bytes of a component, by glTF's number for its type.
fn component_size(component: u32) -> Option<usize> {
    match component {
        5120 | 5121 => Some(1),
        5122 | 5123 => Some(2),
        5125 | FLOAT => Some(4),
        _ => None,
    }
}

impl Entries {
    /// The bytes of an entry; none beyond the end.
    pub(super) fn raw(&self, entry: usize) -> Option<&[u8]> {
        let size = self.layout.size();
        self.bytes.get(entry.checked_mul(size)?..)?.get(..size)
    }

    /// Component `i` of an entry as a number; 0 beyond the end.
    ///
    /// # References
    /// glTF 2.0, section 3.6.2.2: normalised integers.
    pub(super) fn number(&self, entry: usize, i: usize) -> f64 {
        let Layout { component, normalized, shape } = self.layout;
        let at = (i / shape.1) * self.layout.column() + (i % shape.1) * self.layout.width();
        let bytes = self.raw(entry).map_or(&[][..], |raw| &raw[at..at + self.layout.width()]);
        let (value, most) = match (component, bytes) {
            (5120, &[a]) => (f64::from(a as i8), f64::from(i8::MAX)),
            (5121, &[a]) => (f64::from(a), f64::from(u8::MAX)),
            (5122, &[a, b]) => (f64::from(i16::from_le_bytes([a, b])), f64::from(i16::MAX)),
            (5123, &[a, b]) => (f64::from(u16::from_le_bytes([a, b])), f64::from(u16::MAX)),
            (5125, &[a, b, c, d]) => {
                (f64::from(u32::from_le_bytes([a, b, c, d])), f64::from(u32::MAX))
            }
            (_, &[a, b, c, d]) => return f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => return 0.0,
        };
        if normalized { (value / most).max(-1.0) } else { value }
    }
}
