//! Time and memory against elements, with the exponents of their power laws.

use super::{Chart, look, note, runs};
use crate::bench::fit;
use crate::bench::group::Group;
use crate::bench::host::Host;
use crate::bench::section::LARGE;
use crate::figure::{Axis, Curve, Entry, Figure, Labels, Look, Marker, Point, Stroke, color};
use crate::precision::numbers::{digits, goal, grouped};

/// Time against elements; each slice holds the sizes of one scene, ascending.
///
/// # Errors
/// What the drawing says.
pub(in crate::bench) fn time(scenes: &[Vec<&Group>], host: &Host) -> Result<Chart, String> {
    let y = Axis::new("wall time of occluder and solve, seconds", Labels::Plain);
    chart("growth-time", "time against elements", y, scenes, host, |group| {
        let time = group.time();
        let rise = (time.least < time.most).then_some((time.least, time.most));
        Some((time.median, rise))
    })
}

/// Most memory against elements.
///
/// # Errors
/// What the drawing says.
pub(in crate::bench) fn memory(scenes: &[Vec<&Group>], host: &Host) -> Result<Chart, String> {
    let y = Axis::new("most memory, megabytes", Labels::Plain);
    chart("growth-memory", "memory against elements", y, scenes, host, |group| {
        Some((group.peak()? / 1e6, None))
    })
}

type Reading = Option<(f64, Option<(f64, f64)>)>;

fn chart(
    name: &str,
    title: &str,
    y: Axis,
    scenes: &[Vec<&Group>],
    host: &Host,
    reading: impl Fn(&Group) -> Reading,
) -> Result<Chart, String> {
    let figure = figure(title, y, scenes, host, reading);
    Ok(Chart { file: format!("{name}.svg"), title: figure.title.clone(), svg: figure.svg()? })
}

fn figure(
    title: &str,
    y: Axis,
    scenes: &[Vec<&Group>],
    host: &Host,
    reading: impl Fn(&Group) -> Reading,
) -> Figure {
    let all: Vec<&Group> = scenes.iter().flatten().copied().collect();
    let fitted = Look::new(color::BLACK, Stroke::Dotted, Marker::None).thin();
    let (threads, share) = all.first().map_or((0, 0.0), |g| (g.cell.threads, g.cell.goal));
    let mut figure = Figure {
        title: format!("Growth: {title}"),
        notes: vec![
            format!("one mesh, shot to {} unshot; --threads {threads}", goal(share)),
            note(host),
            runs(&all),
        ],
        x: Axis::new("elements", Labels::Plain),
        y,
        levels: Vec::new(),
        curves: Vec::new(),
        legend: vec![Entry::heading("Scenes")],
    };
    for (number, groups) in scenes.iter().enumerate() {
        let look = look(number);
        let mut points = Vec::new();
        for group in groups {
            let Some((y, rise)) = reading(group) else { continue };
            points.push(Point { rise, ..Point::at(group.first().work.elements as f64, y) });
        }
        let large = points.iter().filter(|point| point.x >= LARGE);
        let pairs: Vec<_> = large.map(|point| (point.x, point.y)).collect();
        let scene = groups.first().map_or("", |group| group.cell.scene.title());
        let mut name = scene.to_owned();
        if let (Some((k, c)), Some(first), Some(last)) =
            (fit::power(&pairs), pairs.first(), pairs.last())
        {
            let law = [first.0, last.0].map(|x| Point::at(x, c * x.powf(k))).to_vec();
            figure.curves.push(Curve { look: Look { color: look.color, ..fitted }, points: law });
            name += &format!(": elements^{}", digits(k, 3));
        }
        figure.legend.push(Entry::of(look, name));
        figure.curves.push(Curve { look, points });
    }
    if figure.curves.len() > scenes.len() {
        let text = format!("power law from {} on", grouped(LARGE as u64));
        figure.legend.insert(0, Entry::of(fitted, text));
    }
    figure
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::group::groups;
    use crate::bench::sample;

    /// The sample's time is a ten-thousandth of a second an element.
    #[test]
    fn exponents_are_in_the_legend() {
        let records = sample::records();
        let groups = groups(&records);
        let grown: Vec<_> = groups.iter().filter(|g| g.cell.goal == 1e-2).collect();
        let reading = |group: &Group| Some((group.time().median, None));
        let y = Axis::new("seconds", Labels::Plain);
        let figure = figure("time", y, &[grown], &sample::host(), reading);
        assert_eq!(figure.legend[2].text, "Room: elements^1.00");
        assert_eq!(figure.notes[0], "one mesh, shot to 1 % unshot; --threads 2");
        let law = &figure.curves[0].points;
        assert!((law[1].x - 1e5).abs() < 1e-6 && (law[1].y - 10.0).abs() < 1e-9, "{law:?}");
        assert_eq!(figure.curves[1].points.len(), 3);
    }
}
