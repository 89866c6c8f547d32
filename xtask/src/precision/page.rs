//! The tables of docs/precision.md.

use super::blocks::{self, table};
use super::diagram;
use super::measurement::{Measurement, Method, Solve};
use super::numbers::{count, digits, goal, percent, seconds, times};
use super::statistics::{Reached, time_to};

/// The errors whose time is given, in E1.
const TARGETS: [f64; 2] = [1e-2, 1e-3];

/// The page with a block for each measurement and one over all of them.
pub(super) fn renewed(page: &str, measurements: &[Measurement]) -> Result<String, String> {
    let mut page = page.to_owned();
    for measurement in measurements {
        let block = scene_block(measurement, "precision");
        page = blocks::replace(&page, measurement.subject.name(), &block)?;
    }
    if !measurements.is_empty() {
        page = blocks::replace(&page, "stated", &stated_block(measurements))?;
    }
    Ok(page)
}

/// Diagram and tables of one scene; the diagram lies in `folder`.
pub(super) fn scene_block(measurement: &Measurement, folder: &str) -> String {
    let Measurement { subject, machine, threads, reference_error, .. } = measurement;
    let figure = diagram::of(measurement);
    let parts = [
        format!("![{}]({folder}/{})", figure.title, subject.file_name("svg")),
        format!(
            "{} of {} cores of {}. The reference's own standard error is {}.",
            diagram::threads_text(*threads),
            machine.cores,
            machine.cpu,
            percent(*reference_error)
        ),
        refinement_table(measurement),
        mesh_table(measurement),
        target_table(measurement),
    ];
    parts.join("\n\n")
}

/// What refinement did for each goal.
fn refinement_table(measurement: &Measurement) -> String {
    let header = [
        "error asked for",
        "time (least–most)",
        "elements",
        "segments",
        "form factors",
        "shots",
        "stated E1",
        "true E1",
        "stated / true",
        "stated Einf",
        "true Einf",
    ];
    let rows = measurement.refinement().map(|solve| {
        let limit = solve.work.limit.as_ref().map(|limit| format!(" (ended by {limit})"));
        let [elements, segments, form_factors, shots] = work(solve);
        let stated = solve.stated.as_ref();
        vec![
            format!("{}{}", goal(solve.goal), limit.unwrap_or_default()),
            times(&solve.seconds),
            elements,
            segments,
            form_factors,
            shots,
            known(stated.and_then(|s| s.e1), percent),
            percent(solve.measured.e1),
            known(solve.ratio(), |ratio| digits(ratio, 2)),
            known(stated.and_then(|s| s.einf), percent),
            percent(solve.measured.einf),
        ]
    });
    table(&header, rows)
}

/// What fixed meshes came to for each unshot share.
fn mesh_table(measurement: &Measurement) -> String {
    let header = [
        "fixed mesh",
        "unshot",
        "time (least–most)",
        "elements",
        "segments",
        "form factors",
        "shots",
        "true E1",
        "true Einf",
    ];
    let fixed = measurement.solves().filter(|(method, _)| *method != Method::Refinement);
    let rows = fixed.map(|(method, solve)| {
        let [elements, segments, form_factors, shots] = work(solve);
        vec![
            diagram::name(method),
            format!("{:e}", solve.goal),
            times(&solve.seconds),
            elements,
            segments,
            form_factors,
            shots,
            percent(solve.measured.e1),
            percent(solve.measured.einf),
        ]
    });
    table(&header, rows)
}

/// When each method reaches the target errors.
fn target_table(measurement: &Measurement) -> String {
    let times = TARGETS.map(|target| format!("time to E1 of {target:e}"));
    let header = ["method", &times[0], &times[1], "least true E1"];
    let curves = measurement.series.iter().filter(|s| s.solves.len() > 1);
    let rows = curves.map(|series| {
        let points: Vec<_> =
            series.solves.iter().map(|s| (s.time().median, s.measured.e1)).collect();
        let reached = TARGETS.map(|target| match time_to(target, &points) {
            Reached::At(time) => seconds(time),
            Reached::By(time) => format!("≤ {}", seconds(time)),
            Reached::Not => "not reached".into(),
        });
        let least = points.iter().map(|(_, e1)| *e1).fold(f64::INFINITY, f64::min);
        let [first, second] = reached;
        vec![diagram::name(series.method), first, second, percent(least)]
    });
    table(&header, rows)
}

