//! A scene before any solver: each surface shows what it emits itself.

use scene::{Face, Rgb, Scene, Sides, Solution, SolutionElement, TriangleId, VertexId};

/// The solution of a scene in which nothing reflects yet: an element for each side of each
/// triangle that has area, front before back, with its emittance as exitance.
///
/// It makes a scene that was never solved writable in the formats of this crate.
///
/// # Examples
/// ```
/// use scene::{Material, Rgb, SceneBuilder, Sides};
///
/// let mut builder = SceneBuilder::new();
/// let room = builder.group("room");
/// let lamp = builder.material(Material {
///     name: "lamp".into(),
///     reflectance: Rgb::splat(0.5),
///     emittance: Rgb::splat(9.0),
///     sides: Sides::Both,
/// })?;
/// let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
/// let vertices = corners.map(|p| builder.vertex(p.into()));
/// builder.triangle(vertices, lamp, room)?;
///
/// let solution = output::unlit(&builder.finish());
/// assert_eq!(solution.elements.len(), 2);
/// assert!(solution.elements.iter().all(|side| side.exitance == Rgb::splat(9.0)));
/// # Ok::<(), scene::Error>(())
/// ```
#[must_use]
pub fn unlit(scene: &Scene) -> Solution {
    let mut elements = Vec::with_capacity(scene.triangles().len());
    for id in scene.ids().filter(|&id| scene.area(id) > 0.0) {
        let [a, b, c] = scene.triangles()[id.index()].vertices;
        let material = scene.material_of(id);
        elements.push(element([a, b, c], id, Face::Front, material.emittance));
        if material.sides == Sides::Both {
            elements.push(element([a, c, b], id, Face::Back, material.emittance));
        }
    }
    Solution { vertices: scene.vertices().to_vec(), elements }
}

fn element(
    vertices: [VertexId; 3],
    triangle: TriangleId,
    face: Face,
    exitance: Rgb,
) -> SolutionElement {
    SolutionElement { vertices, triangle, face, exitance, corner_exitance: [exitance; 3] }
}
