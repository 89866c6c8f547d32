//! `church.tri`: a nave with aisles, arcades, pointed vaults, an apse and pews, in centimetres.
//!
//! West is z = 0, the altar stands towards +z. All light comes through the windows.

use super::arches::{Arch, Opening, at, end_wall, lunette, rib, vault};
use super::mesh::{Frame, Point, Shape, length, scale, sub};
use super::shapes::{Faces, cuboid, disc, drum, grid, polygon, quad, ruled};
use super::tri_text::{Model, Paint, lamp, matte};

/// Length of a bay; the nave has `BAYS` with aisles and the choir one without.
const BAY: f64 = 500.0;
const BAYS: u32 = 6;
const CHOIR: f64 = BAY * BAYS as f64;
const EAST: f64 = CHOIR + BAY;
/// Half the width of the nave, the outer face of the arcade wall, and the aisle's outer wall.
const NAVE: f64 = 400.0;
const ARCADE: f64 = 480.0;
const AISLE: f64 = 820.0;
/// Where the arcade's arches, the aisle's vault and the nave's vault spring.
const IMPOST: f64 = 360.0;
const GALLERY: f64 = 680.0;
const SPRING: f64 = 1050.0;
/// Half the width of an arcade wall's stump over a pillar.
const STUMP: f64 = 50.0;
const RIB: f64 = 26.0;
/// Half the width of a rib and of the shaft below it.
const RIB_HALF: f64 = 18.0;

const NAVE_VAULT: Arch = Arch { left: -NAVE, right: NAVE, spring: SPRING, rise: 520.0, pieces: 8 };
const AISLE_VAULT: Arch =
    Arch { left: ARCADE, right: AISLE, spring: GALLERY, rise: 210.0, pieces: 5 };

const WALL: Paint = matte(220, 208, 185);
const VAULT: Paint = matte(232, 224, 208);
const STONE: Paint = matte(200, 186, 160);
const REVEAL: Paint = matte(240, 235, 225);
const FLOORS: [Paint; 2] = [matte(170, 160, 150), matte(130, 95, 80)];
const STEP: Paint = matte(210, 205, 200);
const WOOD: Paint = matte(110, 72, 44);
const ALTAR: Paint = matte(245, 240, 230);
const CLEAR: Paint = lamp(255, 245, 225);
const STAINED: [Paint; 4] =
    [lamp(255, 90, 60), lamp(70, 120, 255), lamp(255, 200, 80), lamp(90, 255, 140)];

pub(crate) fn model() -> Model {
    let mut model = Model::default();
    add_floor(&mut model);
    for bay in 0..BAYS {
        // The left half is built and mirrored; a mirrored half keeps its fronts.
        let z = BAY * f64::from(bay);
        both(&mut model, WALL, arcade_bay(z));
        both_windows(&mut model, z, bay as usize);
        both(&mut model, VAULT, vault(&AISLE_VAULT, z, z + BAY, 2));
    }
    for number in 1..BAYS {
        let z = BAY * f64::from(number);
        both(&mut model, STONE, pillar().moved([(NAVE + ARCADE) / 2.0, 0.0, z]));
        both(&mut model, STONE, aisle_rib(z));
    }
    for number in 1..=BAYS {
        let z = BAY * f64::from(number);
        both(&mut model, STONE, shaft(z));
        model.add(STONE, rib(&NAVE_VAULT, RIB, z - RIB_HALF, z + RIB_HALF));
    }
    model.add(VAULT, vault(&NAVE_VAULT, 0.0, EAST, 2 * (BAYS + 1)));
    both(&mut model, STONE, responds());
    both(&mut model, WALL, end_wall(&AISLE_VAULT, 0.0));
    // Turned half about y, a wall that faces west becomes one that faces east.
    let east = end_wall(&AISLE_VAULT, 0.0).turned(180.0).moved([ARCADE + AISLE, 0.0, CHOIR]);
    both(&mut model, WALL, east);
    both(&mut model, WALL, plain_wall([0.0, GALLERY], CHOIR, EAST));
    add_west_front(&mut model);
    add_apse(&mut model);
    add_altar(&mut model);
    add_pews(&mut model);
    model
}

/// Adds a shape of the right half and its mirror image.
fn both(model: &mut Model, paint: Paint, shape: Shape) {
    model.add(paint, shape.clone());
    model.add(paint, shape.mirrored());
}

