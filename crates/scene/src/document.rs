//! The glTF document that a scene was read from, for a writer that gives it back with light.

use std::sync::Arc;

use crate::TriangleId;

/// A glTF document as it stood in its file, and which triangles of the scene it made.
///
/// Readers hand it out only when they are asked to; it holds the whole file once more.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Document {
    /// The JSON: nodes, names, materials, animations and what no reader here understands.
    pub json: String,
    /// The bytes of each of its buffers; those that are one file share them.
    pub buffers: Vec<Arc<[u8]>>,
    /// The encoded bytes of each of its images that lay in a file of its own; images of one file
    /// share them.
    pub images: Vec<Option<Arc<[u8]>>>,
    /// What each mesh became under each node, in the order of the scene's triangles.
    pub shapes: Vec<Shape>,
}

/// A primitive of a mesh under one node, and the triangles of the scene that it made.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Shape {
    /// The node, by its index in the document.
    pub node: usize,
    /// The mesh, by its index in the document.
    pub mesh: usize,
    /// The primitive, by its index in the mesh.
    pub primitive: usize,
    /// The first of its triangles; the others follow.
    pub first: TriangleId,
    /// For each of its triangles the indices of its vertices in the primitive, in the order in
    /// which glTF winds them.
    pub corners: Arc<[[u32; 3]]>,
    /// Whether the node mirrors: the scene's triangle then has the vertices of `[a, c, b]`.
    pub mirrored: bool,
}
