//! The document itself, beside the scene that was made of it.

use std::collections::HashMap;
use std::sync::Arc;

use scene::{Document, Shape, TriangleId};

use super::document::{Parsed, fetch};
use super::primitive::Added;
use super::uri;
use crate::DiagnosticKind;
use crate::assembler::Assembler;
use crate::beside::Beside;

/// Notes which triangles came from where, if anybody wants to know.
pub(super) struct Keeper {
    wanted: bool,
    shapes: Vec<Shape>,
    /// By mesh and primitive: instances have the same corners.
    corners: HashMap<[usize; 2], Arc<[[u32; 3]]>>,
}

impl Keeper {
    pub(super) fn new(wanted: bool) -> Self {
        Self { wanted, shapes: Vec::new(), corners: HashMap::new() }
    }

    /// Notes what a primitive became under a node.
    pub(super) fn add(
        &mut self,
        [node, mesh, primitive]: [usize; 3],
        first: TriangleId,
        added: &Added,
    ) {
        if !self.wanted || added.corners.is_empty() {
            return;
        }
        let corners = self.corners.entry([mesh, primitive]).or_insert_with(|| {
            // Indices in a file have 32 bits at most.
            added.corners.iter().map(|triangle| triangle.map(|i| i as u32)).collect()
        });
        let corners = Arc::clone(corners);
        self.shapes.push(Shape { node, mesh, primitive, first, corners, mirrored: added.mirrored });
    }

    /// The document with all that it names, if anybody wants it. An image that cannot be read
    /// stays a name, with a warning.
    pub(super) fn finish(
        self,
        parsed: Parsed,
        mut beside: Beside<'_>,
        assembler: &mut Assembler<'_>,
    ) -> Option<Document> {
        let Parsed { document, buffers, text } = parsed;
        let json = text.filter(|_| self.wanted)?;
        let mut files = HashMap::new();
        let images = document.as_json().images.iter().enumerate();
        let images = images.map(|(index, image)| {
            let uri = image.uri.as_deref().filter(|uri| !uri.starts_with("data:"))?;
            match fetch(uri, &mut beside, &mut files) {
                Ok(bytes) => Some(bytes),
                Err(reason) => {
                    let name = uri::shortened(uri);
                    let kind = DiagnosticKind::MissingTexture { name, reason };
                    assembler.warn(kind, None, format!("images[{index}]"));
                    None
                }
            }
        });
        let images = images.collect();
        Some(Document { json, buffers, images, shapes: self.shapes })
    }
}
