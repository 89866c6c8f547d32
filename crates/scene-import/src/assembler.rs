//! Builds a scene from a reader's triangles: joins equal vertices and materials.

use std::collections::HashMap;
use std::fmt::Display;

use glam::DVec3;
use scene::{GroupId, Material, MaterialId, SceneBuilder, Sides, TriangleId, VertexId};

use crate::shortened::shortened;
use crate::{
    Diagnostic, DiagnosticKind, Error, ErrorKind, Format, Imported, SidesRule, Summary, lint, range,
};

/// Reflectance of a surface whose material is missing.
#[cfg(any(feature = "obj", feature = "gltf"))]
pub(crate) const MISSING_REFLECTANCE: scene::Rgb = scene::Rgb::splat(0.5);

/// How far above 1 the reflectance of a triangle may lie and still be brought to 1: as far as
/// the stated one, and as far again, as the mean of a texture is rounded as well.
const ROUNDING: f64 = 2.0 * range::ROUNDING;

/// Bytes of names any file may have in its scene, and for each of its own bytes. A name stands once
/// in a file, but instances and the materials of textured triangles have it each.
const FREE_NAME_BYTES: usize = 1 << 22;
const NAME_BYTES_PER_BYTE: usize = 64;

/// A scene in the making.
pub(crate) struct Assembler<'a> {
    file: &'a str,
    sides: SidesRule,
    builder: SceneBuilder,
    // The maps are looked up but never walked, so their order cannot show.
    vertices: HashMap<[u64; 3], VertexId>,
    materials: HashMap<MaterialKey, MaterialId>,
    groups: HashMap<String, GroupId>,
    /// How many bytes of names may still come.
    names: usize,
    triangles: usize,
    collapsed: Vec<TriangleId>,
    diagnostics: Vec<Diagnostic>,
}

/// A material by name and by the bits of its values.
type MaterialKey = (String, [u64; 6], Sides);

impl<'a> Assembler<'a> {
    /// An empty scene read from `file`, which is with its buffers this many bytes long.
    pub(crate) fn new(file: &'a str, sides: SidesRule, bytes: usize) -> Self {
        Self {
            file,
            sides,
            builder: SceneBuilder::new(),
            vertices: HashMap::new(),
            materials: HashMap::new(),
            groups: HashMap::new(),
            names: NAME_BYTES_PER_BYTE.saturating_mul(bytes).saturating_add(FREE_NAME_BYTES),
            triangles: 0,
            collapsed: Vec::new(),
            diagnostics: Vec::new(),
        }
    }

    /// Adds a warning about the triangle `triangle`, or about the file.
    pub(crate) fn warn(
        &mut self,
        kind: DiagnosticKind,
        triangle: Option<TriangleId>,
        place: impl Into<String>,
    ) {
        self.diagnostics.push(Diagnostic { kind, triangle, place: place.into() });
    }

    /// The material with these values, added if it is new; warnings about it are placed at
    /// `place`. Values out of range are refused, without their place: readers have judged
    /// those that stand in the file.
    pub(crate) fn material(
        &mut self,
        stated: Material,
        place: impl Display,
    ) -> Result<MaterialId, Error> {
        let [r, e] = [stated.reflectance.0, stated.emittance.0];
        let values = [r[0], r[1], r[2], e[0], e[1], e[2]].map(f64::to_bits);
        let key = (stated.name.clone(), values, stated.sides);
        if let Some(&id) = self.materials.get(&key) {
            return Ok(id);
        }
        self.named(&stated.name)?;
        let mut material = stated;
        material.sides = self.sides.decide(material.sides);
        self.settle_reflectance(&mut material, place);
        let id = self.builder.material(material).map_err(|cause| self.refused(cause))?;
        self.materials.insert(key, id);
        Ok(id)
    }

    /// Grey, for a surface whose material is missing.
    #[cfg(any(feature = "obj", feature = "gltf"))]
    pub(crate) fn missing_material(&mut self, name: &str) -> Result<MaterialId, Error> {
        let material = Material {
            name: name.to_owned(),
            reflectance: MISSING_REFLECTANCE,
            emittance: scene::Rgb::ZERO,
            sides: Sides::Front,
        };
        self.material(material, self.file)
    }

