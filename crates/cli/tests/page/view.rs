//! One solve, its page, its table of triangles and its report: the page says what they say.

use std::path::Path;

use serde_json::Value;

use crate::browser::Browser;
use crate::support::{box_tri, folder_with, radiosity};

/// Two columns of six digits, and single precision.
const DIGITS: f64 = 1e-5;

fn solve(folder: &Path) {
    let args = ["solve", "box.tri", "--error", "5%", "-o", "a.html", "-o", "a.glb", "-o", "a.csv"];
    let run = radiosity(folder, &[&args[..], &["--report", "a.json"]].concat());
    assert_eq!(run.code(), 0, "{}", run.stderr());
}

/// The page's data element of a name, as JSON.
fn facts(path: &Path) -> Value {
    let text = std::fs::read_to_string(path).unwrap();
    let facts = text.split_once("id=\"facts\">").unwrap().1.split_once("</script>").unwrap().0;
    serde_json::from_str(facts).unwrap()
}

#[test]
fn a_page_shows_what_the_solve_knew() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    solve(folder.path());
    let report: Value =
        serde_json::from_str(&std::fs::read_to_string(folder.path().join("a.json")).unwrap())
            .unwrap();
    let shown = facts(&folder.path().join("a.html"));
    assert_eq!(shown["title"], "box.tri");
    for part in ["error", "plan", "curve", "energy", "mesh"] {
        assert_eq!(shown["report"][part], report[part], "{part}");
    }

    let Some(mut browser) = Browser::start(1000, 600) else { return };
    browser.open(&folder.path().join("a.html"));
    let stated = browser.number("[data-error=total]");
    assert_eq!(stated, report["error"]["total"].as_f64().unwrap());
    let topics = browser.value("document.querySelectorAll('[data-topic]').length");
    assert_eq!(topics.as_u64(), report["plan"]["decisions"].as_array().map(|d| d.len() as u64));
    // A point for each level whose statement is known.
    let known =
        report["curve"].as_array().unwrap().iter().filter(|p| !p["error"].is_null()).count();
    assert_eq!(browser.value("document.querySelectorAll('.plot circle').length"), known);
    let levels =
        report["curve"].as_array().unwrap().iter().filter(|p| !p["elements"].is_null()).count();
    assert!(known > 0 && levels > known);

    // All means of elements, weighed by area, are the table's row of their triangle.
    let table = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    for (x, y) in [(200.0, 200.0), (350.0, 300.0), (500.0, 450.0)] {
        browser.click(x, y);
        let triangle: usize = browser.text("[data-of=triangle]").parse().unwrap();
        let reflectance = browser.number("[data-of=reflectance][data-channel=g]");
        let emittance = browser.number("[data-of=emittance][data-channel=g]");
        let here = browser.number("[data-of=exitance-here][data-channel=g]");
        let irradiance = browser.number("[data-of=irradiance-here][data-channel=g]");
        assert!((emittance + reflectance * irradiance - here).abs() <= DIGITS * here);
        // 0.5 · 150/255 for walls, 0.5 · 100/255 for the lamp: the colours in `box_tri`.
        let front = if (2..4).contains(&triangle) { 100.0 } else { 150.0 };
        assert!((reflectance - 0.5 * front / 255.0).abs() < 1e-12, "{triangle}: {reflectance}");
        // No wall of this box is twice as bright at one place as on the whole.
        assert!((0.3..3.0).contains(&(here / rows[triangle][3])), "{here}, {:?}", rows[triangle]);
    }
    assert!(browser.requests().iter().all(|a| a.starts_with("file://") || a.starts_with("data:")));
    assert_eq!(browser.complaints(), Vec::<String>::new());
}

#[test]
fn a_lit_file_is_viewed_with_the_same_light() {
    // The bundled Cornell box, which has a camera.
    let folder = tempfile::tempdir().unwrap();
    let args = ["solve", "--error", "8%", "-o", "a.html", "-o", "a.glb", "--report", "a.json"];
    let run = radiosity(folder.path(), &args);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    let run = radiosity(folder.path(), &["view", "a.glb", "--report", "a.json", "-o", "b.html"]);
    assert_eq!(run.code(), 0, "{}", run.stderr());
    assert_eq!(facts(&folder.path().join("b.html"))["report"]["schema"], 2);
    let Some(mut browser) = Browser::start(1000, 600) else { return };
    let mut light = Vec::new();
    for page in ["a.html", "b.html"] {
        browser.open(&folder.path().join(page));
        // The wall at the end.
        browser.click(250.0, 200.0);
        light.push(browser.number("[data-of=exitance-here][data-channel=r]"));
        // The exposure of a solve is in its .glb.
        light.push(browser.picture().at(450, 200)[0].into());
        assert_eq!(browser.complaints(), Vec::<String>::new(), "{page}");
    }
    let (solved, viewed) = light.split_at(2);
    assert!((solved[0] - viewed[0]).abs() <= DIGITS * solved[0], "{light:?}");
    assert!(
        (solved[1] - viewed[1]).abs() <= 2.0 && (60.0..250.0).contains(&solved[1]),
        "{light:?}"
    );
}

#[test]
fn what_cannot_be_viewed_is_refused_in_one_line() {
    let (folder, _) = folder_with("box.tri", box_tri().as_bytes());
    let cases: &[(&[&str], i32, &str)] = &[
        (
            &["view", "box.tri", "-o", "a.html"],
            1,
            "box.tri: expected a .glb that `radiosity solve` wrote",
        ),
        (&["view", "none.glb", "-o", "a.html"], 1, "none.glb: "),
        (&["view", "box.tri", "-o", "a.htm"], 2, "a.htm: expected a name that ends in .html"),
        (&["view", "a.html", "-o", "a.html"], 2, "a.html: is what is read"),
        (&["view", "box.tri", "-o", "no/a.html"], 1, "there is no folder no"),
        (&["view", "box.tri", "-o", "a.html", "--exposure", "99"], 2, "--exposure: expected"),
    ];
    for (args, code, message) in cases {
        let run = radiosity(folder.path(), args);
        let said = run.stderr();
        assert_eq!((run.code(), said.lines().count()), (*code, 1), "{args:?}: {said}");
        assert!(said.contains(message), "{args:?}: {said}");
    }
    assert!(!folder.path().join("a.html").exists());
    // A plan's report is none of a solve.
    let run = radiosity(folder.path(), &["plan", "box.tri", "--report", "plan.json"]);
    assert_eq!(run.code(), 0);
    let args = ["convert", "box.tri", "unlit.glb"];
    assert_eq!(radiosity(folder.path(), &args).code(), 0);
    let run =
        radiosity(folder.path(), &["view", "unlit.glb", "--report", "plan.json", "-o", "a.html"]);
    assert_eq!(run.code(), 1);
    assert!(run.stderr().contains("plan.json: expected what `solve --report` wrote, schema 2"));
}
