//! The tables of docs/performance/scaling.md.

use super::measurement::{Measurement, SerialShare, Series, Solved, Timed};
use super::rounds::CONVERGE;
use crate::precision::blocks::{self, table};
use crate::precision::numbers::{digits, grouped, percent, times};
use crate::precision::statistics::Spread;

/// The block of the page that is written here.
const BLOCK: &str = "figures";

/// The page of a folder that has none.
pub(super) const EMPTY: &str = "\
# Run time against threads

<!-- begin: figures -->
<!-- end: figures -->
";

/// The page with its figures renewed.
pub(super) fn renewed(page: &str, measurement: &Measurement) -> Result<String, String> {
    let Measurement { machine, elements, scenes } = measurement;
    let head = format!(
        "{} cores of {}. Every run is `radiosity solve SCENE --elements {elements} --converge \
         {CONVERGE} --no-statement --threads T`, with the flags of its row.",
        machine.cores, machine.cpu
    );
    let scenes = scenes.iter().map(|solved| scene(solved, machine.cores));
    let parts: Vec<_> = std::iter::once(head).chain(scenes).collect();
    blocks::replace(page, BLOCK, &parts.join("\n\n"))
}

/// Diagram, table and serial shares of one scene.
fn scene(solved: &Solved, cores: usize) -> String {
    let title = solved.scene.title();
    let rounds = solved.series.first().map_or(0, |s| s.points[0].seconds.len());
    let parts = [
        format!("### {title}"),
        format!("![{title}: speed-up against threads]({})", solved.scene.diagram_name()),
        format!(
            "`{}`, {} elements, {rounds} round{}. All solutions of one schedule are the same to the last byte.",
            solved.file,
            grouped(solved.elements),
            if rounds == 1 { "" } else { "s" }
        ),
        meanwhile(solved.others, cores),
        rows(solved, cores),
        [shares(solved, cores), most(solved)].concat(),
    ];
    parts.join("\n\n")
}

/// From so many of the machine's cores on, what others do moves the figures more than the
/// differences that are looked for here, which are some per cent.
const BUSY: f64 = 0.03;

/// What other programs took of the machine.
fn meanwhile(others: Option<f64>, cores: usize) -> String {
    match others {
        None => "What other programs did meanwhile is unknown.".into(),
        Some(others) => {
            let warning = if others > BUSY * cores as f64 {
                " **These are not the times of an idle machine, and the serial share is too high.**"
            } else {
                ""
            };
            format!(
                "Other programs kept {} of {cores} cores busy meanwhile.{warning}",
                digits(others, 2)
            )
        }
    }
}

/// A row for each configuration.
fn rows(solved: &Solved, cores: usize) -> String {
    let header =
        ["threads", "loop", "schedule", "time (least–most)", "speed-up (least–most)", "efficiency"];
    let rows = solved
        .series
        .iter()
        .flat_map(|series| series.points.iter().map(move |point| row(series, point, cores)));
    table(&header, rows)
}

fn row(series: &Series, point: &Timed, cores: usize) -> Vec<String> {
    let Timed { threads, seconds } = point;
    let flag = |value: &Option<String>| value.clone().unwrap_or_else(|| "default".into());
    let Spread { median, least, most } = series.speed_up(point);
    let ends = if least < most {
        format!(" ({}–{})", digits(least, 3), digits(most, 3))
    } else {
        String::new()
    };
    let crowded = if *threads > cores { " (oversubscribed)" } else { "" };
    vec![
        format!("{threads}{crowded}"),
        flag(&series.mode.sharing),
        flag(&series.mode.schedule),
        times(seconds),
        format!("{}{ends}", digits(median, 3)),
        percent(median / *threads as f64),
    ]
}

/// What the machine can do at most.
fn most(solved: &Solved) -> String {
    let Some((programs, Spread { median, least, most })) = solved.most() else {
        return String::new();
    };
    let [median, least, most] = [median, least, most].map(|n| digits(n, 3));
    format!(
        "\n- {programs} programs of one thread at once do {median} ({least}–{most}) times the work of \
         one: the most that threads can reach on this machine"
    )
}

/// The serial share of each mode.
fn shares(solved: &Solved, cores: usize) -> String {
    let lines = solved.series.iter().map(|series| {
        let name = match series.mode.flags() {
            flags if flags.is_empty() => String::new(),
            flags => format!("`{}`: ", flags.join(" ")),
        };
        format!("- {name}{}", share(series, cores))
    });
    lines.collect::<Vec<_>>().join("\n")
}

fn share(series: &Series, cores: usize) -> String {
    let Some(SerialShare { fitted, least, most }) = series.serial_share(cores) else {
        return "no serial share: that needs two threads with a core each".into();
    };
    let threads: Vec<_> = series.within(cores).map(|p| p.threads.to_string()).collect();
    let rounds = if least < most {
        format!(" ({} to {} in single rounds)", signed(least), signed(most))
    } else {
        String::new()
    };
    format!("serial share {}{rounds}, fitted to {} threads", signed(fitted), threads.join(", "))
}

/// `2.5 %`, `−0.8 %`.
fn signed(share: f64) -> String {
    format!("{}{}", if share < 0.0 { "−" } else { "" }, percent(share.abs()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    #[test]
    fn a_scene_has_its_diagram_its_table_and_its_shares() {
        let page = renewed(EMPTY, &sample::measurement()).unwrap();
        let expected = "\
# Run time against threads

<!-- begin: figures -->

2 cores of Some CPU @ 2.60GHz. Every run is `radiosity solve SCENE --elements 8000 --converge 1e-3 --no-statement --threads T`, with the flags of its row.

### Room

![Room: speed-up against threads](scaling-room.svg)

`scenes/room.tri`, 7,999 elements, 3 rounds. All solutions of one schedule are the same to the last byte.

Other programs kept 0.25 of 2 cores busy meanwhile. **These are not the times of an idle machine, and the serial share is too high.**

| threads | loop | schedule | time (least–most) | speed-up (least–most) | efficiency |
|---|---|---|---|---|---|
| 1 | default | default | 8.00 s (8.00–16.0) | 1.00 | 100 % |
| 2 | default | default | 5.00 s (4.00–10.0) | 1.60 (1.60–2.00) | 80 % |
| 4 (oversubscribed) | default | default | 5.00 s (5.00–10.0) | 1.60 | 40 % |
| 1 | static | default | 8.00 s (8.00–16.0) | 1.00 | 100 % |

- serial share 25 % (0 % to 25 % in single rounds), fitted to 1, 2 threads
- `--loop static`: no serial share: that needs two threads with a core each
- 2 programs of one thread at once do 1.60 (1.60–2.00) times the work of one: the most that threads can reach on this machine

<!-- end: figures -->
";
        assert_eq!(page, expected);
        // Renewing again changes nothing.
        assert_eq!(renewed(&page, &sample::measurement()).unwrap(), expected);
    }

    #[test]
    fn an_idle_machine_needs_no_warning() {
        let idle = "Other programs kept 0.060 of 2 cores busy meanwhile.";
        assert_eq!(meanwhile(Some(0.06), 2), idle);
        assert!(meanwhile(Some(0.061), 2).ends_with("too high.**"));
        assert!(meanwhile(None, 2).ends_with("unknown."));
    }

    #[test]
    fn a_share_below_zero_keeps_its_sign() {
        assert_eq!([-0.0081, 0.0, 0.025].map(signed), ["−0.81 %", "0 %", "2.5 %"]);
    }
}
