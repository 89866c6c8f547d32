//! A measurement as a diagram: speed-up against threads.

use super::amdahl;
use super::measurement::{Series, Solved, Timed};
use crate::figure::{
    Axis, Color, Curve, Entry, Figure, Labels, Look, Marker, Point, Stroke, color,
};
use crate::precision::Machine;
use crate::precision::numbers::grouped;
use crate::precision::statistics::Spread;

/// One curve per mode, with the ideal.
pub(super) fn of(solved: &Solved, machine: &Machine) -> Figure {
    let ideal = Look::new(color::GREY, Stroke::Dashed, Marker::None);
    let fit = Look::new(color::BLACK, Stroke::Dotted, Marker::None).thin();
    let crowded = Look::new(color::BLACK, Stroke::None, Marker::Ring);
    let threads = solved.series.iter().flat_map(|s| s.points.iter().map(|p| p.threads));
    let most = threads.max().unwrap_or(1);
    let ideal_points = [1, most].map(|threads| Point::at(threads as f64, threads as f64));
    let mut figure = Figure {
        title: format!("{}: speed-up against threads", solved.scene.title()),
        notes: vec![
            format!("{}, {} cores", machine.cpu, machine.cores),
            format!("{} elements", grouped(solved.elements)),
        ],
        x: Axis::new("threads", Labels::Plain),
        y: Axis::new("time of one thread over time", Labels::Plain),
        levels: Vec::new(),
        curves: vec![Curve { look: ideal, points: ideal_points.to_vec() }],
        legend: vec![Entry::of(ideal, "ideal"), Entry::of(fit, "Amdahl's law, fitted")],
    };
    if most > machine.cores {
        figure.legend.push(Entry::of(crowded, "more threads than cores"));
    }
    figure.legend.push(Entry::heading("Modes"));
    for (number, series) in solved.series.iter().enumerate() {
        let look = look(number);
        figure.legend.push(Entry::of(look, series.mode.name()));
        let cores = machine.cores;
        if let Some(share) = series.serial_share(cores) {
            let at =
                |p: &Timed| Point::at(p.threads as f64, amdahl::speed_up(share.fitted, p.threads));
            let points = series.within(cores).map(at).collect();
            figure.curves.push(Curve { look: Look { color: look.color, ..fit }, points });
        }
        let (within, beyond): (Vec<_>, Vec<_>) =
            series.points.iter().partition(|p| p.threads <= cores);
        figure.curves.push(curve(look, series, &within));
        figure.curves.push(curve(Look { color: look.color, ..crowded }, series, &beyond));
    }
    figure
}

fn curve(look: Look, series: &Series, points: &[&Timed]) -> Curve {
    let at = |point: &&Timed| {
        let Spread { median, least, most } = series.speed_up(point);
        let rise = (least < most).then_some((least, most));
        Point { rise, ..Point::at(point.threads as f64, median) }
    };
    Curve { look, points: points.iter().map(at).collect() }
}

const COLORS: [Color; 4] = [color::BLUE, color::VERMILION, color::GREEN, color::PURPLE];
const MARKERS: [Marker; 4] = [Marker::Dot, Marker::Square, Marker::Triangle, Marker::Cross];

/// Sixteen modes look different; after that they start again.
fn look(number: usize) -> Look {
    let marker = MARKERS[number / COLORS.len() % MARKERS.len()];
    Look::new(COLORS[number % COLORS.len()], Stroke::Solid, marker)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    fn figure() -> Figure {
        let sample = sample::measurement();
        of(&sample.scenes[0], &sample.machine)
    }

    #[test]
    fn the_title_names_scene_machine_and_mesh() {
        let figure = figure();
        assert_eq!(figure.title, "Room: speed-up against threads");
        assert_eq!(figure.notes, ["Some CPU @ 2.60GHz, 2 cores", "7,999 elements"]);
        let svg = figure.svg().unwrap();
        assert!(svg.contains("--loop static") && svg.contains("no flags"), "{svg}");
    }

    #[test]
    fn the_ideal_is_dashed_and_as_long_as_the_curves() {
        let ideal = &figure().curves[0];
        assert_eq!(ideal.look.stroke, Stroke::Dashed);
        assert_eq!(ideal.points, [Point::at(1.0, 1.0), Point::at(4.0, 4.0)]);
    }

    /// Speed-ups of the sample: 1.6, 1.6 and 2 by two threads; the fit has a quarter serial.
    #[test]
    fn threads_without_a_core_stand_apart() {
        let curves = figure().curves;
        let fit = [Point::at(1.0, 1.0), Point::at(2.0, 1.6)];
        assert_eq!(curves[1].points, fit);
        let within = [Point::at(1.0, 1.0), Point { rise: Some((1.6, 2.0)), ..fit[1] }];
        assert_eq!(curves[2].points, within);
        assert_eq!(curves[3].points, [Point::at(4.0, 1.6)]);
        assert_eq!((curves[3].look.stroke, curves[3].look.marker), (Stroke::None, Marker::Ring));
    }

    #[test]
    fn each_mode_has_its_own_look() {
        let looks: Vec<_> = (0..16).map(look).collect();
        for (i, look) in looks.iter().enumerate() {
            assert!(!looks[..i].contains(look), "{i}");
        }
    }
}
