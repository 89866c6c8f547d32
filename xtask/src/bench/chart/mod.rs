//! Records as charts: each file draws one kind.

mod growth;
mod precision;
mod speed_up;
mod stages;

use super::cell::Cell;
use super::group::Group;
use super::host::Host;
use crate::figure::{Color, Look, Marker, Stroke, color};
use crate::precision::numbers::{goal, grouped};

pub(super) use growth::{memory, time};
pub(super) use precision::error_against_time;
pub(super) use speed_up::{efficiency, speed_up};
pub(super) use stages::{STAGES, stages};

/// A drawn chart.
pub(super) struct Chart {
    /// Its file, without folder.
    pub(super) file: String,
    /// What it shows, for those who do not see it.
    pub(super) title: String,
    pub(super) svg: String,
}

const COLORS: [Color; 6] =
    [color::BLUE, color::VERMILION, color::GREEN, color::PURPLE, color::BLACK, color::ORANGE];
const MARKERS: [Marker; 4] = [Marker::Dot, Marker::Square, Marker::Triangle, Marker::Cross];
const STROKES: [Stroke; 2] = [Stroke::Solid, Stroke::Dashed];

/// Twenty-four curves differ in colour or marker, forty-eight with their strokes; neighbours in both,
/// so that they can be told apart without colours.
fn look(number: usize) -> Look {
    let (colors, markers) = (COLORS.len(), MARKERS.len());
    let marker = MARKERS[(number + number / colors) % markers];
    let stroke = STROKES[number / (colors * markers) % STROKES.len()];
    Look::new(COLORS[number % colors], stroke, marker)
}

/// What is solved, for a title: `8,000 elements to 0.1 % unshot`.
fn work(cell: &Cell) -> String {
    match cell.elements {
        Some(elements) => {
            format!("{} elements to {} unshot", grouped(elements as u64), goal(cell.goal))
        }
        None => format!("to a stated {}", goal(cell.goal)),
    }
}

/// The same for the name of a file: `room-mesh-8000-0.001`.
fn stem(cell: &Cell) -> String {
    let elements = cell.elements.map(|elements| format!("-{elements}")).unwrap_or_default();
    format!("{}-{}{elements}-{}", cell.scene.name(), cell.method.name(), cell.goal)
}

/// What else tells series apart: their flags.
fn flags(cell: &Cell) -> String {
    let flags = cell.choices();
    if flags.is_empty() { "no flags".into() } else { flags.trim().to_owned() }
}

/// The machine and the program, the note of every chart.
fn note(host: &Host) -> String {
    format!("{}, {} cores; revision {}", host.cpu, host.cores, host.revision)
}

/// How often each point was run.
fn runs(groups: &[&Group]) -> String {
    let least = groups.iter().map(|group| group.runs()).min().unwrap_or(0);
    let most = groups.iter().map(|group| group.runs()).max().unwrap_or(0);
    let runs = if least == most { least.to_string() } else { format!("{least} to {most}") };
    format!("median of {runs} runs; bars reach from the least to the most")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    #[test]
    fn curves_look_different() {
        let looks: Vec<_> = (0..48).map(look).collect();
        for (i, look) in looks.iter().enumerate() {
            assert!(!looks[..i].contains(look), "{i}");
        }
        // In print, without colours, the first four differ by their markers.
        for (i, look) in looks[..4].iter().enumerate() {
            assert!(looks[..i].iter().all(|other| other.marker != look.marker), "{i}");
        }
    }

    #[test]
    fn files_are_named_after_what_is_solved() {
        assert_eq!(stem(&sample::cell()), "room-mesh-8000-0.001");
        assert_eq!(work(&sample::cell()), "8,000 elements to 0.1 % unshot");
        assert_eq!(flags(&sample::cell()), "no flags");
    }
}