/// A frame for a wall that stands at `x` and faces the middle of the building: its own x runs
/// along +z from `z` on.
fn facing_left(x: f64, z: f64) -> Frame {
    Frame { origin: [x, 0.0, z], x: [0.0, 0.0, 1.0], y: [0.0, 1.0, 0.0], z: [-1.0, 0.0, 0.0] }
}

/// The same wall seen from the other side: its own x runs along -z.
fn facing_right(x: f64, z: f64) -> Frame {
    Frame { origin: [x, 0.0, z], x: [0.0, 0.0, -1.0], y: [0.0, 1.0, 0.0], z: [1.0, 0.0, 0.0] }
}

/// A plain piece of the nave's right wall.
fn plain_wall([low, high]: [f64; 2], from: f64, to: f64) -> Shape {
    grid([NAVE, low, from], [0.0, 0.0, to - from], [0.0, high - low, 0.0], 2, 2)
}

fn add_floor(model: &mut Model) {
    let (columns, rows) = (8, 16);
    let (wide, long) = (2.0 * AISLE / f64::from(columns), CHOIR / f64::from(rows));
    for row in 0..rows {
        for column in 0..columns {
            let origin = [wide * f64::from(column) - AISLE, 0.0, long * f64::from(row)];
            let tile = grid(origin, [0.0, 0.0, long], [wide, 0.0, 0.0], 1, 1);
            model.add(FLOORS[((row + column) % 2) as usize], tile);
        }
    }
    let choir = grid([-NAVE, 0.0, CHOIR], [0.0, 0.0, BAY], [2.0 * NAVE, 0.0, 0.0], 2, 4);
    model.add(FLOORS[0], choir);
}

/// One arch of the right arcade: both faces of its wall from the impost up, and the soffit.
fn arcade_bay(z: f64) -> Shape {
    let thickness = ARCADE - NAVE;
    let arch = Arch { left: STUMP, right: BAY - STUMP, spring: IMPOST, rise: 270.0, pieces: 6 };
    let opening = arch.opening(IMPOST);
    let face = opening.wall([0.0, IMPOST], [BAY, GALLERY]);
    let line = arch.line();
    let soffit = ruled(&at(&line, -thickness), &at(&line, 0.0));
    Shape::all([
        Shape::all([face.clone(), soffit]).placed(&facing_left(NAVE, z)),
        // The arch is symmetric, so the aisle's face is the same wall from the other side.
        face.placed(&facing_right(ARCADE, z + BAY)),
    ])
}

/// A pillar about its axis, with the stump's underside that it carries.
fn pillar() -> Shape {
    const SIDES: u32 = 8;
    let square = |half: f64, bottom: f64, top: f64, faces: Faces| {
        cuboid([-half, bottom, -half], [half, top, half], faces)
    };
    let (wide, deep) = (STUMP, (ARCADE - NAVE) / 2.0);
    Shape::all([
        square(50.0, 0.0, 25.0, Faces::STANDING),
        drum(SIDES, (25.0, 44.0), (45.0, 40.0)),
        disc(SIDES, 45.0, 40.0),
        drum(SIDES, (45.0, 30.0), (300.0, 29.0)),
        drum(SIDES, (300.0, 29.0), (335.0, 40.0)),
        cuboid([-deep, 335.0, -wide], [deep, IMPOST, wide], Faces::HANGING),
    ])
}

/// Half pillars where the arcade meets the west wall and the choir.
fn responds() -> Shape {
    let west = Faces::LEFT | Faces::RIGHT | Faces::FRONT;
    let east = Faces::LEFT | Faces::RIGHT | Faces::BACK;
    Shape::all([
        cuboid([NAVE, 0.0, 0.0], [ARCADE, IMPOST, STUMP], west),
        cuboid([NAVE, 0.0, CHOIR - STUMP], [ARCADE, IMPOST, CHOIR], east),
    ])
}

/// A shaft on the nave's right wall that carries a rib, on a corbel.
fn shaft(z: f64) -> Shape {
    let bottom = 600.0;
    let (low, high) = ([NAVE - RIB, bottom, z - RIB_HALF], [NAVE, SPRING, z + RIB_HALF]);
    let faces = Faces::LEFT | Faces::BACK | Faces::FRONT;
    Shape::all([cuboid(low, high, faces), corbel(RIB, 40.0).moved([NAVE, bottom, z])])
}

