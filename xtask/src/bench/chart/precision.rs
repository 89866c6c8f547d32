//! Work-precision diagrams: error against time, a curve for each way to solve.

use super::{Chart, look, note, runs};
use crate::bench::cell::{Cell, Method};
use crate::bench::group::Group;
use crate::bench::host::Host;
use crate::figure::{Axis, Curve, Entry, Figure, Labels, Look, Marker, Point, Stroke, color};
use crate::precision::numbers::{grouped, percent};

/// Error of one scene's solutions against their time; nothing where fewer than two have an error.
///
/// # Errors
/// What the drawing says.
pub(in crate::bench) fn error_against_time(
    groups: &[&Group],
    host: &Host,
) -> Result<Option<Chart>, String> {
    let known: Vec<_> = groups.iter().filter(|g| g.first().measured.is_some()).copied().collect();
    let [first, _, ..] = known[..] else { return Ok(None) };
    let figure = figure(&known, host);
    let file = format!("precision-{}.svg", first.cell.scene.name());
    Ok(Some(Chart { file, title: figure.title.clone(), svg: figure.svg()? }))
}

/// Cells with the same name are points of one curve, at other goals.
fn name(cell: &Cell) -> String {
    let elements = cell.elements.map(|n| format!(", {} elements", grouped(n as u64)));
    let method = cell.method.name();
    // The plain method's schedule goes without saying.
    let flags = Cell { method: Method::Mesh, ..cell.clone() }.choices();
    format!("{method}{}{flags}", elements.unwrap_or_default())
}

fn figure(groups: &[&Group], host: &Host) -> Figure {
    let stated = Look::new(color::BLACK, Stroke::None, Marker::Ring);
    let scene = groups[0].cell.scene.title();
    let threads = groups[0].cell.threads;
    let reference = groups[0].first().reference.map(percent);
    let reference = reference.map(|e| format!(", standard error {e}")).unwrap_or_default();
    let mut figure = Figure {
        title: format!("{scene}: error against time"),
        notes: vec![
            format!(
                "against a path-traced reference{reference}; worst channel; --threads {threads}"
            ),
            note(host),
            runs(groups),
        ],
        x: Axis::new("wall time of occluder and solve, seconds", Labels::Plain),
        y: Axis::new("error E1", Labels::Percent),
        levels: Vec::new(),
        curves: Vec::new(),
        legend: vec![Entry::of(stated, "E1 as stated"), Entry::heading("Methods")],
    };
    let mut names: Vec<String> = Vec::new();
    for name in groups.iter().map(|group| name(group.cell)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    for (number, title) in names.iter().enumerate() {
        let look = look(number);
        let of: Vec<_> = groups.iter().filter(|group| name(group.cell) == *title).collect();
        let point = |group: &&&Group| {
            let time = group.time();
            let whisker = (time.least < time.most).then_some((time.least, time.most));
            let y = group.first().measured?.e1;
            Some(Point { whisker, ..Point::at(time.median, y) })
        };
        let states = |group: &&&Group| {
            Some(Point::at(group.time().median, group.first().stated.as_ref()?.e1?))
        };
        let points: Vec<_> = of.iter().filter_map(states).collect();
        if !points.is_empty() {
            figure.curves.push(Curve { look: Look { color: look.color, ..stated }, points });
        }
        figure.curves.push(Curve { look, points: of.iter().filter_map(point).collect() });
        figure.legend.push(Entry::of(look, title.as_str()));
    }
    figure
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::group::groups;
    use crate::bench::sample;

    #[test]
    fn goals_of_one_method_are_one_curve() {
        let records = sample::records();
        let groups = groups(&records);
        let two: Vec<_> = groups.iter().filter(|group| group.cell.threads == 2).collect();
        let figure = figure(&two, &sample::host());
        let legend: Vec<_> = figure.legend.iter().map(|entry| entry.text.as_str()).collect();
        let expected = [
            "E1 as stated",
            "Methods",
            "mesh, 8,000 elements",
            "refine",
            "mesh, 1,000 elements",
            "mesh, 10,000 elements",
            "mesh, 100,000 elements",
        ];
        assert_eq!(legend, expected);
        // The refinement: 8 and 2 % stated, half of that true.
        let rings = figure.curves.iter().find(|c| c.look.marker == Marker::Ring).unwrap();
        assert_eq!(rings.points, [Point::at(0.5, 0.08), Point::at(2.0, 0.02)]);
        let refined = &figure.curves[2];
        assert_eq!(refined.points, [Point::at(0.5, 0.04), Point::at(2.0, 0.01)]);
        assert!(figure.notes[0].contains("standard error 0.010 %"), "{}", figure.notes[0]);
    }

    #[test]
    fn without_errors_there_is_no_diagram() {
        let records = sample::runs(&sample::cell(), &[1.0]);
        let groups = groups(&records);
        let one: Vec<_> = groups.iter().collect();
        assert!(error_against_time(&one, &sample::host()).unwrap().is_none());
    }
}
