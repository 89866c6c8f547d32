//! A measurement as a work-precision diagram.

use super::measurement::{Measurement, Method, Series, Solve};
use super::numbers::{grouped, percent};
use crate::figure::{
    Axis, Curve, Entry, Figure, Labels, Level, Look, Marker, Point, Stroke, color,
};

/// Error against time, one curve per way to solve.
pub(super) fn of(measurement: &Measurement) -> Figure {
    let Measurement { subject, machine, threads, reference_error, series } = measurement;
    let mut figure = Figure {
        title: format!("{}: error against time", subject.title()),
        notes: vec![
            format!("{}, {}", machine.cpu, threads_text(*threads)),
            format!(
                "reference: {}, path-traced, standard error {}",
                subject.reference_name(),
                percent(*reference_error)
            ),
        ],
        x: Axis::new("wall time of occluder and solve, seconds", Labels::Plain),
        y: Axis::new("error of the worst channel", Labels::Percent),
        levels: Vec::new(),
        curves: Vec::new(),
        legend: key(),
    };
    let ranks = mesh_ranks(series);
    for one in series {
        let look = look(one.method, &ranks);
        figure.legend.push(Entry::of(look, name(one.method)));
        add(&mut figure, one, look);
    }
    let reference = Look::new(color::GREY, Stroke::Dashed, Marker::None).thin();
    figure.levels.push(Level { y: *reference_error, look: reference });
    let floor = Look::new(color::BLACK, Stroke::Dotted, Marker::None).thin();
    figure.legend.extend([
        Entry::heading("Levels"),
        Entry::of(floor, "error of the mesh alone"),
        Entry::of(reference, "reference's standard error"),
    ]);
    // What is refined lies over fixed meshes, and open markers over both.
    figure.curves.sort_by_key(|curve| (curve.look.stroke == Stroke::None, curve.look.width));
    figure
}

/// `1 thread`, `2 threads`.
pub(super) fn threads_text(threads: usize) -> String {
    format!("{threads} thread{}", if threads == 1 { "" } else { "s" })
}

/// How a method is called.
pub(super) fn name(method: Method) -> String {
    let elements = |n: usize| format!("{} elements", grouped(n as u64));
    match method {
        Method::Refinement => "refined to --error".into(),
        Method::Mesh { elements: n } => elements(n),
        Method::Octree { elements: n } => format!("octree, {}", elements(n)),
        Method::Bvh { elements: n } => format!("bvh, {}", elements(n)),
    }
}

/// What lines and markers mean, whatever their colour.
fn key() -> Vec<Entry> {
    vec![
        Entry::heading("Measures"),
        Entry::of(Look::new(color::BLACK, Stroke::Solid, Marker::None), "E1 (true)"),
        Entry::of(Look::new(color::BLACK, Stroke::Dashed, Marker::None), "Einf (true)"),
        Entry::of(stated_look(), "E1 as stated"),
        Entry::heading("Methods"),
    ]
}

fn stated_look() -> Look {
    Look::new(color::BLUE, Stroke::None, Marker::Ring)
}

/// The curves and the level of one series.
fn add(figure: &mut Figure, series: &Series, look: Look) {
    let curve = |look: Look, whiskers: bool, error: &dyn Fn(&Solve) -> Option<f64>| {
        let point = |solve: &Solve| {
            let time = solve.time();
            let whisker = (whiskers && time.least < time.most).then_some((time.least, time.most));
            Some(Point { x: time.median, y: error(solve)?, whisker, rise: None })
        };
        Curve { look, points: series.solves.iter().filter_map(point).collect() }
    };
    if series.method == Method::Refinement {
        let stated = |solve: &Solve| solve.stated.as_ref()?.e1;
        figure.curves.push(curve(stated_look(), false, &stated));
    }
    figure.curves.push(curve(look, true, &|solve| Some(solve.measured.e1)));
    if let Method::Refinement | Method::Mesh { .. } = series.method {
        let dashed = Look { stroke: Stroke::Dashed, ..look };
        figure.curves.push(curve(dashed, false, &|solve| Some(solve.measured.einf)));
    }
    if let (Method::Mesh { .. }, Some(last)) = (series.method, series.solves.last()) {
        let floor = Look::new(look.color, Stroke::Dotted, Marker::None).thin();
        figure.levels.push(Level { y: last.measured.e1, look: floor });
    }
}

