//! Two solutions beside each other as pictures, and how far they are apart in false colour.
//!
//! Three panels through one camera: the solution to judge, the reference in the same exposure, and
//! their difference per input triangle, as a share of the reference's area mean: the unit of
//! [`Comparison::einf`](crate::Comparison::einf).

mod colours;
mod lettering;
mod sheet;

use std::io::Write;

use scene::{Face, Rgb, Scene, Solution, TriangleId};

use crate::compare::{AREA_TOLERANCE, pair};
use crate::csv::Row;
use crate::picture::{Picture, camera_of, encode_png, render};
use crate::{Error, ErrorKind, Options, unlit};
use sheet::{Legend, Sheet};

/// Draws two solutions and their difference, and writes a PNG; `options` give the camera, the size of
/// one panel and the exposure.
///
/// The difference is (A − B) / mean B: of the sums of the channels, over the triangles that do not emit
/// in the scene, and that neither side marks as emitting or ambiguous; those are grey. Colours end at ± `range`, by default the
/// largest difference, rounded up to 1, 2 or 5 times a power of ten. The range is returned.
///
/// # Errors
/// As [`compare`](crate::compare()); rows that are not those of the scene's triangles; a camera that
/// looks nowhere, an option outside its range, or what the sink answers.
pub fn write(
    out: &mut dyn Write,
    scene: &Scene,
    ours: &[Row],
    reference: &[Row],
    options: &Options,
    range: Option<f64>,
) -> Result<f64, Error> {
    options.check()?;
    let differences = differences(scene, ours, reference)?;
    let range = match range {
        Some(range) if range.is_finite() && range > 0.0 => range,
        Some(_) => return Err(Error::new(ErrorKind::Option("a range above 0"))),
        None => rounded_up(differences.iter().flatten().fold(0.0, |m, d| m.max(d.abs()))),
    };
    let camera = camera_of(scene, options);
    let draw = |light: &dyn Fn(usize) -> Rgb| -> Result<Picture, Error> {
        render(scene, &flat(scene, light), &camera, options.size, options.samples)
    };
    let [a, b] = [ours, reference].map(|rows| draw(&|i| rows[i].exitance));
    let (a, b) = (a?, b?);
    // What it is, and that it is known: averages over a pixel keep the two apart.
    let apart = draw(&|i| differences[i].map_or(Rgb::ZERO, |d| Rgb::new(d, 1.0, 0.0)))?;
    let scale = b.scale(options.exposure);
    let panels = [
        ("A", a.to_srgb(scale)),
        ("B", b.to_srgb(scale)),
        ("(A-B)/mean B", colours::shown(&apart, range)),
    ];
    let sheet = Sheet::of(options.size, &panels, &Legend { range });
    encode_png(out, sheet.size, &sheet.bytes)?;
    Ok(range)
}

/// (A − B) / mean B of each triangle; `None` where that says nothing.
fn differences(scene: &Scene, ours: &[Row], reference: &[Row]) -> Result<Vec<Option<f64>>, Error> {
    let mut used = pair(ours, reference)?;
    let triangles = scene.triangles().len();
    let own = |(i, row): (usize, &Row)| row.triangle as usize == i && row.uv.is_none();
    if ours.len() != triangles || !reference.iter().enumerate().all(own) {
        return Err(Error::new(ErrorKind::SceneRows { rows: ours.len(), triangles }));
    }
    for (row, (of_row, id)) in reference.iter().zip(scene.ids()).enumerate() {
        let (reference, scene) = (of_row.area, scene.area(id));
        if (reference - scene).abs() > AREA_TOLERANCE * reference.max(scene) {
            return Err(Error::new(ErrorKind::SceneArea { row, reference, scene }));
        }
    }
    // A lamp's own light would take up all of the range; solutions need not mark it.
    used.retain(|(_, row)| !scene.material_of(TriangleId(row.triangle)).emits());
    let (mut light, mut area) = (0.0, 0.0);
    for (_, row) in &used {
        light += row.exitance.sum() * row.area;
        area += row.area;
    }
    let mean = light / area;
    let mut differences = vec![None; triangles];
    for (a, b) in used.into_iter().filter(|_| mean > 0.0) {
        let apart = (a.exitance - b.exitance).sum();
        differences[b.triangle as usize] = Some(apart / mean);
    }
    Ok(differences)
}

/// The scene's fronts, each triangle in one exitance.
fn flat(scene: &Scene, light: impl Fn(usize) -> Rgb) -> Solution {
    let mut solution = unlit(scene);
    solution.elements.retain(|element| element.face == Face::Front);
    for element in &mut solution.elements {
        element.exitance = light(element.triangle.index());
        element.corner_exitance = [element.exitance; 3];
    }
    solution
}

/// The next of 1, 2 and 5 times a power of ten; 1 % for no difference at all.
fn rounded_up(largest: f64) -> f64 {
    const NONE: f64 = 0.01;
    /// A number that is one of them but for its rounding is not rounded up further.
    const SLACK: f64 = 1e-9;
    if largest <= f64::MIN_POSITIVE {
        return NONE;
    }
    let unit = 10f64.powf(largest.log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|step| step * unit);
    steps.into_iter().find(|step| largest <= step * (1.0 + SLACK)).unwrap_or(10.0 * unit)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_are_round() {
        for (largest, expected) in [
            (0.1, 0.1),
            (0.11, 0.2),
            (0.02, 0.02),
            (0.3, 0.5),
            (0.6, 1.0),
            (7.0, 10.0),
            (0.0, 0.01),
        ] {
            assert!((rounded_up(largest) / expected - 1.0).abs() < 1e-12, "{largest}");
        }
    }
}
