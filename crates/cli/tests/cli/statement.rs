//! The stated error, the limits that end the work before it, and probes.

use serde_json::Value;

use crate::support::{box_tri, folder_with, radiosity};

/// Solves the box with these flags; the report.
fn report(extra: &[&str]) -> (Value, String) {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let mut args = vec!["solve", "box.tri", "--report", "a.json"];
    args.extend(extra);
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 0, "{extra:?} {}", run.stderr());
    let text = std::fs::read_to_string(folder.path().join("a.json")).unwrap();
    (serde_json::from_str(&text).unwrap(), run.stderr())
}

#[test]
fn the_asked_error_is_reached_and_its_parts_add_up() {
    let (report, said) = report(&["--error", "2%"]);
    let error = &report["error"];
    let part = |of: &Value, name: &str| of[name].as_f64().unwrap();
    for of in [error, &error["largest"], &error["points"], &error["points"]["largest"]] {
        let sum = part(of, "iteration") + part(of, "form_factor") + part(of, "mesh");
        assert!((sum - part(of, "total")).abs() < 1e-12, "{of}");
    }
    assert!(part(error, "total") <= 0.02);
    assert_eq!(report["solve"]["reached"], "error");
    assert_eq!(report["solve"]["limit"], Value::Null);
    assert_eq!(report["settings"]["error"], 0.02);
    // The last level of the curve is the statement itself.
    let curve = report["curve"].as_array().unwrap();
    assert_eq!(curve.last().unwrap()["error"], error["total"]);
    assert!(curve.iter().filter(|p| !p["elements"].is_null()).count() >= 2);
    let seconds: Vec<f64> = curve.iter().map(|p| p["seconds"].as_f64().unwrap()).collect();
    assert!(seconds.is_sorted(), "time goes on from level to level");
    // The box is closed: its points see nothing but form factors that sum to 1.
    assert!((error["rows"]["least"].as_f64().unwrap() - 1.0).abs() < 1e-9);
    assert!(said.contains("error: at most"), "{said}");
}

#[test]
fn stages_and_memory_are_in_the_report() {
    let (report, _) = report(&["--error", "2%"]);
    let stages = report["seconds"]["stages"].as_object().unwrap();
    let seconds: Vec<f64> = stages.values().map(|s| s.as_f64().unwrap()).collect();
    // The box absorbs half of the light: no corrections, and nothing else is left out.
    assert!(stages.iter().all(|(name, s)| name == "correct" || s.as_f64() > Some(0.0)));
    // Clocks that run one at a time, with room for the rounding of their sum.
    assert!(seconds.iter().sum::<f64>() <= report["seconds"]["solve"].as_f64().unwrap() + 1e-9);
    if cfg!(target_os = "linux") {
        // The program alone takes megabytes, the box not many.
        let peak = report["memory"]["peak"].as_u64().unwrap();
        assert!((1_000_000..200_000_000).contains(&peak), "{peak}");
    }
}

#[test]
fn limits_end_the_work_and_say_so() {
    for (limit, value) in
        [("--max-elements", "1500"), ("--max-memory", "15MB"), ("--max-time", "1ms")]
    {
        let (report, said) = report(&["--error", "0.001%", limit, value]);
        assert_eq!(report["solve"]["reached"], "limit", "{limit}");
        assert_eq!(report["solve"]["limit"], limit);
        assert!(said.contains(&format!("{limit} ended the work")), "{said}");
        if limit != "--max-time" {
            // The program alone takes half of the memory.
            let most = if limit == "--max-memory" { 20_000 } else { 1600 };
            assert!(report["mesh"]["elements"].as_u64().unwrap() <= most, "{limit}");
            assert!(report["error"]["total"].as_f64().unwrap() > 1e-5);
        }
    }
}

#[test]
fn a_fixed_mesh_is_stated_unless_that_is_left_out() {
    let (stated, _) = report(&["--elements", "600"]);
    assert!(stated["error"]["total"].as_f64().is_some());
    assert_eq!(stated["solve"]["reached"], "elements");
    let (unstated, _) = report(&["--elements", "600", "--no-statement"]);
    assert_eq!(unstated["error"], Value::Null);
    let form_factors = |report: &Value| report["solve"]["form_factors"].as_u64();
    assert!(form_factors(&unstated) < form_factors(&stated));
    // Twelve elements for twelve triangles: no coarser mesh to compare with.
    let (one, said) = report(&["--elements", "12"]);
    assert_eq!(one["error"]["mesh"], Value::Null);
    assert!(said.contains("one mesh says nothing"), "{said}");
}

#[test]
fn probes_are_written_in_their_order() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let points = "u,v,triangle\n0.25,0.25,0\n0.3,0.3,2\n0.1,0.2,0\n";
    std::fs::write(folder.path().join("points.csv"), points).unwrap();
    let solve = |extra: &[&str]| {
        let mut args = vec!["solve", "box.tri", "--elements", "300", "-o", "a.probe.csv"];
        args.extend(extra);
        radiosity(folder.path(), &args)
    };
    let run = solve(&["--probe", "points.csv"]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let text = std::fs::read_to_string(folder.path().join("a.probe.csv")).unwrap();
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines[0], "triangle,u,v,B_r,B_g,B_b,E_r,E_g,E_b");
    assert!(lines[1].starts_with("0,0.25,0.25,") && lines[3].starts_with("0,0.1,0.2,"));
    // Triangle 2 shines: no less than its emittance, 100·255.
    let shining: f64 = lines[2].split(',').nth(3).unwrap().parse().unwrap();
    assert!(shining >= 25_500.0, "{shining}");
    assert!(run.stderr().contains("at the probes"), "{}", run.stderr());

    std::fs::write(folder.path().join("points.csv"), "triangle,u,v\n12,0,0\n").unwrap();
    let run = solve(&["--probe", "points.csv"]);
    assert_eq!(run.code(), 1);
    assert!(run.stderr().contains("points.csv:2: triangle 12"), "{}", run.stderr());
    assert_eq!(solve(&[]).code(), 2, "where to, but not which");
}

#[test]
fn the_same_statement_on_any_number_of_threads() {
    let error = |threads: &str| {
        let flags = ["--error", "3%", "--threads", threads, "-o", "-"];
        let (report, _) = report(&flags);
        (report["error"].clone(), report["solve"].clone())
    };
    let expected = error("1");
    for threads in ["2", "5"] {
        assert!(error(threads) == expected, "{threads} threads");
    }
}

#[test]
fn little_absorption_is_met_with_corrections() {
    let white = box_tri().replace("200 150 100", "255 255 255");
    let (folder, _) = folder_with("white.tri", white.as_bytes());
    let args = ["solve", "white.tri", "--reflect", "0.999", "--elements", "200", "-o", "-"];
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let said = run.stderr();
    assert!(said.contains("ambient corrections") && said.contains("closed to 1"), "{said}");
    // All that is emitted is absorbed: area 24, lamp 4 square units of reflectance .999·100/255.
    let rows: Vec<Vec<f64>> = run
        .stdout()
        .lines()
        .skip(1)
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    let lamp = |row: &Vec<f64>| row[0] == 2.0 || row[0] == 3.0;
    let absorbed: f64 = rows
        .iter()
        .map(|row| {
            let rho = if lamp(row) { 0.999 * 100.0 / 255.0 } else { 0.999 };
            let emitted = if lamp(row) { 25_500.0 } else { 0.0 };
            row[1] * (row[2] - emitted) / rho * (1.0 - rho)
        })
        .sum();
    assert!((absorbed / (4.0 * 25_500.0) - 1.0).abs() < 2e-3, "{absorbed}");
}
