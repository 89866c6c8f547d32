//! The `.tri` text of a painted model.

use std::fmt::Write;

use super::mesh::{Shape, Triangle};

/// Coordinates are written to a hundredth of the scene's unit.
const PER_UNIT: f64 = 100.0;

/// The two colours of a `.tri` record. Half of `front` / 255 is the reflectance; a triangle emits
/// when a component of `back` is exactly 255.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Paint {
    pub(crate) front: [u8; 3],
    pub(crate) back: [u8; 3],
}

/// A surface that only reflects.
pub(crate) const fn matte(r: u8, g: u8, b: u8) -> Paint {
    Paint { front: [r, g, b], back: [0; 3] }
}

/// A surface that emits; one component must be 255.
pub(crate) const fn lamp(r: u8, g: u8, b: u8) -> Paint {
    assert!(r == 255 || g == 255 || b == 255, "only a component of 255 marks an emitter");
    Paint { front: [220; 3], back: [r, g, b] }
}

/// A scene as painted triangles.
#[derive(Default)]
pub(crate) struct Model {
    pub(crate) triangles: Vec<(Triangle, Paint)>,
}

impl Model {
    pub(crate) fn add(&mut self, paint: Paint, shape: Shape) {
        let snapped = shape.snapped(PER_UNIT).0;
        self.triangles.extend(snapped.into_iter().map(|triangle| (triangle, paint)));
    }

    /// The model as a `.tri` file: a record per triangle, without normals.
    pub(crate) fn to_tri(&self) -> String {
        let mut text = String::new();
        for (triangle, Paint { front, back }) in &self.triangles {
            let ([r, g, b], [s, t, u]) = (front, back);
            let written = writeln!(text, "Triangle\n{r} {g} {b} {s} {t} {u}").and_then(|()| {
                triangle.iter().try_for_each(|[x, y, z]| writeln!(text, "{x} {y} {z}"))
            });
            written.expect("writing to a String cannot fail");
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_record_is_short_and_snapped() {
        let mut model = Model::default();
        let third = 1.0 / 3.0;
        model.add(lamp(255, 9, 0), Shape(vec![[[third, -1e-9, 2.0], [1.5, 0.0, 0.0], [0.0; 3]]]));
        let expected = "Triangle\n220 220 220 255 9 0\n0.33 0 2\n1.5 0 0\n0 0 0\n";
        assert_eq!(model.to_tri(), expected);
    }
}