    /// Brings a reflectance that rounding has left above 1 back to it.
    fn settle_reflectance(&mut self, material: &mut Material, place: impl Display) {
        let stated = material.reflectance;
        let settled = stated.map(|c| if c <= 1.0 + ROUNDING { c.min(1.0) } else { c });
        let kind = if settled != stated {
            DiagnosticKind::ReflectanceClamped { stated }
        } else if stated.max_channel() == 1.0 {
            DiagnosticKind::ReflectanceOne
        } else {
            return;
        };
        self.warn(kind, None, format!("{place}: material {}", shortened(&material.name)));
        material.reflectance = settled;
    }

    /// A new group, even where another has the same name.
    pub(crate) fn new_group(&mut self, name: &str) -> Result<GroupId, Error> {
        self.named(name)?;
        Ok(self.builder.group(name))
    }

    /// The group of this name, added when it is first asked for.
    pub(crate) fn group(&mut self, name: &str) -> Result<GroupId, Error> {
        if let Some(&id) = self.groups.get(name) {
            return Ok(id);
        }
        let id = self.new_group(name)?;
        self.groups.insert(name.to_owned(), id);
        Ok(id)
    }

    /// Adds a camera.
    #[cfg(feature = "gltf")]
    pub(crate) fn camera(&mut self, camera: scene::Camera) -> Result<(), Error> {
        self.named(&camera.name)?;
        self.builder.camera(camera);
        Ok(())
    }

    /// Takes a name from the allowance.
    fn named(&mut self, name: &str) -> Result<(), Error> {
        self.names = self.names.checked_sub(name.len()).ok_or_else(|| {
            let message = "expected names that the file's size can justify";
            Error::new(ErrorKind::TooLarge, self.file, message)
        })?;
        Ok(())
    }

    /// Adds a triangle. One that arithmetic, such as the transform of a node, has given a
    /// coordinate that is not finite is collapsed to its first finite corner, or to the
    /// origin, so that the triangles after it keep their numbers.
    pub(crate) fn triangle(
        &mut self,
        mut corners: [DVec3; 3],
        material: MaterialId,
        group: GroupId,
    ) -> Result<TriangleId, Error> {
        let id = TriangleId::from(self.triangles);
        if corners.iter().any(|p| !p.is_finite()) {
            let stay = corners.into_iter().find(|p| p.is_finite()).unwrap_or(DVec3::ZERO);
            corners = [stay; 3];
            self.collapsed.push(id);
        }
        let vertices = corners.map(|p| self.vertex(p));
        self.builder.triangle(vertices, material, group).map_err(|cause| self.refused(cause))?;
        self.triangles += 1;
        Ok(id)
    }

    fn vertex(&mut self, position: DVec3) -> VertexId {
        // Adding 0 turns −0 into 0, which is the same place.
        let key = position.to_array().map(|c| (c + 0.0).to_bits());
        *self.vertices.entry(key).or_insert_with(|| self.builder.vertex(position))
    }

    /// How many triangles there are so far.
    #[cfg(feature = "gltf")]
    pub(crate) fn triangle_count(&self) -> usize {
        self.triangles
    }

    fn refused(&self, cause: scene::Error) -> Error {
        Error::new(ErrorKind::Invalid, self.file, cause.to_string()).because(cause)
    }

    /// Looks the triangles over and hands out the scene; `place` names a triangle's place
    /// in the file.
    pub(crate) fn finish(self, format: Format, place: impl Fn(TriangleId) -> String) -> Imported {
        let scene = self.builder.finish();
        let mut diagnostics = self.diagnostics;
        let mut add = |id: TriangleId, kind| {
            diagnostics.push(Diagnostic { kind, triangle: Some(id), place: place(id) });
        };
        for &id in &self.collapsed {
            add(id, DiagnosticKind::NonFinite);
        }
        lint::look_over(&scene, &self.collapsed, &mut add);
        // A stable sort keeps the order in which one triangle's warnings were found.
        diagnostics.sort_by_key(|d| d.triangle);
        let summary = Summary::of(&scene, format);
        Imported { scene, diagnostics, summary, document: None }
    }
}
