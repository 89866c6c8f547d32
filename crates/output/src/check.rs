//! Whether a solution can be written: it belongs to its scene, and every number is one.

use scene::{Scene, Solution};

use crate::{Error, ErrorKind};

/// The numbers that a format stores.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Width {
    /// Any finite f64.
    Double,
    /// Exitance within the range of f32.
    Single,
}

/// Checks ids, coordinates and exitance.
pub(crate) fn check(scene: &Scene, solution: &Solution, width: Width) -> Result<(), Error> {
    if let Some(vertex) = solution.vertices.iter().position(|p| !p.is_finite()) {
        return Err(Error::new(ErrorKind::Vertex { vertex }));
    }
    let largest = match width {
        Width::Double => f64::MAX,
        Width::Single => f64::from(f32::MAX),
    };
    for (element, e) in solution.elements.iter().enumerate() {
        if e.triangle.index() >= scene.triangles().len() {
            return Err(Error::new(ErrorKind::Element { element, what: "triangle" }));
        }
        if e.vertices.iter().any(|v| v.index() >= solution.vertices.len()) {
            return Err(Error::new(ErrorKind::Element { element, what: "vertex" }));
        }
        // NaN fails the comparison too.
        let fits = |light: &scene::Rgb| light.0.iter().all(|c| c.abs() <= largest);
        if !fits(&e.exitance) || !e.corner_exitance.iter().all(fits) {
            return Err(Error::new(ErrorKind::Exitance { element }));
        }
    }
    Ok(())
}