/// A rib of the right aisle and the corbels it rests on.
fn aisle_rib(z: f64) -> Shape {
    let depth = 16.0;
    let corbel = corbel(depth, 40.0);
    Shape::all([
        rib(&AISLE_VAULT, depth, z - RIB_HALF, z + RIB_HALF),
        corbel.clone().mirrored().moved([ARCADE, GALLERY, z]),
        corbel.moved([AISLE, GALLERY, z]),
    ])
}

/// A wedge at a wall x = 0 that carries a load of a rib's width and `depth` at y = 0.
fn corbel(depth: f64, height: f64) -> Shape {
    let wedge = |z: f64| [[0.0, -height, z], [-depth, 0.0, z], [0.0, 0.0, z]];
    let ([tip, edge, wall], [far_tip, far_edge, far_wall]) = (wedge(-RIB_HALF), wedge(RIB_HALF));
    let mut shape = quad([tip, far_tip, far_edge, edge]);
    shape.0.extend([[tip, edge, wall], [far_tip, far_wall, far_edge]]);
    shape
}

/// A splayed lancet window in a wall: the wall, the reveal, the pane.
fn lancet(arch: Arch, sill: f64, low: [f64; 2], high: [f64; 2], depth: f64) -> [Shape; 3] {
    let (front, back) = (arch.opening(sill), arch.inset(12.0).opening(sill + 20.0));
    [front.wall(low, high), front.reveal(&back, depth), back.pane(depth)]
}

/// The windows of a bay: the clerestory over the arcade and one in the aisle's outer wall.
fn both_windows(model: &mut Model, z: f64, bay: usize) {
    let middle = BAY / 2.0;
    let arch = |half: f64, spring: f64, rise: f64| Arch {
        left: middle - half,
        right: middle + half,
        spring,
        rise,
        pieces: 4,
    };
    let upper = lancet(arch(42.0, 900.0, 75.0), 760.0, [0.0, GALLERY], [BAY, SPRING], 45.0);
    let lower = lancet(arch(36.0, 460.0, 70.0), 220.0, [0.0, 0.0], [BAY, GALLERY], 40.0);
    for (shapes, x, glass) in [(upper, NAVE, CLEAR), (lower, AISLE, STAINED[bay % 4])] {
        for (shape, paint) in shapes.into_iter().zip([WALL, REVEAL, glass]) {
            both(model, paint, shape.placed(&facing_left(x, z)));
        }
    }
}

/// The nave's west wall: a door below, a rose window above, the vault's end on top.
fn add_west_front(model: &mut Model) {
    let door = Arch { left: -110.0, right: 110.0, spring: 220.0, rise: 150.0, pieces: 6 };
    let portal = door.opening(0.0);
    let inner = door.inset(25.0).opening(0.0);
    model.add(WALL, portal.wall([-NAVE, 0.0], [NAVE, 460.0]));
    model.add(STONE, portal.reveal(&inner, 50.0));
    model.add(WOOD, inner.pane(50.0));

    let rose = Opening::round([0.0, 760.0], 190.0, 6);
    let glass = Opening::round([0.0, 760.0], 160.0, 6);
    model.add(WALL, rose.wall([-NAVE, 460.0], [NAVE, SPRING]));
    model.add(REVEAL, rose.reveal(&glass, 40.0));
    // Petals about the middle; every third is stone, as tracery.
    let border = at(&glass.border(), -40.0);
    for (number, pair) in border.windows(2).enumerate() {
        let petal = Shape(vec![[[0.0, 760.0, -40.0], pair[1], pair[0]]]);
        let paint = if number % 3 == 2 { STONE } else { STAINED[number / 3 % 4] };
        model.add(paint, petal);
    }
    model.add(WALL, lunette(&NAVE_VAULT, 0.0));
}

