//! A camera for a scene that brought none: inside a room, or around an object.
//!
//! The choice is a fixed one for a given scene. The up axis is +y or +z: the one along which more area faces up and more emission goes down. A scene
//! is a room when its surfaces mostly face its middle. A fixed list of eyes, at the ends
//! and corners of a room or around an object, is then tried on small pictures, and the
//! one that sees most wins; the first of equals.

mod facet;
mod score;
mod up;

use glam::DVec3;
use scene::{Camera, Scene};

use facet::{Facet, facets};
use score::score;

/// A scene is a room when the area that faces its middle exceeds the area that faces
/// away by this share of the whole. Rooms with furniture have 0.5 and more, closed
/// objects −1.
const ROOM_SHARE: f64 = 0.3;
/// Surfaces whose plane passes the middle within this share of the diagonal face neither
/// way: it is far above rounding, and no wall stands there.
const MIDDLE_SHARE: f64 = 1e-6;
/// Vertical field of view in a room: 70° across a 4:3 picture, as a wide lens has.
const ROOM_FOV: f64 = 55.0_f64.to_radians();
/// Vertical field of view around an object: a portrait lens.
const OBJECT_FOV: f64 = 35.0_f64.to_radians();
/// The bounding sphere of an object fills this share of the picture's height.
const OBJECT_SHARE: f64 = 0.95;
/// First azimuth around an object: the three-quarter view.
const FIRST_AZIMUTH: f64 = 35.0;
/// How high the eye stands around an object, degrees.
const ELEVATIONS: [f64; 3] = [25.0, 55.0, -25.0];
/// Azimuths around an object.
const AZIMUTHS: u32 = 8;

/// Where an eye stands at a room and where it looks, in shares of the bounds along the
/// longer horizontal axis, the shorter one, and upwards. Eyes outside the bounds look in
/// through walls that are not drawn from behind.
type Stand = ([f64; 3], [f64; 3]);

const STANDS: [Stand; 22] = [
    // From the middle of an end, along the room.
    ([0.03, 0.50, 0.50], [0.97, 0.50, 0.45]),
    ([0.97, 0.50, 0.50], [0.03, 0.50, 0.45]),
    // From a corner to the opposite one.
    ([0.04, 0.12, 0.50], [0.96, 0.75, 0.42]),
    ([0.04, 0.88, 0.50], [0.96, 0.25, 0.42]),
    ([0.96, 0.12, 0.50], [0.04, 0.75, 0.42]),
    ([0.96, 0.88, 0.50], [0.04, 0.25, 0.42]),
    // The same from higher up, over furniture.
    ([0.06, 0.12, 0.78], [0.90, 0.80, 0.25]),
    ([0.06, 0.88, 0.78], [0.90, 0.20, 0.25]),
    ([0.94, 0.12, 0.78], [0.10, 0.80, 0.25]),
    ([0.94, 0.88, 0.78], [0.10, 0.20, 0.25]),
    // Across the room.
    ([0.50, 0.03, 0.50], [0.50, 0.97, 0.45]),
    ([0.50, 0.97, 0.50], [0.50, 0.03, 0.45]),
    // From further in, where the ends are taken.
    ([0.25, 0.50, 0.50], [0.97, 0.50, 0.45]),
    ([0.75, 0.50, 0.50], [0.03, 0.50, 0.45]),
    // From outside, through a wall.
    ([-0.60, 0.50, 0.50], [1.0, 0.50, 0.50]),
    ([1.60, 0.50, 0.50], [0.0, 0.50, 0.50]),
    ([0.50, -0.60, 0.50], [0.50, 1.0, 0.50]),
    ([0.50, 1.60, 0.50], [0.50, 0.0, 0.50]),
    // From above a corner, through the ceiling.
    ([-0.30, -0.30, 1.30], [0.58, 0.58, 0.25]),
    ([-0.30, 1.30, 1.30], [0.58, 0.42, 0.25]),
    ([1.30, -0.30, 1.30], [0.42, 0.58, 0.25]),
    ([1.30, 1.30, 1.30], [0.42, 0.42, 0.25]),
];

