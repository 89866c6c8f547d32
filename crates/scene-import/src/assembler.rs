//! Builds a scene from a reader's triangles: joins equal vertices and materials, and
//! brings values that no scene may hold into range, each with a warning.

use std::collections::HashMap;

use glam::DVec3;
use scene::{GroupId, Material, MaterialId, SceneBuilder, Sides, TriangleId, VertexId};

use crate::{
    Diagnostic, DiagnosticKind, Error, ErrorKind, Format, Imported, SidesRule, Summary, lint,
};

/// Reflectance of a surface whose material is missing.
#[cfg(any(feature = "obj", feature = "gltf"))]
pub(crate) const MISSING_REFLECTANCE: scene::Rgb = scene::Rgb::splat(0.5);

/// A scene in the making.
pub(crate) struct Assembler<'a> {
    file: &'a str,
    sides: SidesRule,
    builder: SceneBuilder,
    // The maps are looked up but never walked, so their order cannot show.
    vertices: HashMap<[u64; 3], VertexId>,
    materials: HashMap<MaterialKey, MaterialId>,
    groups: HashMap<String, GroupId>,
    triangles: usize,
    collapsed: Vec<TriangleId>,
    diagnostics: Vec<Diagnostic>,
}

/// A material by name and by the bits of its values.
type MaterialKey = (String, [u64; 6], Sides);

impl<'a> Assembler<'a> {
    /// An empty scene read from `file`.
    pub(crate) fn new(file: &'a str, sides: SidesRule) -> Self {
        Self {
            file,
            sides,
            builder: SceneBuilder::new(),
            vertices: HashMap::new(),
            materials: HashMap::new(),
            groups: HashMap::new(),
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

    /// The material with these values, added if it is new, its values clamped if need be.
    pub(crate) fn material(&mut self, stated: Material) -> Result<MaterialId, Error> {
        let [r, e] = [stated.reflectance.0, stated.emittance.0];
        let values = [r[0], r[1], r[2], e[0], e[1], e[2]].map(f64::to_bits);
        let key = (stated.name.clone(), values, stated.sides);
        if let Some(&id) = self.materials.get(&key) {
            return Ok(id);
        }
        let mut material = stated;
        material.sides = self.sides.decide(material.sides);
        self.clamp(&mut material);
        let id = self.builder.material(material).map_err(|cause| self.refused(cause))?;
        self.materials.insert(key, id);
        Ok(id)
    }

    /// Grey, for a surface whose material is missing.
    #[cfg(any(feature = "obj", feature = "gltf"))]
    pub(crate) fn missing_material(&mut self, name: &str) -> Result<MaterialId, Error> {
        self.material(Material {
            name: name.to_owned(),
            reflectance: MISSING_REFLECTANCE,
            emittance: scene::Rgb::ZERO,
            sides: Sides::Front,
        })
    }

    fn clamp(&mut self, material: &mut Material) {
        let place = format!("{}: material {}", self.file, material.name);
        let stated = material.reflectance;
        // NaN fails both comparisons of `clamp` and has to be caught by name.
        let reflectance = stated.map(|c| if c.is_nan() { 0.0 } else { c.clamp(0.0, 1.0) });
        if reflectance != stated {
            self.warn(DiagnosticKind::ReflectanceClamped { stated }, None, place.as_str());
        } else if stated.max_channel() >= 1.0 {
            self.warn(DiagnosticKind::ReflectanceOne, None, place.as_str());
        }
        let stated = material.emittance;
        let emittance = stated.map(|c| if c.is_finite() && c > 0.0 { c } else { 0.0 });
        if emittance != stated {
            self.warn(DiagnosticKind::EmittanceClamped { stated }, None, place);
        }
        (material.reflectance, material.emittance) = (reflectance, emittance);
    }

    /// A new group, even where another has the same name.
    pub(crate) fn new_group(&mut self, name: &str) -> GroupId {
        self.builder.group(name)
    }

    /// The group of this name, added when it is first asked for.
    pub(crate) fn group(&mut self, name: &str) -> GroupId {
        if let Some(&id) = self.groups.get(name) {
            return id;
        }
        let id = self.builder.group(name);
        self.groups.insert(name.to_owned(), id);
        id
    }

    /// Adds a camera.
    #[cfg(feature = "gltf")]
    pub(crate) fn camera(&mut self, camera: scene::Camera) {
        self.builder.camera(camera);
    }

    /// Adds a triangle. One with a coordinate that is not finite is collapsed to its first
    /// finite corner, or to the origin, so that the triangles after it keep their numbers.
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
        Imported { scene, diagnostics, summary }
    }
}
