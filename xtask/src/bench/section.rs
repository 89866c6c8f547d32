//! What a report says, whatever it is written in: sections of words, charts and a table.

use super::cell::{Cell, Method};
use super::chart::{self, Chart, STAGES};
use super::fit;
use super::group::{Group, Scaling, groups, scalings};
use super::host::Host;
use super::record::{Outcome, Record};
use super::scene::Scene;
use crate::precision::numbers::{count, digits, goal, grouped, percent, times};
use crate::precision::statistics::Spread;

/// One part of a report.
pub(super) struct Section {
    pub(super) title: String,
    pub(super) words: Vec<String>,
    pub(super) charts: Vec<Chart>,
    pub(super) table: Option<Table>,
}

/// Rows of text under a header.
pub(super) struct Table {
    pub(super) header: Vec<&'static str>,
    pub(super) rows: Vec<Vec<String>>,
}

/// From so many of the machine's cores on, what others do moves the figures more than the
/// differences that are looked for here, which are some per cent.
const BUSY: f64 = 0.03;

/// From so many elements on, little else than elements takes time and memory.
pub(super) const LARGE: f64 = 10_000.0;

/// All sections that the records have something for.
///
/// # Errors
/// What the drawing says.
pub(super) fn all(host: &Host, records: &[Record]) -> Result<Vec<Section>, String> {
    let groups = groups(records);
    let mut sections = threads(&groups, host)?;
    for scene in Scene::ALL {
        sections.extend(precision(&groups, scene, host)?);
    }
    sections.extend(stages(&groups, host)?);
    sections.extend(growth(&groups, host)?);
    sections.extend(occluders(&groups));
    sections.extend(refused(records));
    Ok(sections)
}

/// A line about the machine, and one about what else it did.
pub(super) fn head(host: &Host, records: &[Record]) -> Vec<String> {
    let memory = host.memory.map(|b| format!(", {} GiB", digits(b as f64 / 1_073_741_824.0, 2)));
    let machine = format!(
        "{}: {} cores of {}{}, {}; {}; revision {} (program {}), from {} on.",
        host.host,
        host.cores,
        host.cpu,
        memory.unwrap_or_default(),
        host.system,
        host.toolchain,
        host.revision,
        host.program,
        host.date
    );
    let groups = groups(records);
    let others: Vec<f64> = groups.iter().filter_map(Group::others).collect();
    let busy = match others.len() {
        0 => "What other programs did meanwhile is unknown.".into(),
        n => {
            let mean = others.iter().sum::<f64>() / n as f64;
            let warning = if mean > BUSY * host.cores as f64 {
                " These are not the times of an idle machine."
            } else {
                ""
            };
            let cores = host.cores;
            format!(
                "Other programs kept {} of {cores} cores busy meanwhile.{warning}",
                digits(mean, 2)
            )
        }
    };
    vec![machine, busy]
}

/// A section for each kind of work that was run on more than one number of threads.
fn threads(groups: &[Group], host: &Host) -> Result<Vec<Section>, String> {
    let scalings = scalings(groups);
    let work = |scaling: &Scaling| Cell { schedule: None, ..scaling.one().cell.light() };
    let mut kinds: Vec<Cell> = Vec::new();
    for scaling in &scalings {
        let kind = work(scaling);
        if !kinds.contains(&kind) {
            kinds.push(kind);
        }
    }
    let section = |kind: Cell| {
        let of: Vec<&Scaling> = scalings.iter().filter(|scaling| work(scaling) == kind).collect();
        let mut words = Vec::new();
        for scaling in &of {
            if let Some(share) = scaling.serial_share(host.cores) {
                let flags = scaling.one().cell.choices();
                let flags = if flags.is_empty() { " no flags".into() } else { flags };
                words.push(format!("Serial share with{flags}: {}.", signed(share)));
            }
        }
        if let Some((programs, most)) = of.iter().find_map(|scaling| scaling.ceiling(groups)) {
            words.push(format!(
                "{programs} programs of one thread at once, which share nothing but the machine, do \
                 {} times the work of one.",
                spread(most)
            ));
        }
        Ok(Section {
            title: format!("{}: time against threads", kind.scene.title()),
            words,
            charts: vec![chart::speed_up(&of, host)?, chart::efficiency(&of, host)?],
            table: Some(threads_table(&of, host.cores)),
        })
    };
    kinds.into_iter().map(section).collect()
}

