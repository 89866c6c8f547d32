//! The JSON report of `form-factors`: wire types at the edge.

use std::path::Path;

use radiosity_core::matrix::{Between, Closed, Matrix, RowSum};
use scene_import::{Imported, SidesRule};
use serde::Serialize;

use super::Found;
use crate::failure::Failure;
use crate::settings::FormFactors;

/// Version of the fields and their meaning.
const SCHEMA: u32 = 1;

#[derive(Serialize)]
pub(super) struct Report {
    schema: u32,
    program: &'static str,
    version: &'static str,
    command: &'static str,
    scene: SceneFacts,
    warnings: Vec<String>,
    settings: Settings,
    matrix: MatrixFacts,
    raw: Raw,
    closed: Option<ClosedFacts>,
    seconds: Seconds,
    outputs: Vec<String>,
}

#[derive(Serialize)]
struct SceneFacts {
    file: String,
    format: String,
    triangles: usize,
    groups: usize,
}

#[derive(Serialize)]
struct Settings {
    between: &'static str,
    tolerance: f64,
    sides: &'static str,
    close: bool,
    threads: usize,
}

#[derive(Serialize)]
struct MatrixFacts {
    rows: usize,
    stored: usize,
    pairs: u64,
    lit_pairs: u64,
    visibility_pairs: u64,
    effort: u64,
}

/// The matrix as computed, before any repair.
#[derive(Serialize)]
struct Raw {
    lowest_row: Row,
    highest_row: Row,
    worst_row: Row,
    closure_defect: f64,
    reciprocity_defect: f64,
    error: f64,
    row_error: f64,
}

#[derive(Serialize)]
struct Row {
    row: usize,
    name: String,
    sum: f64,
}

#[derive(Serialize)]
struct ClosedFacts {
    before: f64,
    after: f64,
    change: f64,
    relative_change: f64,
    rounds: u32,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    form_factors: f64,
    output: f64,
}

impl Report {
    /// Gathers the report of a run.
    pub(super) fn of(
        settings: &FormFactors,
        imported: &Imported,
        found: &Found,
        outputs: Vec<String>,
    ) -> Self {
        let (computed, raw) = (&found.computed, &found.raw);
        let row = |row| Row::of(&computed.matrix, row);
        Self {
            schema: SCHEMA,
            program: "radiosity",
            version: env!("CARGO_PKG_VERSION"),
            command: "form-factors",
            scene: SceneFacts {
                file: settings.scene.display().to_string(),
                format: imported.summary.format.to_string(),
                triangles: imported.summary.triangles,
                groups: imported.summary.groups,
            },
            warnings: imported.diagnostics.iter().map(ToString::to_string).collect(),
            settings: Settings {
                between: match found.between {
                    Between::Groups => "groups",
                    Between::Triangles => "triangles",
                },
                tolerance: settings.tolerance,
                sides: match settings.options.sides {
                    SidesRule::Scene => "scene",
                    SidesRule::Front => "front",
                    SidesRule::Both => "both",
                },
                close: settings.close,
                threads: found.threads,
            },
            matrix: MatrixFacts {
                rows: computed.matrix.len(),
                stored: computed.matrix.values().len(),
                pairs: computed.pairs,
                lit_pairs: computed.lit,
                visibility_pairs: computed.visibility,
                effort: computed.effort,
            },
            raw: Raw {
                lowest_row: row(raw.lowest),
                highest_row: row(raw.highest),
                worst_row: row(raw.worst()),
                closure_defect: raw.closure(),
                reciprocity_defect: found.reciprocity,
                error: raw.error,
                row_error: raw.row_error,
            },
            closed: found.closed.map(ClosedFacts::of),
            seconds: Seconds {
                read: found.read_seconds,
                form_factors: found.compute_seconds,
                output: found.output_seconds,
            },
            outputs,
        }
    }

    /// Writes the report, all of it or not at all.
    pub(super) fn write(&self, path: &Path) -> Result<(), Failure> {
        output::replace_file(path, |out| {
            serde_json::to_writer_pretty(&mut *out, self).map_err(std::io::Error::from)?;
            Ok(writeln!(out)?)
        })?;
        Ok(())
    }
}

impl Row {
    fn of(matrix: &Matrix, RowSum { row, sum }: RowSum) -> Self {
        Self { row, name: matrix.names()[row].clone(), sum }
    }
}

impl ClosedFacts {
    fn of(closed: Closed) -> Self {
        let Closed { before, after, change, relative_change, rounds } = closed;
        Self { before, after, change, relative_change, rounds }
    }
}