/// Half a twelve-sided apse: walls with lancets under half a dome.
fn add_apse(model: &mut Model) {
    const WALLS: u32 = 6;
    // Exact at both ends, where the apse meets the choir's walls.
    let direction = |wall: u32| match wall {
        0 => [1.0, 0.0],
        WALLS => [-1.0, 0.0],
        _ => {
            let (sin, cos) = (std::f64::consts::PI * f64::from(wall) / f64::from(WALLS)).sin_cos();
            [cos, sin]
        }
    };
    let around = |wall: u32, radius: f64, y: f64| {
        let [cos, sin] = direction(wall);
        [radius * cos, y, EAST + radius * sin]
    };
    let line = NAVE_VAULT.line();
    let crown = line.len() / 2;
    let meridian = |wall: u32| {
        line[..=crown].iter().map(|p| around(wall, -p[0], p[1])).collect::<Vec<Point>>()
    };

    for wall in 0..WALLS {
        let (from, to) = (around(wall, NAVE, 0.0), around(wall + 1, NAVE, 0.0));
        model.add(FLOORS[0], Shape(vec![[[0.0, 0.0, EAST], to, from]]));

        let width = length(sub(to, from));
        let x = scale(sub(to, from), 1.0 / width);
        let frame = Frame { origin: from, x, y: [0.0, 1.0, 0.0], z: [-x[2], 0.0, x[0]] };
        let middle = width / 2.0;
        let arch = Arch {
            left: middle - 38.0,
            right: middle + 38.0,
            spring: 840.0,
            rise: 90.0,
            pieces: 5,
        };
        add_dome(model, &meridian(wall), &meridian(wall + 1), &frame, arch, width);
        let shapes = lancet(arch, 420.0, [0.0, 0.0], [width, SPRING], 45.0);
        let glass = STAINED[[1, 0, 2, 2, 0, 1][wall as usize]];
        for (shape, paint) in shapes.into_iter().zip([WALL, REVEAL, glass]) {
            model.add(paint, shape.placed(&frame));
        }
    }
    // The choir's windows and wall above the plain part.
    let middle = BAY / 2.0;
    let arch =
        Arch { left: middle - 42.0, right: middle + 42.0, spring: 900.0, rise: 75.0, pieces: 4 };
    let shapes = lancet(arch, 760.0, [0.0, GALLERY], [BAY, SPRING], 45.0);
    for (shape, paint) in shapes.into_iter().zip([WALL, REVEAL, CLEAR]) {
        both(model, paint, shape.placed(&facing_left(NAVE, CHOIR)));
    }
}

/// A gore of the dome between two meridians. Its lowest piece shares every point of the wall's
/// upper edge: on a slanted edge, a point that only one side has opens a crack when rounded.
fn add_dome(
    model: &mut Model,
    from: &[Point],
    to: &[Point],
    frame: &Frame,
    arch: Arch,
    width: f64,
) {
    let mut lowest = vec![from[1], frame.at([0.0, SPRING, 0.0])];
    lowest.extend(arch.line().iter().map(|p| frame.at([p[0], SPRING, 0.0])));
    lowest.extend([frame.at([width, SPRING, 0.0]), to[1]]);
    model.add(VAULT, polygon(&lowest));
    model.add(VAULT, ruled(&to[1..], &from[1..]));
}

/// Three steps, each standing on the one below, and the altar on top.
fn add_altar(model: &mut Model) {
    for step in 0..3 {
        let (inset, bottom) = (45.0 * f64::from(step), 16.0 * f64::from(step));
        let low = [inset - 300.0, bottom, CHOIR + 200.0 + inset];
        let high = [300.0 - inset, bottom + 16.0, EAST + 150.0 - inset];
        model.add(STEP, cuboid(low, high, Faces::STANDING));
    }
    let block = cuboid([-110.0, 48.0, EAST - 80.0], [110.0, 140.0, EAST], Faces::AROUND);
    let table = cuboid([-125.0, 140.0, EAST - 95.0], [125.0, 152.0, EAST + 15.0], Faces::ALL);
    model.add(ALTAR, Shape::all([block, table]));
}

/// Pews on both sides of the middle, facing the altar.
fn add_pews(model: &mut Model) {
    const LENGTH: f64 = 230.0;
    let end = |x: f64| cuboid([x, 0.0, 0.0], [x + 6.0, 95.0, 52.0], Faces::STANDING);
    let between = Faces::ALL - Faces::LEFT - Faces::RIGHT;
    let (left, right) = (6.0, LENGTH - 6.0);
    let pew = Shape::all([
        end(0.0),
        end(right),
        cuboid([left, 42.0, 8.0], [right, 46.0, 48.0], between - Faces::BACK),
        cuboid([left, 42.0, 4.0], [right, 90.0, 8.0], between),
        cuboid([left, 12.0, 10.0], [right, 42.0, 14.0], between - Faces::TOP),
    ]);
    for row in 0..14 {
        let z = 560.0 + 150.0 * f64::from(row);
        both(model, WOOD, pew.clone().moved([75.0, 0.0, z]));
    }
}