fn threads_table(scalings: &[&Scaling], cores: usize) -> Table {
    let row = |scaling: &Scaling, point: &Group| {
        let cell = point.cell;
        let speed_up = scaling.speed_up(point);
        let crowded = if cell.threads > cores { " (oversubscribed)" } else { "" };
        let own = |value: &Option<String>| value.clone().unwrap_or_else(|| "default".into());
        let efficiency = speed_up.map(|s| percent(s.median / cell.threads as f64));
        vec![
            format!("{}{crowded}", cell.threads),
            own(&cell.sharing),
            own(&cell.schedule),
            times(&point.seconds()),
            speed_up.map(spread).unwrap_or_default(),
            efficiency.unwrap_or_default(),
        ]
    };
    let rows = scalings.iter().flat_map(|s| s.points.iter().map(move |point| row(s, point)));
    let header = vec![
        "threads",
        "loop",
        "schedule",
        "time (least–most)",
        "speed-up (least–most)",
        "efficiency",
    ];
    Table { header, rows: rows.collect() }
}

/// Cells in which the program decides everything, on the most threads that have a core each.
fn plain<'a>(groups: &'a [Group<'a>], host: &Host) -> Vec<&'a Group<'a>> {
    let own = |group: &&Group| {
        let Cell { schedule, sharing, accel, programs, threads, .. } = group.cell;
        schedule.is_none()
            && sharing.is_none()
            && accel.is_none()
            && *programs == 1
            && *threads <= host.cores
    };
    let most = groups.iter().filter(own).map(|group| group.cell.threads).max();
    groups.iter().filter(own).filter(|group| Some(group.cell.threads) == most).collect()
}

fn precision(groups: &[Group], scene: Scene, host: &Host) -> Result<Option<Section>, String> {
    let mut known = plain(groups, host);
    known.retain(|g| g.cell.scene == scene && g.first().measured.is_some());
    // A curve has two goals at least: what a mesh of one more size does is in the section on growth.
    let kind = |group: &Group| (group.cell.method, group.cell.elements);
    let kinds: Vec<_> = known.iter().map(|group| kind(group)).collect();
    known.retain(|group| kinds.iter().filter(|other| **other == kind(group)).count() > 1);
    known.sort_by(|a, b| kind(a).cmp(&kind(b)).then(b.cell.goal.total_cmp(&a.cell.goal)));
    let Some(chart) = chart::error_against_time(&known, host)? else { return Ok(None) };
    let rows = known.iter().map(|group| {
        let first = group.first();
        let stated = first.stated.as_ref().and_then(|s| s.e1);
        let text = |share: Option<f64>| share.map_or_else(|| "—".into(), percent);
        vec![
            group.cell.method.name().to_owned(),
            goal(group.cell.goal),
            grouped(first.work.elements),
            times(&group.seconds()),
            text(stated),
            text(first.measured.map(|m| m.e1)),
            text(first.measured.map(|m| m.einf)),
            count(first.work.shots),
            count(first.work.segments),
        ]
    });
    let header = vec![
        "method",
        "goal",
        "elements",
        "time (least–most)",
        "E1 stated",
        "E1",
        "Einf",
        "shots",
        "segments",
    ];
    Ok(Some(Section {
        title: format!("{}: error against time", scene.title()),
        words: vec![
            "Goals of refine, uniform and centroid are stated errors, those of mesh and plain unshot \
             shares."
                .into(),
        ],
        charts: vec![chart],
        table: Some(Table { header, rows: rows.collect() }),
    }))
}

