//! Stated against true error, over all scenes and goals of `cargo xtask precision`.

use crate::figure::{Axis, Curve, Entry, Figure, Labels, Look, Marker, Point, Stroke, color};
use crate::precision::{Errors, Measurement, Stated};

/// A scene's colour; there are as many as scenes.
const COLORS: [crate::figure::Color; 4] =
    [color::BLUE, color::VERMILION, color::GREEN, color::PURPLE];

/// A measure of the stated error, the same of the true one, and its marker.
type Measure = (fn(&Stated) -> Option<f64>, fn(&Errors) -> f64, Marker);

const MEASURES: [Measure; 2] =
    [(|s| s.e1, |e| e.e1, Marker::Dot), (|s| s.einf, |e| e.einf, Marker::Ring)];

/// Points above the diagonal are bounds that hold.
pub(super) fn figure(measurements: &[Measurement]) -> Figure {
    let diagonal = Look::new(color::GREY, Stroke::Solid, Marker::None).thin();
    let mark = |marker| Look::new(color::BLACK, Stroke::None, marker);
    let mut figure = Figure {
        title: "Stated against true error".into(),
        notes: vec!["every goal of docs/precision.md; above the line the statement holds".into()],
        x: Axis::new("true error of the worst channel", Labels::Percent),
        y: Axis::new("stated error", Labels::Percent),
        levels: Vec::new(),
        curves: Vec::new(),
        legend: vec![
            Entry::heading("Measures"),
            Entry::of(mark(Marker::Dot), "E1"),
            Entry::of(mark(Marker::Ring), "Einf"),
            Entry::of(diagonal, "stated = true"),
            Entry::heading("Scenes"),
        ],
    };
    for (measurement, color) in measurements.iter().zip(COLORS) {
        let look = |marker| Look::new(color, Stroke::None, marker);
        figure.legend.push(Entry::of(look(Marker::Dot), measurement.subject.title()));
        for (stated, truth, marker) in MEASURES {
            let points = measurement.refinement().filter_map(|solve| {
                let stated = solve.stated.as_ref().and_then(stated)?;
                Some(Point::at(truth(&solve.measured), stated))
            });
            figure.curves.push(Curve { look: look(marker), points: points.collect() });
        }
    }
    let on_it = |x: f64| Point::at(x, x);
    let truths = || figure.curves.iter().flat_map(|c| &c.points).flat_map(|p| [p.x, p.y]);
    let ends = [truths().fold(f64::INFINITY, f64::min), truths().fold(0.0, f64::max)];
    figure.curves.insert(0, Curve { look: diagonal, points: ends.map(on_it).to_vec() });
    figure
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::sample;

    #[test]
    fn true_is_across_and_stated_is_up() {
        let figure = figure(&[sample::measurement()]);
        let dots = figure.curves.iter().find(|c| c.look.marker == Marker::Dot).unwrap();
        assert_eq!(dots.points, [Point::at(0.03, 0.06)]);
        let line = figure.curves.iter().find(|c| c.look.stroke == Stroke::Solid).unwrap();
        assert_eq!(line.points, [Point::at(0.03, 0.03), Point::at(0.06, 0.06)]);
    }
}
