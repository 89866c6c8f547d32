//! Which way a camera looks, for pictures and for GLB.

use glam::DVec3;
use scene::Camera;

use crate::{Error, ErrorKind};

/// A view closer than this to its up vector (sine of the angle) takes another one:
/// below it rounding would turn the picture.
const MIN_UP_SINE: f64 = 1e-6;

/// Right, up and forward of a camera, of unit length.
///
/// A camera that looks along its own up vector takes the axis nearest to perpendicular
/// instead, x before y before z.
pub(crate) fn basis(camera: &Camera) -> Result<[DVec3; 3], Error> {
    let fail = || Error::new(ErrorKind::Camera(camera.name.clone()));
    let finite = camera.position.is_finite() && camera.up.is_finite();
    let fov = camera.vertical_fov > 0.0 && camera.vertical_fov < std::f64::consts::PI;
    let forward = (camera.target - camera.position).try_normalize().filter(|f| f.is_finite());
    let forward = forward.filter(|_| finite && fov).ok_or_else(fail)?;
    let across = forward.cross(camera.up.normalize_or_zero());
    let right = if across.length() > MIN_UP_SINE {
        across
    } else {
        let size = forward.abs();
        let axis = if size.x <= size.y && size.x <= size.z {
            DVec3::X
        } else if size.y <= size.z {
            DVec3::Y
        } else {
            DVec3::Z
        };
        forward.cross(axis)
    };
    let right = right.normalize();
    Ok([right, right.cross(forward), forward])
}