/// For each scene a mesh on one thread and on many, and its finest refinement; the largest mesh.
fn stages(groups: &[Group], host: &Host) -> Result<Option<Section>, String> {
    let scalings = scalings(groups);
    let mut shown: Vec<&Group> = Vec::new();
    for scene in Scene::ALL {
        let of_scene =
            scalings.iter().find(|s| s.one().cell.scene == scene && s.one().is_default());
        let within = |group: &&&Group| group.cell.threads <= host.cores;
        if let Some(scaling) = of_scene {
            shown.push(scaling.points[0]);
            shown.extend(scaling.points.iter().rfind(within));
        }
        let refined = plain(groups, host)
            .into_iter()
            .filter(|g| g.cell.scene == scene && g.cell.method == Method::Refine);
        shown.extend(refined.min_by(|a, b| a.cell.goal.total_cmp(&b.cell.goal)));
    }
    let meshes = plain(groups, host).into_iter().filter(|group| group.is_mesh());
    shown.extend(meshes.max_by_key(|group| group.first().work.elements));
    shown.dedup_by(|a, b| a.cell == b.cell);
    if shown.is_empty() {
        return Ok(None);
    }
    let chart = chart::stages(&shown, host)?;
    let rows = shown.iter().map(|group| {
        let mut row = vec![group.cell.name()];
        row.extend(STAGES.iter().map(|(stage, _)| milliseconds(group.stage(stage))));
        row
    });
    let header = std::iter::once("milliseconds of").chain(STAGES.iter().map(|(name, _)| *name));
    Ok(Some(Section {
        title: "Time by stage".into(),
        words: vec![
            "Each step of the shooting selects shooters, prepares their cells, transfers their light \
             (form factors and occlusion) and commits it. Of a refinement all levels count."
                .into(),
        ],
        charts: vec![chart],
        table: Some(Table { header: header.collect(), rows: rows.collect() }),
    }))
}

fn growth(groups: &[Group], host: &Host) -> Result<Option<Section>, String> {
    let mut meshes = plain(groups, host);
    meshes.retain(|group| group.is_mesh());
    meshes.sort_by_key(|group| group.first().work.elements);
    // One unshot share for all: the one that most sizes were shot to.
    let sizes = |share: f64| meshes.iter().filter(|g| g.cell.goal == share).count();
    let share = meshes.iter().map(|g| g.cell.goal).max_by_key(|share| sizes(*share));
    meshes.retain(|group| Some(group.cell.goal) == share);
    let of = |scene: Scene| {
        let groups = meshes.iter().filter(|group| group.cell.scene == scene);
        groups.copied().collect::<Vec<_>>()
    };
    let scenes: Vec<_> = Scene::ALL.into_iter().map(of).filter(|groups| groups.len() > 2).collect();
    if scenes.is_empty() {
        return Ok(None);
    }
    let mut words = Vec::new();
    for groups in &scenes {
        let pairs = |y: &dyn Fn(&Group) -> Option<f64>| {
            let pair = |group: &&Group| Some((group.first().work.elements as f64, y(group)?));
            groups.iter().filter_map(pair).collect::<Vec<_>>()
        };
        let time = pairs(&|group| Some(group.time().median));
        let bytes = pairs(&|group| group.peak());
        let exponent = |pairs: &[(f64, f64)]| {
            fit::power(pairs).map_or_else(|| "unknown".into(), |(k, _)| signed_digits(k))
        };
        let law = |pairs: &[(f64, f64)]| {
            let large: Vec<_> = pairs.iter().filter(|(x, _)| *x >= LARGE).copied().collect();
            let count = grouped(LARGE as u64);
            format!("{} ({} from {count} on)", exponent(pairs), exponent(&large))
        };
        let end = |pairs: &[(f64, f64)], scale: f64| {
            fit::slope_at_the_end(pairs)
                .map_or_else(|| "unknown".into(), |s| signed_digits(s * scale))
        };
        words.push(format!(
            "{}: time grows as the elements to the power of {}, memory to that of {}; between the two \
             largest meshes an element takes {} µs and {} bytes.",
            groups[0].cell.scene.title(),
            law(&time),
            law(&bytes),
            end(&time, 1e6),
            end(&bytes, 1.0)
        ));
    }
    let rows = scenes.iter().flatten().map(|group| {
        let first = group.first();
        let elements = first.work.elements as f64;
        vec![
            group.cell.scene.title().to_owned(),
            grouped(first.work.elements),
            times(&group.seconds()),
            digits(group.time().median / elements * 1e6, 3),
            group.peak().map_or_else(|| "—".into(), |b| digits(b / 1e6, 3)),
            group.peak().map_or_else(|| "—".into(), |b| digits(b / elements, 3)),
            count(first.work.shots),
            count(first.work.segments),
        ]
    });
    let header = vec![
        "scene",
        "elements",
        "time (least–most)",
        "µs an element",
        "MB",
        "bytes an element",
        "shots",
        "segments",
    ];
    Ok(Some(Section {
        title: "Growth with the elements".into(),
        words,
        charts: vec![chart::time(&scenes, host)?, chart::memory(&scenes, host)?],
        table: Some(Table { header, rows: rows.collect() }),
    }))
}

