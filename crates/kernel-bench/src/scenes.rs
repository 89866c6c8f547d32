//! The scenes: bundled ones, held by the program itself, and a room made in code.

use glam::DVec3;
use scene::{Material, MaterialId, Rgb, Scene, SceneBuilder, Sides};
use tri_io::Reader;

/// A furnished room of 1472 triangles, as text.
pub(crate) const FURNISHED: &[u8] = include_bytes!("../../../scenes/room.tri");
/// A hall with columns, 4310 triangles.
pub(crate) const HALL: &[u8] = include_bytes!("../../../scenes/hall.tri");

/// The side of the room made in code.
const SIDE: f64 = 4.0;

/// The corners of the triangles that a .tri text holds. No hash table takes part, as one does in
/// `scene-import`: its seed would show in the layout of the heap, and so in the counts.
pub(crate) fn read(text: &[u8]) -> Vec<[DVec3; 3]> {
    let records = Reader::new(text).map(|record| record.expect("a bundled scene is valid"));
    records.map(|record| record.vertices.map(DVec3::from)).collect()
}

/// The corners of a scene's triangles, in its order: what may stand in between.
pub(crate) fn triangles(scene: &Scene) -> Vec<[DVec3; 3]> {
    scene.ids().map(|id| scene.corners(id)).collect()
}

/// A scene of these triangles, all of one grey.
pub(crate) fn grey(triangles: &[[DVec3; 3]]) -> Scene {
    let mut scene = Parts::default();
    let grey = scene.surface([0.5; 3], 0.0);
    triangles.iter().for_each(|corners| scene.triangle(*corners, grey));
    scene.builder.finish()
}

/// A square lamp that shines down.
#[derive(Clone, Copy)]
pub(crate) struct Lamp {
    side: f64,
    /// Above the floor.
    height: f64,
}

/// Wide, below the ceiling: its light is even.
pub(crate) const WIDE: Lamp = Lamp { side: 1.0, height: 3.9 };
/// Narrow, above the floor: a spot that the mesh has to be finer in.
pub(crate) const NARROW: Lamp = Lamp { side: 0.05, height: 0.05 };

/// A closed room of 4 × 4 × 4 with a lamp and, in the middle, `boards` × `boards` tilted boards.
pub(crate) fn room(lamp: Lamp, boards: u32) -> Scene {
    let mut room = Parts::default();
    let wall = room.surface([0.7, 0.5, 0.3], 0.0);
    let bright = room.surface([0.0; 3], 10.0);
    let corner = |i: u32| [i & 1, i >> 1 & 1, i >> 2].map(|bit| SIDE * f64::from(bit));
    // Counter-clockwise seen from inside.
    for face in [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    {
        room.quad(face.map(corner), wall);
    }
    let step = SIDE / f64::from(boards);
    for (i, j) in (0..boards).flat_map(|i| (0..boards).map(move |j| (i, j))) {
        let [x, y] = [i, j].map(|k| step * (f64::from(k) + 0.25));
        let [far_x, far_y] = [x, y].map(|start| start + step / 2.0);
        let (low, high) = (SIDE / 2.0, SIDE / 2.0 + step / 8.0);
        room.quad([[x, y, low], [far_x, y, low], [far_x, far_y, high], [x, far_y, high]], wall);
    }
    let [low, high] = [-0.5, 0.5].map(|half| SIDE / 2.0 + half * lamp.side);
    let corner = |x: f64, y: f64| [x, y, lamp.height];
    room.quad([corner(low, low), corner(low, high), corner(high, high), corner(high, low)], bright);
    room.builder.finish()
}

#[derive(Default)]
struct Parts {
    builder: SceneBuilder,
}

impl Parts {
    fn surface(&mut self, reflectance: [f64; 3], emittance: f64) -> MaterialId {
        let (reflectance, emittance) = (Rgb(reflectance), Rgb::splat(emittance));
        let material = Material { name: "s".into(), reflectance, emittance, sides: Sides::Front };
        self.builder.material(material).expect("reflectances are at most 1")
    }

    fn triangle(&mut self, corners: [DVec3; 3], material: MaterialId) {
        let group = self.builder.group("all");
        let corners = corners.map(|corner| self.builder.vertex(corner));
        self.builder.triangle(corners, material, group).expect("coordinates are finite");
    }

    /// A quadrilateral a b c d, counter-clockwise seen from its front.
    fn quad(&mut self, corners: [[f64; 3]; 4], material: MaterialId) {
        let [a, b, c, d] = corners.map(DVec3::from);
        self.triangle([a, b, c], material);
        self.triangle([a, c, d], material);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scenes_have_as_many_triangles_as_is_said() {
        let bundled = [FURNISHED, HALL].map(read);
        let made = [grey(&bundled[0]), room(WIDE, 3)].map(|scene| triangles(&scene));
        assert_eq!(made[0], bundled[0]);
        let counts = [bundled[0].len(), bundled[1].len(), made[1].len()];
        assert_eq!(counts, [1472, 4310, 12 + 18 + 2]);
    }
}
