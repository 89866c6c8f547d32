//! Scenes that need little, as .tri text: written where they are measured, kept nowhere.

use std::fmt::Write as _;

/// A place.
type Place = [f64; 3];

/// Colours from 0 to 255.
type Colour = [u8; 3];

/// Faces of a box, by the axis and the end that they lie at.
const FACES: [[usize; 4]; 6] =
    [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];

const WARM: Colour = [200, 180, 150];
const GREY: Colour = [180; 3];
const BLACK: Colour = [0; 3];
const ROOM: Place = [4.0, 3.0, 2.5];

/// A scene on its way.
#[derive(Default)]
struct Tri(String);

impl Tri {
    fn quad(&mut self, front: Colour, back: Colour, [a, b, c, d]: [Place; 4]) {
        for corners in [[a, b, c], [a, c, d]] {
            let [r, g, b] = front;
            let [back_r, back_g, back_b] = back;
            let _ = writeln!(self.0, "Triangle\n{r} {g} {b} {back_r} {back_g} {back_b}");
            for [x, y, z] in corners {
                let _ = writeln!(self.0, "{x} {y} {z}");
            }
        }
    }

    /// A box seen from inside, or from outside.
    fn cuboid(&mut self, low: Place, high: Place, colour: Colour, inside: bool) {
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { high[k] } else { low[k] });
        for face in FACES {
            let mut corners = face.map(corner);
            if !inside {
                corners.reverse();
            }
            self.quad(colour, BLACK, corners);
        }
    }

    /// A lamp that shines down.
    fn lamp(&mut self, low: [f64; 2], high: [f64; 2], z: f64) {
        let at = |x: f64, y: f64| [x, y, z];
        let corners =
            [at(low[0], low[1]), at(low[0], high[1]), at(high[0], high[1]), at(high[0], low[1])];
        self.quad([255; 3], [255; 3], corners);
    }
}

/// A convex box whose ceiling shines.
pub(super) fn convex() -> String {
    let mut tri = Tri::default();
    let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 1 { ROOM[k] } else { 0.0 });
    for (number, face) in FACES.into_iter().enumerate() {
        let back = if number == 1 { [255; 3] } else { BLACK };
        tri.quad(WARM, back, face.map(corner));
    }
    tri.0
}

/// An open plane below one lamp.
pub(super) fn plane() -> String {
    let mut tri = Tri::default();
    let at = |x, y| [x, y, 0.0];
    tri.quad(WARM, BLACK, [at(0.0, 0.0), at(10.0, 0.0), at(10.0, 10.0), at(0.0, 10.0)]);
    tri.lamp([4.0, 4.0], [6.0, 6.0], 3.0);
    tri.0
}

/// A room with a lamp below its ceiling, of this colour.
fn room(colour: Colour) -> Tri {
    let mut tri = Tri::default();
    tri.cuboid([0.0; 3], ROOM, colour, true);
    tri.lamp([1.0, 1.0], [2.0, 2.0], 2.4);
    tri
}

/// A grey room with a cupboard.
pub(super) fn grey() -> String {
    let mut tri = room(GREY);
    tri.cuboid([1.0, 1.0, 0.0], [1.5, 1.5, 1.0], [100; 3], false);
    tri.0
}

/// Two furnished rooms wall to wall without a door, a lamp in one of them.
pub(super) fn two_rooms() -> String {
    let mut tri = room(WARM);
    tri.cuboid([4.0, 0.0, 0.0], [8.0, 3.0, 2.5], WARM, true);
    tri.cuboid([5.0, 1.0, 0.0], [5.5, 1.5, 1.0], [100; 3], false);
    tri.0
}

/// A black room with a small coloured box in the air: 99 % of the area is black.
pub(super) fn black() -> String {
    let mut tri = room(BLACK);
    tri.cuboid([1.5, 1.5, 0.5], [1.8, 1.8, 0.8], [200, 100, 50], false);
    tri.0
}

/// A plane, a wall across it, and one lamp behind the wall.
pub(super) fn behind() -> String {
    let mut tri = Tri::default();
    let at = |x, y| [x, y, 0.0];
    tri.quad(WARM, BLACK, [at(0.0, 0.0), at(10.0, 0.0), at(10.0, 10.0), at(0.0, 10.0)]);
    tri.lamp([1.0, 4.0], [2.0, 6.0], 3.0);
    tri.cuboid([4.9, -1.0, 0.0], [5.1, 11.0, 6.0], GREY, false);
    tri.0
}

/// A convex room with one small box in the air.
pub(super) fn obstacle() -> String {
    let mut tri = room(WARM);
    tri.cuboid([3.0, 2.0, 1.0], [3.2, 2.2, 1.2], [100; 3], false);
    tri.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_scene_has_its_triangles() {
        let count = |text: String| text.matches("Triangle").count();
        let counts = [convex(), plane(), grey(), two_rooms(), black(), behind(), obstacle()];
        assert_eq!(counts.map(count), [12, 4, 26, 38, 26, 16, 26]);
    }
}