/// Cells that differ in what finds occluders.
fn occluders(groups: &[Group]) -> Option<Section> {
    let chosen = groups.iter().filter(|group| group.cell.accel.is_some());
    let rows: Vec<_> = chosen
        .map(|group| {
            let base = Cell { accel: None, ..group.cell.clone() };
            let first = groups.iter().find(|other| {
                other.cell.accel.is_some() && Cell { accel: None, ..other.cell.clone() } == base
            });
            let ratios = first.map(|first| group.over(first)).filter(|ratios| !ratios.is_empty());
            let ratio = ratios.map(|ratios| spread(Spread::of(&ratios)));
            vec![
                group.cell.name(),
                times(&group.seconds()),
                ratio.unwrap_or_default(),
                milliseconds(group.stage("occluder")),
            ]
        })
        .collect();
    (!rows.is_empty()).then(|| Section {
        title: "Occluders".into(),
        words: vec!["Ratios are to the first of the same work, round by round.".into()],
        charts: Vec::new(),
        table: Some(Table {
            header: vec!["cell", "time (least–most)", "ratio (least–most)", "ms to build"],
            rows,
        }),
    })
}

fn refused(records: &[Record]) -> Option<Section> {
    let rows: Vec<_> = records
        .iter()
        .filter_map(|Record { cell, run, outcome }| match outcome {
            Outcome::Refused(reason) => Some(vec![cell.name(), run.to_string(), reason.clone()]),
            Outcome::Timed(_) => None,
        })
        .collect();
    (!rows.is_empty()).then(|| Section {
        title: "What does not count".into(),
        words: vec!["Runs whose result is not right have no time.".into()],
        charts: Vec::new(),
        table: Some(Table { header: vec!["cell", "round", "reason"], rows }),
    })
}

/// `1.65 (1.54–1.96)`, without ends where they are one.
fn spread(Spread { median, least, most }: Spread) -> String {
    let [median, low, high] = [median, least, most].map(|x| digits(x, 3));
    if least < most { format!("{median} ({low}–{high})") } else { median }
}

/// A share with its sign.
fn signed(share: f64) -> String {
    let sign = if share < 0.0 { "−" } else { "" };
    format!("{sign}{}", percent(share.abs()))
}

fn signed_digits(x: f64) -> String {
    let sign = if x < 0.0 { "−" } else { "" };
    format!("{sign}{}", digits(x.abs(), 3))
}

