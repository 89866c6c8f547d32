//! `--log json`: an object a line, whose numbers are those of the report.

use std::collections::BTreeSet;

use serde_json::Value;

use crate::support::{Run, box_tri, folder_with, radiosity};

/// What docs/log.md says.
const PAGE: &str = include_str!("../../../../docs/log.md");

/// The lines, each an object with its kind and time; kinds and fields are all on the page.
fn lines(run: &Run) -> Vec<Value> {
    let text = run.stderr();
    let lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap_or_else(|e| panic!("{e}: {line}")))
        .collect();
    let mut last = 0.0;
    for line in &lines {
        let seconds = line["seconds"].as_f64().unwrap();
        assert!(seconds >= last, "time goes on: {line}");
        last = seconds;
        let fields = line.as_object().unwrap().keys().map(String::as_str);
        for name in fields.chain([line["kind"].as_str().unwrap()]) {
            assert!(PAGE.contains(&format!("`{name}`")), "docs/log.md has no `{name}`: {line}");
        }
    }
    lines
}

fn of<'a>(lines: &'a [Value], kind: &str) -> Vec<&'a Value> {
    lines.iter().filter(|line| line["kind"] == kind).collect()
}

/// The only line of a kind.
fn one<'a>(lines: &'a [Value], kind: &str) -> &'a Value {
    let all = of(lines, kind);
    assert_eq!(all.len(), 1, "{kind}: {lines:?}");
    all[0]
}

/// Fields of a line that must be those of the report, each with its path there.
fn same(line: &Value, report: &Value, fields: &[(&str, &str)]) {
    for (name, path) in fields {
        let there = report.pointer(path).unwrap_or_else(|| panic!("the report has no {path}"));
        let here = line.get(*name).unwrap_or_else(|| panic!("{line} has no {name}"));
        let equal = here == there || here.as_f64().is_some() && here.as_f64() == there.as_f64();
        assert!(equal, "{name} is {here}, and {path} {there}");
    }
}

#[test]
fn numbers_are_those_of_the_report() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = ["solve", "box.tri", "--error", "2%", "--need", "everything", "-o", "a.csv"];
    let args = [&args[..], &["--report", "a.json", "--log", "json"]].concat();
    let run = radiosity(folder.path(), &args);
    assert_eq!((run.code(), run.stdout().as_str()), (0, ""), "{}", run.stderr());
    let text = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    let report: Value = serde_json::from_str(&text).unwrap();
    let lines = lines(&run);
    assert_eq!(lines[0]["kind"], "start");
    assert!(PAGE.contains(&format!("version {}", lines[0]["log"])), "{}", lines[0]);
    let facts = ["triangles", "emitters", "materials", "groups", "file", "format"];
    let facts = facts.map(|name| (name, format!("/scene/{name}")));
    for (name, path) in &facts {
        same(one(&lines, "scene"), &report, &[(*name, path.as_str())]);
    }
    same(
        one(&lines, "plan"),
        &report,
        &[
            ("foreseen_elements", "/plan/foreseen/elements"),
            ("foreseen_shots", "/plan/foreseen/shots"),
            ("foreseen_form_factors", "/plan/foreseen/form_factors"),
            ("foreseen_segments", "/plan/foreseen/segments"),
            ("foreseen_seconds_on_one_thread", "/plan/foreseen/seconds"),
        ],
    );
    same(
        one(&lines, "mesh"),
        &report,
        &[
            ("elements", "/mesh/elements"),
            ("patches", "/mesh/patches"),
            ("receiver_points", "/mesh/receiver_points"),
            ("covered_triangles", "/mesh/covered_triangles"),
            ("occluders", "/occluder/kind"),
            ("threads", "/settings/threads"),
        ],
    );
    same(
        one(&lines, "work"),
        &report,
        &[
            ("shots", "/solve/shots"),
            ("segments", "/solve/rays"),
            ("form_factors", "/solve/form_factors"),
            ("directions", "/solve/directions"),
            ("unshot_share", "/solve/unshot"),
            ("ambient_corrections", "/solve/ambient_corrections"),
        ],
    );
    same(
        one(&lines, "statement"),
        &report,
        &[
            ("error_share", "/error/total"),
            ("iteration_share", "/error/iteration"),
            ("form_factor_share", "/error/form_factor"),
            ("mesh_share", "/error/mesh"),
            ("largest_share", "/error/largest/total"),
            ("points_share", "/error/points/total"),
            ("points_largest_share", "/error/points/largest/total"),
            ("least_row", "/error/rows/least"),
            ("most_row", "/error/rows/most"),
            ("sampled_elements", "/error/sample"),
        ],
    );
    same(
        one(&lines, "energy"),
        &report,
        &[
            ("emitted_power", "/energy/emitted"),
            ("absorbed_power", "/energy/absorbed"),
            ("escaped_power", "/energy/escaped"),
            ("form_factor_defect_power", "/energy/form_factor_defect"),
            ("wrong_side_power", "/energy/wrong_side"),
            ("unshot_power", "/energy/unshot"),
            ("imbalance_share", "/energy/imbalance"),
        ],
    );
    same(
        one(&lines, "time"),
        &report,
        &[
            ("read_seconds", "/seconds/read"),
            ("plan_seconds", "/seconds/plan"),
            ("occluder_seconds", "/seconds/occluder"),
            ("solve_seconds", "/seconds/solve"),
            ("output_seconds", "/seconds/output"),
        ],
    );
    assert_eq!(one(&lines, "written")["files"], serde_json::json!(["a.csv", "a.json"]));
    // A line for each level of the curve.
    let curve = report["curve"].as_array().unwrap();
    let curve: Vec<&Value> = curve.iter().filter(|point| !point["elements"].is_null()).collect();
    let levels = of(&lines, "level");
    assert!(levels.len() >= 2 && levels.len() == curve.len(), "{levels:?}");
    for (number, (level, point)) in (1..).zip(levels.into_iter().zip(curve)) {
        assert_eq!(level["level"], number);
        let fields = ["elements", "shots", "form_factors"].map(|name| (name, format!("/{name}")));
        for (name, path) in &fields {
            same(level, point, &[(*name, path.as_str())]);
        }
        same(
            level,
            point,
            &[("segments", "/rays"), ("unshot_share", "/unshot"), ("error_share", "/error")],
        );
    }
    let stages: BTreeSet<&str> =
        of(&lines, "stage").iter().map(|s| s["stage"].as_str().unwrap()).collect();
    let expected =
        ["census", "mesh", "occluder", "planning", "reading", "shooting", "statement", "writing"];
    assert_eq!(stages.into_iter().collect::<Vec<_>>(), expected);
}

