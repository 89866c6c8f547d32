//! The exact solutions that lie beside the checkout.

use std::path::Path;

use serde_json::Value;

/// The solution of this name in `cases/form_factors_and_solutions.json`, or `None`, said
/// aloud, where there is no such file.
pub(super) fn solution(id: &str) -> Option<Value> {
    let cases = "shared/cases/form_factors_and_solutions.json";
    let folders = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors();
    let Some(path) = folders.map(|folder| folder.join(cases)).find(|path| path.exists()) else {
        println!("skipped: there is no {cases} beside the checkout");
        return None;
    };
    let all: Value = serde_json::from_slice(&std::fs::read(path).unwrap()).unwrap();
    let mut solutions = all["solutions"].as_array().unwrap().iter();
    let found = solutions.find(|solution| solution["id"] == id);
    Some(found.unwrap_or_else(|| panic!("no solution is called {id}")).clone())
}

/// A list of numbers, written as numbers or as text.
pub(super) fn numbers(list: &Value) -> Vec<f64> {
    list.as_array().unwrap().iter().map(number).collect()
}

/// A number, written as one or as text.
pub(super) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| value.as_str().unwrap().parse().unwrap())
}