fn milliseconds(seconds: f64) -> String {
    digits(seconds * 1e3, 3)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    fn sections() -> Vec<Section> {
        all(&sample::host(), &sample::records()).unwrap()
    }

    fn section<'a>(sections: &'a [Section], title: &str) -> &'a Section {
        sections.iter().find(|section| section.title == title).unwrap()
    }

    #[test]
    fn threads_have_times_speed_ups_and_a_ceiling() {
        let sections = sections();
        let threads = section(&sections, "Room: time against threads");
        assert_eq!(threads.words[0], "Serial share with no flags: 25 %.");
        assert!(threads.words[1].ends_with("do 1.60 (1.60–2.00) times the work of one."));
        let rows = &threads.table.as_ref().unwrap().rows;
        let two = ["2", "default", "default", "5.00 s (4.00–10.0)", "1.60 (1.60–2.00)", "80 %"];
        assert_eq!(rows[1], two);
        assert_eq!(rows[2][0], "4 (oversubscribed)");
        let files: Vec<_> = threads.charts.iter().map(|chart| chart.file.as_str()).collect();
        let expected = ["speed-up-room-mesh-8000-0.001.svg", "efficiency-room-mesh-8000-0.001.svg"];
        assert_eq!(files, expected);
    }

    #[test]
    fn errors_stand_beside_their_times() {
        let sections = sections();
        let precision = section(&sections, "Room: error against time");
        let rows = &precision.table.as_ref().unwrap().rows;
        let refined = rows.iter().find(|row| row[0] == "refine" && row[1] == "2 %").unwrap();
        assert_eq!(refined[2..7], ["7,999", "2.00 s (2.00–2.00)", "2.0 %", "1.0 %", "4.0 %"]);
        // Meshes with one goal have no curve.
        assert_eq!(rows.len(), 2);
    }

    /// A second more for each ten thousand elements, 90 MB for 90,000.
    #[test]
    fn growth_has_exponents_and_slopes() {
        let sections = sections();
        let growth = section(&sections, "Growth with the elements");
        let start = "Room: time grows as the elements to the power of 1.00 (1.00 from 10,000 on)";
        assert!(growth.words[0].starts_with(start), "{}", growth.words[0]);
        assert!(growth.words[0].contains("takes 100 µs and 1000 bytes"), "{}", growth.words[0]);
        assert_eq!(growth.table.as_ref().unwrap().rows.len(), 3);
    }

    #[test]
    fn stages_show_one_thread_many_and_the_finest_refinement() {
        let sections = sections();
        let stages = section(&sections, "Time by stage");
        let rows = &stages.table.as_ref().unwrap().rows;
        let names: Vec<_> = rows.iter().map(|row| row[0].as_str()).collect();
        let expected = [
            "room, mesh, 8,000 elements to 0.1 % unshot, --threads 1",
            "room, mesh, 8,000 elements to 0.1 % unshot, --threads 2",
            "room, refine, to a stated 2 %, --threads 2",
            "room, mesh, 100,000 elements to 1 % unshot, --threads 2",
        ];
        assert_eq!(names, expected);
        // A quarter of a median of 5 seconds builds the occluder.
        assert_eq!(rows[1][1], "1250");
    }

    #[test]
    fn what_is_refused_is_listed() {
        let mut records = sample::records();
        records[0].outcome = Outcome::Refused("wrong".into());
        let sections = all(&sample::host(), &records).unwrap();
        let refused = section(&sections, "What does not count").table.as_ref().unwrap();
        assert_eq!(refused.rows[0][2], "wrong");
    }

    #[test]
    fn a_busy_machine_is_named() {
        let mut records = sample::records();
        let host = sample::host();
        assert!(head(&host, &records)[1].ends_with("busy meanwhile."));
        for record in &mut records {
            if let Outcome::Timed(timed) = &mut record.outcome {
                timed.others = Some(0.5);
            }
        }
        assert!(head(&host, &records)[1].ends_with("not the times of an idle machine."));
    }
}
