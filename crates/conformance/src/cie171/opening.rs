//! An even sky through an unglazed opening: in a roof, and in a facade.
//!
//! After the test cases of CIE 171:2006 for the sky component under unglazed openings, with a sky of
//! one luminance, which shines through an opening as the opening would. The sky is a panel a little
//! behind it, so large that from every point the opening is full of it: what is tested is that the
//! walls round the opening block the rest.

use glam::DVec3;

use super::{COARSE, Comparison, FINE, FINEST, FORM_FACTOR, Room, light, named};
use crate::Error;
use crate::howell::{point_to_parallel, point_to_perpendicular};

const ROOF: &str = "sky through a roof opening";
const FACADE: &str = "sky through a facade opening";
const ABOVE: &str = "Howell, catalogue, B-3; Tregenza & Sharples, 3.14";
const ASIDE: &str = "Howell, catalogue, B-4; Tregenza & Sharples, 2.31 and 3.15";

/// π times the luminance of the sky.
const SKY: f64 = 10_000.0;
/// How far behind the opening the sky is.
const BEHIND: f64 = 0.2;
/// Triangles along a side of the sky where it is to be seen finely.
const MANY: u32 = 40;

pub(super) fn comparisons() -> Result<Vec<Comparison>, Error> {
    let mut all = roof(MANY, 1, FINE)?;
    all.extend(facade()?);
    Ok(all)
}

/// The roof as a user would draw it, its sky one rectangle, in cells of the solver's own choice.
pub(super) fn as_drawn() -> Result<Vec<Comparison>, Error> {
    roof(1, 10_000, COARSE)
}

/// What an opening of this area and rim may be off by, through a sky of elements of some width: its
/// cells are seen wholly or not at all, by their middles, so the rim is off by half a cell at most.
fn tolerance(area: f64, rim: f64, element: f64) -> f64 {
    FORM_FACTOR + rim * FINEST * element / 2.0 / area
}

/// A wall with an opening, as four rectangles; `u` and `v` are the wall's sides from its corner, and
/// the opening lies between shares of them.
fn frame(
    room: &mut Room,
    [corner, u, v]: [DVec3; 3],
    [u0, u1]: [f64; 2],
    [v0, v1]: [f64; 2],
) -> Result<(), Error> {
    for ([a, b], [c, d]) in [
        ([0.0, u0], [0.0, 1.0]),
        ([u1, 1.0], [0.0, 1.0]),
        ([u0, u1], [0.0, v0]),
        ([u0, u1], [v1, 1.0]),
    ] {
        room.rectangle([corner + u * a + v * c, u * (b - a), v * (d - c)], 0.0, 0.0)?;
    }
    Ok(())
}

/// An opening of 1 × 1 in the middle of a roof of 4 × 4, 3 above the floor.
fn roof(along: u32, elements: usize, cell_share: f64) -> Result<Vec<Comparison>, Error> {
    let (half, wall, height) = (0.5, 2.0, 3.0);
    let mut room = Room::new();
    room.black_walls(DVec3::new(-wall, -wall, 0.0), DVec3::new(wall, wall, height))?;
    let roof = [DVec3::new(-wall, -wall, height), DVec3::Y * 2.0 * wall, DVec3::X * 2.0 * wall];
    frame(&mut room, roof, [0.375, 0.625], [0.375, 0.625])?;
    let sky = DVec3::new(-1.0, -1.0, height + BEHIND);
    room.grid([sky, DVec3::Y * 2.0, DVec3::X * 2.0], [along; 2], 0.0, SKY)?;
    let scene = room.finish();

    let places = [[0.0, 0.0], [0.5, 0.5], [1.0, 0.0], [1.5, 1.5], [-1.9, 0.3]];
    let places = places.map(|[x, y]| (DVec3::new(x, y, 0.0), DVec3::Z));
    let lit = light(&scene, elements, cell_share, &places);
    let tolerance = tolerance(1.0, 4.0, 2.0 / f64::from(MANY));
    let compare = |(&(place, _), got): (&(DVec3, DVec3), &scene::Rgb)| Comparison {
        case: ROOF,
        source: ABOVE,
        place: named("floor", place),
        expected: SKY
            * point_to_parallel(
                [-half - place.x, half - place.x],
                [-half - place.y, half - place.y],
                height,
            ),
        got: got[0],
        tolerance,
    };
    Ok(places.iter().zip(&lit.probe_irradiance).map(compare).collect())
}

/// An opening of 2 × 1.5, 1 above the floor, in the wall x = 0, 4 wide and 3 high. The sky is no
/// larger than the wall, so nothing of it is seen past the wall.
fn facade() -> Result<Vec<Comparison>, Error> {
    let mut room = Room::new();
    let floor = [DVec3::new(0.0, -2.0, 0.0), DVec3::X * 6.0, DVec3::Y * 4.0];
    room.rectangle(floor, 0.0, 0.0)?;
    let wall = [DVec3::new(0.0, -2.0, 0.0), DVec3::Y * 4.0, DVec3::Z * 3.0];
    frame(&mut room, wall, [0.25, 0.75], [1.0 / 3.0, 2.5 / 3.0])?;
    let sky = [DVec3::new(-BEHIND, -2.0, 0.5), DVec3::Y * 4.0, DVec3::Z * 2.5];
    room.grid(sky, [40, 25], 0.0, SKY)?;
    let scene = room.finish();

    let places = [[1.25, 0.0], [1.5, 0.0], [2.0, 1.5], [3.0, 0.0], [5.0, -1.0]];
    let places = places.map(|[x, y]| (DVec3::new(x, y, 0.0), DVec3::Z));
    let lit = light(&scene, 1, FINE, &places);
    let tolerance = tolerance(3.0, 7.0, 4.0 / 40.0);
    let compare = |(&(place, _), got): (&(DVec3, DVec3), &scene::Rgb)| Comparison {
        case: FACADE,
        source: ASIDE,
        place: named("floor", place),
        expected: SKY
            * point_to_perpendicular([1.0, 2.5], [-1.0 - place.y, 1.0 - place.y], place.x),
        got: got[0],
        tolerance,
    };
    Ok(places.iter().zip(&lit.probe_irradiance).map(compare).collect())
}