/// A camera that shows the scene well, the same one each time.
///
/// Costs one small picture of the whole scene for each of up to 24 eyes.
///
/// # Examples
/// ```
/// let camera = output::camera::automatic(&scene::Scene::default());
/// assert!(camera.vertical_fov > 0.0 && camera.position != camera.target);
/// ```
#[must_use]
pub fn automatic(scene: &Scene) -> Camera {
    let facets = facets(scene);
    let (low, high) = scene.bounds().unwrap_or((DVec3::ZERO, DVec3::ZERO));
    let up = up::up(&facets);
    let cameras = if inward_share(&facets, low, high) > ROOM_SHARE {
        STANDS.iter().map(|stand| in_room(stand, low, high, up)).collect()
    } else {
        around(low, high, up)
    };
    best(cameras, &facets, low, high)
}

/// The area that faces the middle less the area that faces away, as a share of the whole.
/// A two-sided surface faces the middle when the lamps are on the same side of it.
fn inward_share(facets: &[Facet], low: DVec3, high: DVec3) -> f64 {
    let middle = 0.5 * low + 0.5 * high;
    let margin = MIDDLE_SHARE * (high - low).length();
    let power: f64 = facets.iter().map(|f| f.power).sum();
    let lamps = facets.iter().map(|f| f.middle * f.power).sum::<DVec3>() / power;
    let side = |f: &Facet, p: DVec3| {
        let height = f.normal.dot(p - f.middle);
        if height.abs() > margin { height.signum() } else { 0.0 }
    };
    let total: f64 = facets.iter().map(|f| f.area).sum();
    let inward = |f: &Facet| {
        let front = match f.both_sides {
            false => 1.0,
            true if power > 0.0 => side(f, lamps),
            true => 0.0,
        };
        f.area * front * side(f, middle)
    };
    if total > 0.0 { facets.iter().map(inward).sum::<f64>() / total } else { 0.0 }
}

fn in_room((eye, target): &Stand, low: DVec3, high: DVec3, up: DVec3) -> Camera {
    let size = high - low;
    let (right, near) = horizontal(up);
    let extent = |axis: DVec3| axis.abs().dot(size);
    let (long, short) = if extent(right) >= extent(near) { (right, near) } else { (near, right) };
    let place = |shares: &[f64; 3]| {
        let along = |axis: DVec3, share: f64| axis * extent(axis) * (share - 0.5);
        0.5 * low
            + 0.5 * high
            + along(long, shares[0])
            + along(short, shares[1])
            + along(up, shares[2])
    };
    Camera {
        name: "automatic, room".into(),
        position: place(eye),
        target: place(target),
        up,
        vertical_fov: ROOM_FOV,
    }
}

fn around(low: DVec3, high: DVec3, up: DVec3) -> Vec<Camera> {
    let middle = 0.5 * low + 0.5 * high;
    let radius = match 0.5 * (high - low).length() {
        0.0 => 1.0, // nothing to frame
        radius => radius,
    };
    let distance = radius / (OBJECT_SHARE * (OBJECT_FOV / 2.0).sin());
    let (right, near) = horizontal(up);
    let mut cameras = Vec::new();
    for elevation in ELEVATIONS.map(f64::to_radians) {
        for step in 0..AZIMUTHS {
            let turn = f64::from(step) * 360.0 / f64::from(AZIMUTHS);
            let azimuth = (FIRST_AZIMUTH + turn).to_radians();
            let level = right * azimuth.sin() + near * azimuth.cos();
            let towards = level * elevation.cos() + up * elevation.sin();
            cameras.push(Camera {
                name: "automatic, object".into(),
                position: middle + towards * distance,
                target: middle,
                up,
                vertical_fov: OBJECT_FOV,
            });
        }
    }
    cameras
}

/// The axes to the right and towards the viewer, for an up axis.
fn horizontal(up: DVec3) -> (DVec3, DVec3) {
    (DVec3::X, DVec3::X.cross(up))
}

fn best(cameras: Vec<Camera>, facets: &[Facet], low: DVec3, high: DVec3) -> Camera {
    let diagonal = (high - low).length();
    let worth = |camera: &Camera| score(camera, facets, diagonal, within(camera, low, high));
    let mut cameras = cameras.into_iter();
    let first = cameras.next().expect("both lists of eyes are never empty");
    let start = (worth(&first), first);
    let better = |best: (f64, Camera), camera| {
        let worth = worth(&camera);
        if worth > best.0 { (worth, camera) } else { best }
    };
    cameras.fold(start, better).1
}

fn within(camera: &Camera, low: DVec3, high: DVec3) -> bool {
    let eye = camera.position;
    eye.cmpge(low).all() && eye.cmple(high).all()
}
