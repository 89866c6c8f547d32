//! What a case file may say, and what happens when it says something else.

use conformance::case::{Case, Skip};
use conformance::solve::{Engine, ExecutorKind, OccluderKind};

const PLATES: &str = include_str!("../../cases/two_plates_half.json");

#[test]
fn a_skip_leaves_out_all_engines_with_that_part() {
    let mut case = Case::parse("plates", PLATES).unwrap();
    assert!(Engine::all().all(|engine| case.skipped(engine).is_none()));
    let skip: Skip =
        serde_json::from_str(r#"{ "engine": "octree", "reason": "too deep" }"#).unwrap();
    case.skips.push(skip);
    for engine in Engine::all() {
        let expected = (engine.occluder == OccluderKind::Octree).then_some("too deep");
        assert_eq!(case.skipped(engine), expected, "{engine}");
    }
    let pool = PLATES.replacen(
        "\"tolerance\"",
        "\"skips\": [{ \"engine\": \"pool\", \"reason\": \"slow\" }],\n  \"tolerance\"",
        1,
    );
    let case = Case::parse("plates", &pool).unwrap();
    for engine in Engine::all() {
        let expected = (engine.executor != ExecutorKind::Sequential).then_some("slow");
        assert_eq!(case.skipped(engine), expected, "{engine}");
    }
}

#[test]
fn every_occluder_meets_every_executor() {
    let all: Vec<_> = Engine::all().collect();
    assert_eq!((all.len(), all[0]), (9, Engine::FIRST));
    let mut names: Vec<_> = all.iter().map(ToString::to_string).collect();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 9);
}

#[test]
fn a_wrong_file_is_an_error_of_one_line() {
    let parse = |from: &str, to: &str| {
        let text = PLATES.replacen(from, to, 1);
        assert_ne!(text, PLATES, "{from}");
        let case = Case::parse("plates", &text);
        case.and_then(|case| case.scene()).unwrap_err().to_string()
    };
    assert!(parse("\"elements\"", "\"pieces\"").starts_with("plates: unknown field `pieces`"));
    assert!(parse("\"gap\": 0.5", "\"gap\": no").contains("line 5 column"));
    assert_eq!(
        parse("\"lower\": {", "\"floor\": {"),
        "two_plates_half: the geometry has no group floor"
    );
    assert!(parse("[0.8, 0.4, 1.0]", "[0.8, 0.4, 1.1]").starts_with("group upper: "));
    assert!(Case::load("no_such_case").is_err());
}

#[test]
fn an_error_is_measured_where_the_case_says() {
    let case = Case::parse("plates", PLATES).unwrap();
    let scene = case.scene().unwrap();
    let config = radiosity_core::ShootingConfig::until(case.unshot);
    let mut solved = conformance::solve(&scene, 64, config, Engine::FIRST).unwrap();
    // The upper plate's mean is off by the coarse mesh; a dark corner of the lamp is all wrong.
    let (error, group) = case.error(&scene, &solved.solution);
    assert!(group == "upper" && (1e-3..0.1).contains(&error), "{group} {error}");
    solved.solution.elements[0].corner_exitance[1].0[0] = 0.0;
    assert_eq!(case.error(&scene, &solved.solution), (1.0, "lower"));
    solved.solution.elements[0].exitance.0[0] = f64::NAN;
    assert_eq!(case.error(&scene, &solved.solution), (f64::INFINITY, "lower"));
}
