//! A pinhole camera: where a picture is taken from.

use glam::DVec3;

/// A pinhole camera in scene coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Camera {
    /// The file's name for it, or how it was chosen.
    pub name: String,
    /// The eye.
    pub position: DVec3,
    /// A point straight ahead.
    pub target: DVec3,
    /// Up in the picture; need not be perpendicular to the view.
    pub up: DVec3,
    /// Full vertical field of view, radians.
    pub vertical_fov: f64,
}
