//! A scene whose light is known everywhere: two walls back to back and a lamp, exitance linear in place.

use glam::DVec3;
use scene::{
    Camera, Face, Material, Rgb, Scene, SceneBuilder, Sides, Solution, SolutionElement, VertexId,
};
use viewer::{Means, Shown};

/// Far from the origin, where single precision alone would have lost the shape.
pub(crate) const ORIGIN: DVec3 = DVec3::new(4.0e6, -2.0e6, 1.0e6);
/// Vertical field of view of both cameras.
pub(crate) const FOV: f64 = 0.8;
/// Display light per exitance.
pub(crate) const EXPOSURE: f64 = 0.01;

pub(crate) const REFLECTANCE: Rgb = Rgb([0.5, 0.25, 0.0]);
pub(crate) const EMITTANCE: Rgb = Rgb([2.0, 1.0, 0.5]);

/// Exitance of the wall at a place, relative to the origin: red on its front, blue on its back.
pub(crate) fn exitance(place: DVec3, face: Face) -> Rgb {
    let slope = 10.0 + 3.0 * place.x + 2.0 * place.y;
    match face {
        Face::Front => Rgb([4.0 * slope, 0.3 * slope, 0.5]),
        Face::Back => Rgb([2.0, 1.0, 3.0 * slope]),
    }
}

/// The wall from (-2, -1) to (2, 1) in the plane z = 0, cut into elements differently on both sides.
pub(crate) fn scene() -> (Scene, Solution) {
    let mut builder = SceneBuilder::new();
    let group = builder.group("wall </script><b>&amp;");
    let material = builder
        .material(Material {
            name: "paint <!--".into(),
            reflectance: REFLECTANCE,
            emittance: EMITTANCE,
            sides: Sides::Both,
        })
        .unwrap();
    let corners = [(-2.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-2.0, 1.0)]
        .map(|(x, y)| builder.vertex(ORIGIN + DVec3::new(x, y, 0.0)));
    let [a, b, c, d] = corners;
    let first = builder.triangle([a, b, c], material, group).unwrap();
    let second = builder.triangle([a, c, d], material, group).unwrap();
    for (name, z) in [("from the front", 5.0), ("from the back", -5.0)] {
        builder.camera(Camera {
            name: name.into(),
            position: ORIGIN + DVec3::new(0.0, 0.0, z),
            target: ORIGIN,
            up: DVec3::Y,
            vertical_fov: FOV,
        });
    }
    let mut solution = Solution::default();
    // Front: each triangle is cut at the middle of its first edge; back: they are whole.
    let place = |id: VertexId| {
        let (x, y) = [(-2.0, -1.0), (2.0, -1.0), (2.0, 1.0), (-2.0, 1.0)][id.index()];
        DVec3::new(x, y, 0.0)
    };
    for (triangle, [p, q, r]) in [(first, [a, b, c]), (second, [a, c, d])] {
        let [p, q, r] = [p, q, r].map(place);
        let middle = 0.5 * (p + q);
        for (face, corners) in
            [(Face::Front, [p, middle, r]), (Face::Front, [middle, q, r]), (Face::Back, [p, r, q])]
        {
            let vertices = corners.map(|corner| {
                solution.vertices.push(ORIGIN + corner);
                VertexId::from(solution.vertices.len() - 1)
            });
            solution.elements.push(SolutionElement {
                vertices,
                triangle,
                face,
                // A linear function's mean is its value in the middle.
                exitance: exitance((corners[0] + corners[1] + corners[2]) / 3.0, face),
                corner_exitance: corners.map(|corner| exitance(corner, face)),
            });
        }
    }
    (builder.finish(), solution)
}

/// That scene as a page shows it first.
pub(crate) fn shown<'a>(scene: &'a Scene, solution: &'a Solution) -> Shown<'a> {
    Shown {
        scene,
        solution,
        unit: "W/m²",
        exposure: EXPOSURE,
        view: None,
        means: Means::OfElements,
    }
}
