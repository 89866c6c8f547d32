//! Where a point of the scene lands in the picture.

use glam::{DVec2, DVec3};
use scene::Camera;

use crate::Error;
use crate::basis::basis;

/// What is nearer to the eye than this share of the distance to the target is cut away.
/// Depth is kept in f64, so it need only be far enough for the division by it.
const NEAR_SHARE: f64 = 1e-6;

/// A pinhole camera over a grid of samples.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View {
    eye: DVec3,
    /// Right, up, forward.
    axes: [DVec3; 3],
    /// Samples per unit of tangent.
    focal: f64,
    centre: DVec2,
    pub(crate) near: f64,
    pub(crate) width: u32,
    pub(crate) height: u32,
}

impl View {
    pub(crate) fn new(camera: &Camera, (width, height): (u32, u32)) -> Result<Self, Error> {
        let axes = basis(camera)?;
        let centre = DVec2::new(f64::from(width), f64::from(height)) / 2.0;
        Ok(Self {
            eye: camera.position,
            axes,
            focal: centre.y / (camera.vertical_fov / 2.0).tan(),
            centre,
            near: NEAR_SHARE * (camera.target - camera.position).length(),
            width,
            height,
        })
    }

    /// A point as right, up and forward of the eye.
    pub(crate) fn seen(&self, point: DVec3) -> DVec3 {
        let offset = point - self.eye;
        DVec3::from_array(self.axes.map(|axis| offset.dot(axis)))
    }

    /// Where a seen point lands: samples from the left and from the top.
    pub(crate) fn project(&self, seen: DVec3) -> DVec2 {
        let slope = DVec2::new(seen.x, -seen.y) / seen.z;
        self.centre + self.focal * slope
    }
}
