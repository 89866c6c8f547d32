//! What opening a file gives.

use std::fmt;

use scene::{Document, Scene};

use crate::Diagnostic;

/// A checked scene, and what was odd about its file.
#[derive(Clone, Debug)]
pub struct Imported {
    /// The scene.
    pub scene: Scene,
    /// The warnings: first those about the file, then by triangle.
    pub diagnostics: Vec<Diagnostic>,
    /// What the file held, in numbers.
    pub summary: Summary,
    /// The glTF document, where there is one and [`Options`](crate::Options) keep it.
    pub document: Option<Document>,
}

/// What a file held, in numbers; Display is one line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Summary {
    /// How it was read.
    pub format: Format,
    /// Triangles, those without area included.
    pub triangles: usize,
    /// Triangles that emit.
    pub emitters: usize,
    /// Distinct vertex positions.
    pub vertices: usize,
    /// Distinct materials.
    pub materials: usize,
    /// Named groups.
    pub groups: usize,
    /// Cameras.
    pub cameras: usize,
}

impl Summary {
    pub(crate) fn of(scene: &Scene, format: Format) -> Self {
        Self {
            format,
            triangles: scene.triangles().len(),
            emitters: scene.ids().filter(|&id| scene.material_of(id).emits()).count(),
            vertices: scene.vertices().len(),
            materials: scene.materials().len(),
            groups: scene.groups().len(),
            cameras: scene.cameras().len(),
        }
    }
}

impl fmt::Display for Summary {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { format, triangles, emitters, vertices, materials, groups, cameras } = self;
        write!(
            f,
            "{format}: {triangles} triangles ({emitters} emit), {vertices} vertices, \
             {materials} materials, {groups} groups, {cameras} cameras"
        )
    }
}

/// The formats that can be opened.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Format {
    /// The triangle list `.tri`.
    Tri,
    /// View3D's vertices and surfaces, `.vs3`.
    Vs3,
    /// Wavefront OBJ with MTL.
    Obj,
    /// glTF 2.0 as JSON.
    Gltf,
    /// glTF 2.0 as one binary file.
    Glb,
}

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Tri => ".tri",
            Self::Vs3 => "View3D",
            Self::Obj => "OBJ",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
        })
    }
}
