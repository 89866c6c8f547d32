//! What the time of a solve goes to, as bars.

use super::{Chart, note, work};
use crate::bench::group::Group;
use crate::bench::host::Host;
use crate::figure::{Bar, Bars, Part};
use crate::precision::numbers::seconds;

/// The stages that count as time, in the order of the work, each with its colour: neighbours differ
/// in lightness, too.
pub(in crate::bench) const STAGES: [(&str, [u8; 3]); 10] = [
    ("occluder", [120, 120, 120]),
    ("mesh", [230, 159, 0]),
    ("census", [0, 73, 73]),
    ("select", [240, 228, 66]),
    ("prepare", [148, 82, 0]),
    ("transfer", [86, 180, 233]),
    ("commit", [0, 62, 118]),
    ("correct", [255, 182, 219]),
    ("statement", [0, 128, 92]),
    ("other", [205, 205, 205]),
];

/// A bar for each cell.
///
/// # Errors
/// What the drawing says.
pub(in crate::bench) fn stages(groups: &[&Group], host: &Host) -> Result<Chart, String> {
    let bar = |group: &&Group| {
        let cell = group.cell;
        let name = format!("{}, {}", cell.scene.title(), cell.method.name());
        let threads = if cell.threads == 1 { "thread" } else { "threads" };
        let total = seconds(group.time().median);
        Bar {
            labels: vec![name, work(cell), format!("{} {threads}, {total}", cell.threads)],
            sizes: STAGES.iter().map(|(stage, _)| group.stage(stage)).collect(),
        }
    };
    let part = |(name, color): &(&str, [u8; 3])| Part { name: (*name).to_owned(), color: *color };
    let bars = Bars {
        title: "Time by stage".into(),
        notes: vec!["medians of each stage, as shares of their sum".into(), note(host)],
        x: "share of the wall time of occluder and solve".into(),
        parts: STAGES.iter().map(part).collect(),
        bars: groups.iter().map(bar).collect(),
    };
    Ok(Chart { file: "stages.svg".into(), title: bars.title.clone(), svg: bars.svg()? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::group::groups;
    use crate::bench::sample;

    #[test]
    fn bars_are_labelled() {
        let records = sample::runs(&sample::cell(), &[1.0, 2.0, 4.0]);
        let groups = groups(&records);
        let chart = stages(&[&groups[0]], &sample::host()).unwrap();
        for words in ["Room, mesh", "2 threads, 2.00 s", "transfer", "50 %", "25 %"] {
            assert!(chart.svg.contains(words), "{words}: {}", chart.svg);
        }
    }
}
