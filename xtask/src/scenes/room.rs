//! `room.tri`: a furnished living room, in centimetres, with three kinds of lamp.

use super::mesh::Shape;
use super::shapes::{Faces, cuboid, disc, drum, shell, tube};
use super::tri_text::{Model, Paint, lamp, matte};

const WIDTH: f64 = 600.0;
const HEIGHT: f64 = 270.0;
const DEPTH: f64 = 450.0;

const WALL: Paint = matte(235, 225, 205);
const ACCENT: Paint = matte(120, 160, 170);
const CEILING: Paint = matte(245, 245, 240);
const FLOOR: Paint = matte(170, 120, 75);
const RUG: Paint = matte(150, 45, 50);
const OAK: Paint = matte(200, 150, 95);
const WALNUT: Paint = matte(120, 80, 50);
const CLOTH: Paint = matte(70, 90, 130);
const CUSHION: Paint = matte(95, 120, 165);
const METAL: Paint = matte(110, 110, 115);
const PAPER: Paint = matte(245, 240, 225);
const BOOKS: [Paint; 5] = [
    matte(170, 50, 45),
    matte(50, 95, 70),
    matte(215, 190, 120),
    matte(60, 70, 120),
    matte(230, 225, 215),
];
const PICTURE: [Paint; 4] =
    [matte(230, 170, 60), matte(60, 130, 150), matte(200, 80, 60), matte(240, 230, 210)];
const WARM: Paint = lamp(255, 190, 110);
const WHITE: Paint = lamp(255, 240, 220);

pub(crate) fn model() -> Model {
    let mut model = Model::default();
    add_shell(&mut model);
    model.add(RUG, cuboid([150.0, 0.0, 130.0], [430.0, 1.5, 330.0], Faces::STANDING));
    // The table and its chairs stand on the rug, the rest on the floor.
    let rug = |shape: Shape| shape.moved([290.0, 1.5, 230.0]);
    model.add(OAK, rug(table()));
    for (x, z, angle) in
        [(-35.0, -70.0, 0.0), (35.0, -74.0, -8.0), (-38.0, 72.0, 175.0), (90.0, 5.0, 262.0)]
    {
        model.add(WALNUT, rug(chair().turned(angle).moved([x, 0.0, z])));
    }
    add_shelf(&mut model);
    add_sofa(&mut model);
    add_picture(&mut model);
    add_lamps(&mut model);
    add_door(&mut model);
    model
}

fn add_shell(model: &mut Model) {
    let (low, high, counts) = ([0.0; 3], [WIDTH, HEIGHT, DEPTH], [6, 3, 5]);
    model.add(FLOOR, shell(low, high, counts, Faces::BOTTOM));
    model.add(CEILING, shell(low, high, counts, Faces::TOP));
    model.add(ACCENT, shell(low, high, counts, Faces::BACK));
    model.add(WALL, shell(low, high, counts, Faces::LEFT | Faces::RIGHT | Faces::FRONT));
}

/// A table about its middle, on four legs.
fn table() -> Shape {
    let top = cuboid([-80.0, 71.0, -45.0], [80.0, 75.0, 45.0], Faces::ALL);
    let legs = [(-76.0, -41.0), (70.0, -41.0), (-76.0, 35.0), (70.0, 35.0)];
    let leg = |(x, z): (f64, f64)| cuboid([x, 0.0, z], [x + 6.0, 71.0, z + 6.0], Faces::AROUND);
    Shape::all(legs.map(leg).into_iter().chain([top]))
}

/// A chair about its middle, its back towards -z.
fn chair() -> Shape {
    let leg = |x: f64, z: f64| cuboid([x, 0.0, z], [x + 4.0, 43.0, z + 4.0], Faces::AROUND);
    let post = |x: f64| cuboid([x, 46.0, -21.0], [x + 4.0, 94.0, -18.0], Faces::STANDING);
    let slat = |y: f64| {
        let faces = Faces::ALL - Faces::LEFT - Faces::RIGHT;
        cuboid([-17.0, y, -20.5], [17.0, y + 10.0, -18.5], faces)
    };
    Shape::all([
        cuboid([-21.0, 43.0, -21.0], [21.0, 46.0, 21.0], Faces::ALL),
        leg(-20.0, -20.0),
        leg(16.0, -20.0),
        leg(-20.0, 16.0),
        leg(16.0, 16.0),
        post(-21.0),
        post(17.0),
        slat(60.0),
        slat(80.0),
    ])
}

/// A shelf at the wall x = 0 with books on its boards.
fn add_shelf(model: &mut Model) {
    const LENGTH: f64 = 160.0;
    const TALL: f64 = 200.0;
    const DEEP: f64 = 32.0;
    const BOARD: f64 = 3.0;
    const PANEL: f64 = 1.0;
    let floors = [0.0, 48.0, 96.0, 144.0];
    // Built with its back at z = 0 and turned so that this is the wall.
    let stand = |shape: Shape| shape.turned(90.0).moved([0.0, 0.0, 360.0]);

    let side = |x: f64| {
        let faces = Faces::STANDING - Faces::BACK;
        cuboid([x, 0.0, 0.0], [x + BOARD, TALL, DEEP], faces)
    };
    let back_faces = Faces::FRONT | Faces::TOP;
    let back = cuboid([BOARD, 0.0, 0.0], [LENGTH - BOARD, TALL, PANEL], back_faces);
    let board = |y: f64| {
        let below = if y == 0.0 { Faces::TOP } else { Faces::TOP | Faces::BOTTOM };
        let high = [LENGTH - BOARD, y + BOARD, DEEP];
        cuboid([BOARD, y, PANEL], high, Faces::FRONT | below)
    };
    let boards = floors.into_iter().chain([TALL - BOARD]).map(board);
    model.add(OAK, stand(Shape::all(boards.chain([side(0.0), side(LENGTH - BOARD), back]))));

    for (level, floor) in floors.into_iter().enumerate() {
        let mut x = 6.0 + 5.0 * level as f64;
        for number in 0..11 {
            // Fixed variety: neither a clock nor a random number belongs into a bundled scene.
            let kind = number * 7 + level * 3;
            let thick = 5.0 + 1.5 * (kind % 4) as f64;
            let tall = 24.0 + 2.0 * (kind % 5) as f64;
            let low = [x, floor + BOARD, 4.0];
            let book = cuboid(low, [x + thick, floor + BOARD + tall, 24.0], Faces::STANDING);
            model.add(BOOKS[kind % BOOKS.len()], stand(book));
            x += thick + 0.5;
        }
    }
}

