//! Small scenes whose outputs can be worked out by hand.

use std::path::PathBuf;

use glam::DVec3;
use output::{Format, Options};
use scene::{
    Face, Material, MaterialId, Rgb, Scene, SceneBuilder, Sides, Solution, SolutionElement,
    TriangleId, VertexId,
};

/// A scene in the making, with one element per triangle side.
#[derive(Default)]
pub(crate) struct Lit {
    pub(crate) builder: SceneBuilder,
    pub(crate) solution: Solution,
    triangles: u32,
}

impl Lit {
    pub(crate) fn material(&mut self, name: &str, emittance: f64, sides: Sides) -> MaterialId {
        let (reflectance, emittance) = (Rgb::new(0.25, 0.5, 0.75), Rgb::splat(emittance));
        let material = Material { name: name.into(), reflectance, emittance, sides };
        self.builder.material(material).unwrap()
    }

    /// A quadrilateral as two triangles (0, 1, 2) and (0, 2, 3), its exitance a function
    /// of the position.
    pub(crate) fn quad(
        &mut self,
        corners: [DVec3; 4],
        group: scene::GroupId,
        material: MaterialId,
        light: impl Fn(DVec3) -> Rgb,
    ) {
        let ids = corners.map(|p| self.builder.vertex(p));
        let first = self.solution.vertices.len() as u32;
        self.solution.vertices.extend(corners);
        for [a, b, c] in [[0, 1, 2], [0, 2, 3]] {
            self.builder.triangle([ids[a], ids[b], ids[c]], material, group).unwrap();
            let corner_exitance = [a, b, c].map(|i| light(corners[i]));
            let element = SolutionElement {
                vertices: [a, b, c].map(|i| VertexId(first + i as u32)),
                triangle: TriangleId(self.triangles),
                face: Face::Front,
                // The mean, for light that is linear in the position.
                exitance: light((corners[a] + corners[b] + corners[c]) / 3.0),
                corner_exitance,
            };
            self.solution.elements.push(element);
            self.triangles += 1;
        }
    }

    pub(crate) fn finish(self) -> (Scene, Solution) {
        (self.builder.finish(), self.solution)
    }
}

/// The rectangle [0, 2] × [0, 1] at height z, seen from above.
pub(crate) fn rectangle(z: f64) -> [DVec3; 4] {
    [[0.0, 0.0, z], [2.0, 0.0, z], [2.0, 1.0, z], [0.0, 1.0, z]].map(DVec3::from_array)
}

/// A rectangle of one exitance.
pub(crate) fn square(light: Rgb) -> (Scene, Solution) {
    let mut lit = Lit::default();
    let group = lit.builder.group("table");
    let material = lit.material("wood", 0.0, Sides::Front);
    lit.quad(rectangle(0.0), group, material, |_| light);
    lit.finish()
}

/// A box with one exitance: the walls of a room that face inwards, or an object's.
#[cfg(any(feature = "exr", feature = "png"))]
pub(crate) fn closed_box(low: DVec3, high: DVec3, inwards: bool, lamp: Option<DVec3>) -> Scene {
    let mut lit = Lit::default();
    let group = lit.builder.group("box");
    let grey = lit.material("grey", 0.0, Sides::Front);
    let bright = lit.material("lamp", 9.0, Sides::Front);
    let corner = |x: usize, y: usize, z: usize| {
        DVec3::new([low, high][x].x, [low, high][y].y, [low, high][z].z)
    };
    let at = |bits: usize| corner(bits & 1, bits >> 1 & 1, bits >> 2 & 1);
    // Counter-clockwise seen from outside: -x, +x, -y, +y, -z, +z.
    let faces =
        [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    for face in faces {
        let mut corners = face.map(at);
        if inwards {
            corners.reverse();
        }
        lit.quad(corners, group, grey, |_| Rgb::splat(1.0));
    }
    // A small panel a little away from the ceiling, facing along `down`.
    if let Some(down) = lamp {
        let middle = 0.5 * (low + high);
        let place = middle - 0.48 * down * (high - low);
        let (u, v) = down.any_orthonormal_pair();
        let [u, v] = if u.cross(v).dot(down) > 0.0 { [u, v] } else { [v, u] };
        let corners = [-u - v, u - v, u + v, v - u].map(|c| place + 0.2 * c);
        lit.quad(corners, group, bright, |_| Rgb::splat(9.0));
    }
    lit.finish().0
}

pub(crate) fn bytes(format: Format, lit: &(Scene, Solution), options: &Options) -> Vec<u8> {
    let mut bytes = Vec::new();
    output::write(format, &mut bytes, &lit.0, &lit.1, options).unwrap();
    bytes
}

/// The folder of data that lies beside the checkout, where there is one.
pub(crate) fn shared(path: &str) -> Option<PathBuf> {
    let here = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let found = here.ancestors().map(|a| a.join("shared").join(path)).find(|p| p.exists());
    if found.is_none() {
        println!("skipped: no shared/{path} beside the checkout");
    }
    found
}