#[test]
fn steps_tell_what_is_left_and_how_fast_it_goes() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let args = ["solve", "box.tri", "--error", "1e-6", "--max-time", "3s", "--need", "everything"];
    let run = radiosity(folder.path(), &[&args[..], &["-o", "a.csv", "--log", "json"]].concat());
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let lines = lines(&run);
    let steps = of(&lines, "step");
    // Four a second at most.
    assert!((1..=13).contains(&steps.len()), "{steps:?}");
    assert!(steps.iter().any(|step| step["segments_per_second"].as_f64() > Some(0.0)));
    for step in &steps {
        // The limit ends the work; its clock begins after reading and planning.
        let left = step["left_seconds"].as_f64().unwrap_or(3.0);
        assert!(left <= 3.0 && step["seconds"].as_f64().unwrap() + left <= 3.5, "{step}");
        assert!(step["elements"].as_u64() > Some(0) && step["level"].as_u64() > Some(0), "{step}");
    }
    let limit = one(&lines, "limit");
    assert_eq!(limit["limit"], "--max-time");
    assert!(limit["text"].as_str().unwrap().starts_with("--max-time ended the work"), "{limit}");
}

#[test]
fn warnings_and_errors_are_lines_and_keep_their_exit_codes() {
    let dark = box_tri().replace("255 255 255", "0 0 0");
    let (folder, _) = folder_with("dark.tri", dark.as_bytes());
    let run = |line: &str| radiosity(folder.path(), &line.split(' ').collect::<Vec<_>>());
    let solved = run("solve dark.tri -o a.csv --log json");
    assert_eq!(solved.code(), 0);
    let text = "nothing emits: the scene stays dark";
    assert_eq!(one(&lines(&solved), "warning")["text"], text);
    let quiet = run("solve dark.tri -o a.csv --log json -q");
    let quiet = lines(&quiet);
    assert_eq!((quiet.len(), &quiet[0]["text"]), (1, &text.into()), "{quiet:?}");
    // A limit is a warning where only those are wanted.
    std::fs::write(folder.path().join("box.tri"), box_tri()).unwrap();
    let limited = run("solve box.tri -o a.csv --error 0.1% --max-elements 1500 -q --log json");
    let limited = lines(&limited);
    assert!(one(&limited, "warning")["text"].as_str().unwrap().starts_with("--max-elements ended"));
    let said = run("solve dark.tri -o a.csv --quiet").stderr();
    assert_eq!(said, format!("radiosity: warning: {text}\n"));
    for (line, code, part) in [
        ("solve gone.tri -o a.csv --log json", 1, "gone.tri: "),
        ("solve gone.tri -o a.csv --log=json --quiet", 1, "gone.tri: "),
        ("solve dark.tri --log json --elemnts 9", 2, "--elemnts: is no flag"),
        ("--log json solv", 2, "solv: is no command"),
    ] {
        let run = run(line);
        assert_eq!(run.code(), code, "{line}");
        let lines = lines(&run);
        let error = lines.last().unwrap();
        assert_eq!(
            (&error["kind"], &error["exit_code"]),
            (&"error".into(), &code.into()),
            "{line}"
        );
        assert!(error["text"].as_str().unwrap().contains(part), "{line}: {error}");
    }
}

#[test]
fn what_is_said_changes_no_byte_of_the_light() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let light = |flags: &[&str]| {
        let args = ["solve", "box.tri", "--elements", "600", "-o", "-"];
        let run = radiosity(folder.path(), &[&args[..], flags].concat());
        assert_eq!(run.code(), 0, "{}", run.stderr());
        run.stdout()
    };
    let plain = light(&[]);
    for flags in [&["--log", "json"][..], &["-q"], &["--color", "always"]] {
        assert_eq!(light(flags), plain, "{flags:?}");
    }
}