/// A sofa with its back towards the wall z = [`DEPTH`].
fn add_sofa(model: &mut Model) {
    const LENGTH: f64 = 210.0;
    const DEEP: f64 = 90.0;
    const ARM: f64 = 18.0;
    const BACK: f64 = 22.0;
    let stand = |shape: Shape| shape.turned(180.0).moved([560.0, 0.0, DEPTH - 12.0]);

    let side = Faces::ALL - Faces::BACK;
    let between = side - Faces::LEFT - Faces::RIGHT;
    model.add(WALNUT, stand(cuboid([10.0, 0.0, 10.0], [200.0, 8.0, 80.0], Faces::AROUND)));
    model.add(
        CLOTH,
        stand(Shape::all([
            cuboid([0.0, 8.0, 0.0], [LENGTH, 82.0, BACK], Faces::ALL),
            cuboid([0.0, 8.0, BACK], [ARM, 60.0, DEEP], side),
            cuboid([LENGTH - ARM, 8.0, BACK], [LENGTH, 60.0, DEEP], side),
            cuboid([ARM, 8.0, BACK], [LENGTH - ARM, 26.0, DEEP], between),
        ])),
    );
    let seats = (0..3).map(|seat| {
        let x = ARM + 0.5 + 58.0 * f64::from(seat);
        cuboid([x, 26.0, BACK], [x + 57.0, 43.0, DEEP - 2.0], side - Faces::BOTTOM)
    });
    model.add(CUSHION, stand(Shape::all(seats)));
}

/// A framed picture on the wall z = 0.
fn add_picture(model: &mut Model) {
    let hang = |shape: Shape| shape.moved([230.0, 120.0, 0.0]);
    let side = Faces::ALL - Faces::BACK;
    let between = side - Faces::LEFT - Faces::RIGHT;
    let frame = Shape::all([
        cuboid([0.0, 0.0, 0.0], [5.0, 90.0, 3.0], side),
        cuboid([125.0, 0.0, 0.0], [130.0, 90.0, 3.0], side),
        cuboid([5.0, 0.0, 0.0], [125.0, 5.0, 3.0], between),
        cuboid([5.0, 85.0, 0.0], [125.0, 90.0, 3.0], between),
    ]);
    model.add(WALNUT, hang(frame));
    for row in 0..4 {
        for column in 0..6 {
            let (x, y) = (5.0 + 20.0 * column as f64, 5.0 + 20.0 * row as f64);
            let patch = cuboid([x, y, 0.0], [x + 20.0, y + 20.0, 1.0], Faces::FRONT);
            model.add(PICTURE[(row * row + 2 * column) % 4], hang(patch));
        }
    }
}

fn add_lamps(model: &mut Model) {
    // At the ceiling: only the underside shines.
    let (low, high) = ([230.0, HEIGHT - 6.0, 190.0], [350.0, HEIGHT, 270.0]);
    model.add(METAL, cuboid(low, high, Faces::AROUND));
    model.add(WHITE, cuboid(low, high, Faces::BOTTOM));

    // Standing, with a square shade that is open above and below.
    let stand = |shape: Shape| shape.moved([60.0, 0.0, 55.0]);
    model.add(METAL, stand(foot_and_pole(15.0, 150.0)));
    model.add(PAPER, stand(tube(4, (146.0, 26.0), (176.0, 20.0), 0.5)));
    let bulb = Shape::all([drum(8, (150.0, 5.0), (166.0, 5.0)), disc(8, 166.0, 5.0)]);
    let under = disc(8, 150.0, 5.0).flipped();
    model.add(WARM, stand(Shape::all([bulb, under])));

    // On the table, with a shade that shines all around.
    let stand = |shape: Shape| shape.moved([245.0, 76.5, 212.0]);
    model.add(METAL, stand(foot_and_pole(7.0, 22.0)));
    let caps = Shape::all([disc(8, 40.0, 8.0), disc(8, 22.0, 13.0).flipped()]);
    model.add(PAPER, stand(caps));
    model.add(WARM, stand(drum(8, (22.0, 13.0), (40.0, 8.0))));
}

/// A round foot, and a pole up to `height` whose end is hidden by what it carries.
fn foot_and_pole(radius: f64, height: f64) -> Shape {
    Shape::all([
        drum(12, (0.0, radius), (2.5, radius)),
        disc(12, 2.5, radius),
        drum(6, (2.5, 1.2), (height, 1.2)),
    ])
}

/// A door in the wall x = [`WIDTH`].
fn add_door(model: &mut Model) {
    let faces = Faces::STANDING - Faces::RIGHT;
    let leaf = cuboid([WIDTH - 3.0, 0.0, 60.0], [WIDTH, 205.0, 150.0], faces);
    model.add(OAK, leaf);
    let knob =
        cuboid([WIDTH - 8.0, 100.0, 140.0], [WIDTH - 3.0, 104.0, 144.0], faces | Faces::BOTTOM);
    model.add(METAL, knob);
}
