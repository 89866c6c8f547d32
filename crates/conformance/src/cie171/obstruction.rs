//! A patch lit from afar that lights points above it, some of them past a board in between.
//!
//! After the test cases of CIE 171:2006 for light reflected by a diffuse surface, without and with
//! obstructions inside. The formula is of two form factors: from the patch to the lamp, which is even
//! over the patch, and from a point to what it sees of the patch.

use glam::DVec3;

use super::{Comparison, FINE, FINEST, FORM_FACTOR, Room, light, named};
use crate::Error;
use crate::howell::{point_to_parallel, point_to_perpendicular};

const CASE: &str = "reflection by a patch";
const SOURCE: &str = "Howell, catalogue, B-3 twice";
const WITH_LAMP: &str = "Howell, catalogue, B-3 and B-4";

/// The patch, 0.5 × 0.5 about the origin, and how much it reflects.
const PATCH: f64 = 0.25;
const REFLECTANCE: f64 = 0.8;
/// Elements along a side of it.
const ELEMENTS: u32 = 16;
/// The lamp, 1 × 1 above it.
const LAMP: f64 = 0.5;
const LAMP_HEIGHT: f64 = 20.0;
const EXITANCE: f64 = 1e6;
/// The points that look down.
const CEILING: f64 = 2.0;
/// A black board at this x, 2 wide, from the ceiling down to half its height: farther out than any
/// light on its way from the lamp to the patch.
const BOARD: f64 = 1.0;

/// The irradiance of the patch is that of its middle within this share: cos⁴ of the angle of its
/// corner, 0.35 / 20, differs from 1 by twice the square of that.
const UNEVEN: f64 = 7e-4;

pub(super) fn comparisons() -> Result<Vec<Comparison>, Error> {
    let mut room = Room::new();
    let patch = DVec3::new(-PATCH, -PATCH, 0.0);
    let lamp = DVec3::new(-LAMP, -LAMP, LAMP_HEIGHT);
    let board = DVec3::new(BOARD, -1.0, CEILING / 2.0);
    let (side, across, up) = (2.0 * PATCH, DVec3::Y * 2.0, DVec3::Z * (CEILING / 2.0));
    let sides = [patch, DVec3::X * side, DVec3::Y * side];
    room.grid(sides, [ELEMENTS; 2], REFLECTANCE, 0.0)?;
    room.rectangle([lamp, DVec3::Y * 2.0 * LAMP, DVec3::X * 2.0 * LAMP], 0.0, EXITANCE)?;
    room.rectangle([board, across, up], 0.0, 0.0)?;
    let scene = room.finish();

    let down =
        [[0.0, 0.0], [0.5, 0.0], [-1.0, 1.5], [1.9, 0.0], [2.0, 0.0], [2.15, 0.0], [2.6, 0.0]];
    let down = down.map(|[x, y]| (DVec3::new(x, y, CEILING), DVec3::NEG_Z));
    let aside = [0.25, 1.0].map(|z| (DVec3::new(-1.0, 0.0, z), DVec3::X));
    let places: Vec<_> = down.into_iter().chain(aside).collect();
    let lit = light(&scene, 1, FINE, &places);
    let cell = FINEST * side / f64::from(ELEMENTS);

    let patch =
        REFLECTANCE * EXITANCE * point_to_parallel([-LAMP, LAMP], [-LAMP, LAMP], LAMP_HEIGHT);
    let compare = |(&(place, look), got): (&(DVec3, DVec3), &scene::Rgb)| {
        let tolerance = 2.0 * FORM_FACTOR + UNEVEN;
        let across = [-PATCH - place.y, PATCH - place.y];
        if look == DVec3::X {
            let along = |half: f64| [-half - place.x, half - place.x];
            let from_lamp =
                point_to_perpendicular(along(LAMP), [-LAMP, LAMP], LAMP_HEIGHT - place.z);
            let from_patch = point_to_perpendicular(along(PATCH), across, place.z);
            return Comparison {
                case: CASE,
                source: WITH_LAMP,
                place: named("wall, with the lamp,", place),
                expected: EXITANCE * from_lamp + patch * from_patch,
                got: got[0],
                tolerance,
            };
        }
        // The line of sight over the board's lower edge meets the patch's plane here.
        let edge = 2.0 * BOARD - place.x;
        let first = if place.x > BOARD { edge.max(-PATCH) } else { -PATCH };
        let cut = first > -PATCH;
        let seen = point_to_parallel([first - place.x, PATCH - place.x], across, CEILING);
        Comparison {
            case: CASE,
            source: SOURCE,
            place: named(if cut { "ceiling, past the board," } else { "ceiling" }, place),
            expected: patch * seen,
            got: got[0],
            // A cell is seen wholly or not at all, by its middle: off by half of it at most.
            tolerance: tolerance + if cut { cell / 2.0 / (PATCH - first) } else { 0.0 },
        }
    };
    Ok(places.iter().zip(&lit.probe_irradiance).map(compare).collect())
}
