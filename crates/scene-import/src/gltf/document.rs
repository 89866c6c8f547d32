//! The JSON, validated, and the buffers it names.

use std::borrow::Cow;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

use gltf::binary::Glb;
use gltf::json::mesh::Semantic;
use gltf::json::validation::Checked;
use gltf::{Document, Gltf};

use super::{restore, uri};
use crate::beside::Beside;
use crate::open::Source;
use crate::{Error, ErrorKind};

/// Bytes of a GLB header, the shortest length it can state.
const GLB_HEADER: u32 = 12;

/// What a reader needs of a document besides the scene in it.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    /// The JSON as text.
    pub(super) text: bool,
    /// The light, if this project put it in: attributes, and primitives of backs.
    pub(super) light: bool,
}

/// A validated document with its buffers.
pub(super) struct Parsed {
    pub(super) document: Document,
    /// Buffers that name one file share its bytes.
    pub(super) buffers: Vec<Arc<[u8]>>,
    /// The JSON as text, light that this project put in taken out of it; where it is asked for.
    pub(super) text: Option<String>,
}

impl Parsed {
    /// Parses and validates, then fetches the buffers.
    pub(super) fn new(
        source: &Source<'_>,
        wanted: Wanted,
        beside: &mut Beside<'_>,
    ) -> Result<Self, Error> {
        let fail = |cause| failure(source.name, cause);
        check_stated_length(source)?;
        let Gltf { document, blob } =
            Gltf::from_slice_without_validation(source.bytes).map_err(fail)?;
        let (json, text) = unlit(source.bytes, document.into_json(), wanted).map_err(fail)?;
        check_positions(source.name, &json)?;
        let document = Document::from_json(json).map_err(fail)?;
        let buffers = buffers(source, &document, blob, beside)?;
        Ok(Self { document, buffers, text })
    }
}

/// The document as it was before this project put light in, and its text if that is to be kept.
fn unlit(
    file: &[u8],
    json: gltf::json::Root,
    wanted: Wanted,
) -> Result<(gltf::json::Root, Option<String>), gltf::Error> {
    let text: Cow<'_, [u8]> =
        if file.starts_with(b"glTF") { Glb::from_slice(file)?.json } else { Cow::Borrowed(file) };
    let kept = |text: &[u8]| wanted.text.then(|| String::from_utf8_lossy(text).into_owned());
    match restore::restore(&text, wanted.light) {
        None => Ok((json, kept(&text))),
        Some(restored) => Ok((gltf::json::deserialize::from_slice(&restored)?, kept(&restored))),
    }
}

/// The gltf crate subtracts the header from the length stated in it, unchecked.
fn check_stated_length(source: &Source<'_>) -> Result<(), Error> {
    if source.bytes.starts_with(b"glTF") {
        let length = source.bytes.get(8..12).and_then(|bytes| bytes.try_into().ok());
        if length.map(u32::from_le_bytes).is_none_or(|length| length < GLB_HEADER) {
            let message = "expected a GLB header that states the file's length";
            return Err(Error::new(ErrorKind::Syntax, source.name, message));
        }
    }
    Ok(())
}

/// The gltf crate's validation follows a primitive's POSITION before it checks the index.
fn check_positions(file: &str, json: &gltf::json::Root) -> Result<(), Error> {
    for (m, mesh) in json.meshes.iter().enumerate() {
        for (p, primitive) in mesh.primitives.iter().enumerate() {
            let position = primitive.attributes.get(&Checked::Valid(Semantic::Positions));
            if position.is_some_and(|index| index.value() >= json.accessors.len()) {
                let message = format!(
                    "meshes[{m}].primitives[{p}].attributes.POSITION: expected one of {} accessors",
                    json.accessors.len()
                );
                return Err(Error::new(ErrorKind::Invalid, file, message));
            }
        }
    }
    Ok(())
}

fn buffers(
    source: &Source<'_>,
    document: &Document,
    blob: Option<Vec<u8>>,
    beside: &mut Beside<'_>,
) -> Result<Vec<Arc<[u8]>>, Error> {
    let mut blob = blob;
    let mut buffers = Vec::new();
    let mut files = HashMap::new();
    for buffer in document.buffers() {
        let fail = |reason: String| {
            let message = format!("buffers[{}]: {reason}", buffer.index());
            Error::new(ErrorKind::Invalid, source.name, message)
        };
        let data = match buffer.source() {
            gltf::buffer::Source::Bin => blob
                .take()
                .map(Arc::from)
                .ok_or_else(|| fail("expected one binary chunk for it".to_owned())),
            gltf::buffer::Source::Uri(uri) => fetch(uri, beside, &mut files).map_err(|reason| {
                fail(format!("{} cannot be read: {reason}", uri::shortened(uri)))
            }),
        }?;
        if data.len() < buffer.length() {
            return Err(fail(format!("expected {} bytes, found {}", buffer.length(), data.len())));
        }
        buffers.push(data);
    }
    Ok(buffers)
}

/// The bytes behind a URI; those of a file once, however often it is named.
pub(super) fn fetch(
    uri: &str,
    beside: &mut Beside<'_>,
    files: &mut HashMap<PathBuf, Arc<[u8]>>,
) -> Result<Arc<[u8]>, String> {
    if let Some(data) = uri::data(uri) {
        return data.map(Arc::from);
    }
    let path = beside.find(&uri::path(uri)?)?;
    if let Some(known) = files.get(&path) {
        return Ok(Arc::clone(known));
    }
    let bytes: Arc<[u8]> = beside.read_found(&path)?.into();
    files.insert(path, Arc::clone(&bytes));
    Ok(bytes)
}

fn failure(file: &str, cause: gltf::Error) -> Error {
    match &cause {
        gltf::Error::Deserialize(json) => {
            // Only a file of bare JSON has lines to point at; a message ends with them too.
            let (line, column) = (json.line() as u64, json.column() as u64);
            let text = json.to_string();
            let text =
                text.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&text);
            let error = Error::new(ErrorKind::Syntax, file, format!("expected glTF JSON: {text}"));
            let error = if line > 0 { error.at(line, column) } else { error };
            error.because(cause)
        }
        gltf::Error::Validation(errors) => {
            let first = errors.first().map(|(path, error)| format!("{path}: {error}"));
            let mut message = format!("expected valid glTF: {}", first.unwrap_or_default());
            if errors.len() > 1 {
                message += &format!(" (and {} more)", errors.len() - 1);
            }
            Error::new(ErrorKind::Invalid, file, message).because(cause)
        }
        _ => Error::new(ErrorKind::Syntax, file, format!("expected a glTF file: {cause}"))
            .because(cause),
    }
}
