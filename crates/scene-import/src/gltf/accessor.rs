//! Reading accessors with every offset checked.

use gltf::Accessor;
use gltf::accessor::DataType;

use super::budget::Budget;
use super::document::Parsed;
use crate::{Error, ErrorKind};

/// Entries that an accessor without a buffer may stand for: it costs no bytes. A primitive has up
/// to six accessors, which take 24 bytes an entry: 10 MB.
const MAX_ZEROS: usize = 1 << 16;

/// Reads `N` components of each entry as numbers, integers scaled to [0, 1] or [−1, 1] where
/// the accessor says so; all must be finite. Entries may have more components than `N`,
/// which are left out.
pub(super) fn read<const N: usize>(
    accessor: &Accessor<'_>,
    parsed: &Parsed,
    budget: &mut Budget<'_>,
) -> Result<Vec<[f64; N]>, Error> {
    let place = format!("accessors[{}]", accessor.index());
    budget.entries(accessor.count(), &place)?;
    read_checked(accessor, parsed)
        .and_then(finite)
        .map_err(|message| budget.invalid(&format!("{place}: {message}")))
}

/// The entries, if all their numbers are finite: no coordinate or colour is otherwise.
fn finite<const N: usize>(entries: Vec<[f64; N]>) -> Result<Vec<[f64; N]>, String> {
    let wrong = entries.iter().enumerate().find_map(|(number, entry)| {
        entry.iter().find(|c| !c.is_finite()).map(|component| (number, *component))
    });
    match wrong {
        Some((number, component)) => {
            Err(format!("expected finite numbers, found {component} in entry {number}"))
        }
        None => Ok(entries),
    }
}

/// Reads indices.
pub(super) fn read_indices(
    accessor: &Accessor<'_>,
    parsed: &Parsed,
    budget: &mut Budget<'_>,
) -> Result<Vec<u32>, Error> {
    let whole = matches!(accessor.data_type(), DataType::U8 | DataType::U16 | DataType::U32);
    if !whole || accessor.normalized() {
        let place = format!("accessors[{}]", accessor.index());
        return Err(budget.invalid(&format!("{place}: expected unsigned integers for indices")));
    }
    // A 32-bit integer survives the way through f64 unchanged.
    Ok(read::<1>(accessor, parsed, budget)?.into_iter().map(|[index]| index as u32).collect())
}

impl Budget<'_> {
    /// A failure in the file that the budget is for.
    pub(super) fn invalid(&self, message: &str) -> Error {
        Error::new(ErrorKind::Invalid, self.file(), message)
    }
}

fn read_checked<const N: usize>(
    accessor: &Accessor<'_>,
    parsed: &Parsed,
) -> Result<Vec<[f64; N]>, String> {
    let components = accessor.dimensions().multiplicity();
    if components < N {
        return Err(format!("expected {N} components, found {components}"));
    }
    let layout = Layout { data_type: accessor.data_type(), normalized: accessor.normalized() };
    let count = accessor.count();
    let mut entries = match accessor.view() {
        Some(view) => {
            let size = accessor.size();
            let data = strided(parsed, &view, accessor.offset(), size, count)?;
            data.map(|entry| layout.decode(entry)).collect()
        }
        None if count <= MAX_ZEROS => vec![[0.0; N]; count],
        None => return Err(format!("expected at most {MAX_ZEROS} entries without a buffer")),
    };
    if let Some(sparse) = accessor.sparse() {
        let (indices, values) = (sparse.indices(), sparse.values());
        let index_size = indices.index_type().size();
        let at = strided(parsed, &indices.view(), indices.offset(), index_size, sparse.count())?;
        let to = strided(parsed, &values.view(), values.offset(), accessor.size(), sparse.count())?;
        for (index, value) in at.zip(to) {
            let mut bytes = [0; 4];
            bytes[..index_size].copy_from_slice(index);
            let index = u32::from_le_bytes(bytes);
            let entry = entries.get_mut(index as usize);
            *entry
                .ok_or_else(|| format!("expected a sparse index below {count}, found {index}"))? =
                layout.decode(value);
        }
    }
    Ok(entries)
}

/// The `count` entries of `size` bytes in a buffer view, which must hold them all.
fn strided<'p>(
    parsed: &'p Parsed,
    view: &gltf::buffer::View<'_>,
    offset: usize,
    size: usize,
    count: usize,
) -> Result<impl Iterator<Item = &'p [u8]> + use<'p>, String> {
    let stride = view.stride().unwrap_or(size);
    if stride < size {
        return Err(format!("expected a stride of at least {size}, found {stride}"));
    }
    let data = view_bytes(parsed, view)?;
    let last = count.checked_sub(1).and_then(|last| last.checked_mul(stride));
    let end = match last {
        None if count == 0 => Some(offset),
        None => None,
        Some(last) => last.checked_add(size).and_then(|length| length.checked_add(offset)),
    };
    let data = end.and_then(|end| data.get(offset..end)).ok_or_else(|| {
        format!("expected {count} entries of {size} bytes in bufferViews[{}]", view.index())
    })?;
    Ok(data.chunks(stride.max(1)).map(move |entry| &entry[..size]))
}

/// The bytes of a buffer view.
pub(super) fn view_bytes<'p>(
    parsed: &'p Parsed,
    view: &gltf::buffer::View<'_>,
) -> Result<&'p [u8], String> {
    let end = view.offset().checked_add(view.length());
    let buffer = &parsed.buffers[view.buffer().index()];
    end.and_then(|end| buffer.get(view.offset()..end))
        .ok_or_else(|| format!("expected bufferViews[{}] to lie within its buffer", view.index()))
}

/// How components are spelt.
#[derive(Clone, Copy)]
struct Layout {
    data_type: DataType,
    normalized: bool,
}

impl Layout {
    fn decode<const N: usize>(self, entry: &[u8]) -> [f64; N] {
        let size = self.data_type.size();
        std::array::from_fn(|i| self.component(&entry[i * size..(i + 1) * size]))
    }

    /// # References
    /// glTF 2.0, section 3.6.2.2: normalised integers.
    fn component(self, bytes: &[u8]) -> f64 {
        let (value, most) = match (self.data_type, bytes) {
            (DataType::I8, &[a]) => (f64::from(a as i8), f64::from(i8::MAX)),
            (DataType::U8, &[a]) => (f64::from(a), f64::from(u8::MAX)),
            (DataType::I16, &[a, b]) => {
                (f64::from(i16::from_le_bytes([a, b])), f64::from(i16::MAX))
            }
            (DataType::U16, &[a, b]) => {
                (f64::from(u16::from_le_bytes([a, b])), f64::from(u16::MAX))
            }
            (DataType::U32, &[a, b, c, d]) => {
                (f64::from(u32::from_le_bytes([a, b, c, d])), f64::from(u32::MAX))
            }
            (DataType::F32, &[a, b, c, d]) => return f64::from(f32::from_le_bytes([a, b, c, d])),
            _ => unreachable!("`decode` cuts components of the type's size"),
        };
        if self.normalized { (value / most).max(-1.0) } else { value }
    }
}