/// Stated against true E1 over all scenes and goals.
fn stated_block(measurements: &[Measurement]) -> String {
    let mut goals: Vec<f64> =
        measurements.iter().flat_map(|m| m.refinement().map(|solve| solve.goal)).collect();
    goals.sort_by(|a, b| b.total_cmp(a));
    goals.dedup();
    let titles = measurements.iter().map(|m| m.subject.title());
    let header: Vec<_> = std::iter::once("error asked for").chain(titles).collect();
    let rows = goals.iter().map(|share| {
        let cells = measurements.iter().map(|measurement| {
            let solve = measurement.refinement().find(|solve| solve.goal == *share);
            solve.map_or_else(String::new, stated_cell)
        });
        std::iter::once(goal(*share)).chain(cells).collect()
    });
    format!("{}\n\n{}", table(&header, rows), extremes(measurements))
}

fn stated_cell(solve: &Solve) -> String {
    let stated = known(solve.stated.as_ref().and_then(|s| s.e1), percent);
    let ratio = known(solve.ratio(), |ratio| digits(ratio, 2));
    format!("{stated} / {} = **{ratio}**", percent(solve.measured.e1))
}

/// The smallest and the largest ratio, and how many statements are too low.
fn extremes(measurements: &[Measurement]) -> String {
    let mut ratios: Vec<(f64, String)> = Vec::new();
    for measurement in measurements {
        for solve in measurement.refinement() {
            let place = format!("{} at {}", measurement.subject.title(), goal(solve.goal));
            ratios.extend(solve.ratio().map(|ratio| (ratio, place)));
        }
    }
    ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (Some((least, at_least)), Some((most, at_most))) = (ratios.first(), ratios.last()) else {
        return "Nothing was stated.".into();
    };
    let low = ratios.iter().filter(|(ratio, _)| *ratio < 1.0).count();
    format!(
        "Stated over true: least {} ({at_least}), most {} ({at_most}). {low} of {} statements \
         are below the true error.",
        digits(*least, 2),
        digits(*most, 2),
        ratios.len()
    )
}

fn work(solve: &Solve) -> [String; 4] {
    let work = &solve.work;
    [work.elements, work.segments, work.form_factors, work.shots].map(count)
}

fn known(value: Option<f64>, text: impl Fn(f64) -> String) -> String {
    value.map_or_else(|| "unknown".into(), text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::sample;

    #[test]
    fn a_scene_has_its_diagram_and_three_tables() {
        let block = scene_block(&sample::measurement(), "precision");
        let expected = "\
![Room: error against time](precision/room.svg)

2 threads of 2 cores of Some CPU @ 2.60GHz. The reference's own standard error is 0.012 %.

| error asked for | time (least–most) | elements | segments | form factors | shots | stated E1 | true E1 | stated / true | stated Einf | true Einf |
|---|---|---|---|---|---|---|---|---|---|---|
| 8 % | 0.300 s (0.200–0.400) | 4,000 | 4.79 M | 4.00 M | 1,651 | 6.0 % | 3.0 % | 2.0 | unknown | 13 % |
| 1 % (ended by --max-time) | 1.50 s | 8,000 | 9.58 M | 8.00 M | 3,302 | unknown | 0.80 % | unknown | unknown | 5.0 % |

| fixed mesh | unshot | time (least–most) | elements | segments | form factors | shots | true E1 | true Einf |
|---|---|---|---|---|---|---|---|---|
| 1,000 elements | 1e-1 | 0.100 s | 1,000 | 700 k | 700 k | 300 | 10 % | 30 % |
| 1,000 elements | 1e-2 | 0.200 s | 1,000 | 1.40 M | 1.40 M | 600 | 2.1 % | 20 % |
| octree, 1,000 elements | 1e-2 | 0.400 s | 1,000 | 1.40 M | 1.40 M | 600 | 2.1 % | 20 % |

| method | time to E1 of 1e-2 | time to E1 of 1e-3 | least true E1 |
|---|---|---|---|
| refined to --error | 1.14 s | not reached | 0.80 % |
| 1,000 elements | not reached | not reached | 2.1 % |";
        assert_eq!(block, expected);
    }

    #[test]
    fn the_extremes_are_named() {
        let (room, mut paired) = (sample::measurement(), sample::measurement());
        paired.subject = crate::precision::Subject::Paired;
        paired.series[0].solves[0].measured.e1 = 0.1;
        let block = stated_block(&[room, paired]);
        let row = "| 8 % | 6.0 % / 3.0 % = **2.0** | 6.0 % / 10 % = **0.60** |";
        assert!(block.contains(row), "{block}");
        let last = "Stated over true: least 0.60 (Room, paired sides at 8 %), most 2.0 (Room \
                    at 8 %). 1 of 2 statements are below the true error.";
        assert!(block.ends_with(last), "{block}");
    }

    #[test]
    fn a_page_without_measurements_stays() {
        assert_eq!(renewed("words", &[]).unwrap(), "words");
        let error = renewed("words", &[sample::measurement()]).unwrap_err();
        assert!(error.contains("begin: room"), "{error}");
    }
}
