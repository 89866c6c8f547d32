//! `blocks.tri`: cuboids in stacks with small gaps, in a closed room with lamps at the ceiling.

use super::mesh::Shape;
use super::shapes::{Faces, cuboid, shell};
use super::tri_text::{Model, Paint, lamp, matte};

/// Edge of the room.
const ROOM: f64 = 1000.0;
/// Distance between the middles of neighbouring stacks.
const PITCH: f64 = 250.0;
/// Free height between the blocks of a stack: narrow enough that little light enters.
const GAP: f64 = 12.0;

const WALL: Paint = matte(200, 200, 200);
const FLOOR: Paint = matte(150, 150, 150);
const BLOCKS: [Paint; 4] =
    [matte(230, 80, 60), matte(70, 160, 220), matte(240, 200, 80), matte(225, 225, 215)];
const LAMP: Paint = lamp(255, 240, 210);

/// Width, depth and height of the blocks of a stack, from below.
const STACKS: [&[[f64; 3]]; 4] = [
    &[[150.0, 150.0, 120.0], [150.0, 150.0, 120.0], [110.0, 110.0, 90.0]],
    &[[130.0, 170.0, 220.0], [170.0, 110.0, 60.0]],
    &[[170.0, 170.0, 70.0], [130.0, 130.0, 70.0], [90.0, 90.0, 70.0], [60.0, 60.0, 160.0]],
    &[[120.0, 120.0, 330.0]],
];

pub(crate) fn model() -> Model {
    let mut model = Model::default();
    let (low, high) = ([0.0; 3], [ROOM; 3]);
    model.add(WALL, shell(low, high, [8, 8, 8], Faces::ALL - Faces::BOTTOM));
    model.add(FLOOR, shell(low, high, [8, 8, 8], Faces::BOTTOM));
    for row in 0..4_usize {
        for column in 0..4_usize {
            // Every kind of stack stands once in each row and once in each column.
            let stack = STACKS[(row + column) % 4];
            let middle = [PITCH * (column as f64 + 0.5), PITCH * (row as f64 + 0.5)];
            add_stack(&mut model, stack, middle, row + 2 * column);
            if (row + column) % 2 == 1 {
                float_above(&mut model, middle, row * 4 + column);
            }
        }
    }
    for [x, z] in [[250.0, 250.0], [750.0, 250.0], [500.0, 500.0], [250.0, 750.0], [750.0, 750.0]] {
        let (low, high) = ([x - 70.0, 975.0, z - 70.0], [x + 70.0, ROOM, z + 70.0]);
        model.add(WALL, cuboid(low, high, Faces::AROUND));
        model.add(LAMP, cuboid(low, high, Faces::BOTTOM));
    }
    model
}

/// The lowest block stands on the floor, the others float over it.
fn add_stack(model: &mut Model, stack: &[[f64; 3]], middle: [f64; 2], colour: usize) {
    let mut bottom = 0.0;
    for (level, &[width, depth, height]) in stack.iter().enumerate() {
        let faces = if level == 0 { Faces::STANDING } else { Faces::ALL };
        let block = block(middle, bottom, [width, depth, height], faces);
        model.add(BLOCKS[(colour + level) % BLOCKS.len()], block);
        bottom += height + GAP;
    }
}

/// A block high above a stack, so that shadows fall on tops, too.
fn float_above(model: &mut Model, middle: [f64; 2], number: usize) {
    let bottom = 560.0 + 60.0 * (number % 3) as f64;
    model.add(BLOCKS[number % BLOCKS.len()], block(middle, bottom, [100.0; 3], Faces::ALL));
}

fn block([x, z]: [f64; 2], bottom: f64, [w, d, h]: [f64; 3], faces: Faces) -> Shape {
    let low = [x - w / 2.0, bottom, z - d / 2.0];
    cuboid(low, [x + w / 2.0, bottom + h, z + d / 2.0], faces)
}
