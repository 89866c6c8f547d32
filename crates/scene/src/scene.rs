//! The triangles, and the builder that checks them once.

use glam::DVec3;

use crate::{Camera, Error, ErrorKind, GroupId, Material, MaterialId, TriangleId, VertexId};

/// An input triangle: three vertices, counter-clockwise seen from its front.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Triangle {
    /// Its corners.
    pub vertices: [VertexId; 3],
    /// Its surface.
    pub material: MaterialId,
    /// The named group it came in.
    pub group: GroupId,
}

/// The largest coordinate, in any unit: fourth powers of distances must stay in the range of
/// f64.
pub const MOST_COORDINATE: f64 = 1e75;

/// A checked triangle scene: every id resolves, every coordinate is finite, every
/// reflectance lies in [0, 1]. Triangles keep their file order; one without area stays
/// in its place, and neither emits, receives nor blocks.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    vertices: Vec<DVec3>,
    triangles: Vec<Triangle>,
    materials: Vec<Material>,
    groups: Vec<String>,
    cameras: Vec<Camera>,
}

impl Scene {
    /// Vertex positions, in the file's own units.
    #[must_use]
    pub fn vertices(&self) -> &[DVec3] {
        &self.vertices
    }

    /// The triangles in file order.
    #[must_use]
    pub fn triangles(&self) -> &[Triangle] {
        &self.triangles
    }

    /// The materials.
    #[must_use]
    pub fn materials(&self) -> &[Material] {
        &self.materials
    }

    /// The groups' names.
    #[must_use]
    pub fn groups(&self) -> &[String] {
        &self.groups
    }

    /// The cameras the file brought, in its order.
    #[must_use]
    pub fn cameras(&self) -> &[Camera] {
        &self.cameras
    }

    /// The corner positions of a triangle.
    ///
    /// # Panics
    /// If `id` is not of this scene.
    #[must_use]
    pub fn corners(&self, id: TriangleId) -> [DVec3; 3] {
        self.triangles[id.index()].vertices.map(|v| self.vertices[v.index()])
    }

    /// The material of a triangle.
    ///
    /// # Panics
    /// If `id` is not of this scene.
    #[must_use]
    pub fn material_of(&self, id: TriangleId) -> &Material {
        &self.materials[self.triangles[id.index()].material.index()]
    }

    /// The area of a triangle, one side.
    ///
    /// # Panics
    /// If `id` is not of this scene.
    #[must_use]
    pub fn area(&self, id: TriangleId) -> f64 {
        let [a, b, c] = self.corners(id);
        0.5 * (b - a).cross(c - a).length()
    }

    /// All triangle ids in file order.
    pub fn ids(&self) -> impl Iterator<Item = TriangleId> + use<> {
        (0..self.triangles.len()).map(TriangleId::from)
    }

    /// The smallest and largest coordinates of all triangles, or `None` without any.
    #[must_use]
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let mut corners = self.triangles.iter().flat_map(|t| t.vertices);
        let first = self.vertices[corners.next()?.index()];
        Some(corners.fold((first, first), |(low, high), v| {
            let p = self.vertices[v.index()];
            (low.min(p), high.max(p))
        }))
    }
}

/// Builds a [`Scene`], checking each piece as it is added.
#[derive(Clone, Debug, Default)]
pub struct SceneBuilder {
    scene: Scene,
}

impl SceneBuilder {
    /// An empty scene.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a vertex; it is checked when a triangle first uses it.
    pub fn vertex(&mut self, position: DVec3) -> VertexId {
        self.scene.vertices.push(position);
        VertexId::from(self.scene.vertices.len() - 1)
    }

    /// Adds a named group.
    pub fn group(&mut self, name: impl Into<String>) -> GroupId {
        self.scene.groups.push(name.into());
        GroupId::from(self.scene.groups.len() - 1)
    }