/// The sizes of the fixed meshes, ascending.
fn mesh_ranks(series: &[Series]) -> Vec<usize> {
    let size = |series: &Series| match series.method {
        Method::Mesh { elements } => Some(elements),
        _ => None,
    };
    let mut sizes: Vec<_> = series.iter().filter_map(size).collect();
    sizes.sort_unstable();
    sizes
}

/// Meshes become darker as they become finer; beyond the last they stay as dark.
const MESHES: [crate::figure::Color; 4] =
    [[246, 178, 90], [226, 120, 30], [168, 70, 10], [96, 34, 4]];

fn look(method: Method, ranks: &[usize]) -> Look {
    match method {
        Method::Refinement => {
            Look { width: 3, ..Look::new(color::BLUE, Stroke::Solid, Marker::Dot) }
        }
        Method::Mesh { elements } => {
            let rank = ranks.iter().position(|size| *size == elements).unwrap_or(0);
            Look::new(MESHES[rank.min(MESHES.len() - 1)], Stroke::Solid, Marker::Dot)
        }
        Method::Octree { .. } => Look::new(color::PURPLE, Stroke::None, Marker::Cross),
        Method::Bvh { .. } => Look::new(color::GREEN, Stroke::None, Marker::Frame),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::sample;

    #[test]
    fn the_title_names_machine_threads_and_reference() {
        let figure = of(&sample::measurement());
        assert_eq!(figure.title, "Room: error against time");
        assert_eq!(figure.notes[0], "Some CPU @ 2.60GHz, 2 threads");
        let reference = "reference: room_onesided.csv, path-traced, standard error 0.012 %";
        assert_eq!(figure.notes[1], reference);
    }

    #[test]
    fn a_point_is_the_median_with_both_ends() {
        let figure = of(&sample::measurement());
        let blue = |c: &&Curve| c.look.color == color::BLUE && c.look.stroke == Stroke::Solid;
        let refined = figure.curves.iter().find(blue).unwrap();
        // Three runs of 0.2, 0.4 and 0.3 s; E1 of 3 %.
        let expected = Point { x: 0.3, y: 0.03, whisker: Some((0.2, 0.4)), rise: None };
        assert_eq!(refined.points[0], expected);
        // One run has no ends.
        assert_eq!(refined.points[1], Point::at(1.5, 0.008));
    }

    #[test]
    fn stated_errors_are_open_markers_where_they_are_known() {
        let figure = of(&sample::measurement());
        let stated = figure.curves.iter().find(|c| c.look == stated_look()).unwrap();
        assert_eq!(stated.points, [Point::at(0.3, 0.06)]);
    }

    #[test]
    fn each_mesh_and_the_reference_have_a_level() {
        let levels: Vec<_> = of(&sample::measurement()).levels.iter().map(|l| l.y).collect();
        assert_eq!(levels, [0.021, 0.000119]);
    }

    #[test]
    fn every_method_is_in_the_legend_with_its_own_look() {
        let figure = of(&sample::measurement());
        for text in ["refined to --error", "1,000 elements", "octree, 1,000 elements"] {
            assert_eq!(figure.legend.iter().filter(|e| e.text == text).count(), 1, "{text}");
        }
        let looks: Vec<_> = figure.legend.iter().filter_map(|e| e.sample).collect();
        for (i, look) in looks.iter().enumerate() {
            assert!(!looks[..i].contains(look), "{look:?} means two things");
        }
    }
}
