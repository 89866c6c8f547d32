//! A lamp that shines evenly, over points of the floor and the walls: one form factor each.
//!
//! After the test cases of CIE 171:2006 for area light sources.

use glam::DVec3;

use super::{COARSE, Comparison, FORM_FACTOR, Room, light, named};
use crate::Error;
use crate::howell::{point_to_parallel, point_to_perpendicular};

const CASE: &str = "area source";
const ON_THE_FLOOR: &str = "Howell, catalogue, B-3; Tregenza & Sharples, 3.14";
const ON_A_WALL: &str = "Howell, catalogue, B-4; Tregenza & Sharples, 3.15";

/// A lamp of 1 × 1 in the middle of the ceiling of a black room of 4 × 4 × 3.
const HEIGHT: f64 = 3.0;
const HALF: f64 = 0.5;
const WALL: f64 = 2.0;
const EXITANCE: f64 = 1000.0;

pub(super) fn comparisons() -> Result<Vec<Comparison>, Error> {
    let mut room = Room::new();
    let low = DVec3::new(-WALL, -WALL, 0.0);
    room.black_walls(low, DVec3::new(WALL, WALL, HEIGHT))?;
    let corner = DVec3::new(-HALF, -HALF, HEIGHT);
    room.rectangle([corner, DVec3::Y * 2.0 * HALF, DVec3::X * 2.0 * HALF], 0.0, EXITANCE)?;
    let scene = room.finish();

    let floor = [[0.0, 0.0], [0.5, 0.5], [1.0, 0.0], [1.5, 1.5], [1.9, 1.0]];
    let floor = floor.map(|[x, y]| (DVec3::new(x, y, 0.0), DVec3::Z));
    let wall = [[0.0, 0.5], [0.0, 1.5], [0.0, 2.5], [1.0, 2.0], [-1.5, 2.9]];
    let wall = wall.map(|[y, z]| (DVec3::new(WALL, y, z), DVec3::NEG_X));
    let places = [floor, wall].concat();
    let lit = light(&scene, 200, COARSE, &places);
    let compare = |(&(place, look), got): (&(DVec3, DVec3), &scene::Rgb)| {
        let across = [-HALF - place.y, HALF - place.y];
        let (what, source, form_factor) = if look == DVec3::Z {
            let along = [-HALF - place.x, HALF - place.x];
            ("floor", ON_THE_FLOOR, point_to_parallel(along, across, HEIGHT))
        } else {
            let along = [WALL - HALF, WALL + HALF];
            ("wall", ON_A_WALL, point_to_perpendicular(along, across, HEIGHT - place.z))
        };
        Comparison {
            case: CASE,
            source,
            place: named(what, place),
            expected: EXITANCE * form_factor,
            got: got[0],
            tolerance: FORM_FACTOR,
        }
    };
    Ok(places.iter().zip(&lit.probe_irradiance).map(compare).collect())
}
