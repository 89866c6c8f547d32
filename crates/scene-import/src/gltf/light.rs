//! The light in a file that this project has lit.

use gltf::mesh::Semantic;
use scene::{Face, Rgb, Scene, Solution, SolutionElement, TriangleId};
use serde_json::Value;

use super::accessor;
use super::budget::Budget;
use super::document::Parsed;
use super::primitive::Added;
use crate::{Error, ErrorKind};

/// The attribute that carries exitance, without the underscore that marks it as nobody's own.
const ATTRIBUTE: &str = "RADIOSITY";

/// The elements of a lit file, while it is read.
#[derive(Default)]
pub(super) struct Light {
    elements: Vec<(TriangleId, Face, [Rgb; 3])>,
    /// Display light per exitance.
    exposure: f64,
}

impl Light {
    /// Reads how the file's colours were made.
    pub(super) fn read_exposure(&mut self, parsed: &Parsed, file: &str) -> Result<(), Error> {
        let extras = parsed.document.as_json().asset.extras.as_ref();
        let extras: Value =
            extras.and_then(|e| serde_json::from_str(e.get()).ok()).unwrap_or_default();
        let scale = extras.pointer("/radiosity/exposureScale").and_then(Value::as_f64);
        let sound = scale.filter(|scale| scale.is_finite() && *scale > 0.0);
        self.exposure = sound.ok_or_else(|| {
            let message = "asset.extras.radiosity.exposureScale: expected a number above 0, as \
                           `radiosity solve` writes it";
            Error::new(ErrorKind::Invalid, file, message)
        })?;
        Ok(())
    }

    /// Adds the light of a primitive's triangles. One without light is no element: nothing of it
    /// was to be seen.
    pub(super) fn add(
        &mut self,
        primitive: &gltf::Primitive<'_>,
        face: Face,
        first: TriangleId,
        added: &Added,
        parsed: &Parsed,
        budget: &mut Budget<'_>,
    ) -> Result<(), Error> {
        let Some(light) = primitive.get(&Semantic::Extras(ATTRIBUTE.to_owned())) else {
            return Ok(());
        };
        let values: Vec<[f64; 3]> = accessor::read(&light, parsed, budget)?;
        for (number, &[a, b, c]) in added.corners.iter().enumerate() {
            let corners = if added.mirrored { [a, c, b] } else { [a, b, c] };
            let mut exitance = [Rgb::ZERO; 3];
            for (slot, corner) in exitance.iter_mut().zip(corners) {
                let value = values.get(corner).filter(|value| value.iter().all(|c| *c >= 0.0));
                let Some(value) = value else {
                    let message = format!(
                        "accessors[{}]: expected an exitance of at least 0 for each vertex",
                        light.index()
                    );
                    return Err(budget.invalid(&message));
                };
                *slot = Rgb(*value);
            }
            self.elements.push((TriangleId::from(first.index() + number), face, exitance));
        }
        Ok(())
    }

    /// The elements as a solution of the scene that was read, and display light per exitance. Their
    /// own exitance is the mean of their corners, as the file has no other.
    pub(super) fn solution(self, scene: &Scene, file: &str) -> Result<(Solution, f64), Error> {
        if self.elements.is_empty() {
            let message = "no mesh has _RADIOSITY: expected a .glb that `radiosity solve` wrote";
            return Err(Error::new(ErrorKind::Invalid, file, message));
        }
        let element =
            |(triangle, face, corner_exitance): (TriangleId, Face, [Rgb; 3])| SolutionElement {
                vertices: scene.triangles()[triangle.index()].vertices,
                triangle,
                face,
                exitance: corner_exitance.into_iter().sum::<Rgb>() / 3.0,
                corner_exitance,
            };
        let elements = self.elements.into_iter().map(element).collect();
        Ok((Solution { vertices: scene.vertices().to_vec(), elements }, self.exposure))
    }
}
