//! Names are text, whatever they hold.

use serde_json::{Value, json};
use viewer::Page;

use crate::common::{scene, shown};

/// What ends a script, begins a comment, or is a line end to older readers.
const HOSTILE: &str = "</script><script>alert(1)</script><!-- \u{2028} & \" ' \\";

#[test]
fn no_name_ends_the_element_it_stands_in() {
    let (scene, solution) = scene();
    let report = json!({ "scene": { "file": HOSTILE } });
    let mut bytes = Vec::new();
    Page::new(HOSTILE, &shown(&scene, &solution), &report).unwrap().write(&mut bytes).unwrap();
    let page = String::from_utf8(bytes).unwrap();
    // As many elements as without any name.
    let mut plain = Vec::new();
    Page::new("", &shown(&scene, &solution), &Value::Null).unwrap().write(&mut plain).unwrap();
    let plain = String::from_utf8(plain).unwrap();
    for mark in ["<script", "</script", "<!--", "-->", "</title"] {
        assert_eq!(page.matches(mark).count(), plain.matches(mark).count(), "{mark}");
    }
    let facts = page.split_once("id=\"facts\">").unwrap().1.split_once("</script>").unwrap().0;
    let facts: Value = serde_json::from_str(facts).unwrap();
    assert_eq!(facts["title"], HOSTILE);
    assert_eq!(facts["report"], report);
}

#[test]
fn what_no_page_can_hold_is_refused_in_one_line() {
    let (scene, mut solution) = scene();
    let say = |solution: &scene::Solution, exposure: f64| {
        let shown = viewer::Shown { exposure, ..shown(&scene, solution) };
        Page::new("", &shown, &Value::Null).map(drop).map_err(|e| e.to_string())
    };
    assert_eq!(say(&solution, 1.0), Ok(()));
    assert_eq!(say(&solution, f64::NAN).unwrap_err(), "exposure: expected a finite number above 0");
    solution.elements[1].exitance.0[2] = f64::NAN;
    let message = say(&solution, 1.0).unwrap_err();
    assert_eq!(message, "element 1: exitance is not finite, or too large for single precision");
    solution.elements[0].vertices[1] = scene::VertexId(99);
    let message = say(&solution, 1.0).unwrap_err();
    assert_eq!(message, "element 0: names a triangle or a vertex that is not there");
    solution.vertices[3].y = f64::INFINITY;
    assert_eq!(say(&solution, 1.0).unwrap_err(), "solution vertex 3: a coordinate is not finite");
}
