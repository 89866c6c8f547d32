//! `hall.tri`: a long hall, in centimetres, with two rows of columns under a ceiling of beams.

use super::mesh::Shape;
use super::shapes::{Faces, cuboid, disc, drum, grid, shell};
use super::tri_text::{Model, Paint, lamp, matte};

const WIDTH: f64 = 1200.0;
const HEIGHT: f64 = 900.0;
const LENGTH: f64 = 4400.0;
/// Bays between columns along the hall; columns stand where two bays meet.
const BAYS: u32 = 11;
const BAY: f64 = LENGTH / BAYS as f64;
/// Distance of a row of columns from its wall.
const AISLE: f64 = 300.0;
/// Half the width of a column's plinth, of its top plate and of the beam it carries.
const HALF: f64 = 48.0;
/// Underside of the beams along the rows, and of those across.
const ARCHITRAVE: f64 = 790.0;
const CROSS_BEAM: f64 = 830.0;

const WALL: Paint = matte(215, 200, 175);
const CEILING: Paint = matte(235, 230, 220);
const BEAM: Paint = matte(150, 105, 70);
const STONE: Paint = matte(225, 215, 195);
const BENCH: Paint = matte(110, 70, 45);
const TILES: [Paint; 2] = [matte(210, 205, 195), matte(120, 60, 50)];
const LAMP: Paint = lamp(255, 225, 180);
const SCONCE: Paint = lamp(255, 170, 90);

pub(crate) fn model() -> Model {
    let mut model = Model::default();
    add_floor(&mut model);
    let (low, high) = ([0.0; 3], [WIDTH, HEIGHT, LENGTH]);
    let counts = [4, 3, BAYS];
    model.add(CEILING, shell(low, high, counts, Faces::TOP));
    model.add(WALL, shell(low, high, counts, Faces::ALL - Faces::TOP - Faces::BOTTOM));

    for x in [AISLE, WIDTH - AISLE] {
        for row in 1..BAYS {
            model.add(STONE, column().moved([x, 0.0, BAY * f64::from(row)]));
        }
        let faces = Faces::LEFT | Faces::RIGHT | Faces::BOTTOM;
        let beam = cuboid([x - HALF, ARCHITRAVE, 0.0], [x + HALF, HEIGHT, LENGTH], faces);
        model.add(BEAM, beam);
    }
    add_cross_beams(&mut model);
    add_lamps(&mut model);
    add_benches(&mut model);
    model
}

/// Tiles in two colours, a metre and a half wide.
fn add_floor(model: &mut Model) {
    let (columns, rows) = (8, 29);
    let (wide, long) = (WIDTH / f64::from(columns), LENGTH / f64::from(rows));
    for row in 0..rows {
        for column in 0..columns {
            let origin = [wide * f64::from(column), 0.0, long * f64::from(row)];
            let tile = grid(origin, [0.0, 0.0, long], [wide, 0.0, 0.0], 1, 1);
            model.add(TILES[((row + column) % 2) as usize], tile);
        }
    }
}

/// A column about its axis: plinth, ring, tapered shaft, capital, plate.
fn column() -> Shape {
    const SIDES: u32 = 12;
    let square = |bottom: f64, top: f64, faces: Faces| {
        cuboid([-HALF, bottom, -HALF], [HALF, top, HALF], faces)
    };
    Shape::all([
        square(0.0, 30.0, Faces::STANDING),
        drum(SIDES, (30.0, 44.0), (55.0, 40.0)),
        disc(SIDES, 55.0, 40.0),
        drum(SIDES, (55.0, 33.0), (400.0, 32.0)),
        drum(SIDES, (400.0, 32.0), (720.0, 28.0)),
        drum(SIDES, (720.0, 28.0), (765.0, 44.0)),
        square(765.0, ARCHITRAVE, Faces::HANGING),
    ])
}

/// Beams from wall to row, row to row, row to wall; their ends touch and are left out.
fn add_cross_beams(model: &mut Model) {
    let spans =
        [(0.0, AISLE - HALF), (AISLE + HALF, WIDTH - AISLE - HALF), (WIDTH - AISLE + HALF, WIDTH)];
    let faces = Faces::FRONT | Faces::BACK | Faces::BOTTOM;
    for row in 1..BAYS {
        let z = BAY * f64::from(row);
        for (from, to) in spans {
            let beam = cuboid([from, CROSS_BEAM, z - 25.0], [to, HEIGHT, z + 25.0], faces);
            model.add(BEAM, beam);
        }
    }
}

/// Flat boxes between the beams that shine downwards, and sconces on the walls.
fn add_lamps(model: &mut Model) {
    for bay in 0..BAYS {
        let z = BAY * (f64::from(bay) + 0.5);
        for (x, half) in [(AISLE / 2.0 - HALF / 2.0, 30.0), (WIDTH / 2.0, 50.0)] {
            let mirrored = (x < AISLE).then_some(WIDTH - x);
            for x in [Some(x), mirrored].into_iter().flatten() {
                let low = [x - half, HEIGHT - 15.0, z - half];
                let high = [x + half, HEIGHT, z + half];
                model.add(CEILING, cuboid(low, high, Faces::AROUND));
                model.add(LAMP, cuboid(low, high, Faces::BOTTOM));
            }
        }
    }
    for row in 1..BAYS {
        let z = BAY * f64::from(row);
        let (low, high) = ([0.0, 300.0, z - 12.0], [14.0, 350.0, z + 12.0]);
        let left = cuboid(low, high, Faces::ALL - Faces::LEFT);
        let right = left.clone().mirrored().moved([WIDTH, 0.0, 0.0]);
        model.add(SCONCE, Shape::all([left, right]));
    }
}

/// Benches in the aisles, under the middle of every second bay.
fn add_benches(model: &mut Model) {
    for bay in (0..BAYS).step_by(2) {
        let z = BAY * (f64::from(bay) + 0.5);
        let seat = cuboid([40.0, 42.0, z - 90.0], [85.0, 48.0, z + 90.0], Faces::ALL);
        let leg = |z: f64| cuboid([45.0, 0.0, z - 5.0], [80.0, 42.0, z + 5.0], Faces::AROUND);
        let left = Shape::all([seat, leg(z - 70.0), leg(z + 70.0)]);
        let right = left.clone().mirrored().moved([WIDTH, 0.0, 0.0]);
        model.add(BENCH, Shape::all([left, right]));
    }
}
