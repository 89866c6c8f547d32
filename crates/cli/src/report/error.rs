//! The statement as the report's wire types.

use radiosity_core::{Parts, Stated, Statement};
use serde::Serialize;

/// Parts of a relative error; `null` is unknown.
#[derive(Clone, Copy, Serialize)]
struct ErrorParts {
    total: Option<f64>,
    iteration: Option<f64>,
    form_factor: Option<f64>,
    mesh: Option<f64>,
}

/// An error in two measures: E1 in the open, Einf beside it.
#[derive(Clone, Copy, Serialize)]
struct StatedFacts {
    #[serde(flatten)]
    e1: ErrorParts,
    largest: ErrorParts,
}

#[derive(Clone, Copy, Serialize)]
pub(super) struct ErrorFacts {
    #[serde(flatten)]
    triangles: StatedFacts,
    points: StatedFacts,
    probes: Option<StatedFacts>,
    rows: RowFacts,
    sample: usize,
}

/// Sums of form factors, before any closure.
#[derive(Clone, Copy, Serialize)]
struct RowFacts {
    least: f64,
    most: f64,
    closed: Option<[f64; 2]>,
}

impl ErrorParts {
    fn of(parts: &Parts) -> Self {
        let known = |x: f64| x.is_finite().then_some(x);
        Self {
            total: known(parts.total()),
            iteration: known(parts.iteration),
            form_factor: known(parts.form_factor),
            mesh: known(parts.mesh),
        }
    }
}

impl StatedFacts {
    fn of(stated: &Stated) -> Self {
        Self { e1: ErrorParts::of(&stated.e1), largest: ErrorParts::of(&stated.einf) }
    }
}

impl ErrorFacts {
    pub(super) fn of(statement: &Statement, closed: Option<[f64; 2]>) -> Self {
        let [least, most] = statement.rows;
        Self {
            triangles: StatedFacts::of(&statement.triangles),
            points: StatedFacts::of(&statement.points),
            probes: statement.probes.as_ref().map(StatedFacts::of),
            rows: RowFacts { least, most, closed },
            sample: statement.sample,
        }
    }
}
