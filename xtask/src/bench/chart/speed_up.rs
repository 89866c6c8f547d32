//! Speed-up and efficiency against threads, a curve for each way to share loops.

use super::{Chart, flags, look, note, runs, stem, work};
use crate::bench::amdahl;
use crate::bench::group::{Group, Scaling};
use crate::bench::host::Host;
use crate::figure::{Axis, Curve, Entry, Figure, Labels, Look, Marker, Point, Stroke, color};
use crate::precision::statistics::Spread;

/// Speed-up of cells that solve the same.
///
/// # Errors
/// What the drawing says.
pub(in crate::bench) fn speed_up(scalings: &[&Scaling], host: &Host) -> Result<Chart, String> {
    let figure = figure(scalings, host, Kind::SpeedUp);
    chart("speed-up", scalings, &figure)
}

/// The same over the number of threads.
///
/// # Errors
/// What the drawing says.
pub(in crate::bench) fn efficiency(scalings: &[&Scaling], host: &Host) -> Result<Chart, String> {
    let figure = figure(scalings, host, Kind::Efficiency);
    chart("efficiency", scalings, &figure)
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    SpeedUp,
    Efficiency,
}

impl Kind {
    /// What is drawn for a speed-up.
    fn of(self, speed_up: f64, threads: usize) -> f64 {
        match self {
            Self::SpeedUp => speed_up,
            Self::Efficiency => speed_up / threads as f64,
        }
    }
}

fn chart(kind: &str, scalings: &[&Scaling], figure: &Figure) -> Result<Chart, String> {
    let file = format!("{kind}-{}.svg", stem(scalings[0].one().cell));
    Ok(Chart { file, title: figure.title.clone(), svg: figure.svg()? })
}

fn figure(scalings: &[&Scaling], host: &Host, kind: Kind) -> Figure {
    let cell = scalings[0].one().cell;
    let groups: Vec<&Group> = scalings.iter().flat_map(|s| s.points.iter().copied()).collect();
    let ideal = Look::new(color::GREY, Stroke::Dashed, Marker::None);
    let fit = Look::new(color::BLACK, Stroke::Dotted, Marker::None).thin();
    let crowded = Look::new(color::BLACK, Stroke::None, Marker::Ring);
    let most = groups.iter().map(|group| group.cell.threads).max().unwrap_or(1);
    let at = |speed_up: f64, threads: usize| Point::at(threads as f64, kind.of(speed_up, threads));
    let (name, y) = match kind {
        Kind::SpeedUp => ("speed-up", Axis::new("time of one thread over time", Labels::Plain)),
        Kind::Efficiency => {
            let y = Axis::new("speed-up over threads", Labels::Percent);
            ("efficiency", y)
        }
    };
    let mut figure = Figure {
        title: format!("{}: {name} against threads", cell.scene.title()),
        notes: vec![format!("{}, {}", cell.method.name(), work(cell)), note(host), runs(&groups)],
        x: Axis::new("threads", Labels::Plain),
        y,
        levels: Vec::new(),
        curves: vec![Curve {
            look: ideal,
            points: [1, most].map(|threads| at(threads as f64, threads)).to_vec(),
        }],
        legend: vec![Entry::of(ideal, "ideal"), Entry::of(fit, "Amdahl's law, fitted")],
    };
    if most > host.cores {
        figure.legend.push(Entry::of(crowded, "more threads than cores"));
    }
    figure.legend.push(Entry::heading("Flags"));
    for (number, scaling) in scalings.iter().enumerate() {
        let look = look(number);
        figure.legend.push(Entry::of(look, flags(scaling.one().cell)));
        let (within, beyond): (Vec<&Group>, Vec<_>) =
            scaling.points.iter().partition(|point| point.cell.threads <= host.cores);
        if let Some(serial) = scaling.serial_share(host.cores) {
            let law = |point: &&Group| {
                let threads = point.cell.threads;
                at(amdahl::speed_up(serial, threads), threads)
            };
            let points = within.iter().map(law).collect();
            figure.curves.push(Curve { look: Look { color: look.color, ..fit }, points });
        }
        figure.curves.push(curve(look, scaling, &within, kind));
        figure.curves.push(curve(Look { color: look.color, ..crowded }, scaling, &beyond, kind));
    }
    figure
}

fn curve(look: Look, scaling: &Scaling, points: &[&Group], kind: Kind) -> Curve {
    let at = |point: &&Group| {
        let Spread { median, least, most } = scaling.speed_up(point)?;
        let threads = point.cell.threads;
        let of = |speed_up| kind.of(speed_up, threads);
        let rise = (least < most).then_some((of(least), of(most)));
        Some(Point { rise, ..Point::at(threads as f64, of(median)) })
    };
    Curve { look, points: points.iter().filter_map(at).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::group::{groups, scalings};
    use crate::bench::sample;

    fn drawn(kind: Kind) -> Figure {
        let records = sample::records();
        let groups = groups(&records);
        let scalings = scalings(&groups);
        figure(&scalings.iter().collect::<Vec<_>>(), &sample::host(), kind)
    }

    #[test]
    fn the_title_names_scene_machine_and_mesh() {
        let figure = drawn(Kind::SpeedUp);
        assert_eq!(figure.title, "Room: speed-up against threads");
        assert_eq!(figure.notes[0], "mesh, 8,000 elements to 0.1 % unshot");
        assert_eq!(figure.notes[1], "Some CPU @ 2.60GHz, 2 cores; revision 0123abc");
    }

    /// Speed-ups of the sample: 1.6, 1.6 and 2 by two threads; the fit has a quarter serial.
    #[test]
    fn threads_without_a_core_stand_apart() {
        let curves = drawn(Kind::SpeedUp).curves;
        assert_eq!(curves[0].points, [Point::at(1.0, 1.0), Point::at(4.0, 4.0)]);
        let fit = [Point::at(1.0, 1.0), Point::at(2.0, 1.6)];
        assert_eq!(curves[1].points, fit);
        let within = [Point::at(1.0, 1.0), Point { rise: Some((1.6, 2.0)), ..fit[1] }];
        assert_eq!(curves[2].points, within);
        assert_eq!(curves[3].points, [Point::at(4.0, 1.6)]);
        assert_eq!((curves[3].look.stroke, curves[3].look.marker), (Stroke::None, Marker::Ring));
    }

    #[test]
    fn efficiency_is_a_share_of_the_threads() {
        let curves = drawn(Kind::Efficiency).curves;
        assert_eq!(curves[0].points, [Point::at(1.0, 1.0), Point::at(4.0, 1.0)]);
        assert_eq!(curves[2].points[1], Point { rise: Some((0.8, 1.0)), ..Point::at(2.0, 0.8) });
        assert_eq!(curves[3].points, [Point::at(4.0, 0.4)]);
    }
}