    /// Adds a material.
    ///
    /// # Errors
    /// [`ErrorKind::Reflectance`] outside [0, 1]; [`ErrorKind::Emittance`] below 0 or not finite.
    pub fn material(&mut self, material: Material) -> Result<MaterialId, Error> {
        material.check()?;
        self.scene.materials.push(material);
        Ok(MaterialId::from(self.scene.materials.len() - 1))
    }

    /// Adds a camera.
    pub fn camera(&mut self, camera: Camera) {
        self.scene.cameras.push(camera);
    }

    /// Adds a triangle, counter-clockwise seen from its front.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownId`] for an id this builder never gave out;
    /// [`ErrorKind::NonFiniteVertex`] for a vertex with a coordinate that is not finite;
    /// [`ErrorKind::FarVertex`] for one beyond [`MOST_COORDINATE`].
    pub fn triangle(
        &mut self,
        vertices: [VertexId; 3],
        material: MaterialId,
        group: GroupId,
    ) -> Result<TriangleId, Error> {
        let scene = &mut self.scene;
        let id = TriangleId::from(scene.triangles.len());
        let fail = |kind| Err(Error::new(kind, format!("triangle {}", id.0)));
        for v in vertices {
            match scene.vertices.get(v.index()) {
                None => return fail(ErrorKind::UnknownId("vertex", v.0)),
                Some(p) if !p.is_finite() => return fail(ErrorKind::NonFiniteVertex(v.0)),
                Some(p) if p.abs().max_element() > MOST_COORDINATE => {
                    return fail(ErrorKind::FarVertex(v.0));
                }
                Some(_) => {}
            }
        }
        if material.index() >= scene.materials.len() {
            return fail(ErrorKind::UnknownId("material", material.0));
        }
        if group.index() >= scene.groups.len() {
            return fail(ErrorKind::UnknownId("group", group.0));
        }
        scene.triangles.push(Triangle { vertices, material, group });
        Ok(id)
    }

    /// The finished scene.
    #[must_use]
    pub fn finish(self) -> Scene {
        self.scene
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Rgb, Sides};

    fn grey(reflectance: f64, emittance: f64) -> Material {
        Material {
            name: "grey".into(),
            reflectance: Rgb::splat(reflectance),
            emittance: Rgb::splat(emittance),
            sides: Sides::Front,
        }
    }

    #[test]
    fn rejects_what_no_surface_can_do() {
        let mut b = SceneBuilder::new();
        for (rho, e) in
            [(1.2, 0.0), (-0.1, 0.0), (f64::NAN, 0.0), (0.5, -1.0), (0.5, f64::INFINITY)]
        {
            assert!(b.material(grey(rho, e)).is_err(), "{rho} {e}");
        }
        assert!(b.material(grey(0.0, 1e300)).is_ok());
        assert!(b.material(grey(1.0, 0.0)).is_ok());
    }

    #[test]
    fn names_the_triangle_with_a_bad_vertex() {
        let mut b = SceneBuilder::new();
        let g = b.group("g");
        let m = b.material(grey(0.5, 0.0)).unwrap();
        let a = b.vertex(DVec3::ZERO);
        let n = b.vertex(DVec3::new(0.0, f64::NAN, 0.0));
        let error = b.triangle([a, a, n], m, g).unwrap_err();
        assert_eq!(error.to_string(), "triangle 0: vertex 1 has a coordinate that is not finite");
        let error = b.triangle([a, a, VertexId(9)], m, g).unwrap_err();
        assert_eq!(error.kind(), &ErrorKind::UnknownId("vertex", 9));
    }

    #[test]
    fn bounds_follow_the_triangles_alone() {
        let mut b = SceneBuilder::new();
        assert_eq!(b.clone().finish().bounds(), None);
        let g = b.group("g");
        let m = b.material(grey(0.5, 0.0)).unwrap();
        b.vertex(DVec3::splat(99.0));
        let v = [DVec3::X, DVec3::Y, DVec3::NEG_Z].map(|p| b.vertex(p));
        b.triangle(v, m, g).unwrap();
        assert_eq!(b.finish().bounds(), Some((DVec3::NEG_Z, DVec3::new(1.0, 1.0, 0.0))));
    }
}
