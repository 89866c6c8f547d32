//! What a page shows, checked before anything is written.

use std::f64::consts::PI;

use glam::DVec3;
use scene::{Camera, Scene, Solution};

use crate::Error;

/// A lit scene and how it is shown first.
#[derive(Clone, Copy, Debug)]
pub struct Shown<'a> {
    /// The scene that was lit.
    pub scene: &'a Scene,
    /// Its light.
    pub solution: &'a Solution,
    /// The unit of exitance, such as W/m².
    pub unit: &'a str,
    /// Display light per exitance at 0 stops, 1 being white: above 0 and finite.
    pub exposure: f64,
    /// Where one stands first; without it at the scene's first camera, or far enough to see all.
    pub view: Option<&'a Camera>,
    /// What the elements' own exitance is.
    pub means: Means,
}

/// What [`scene::SolutionElement::exitance`] holds, which a page says beside it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Means {
    /// Area means of elements, each part of an input triangle.
    #[default]
    OfElements,
    /// Means of three corners, for want of better; triangles are elements.
    OfCorners,
}

impl Shown<'_> {
    /// Complains of what no page can hold.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let Self { scene, solution, exposure, .. } = *self;
        if !(exposure > 0.0 && exposure.is_finite()) {
            return Err(Error::new("exposure: expected a finite number above 0"));
        }
        if let Some(vertex) = solution.vertices.iter().position(|p| !p.is_finite()) {
            return Err(Error::new(format!(
                "solution vertex {vertex}: a coordinate is not finite"
            )));
        }
        for (i, element) in solution.elements.iter().enumerate() {
            let known = element.triangle.index() < scene.triangles().len()
                && element.vertices.iter().all(|v| v.index() < solution.vertices.len());
            if !known {
                let what = "names a triangle or a vertex that is not there";
                return Err(Error::new(format!("element {i}: {what}")));
            }
            // NaN fails the comparison, too.
            let fits = |light: &scene::Rgb| light.0.iter().all(|c| c.abs() <= f64::from(f32::MAX));
            if !fits(&element.exitance) || !element.corner_exitance.iter().all(fits) {
                let what = "exitance is not finite, or too large for single precision";
                return Err(Error::new(format!("element {i}: {what}")));
            }
        }
        self.cameras().try_for_each(check_camera)
    }

    /// All cameras, the one to start with first.
    pub(crate) fn cameras(&self) -> impl Iterator<Item = &Camera> {
        let first = self.view;
        let others = self.scene.cameras().iter().filter(move |camera| Some(*camera) != first);
        first.into_iter().chain(others)
    }

    /// The middle of the solution, and a power of two at least as large as its radius.
    pub(crate) fn extent(&self) -> (DVec3, f64) {
        let solution = self.solution;
        let mut points = solution.elements.iter().flat_map(|e| solution.corners(e));
        let Some(first) = points.next() else { return (DVec3::ZERO, 1.0) };
        let (low, high) = points.fold((first, first), |(l, h), p| (l.min(p), h.max(p)));
        let radius = 0.5 * (high - low).length();
        // Dividing by a power of two rounds nothing.
        let scale = if radius > 0.0 { radius.log2().ceil().exp2() } else { 1.0 };
        (0.5 * low + 0.5 * high, scale)
    }
}

fn check_camera(camera: &Camera) -> Result<(), Error> {
    let numbers = [camera.position, camera.target, camera.up];
    let good = numbers.iter().all(|v| v.is_finite())
        && camera.position != camera.target
        && camera.up != DVec3::ZERO
        && camera.vertical_fov > 0.0
        && camera.vertical_fov < PI;
    match good {
        true => Ok(()),
        false => Err(Error::new(format!(
            "camera {:?}: expected finite coordinates, a target apart from the eye, an up axis and a \
             field of view between 0 and 180 degrees",
            camera.name
        ))),
    }
}
