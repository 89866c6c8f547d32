//! The JSON report: wire types at the edge, described in docs/report.md.

use std::path::Path;

use radiosity_core::{Exchange, StepReport, StopReason};
use scene::{Rgb, Scene};
use scene_import::Imported;
use serde::Serialize;

use crate::failure::Failure;
use crate::pipeline::{Prepared, Solved};
use crate::settings::Read;

/// Version of the fields and their meaning.
const SCHEMA: u32 = 1;

#[derive(Serialize)]
pub(crate) struct Report {
    schema: u32,
    program: &'static str,
    version: &'static str,
    scene: SceneFacts,
    warnings: Vec<String>,
    settings: Settings,
    mesh: MeshFacts,
    occluder: OccluderFacts,
    solve: SolveFacts,
    energy: Energy,
    seconds: Seconds,
    curve: Vec<CurvePoint>,
    outputs: Vec<String>,
}

/// What the scene file held.
#[derive(Serialize)]
pub(crate) struct SceneFacts {
    file: String,
    format: String,
    triangles: usize,
    emitters: usize,
    materials: usize,
    groups: usize,
    area: f64,
    low: [f64; 3],
    high: [f64; 3],
}

#[derive(Serialize)]
struct Settings {
    converge: f64,
    exchange: &'static str,
    threads: usize,
    light: f64,
    reflect: f64,
}

#[derive(Serialize)]
struct MeshFacts {
    elements: usize,
    patches: usize,
    receiver_points: usize,
}

#[derive(Serialize)]
struct OccluderFacts {
    kind: &'static str,
    bytes: usize,
}

#[derive(Serialize)]
struct SolveFacts {
    stopped: &'static str,
    unshot: f64,
    shots: u64,
    rays: u64,
    form_factors: u64,
}

#[derive(Serialize)]
struct Energy {
    emitted: [f64; 3],
    absorbed: [f64; 3],
    escaped: [f64; 3],
    form_factor_defect: [f64; 3],
    wrong_side: [f64; 3],
    unshot: [f64; 3],
    imbalance: f64,
}

#[derive(Serialize)]
struct Seconds {
    read: f64,
    mesh: f64,
    occluder: f64,
    census: f64,
    shooting: f64,
    output: f64,
}

#[derive(Serialize)]
struct CurvePoint {
    seconds: f64,
    shots: u64,
    rays: u64,
    form_factors: u64,
    unshot: f64,
}

impl SceneFacts {
    fn of(file: &str, imported: &Imported) -> Self {
        let scene = &imported.scene;
        let (low, high) = scene.bounds().unwrap_or_default();
        Self {
            file: file.to_owned(),
            format: imported.summary.format.to_string(),
            triangles: scene.triangles().len(),
            emitters: imported.summary.emitters,
            materials: scene.materials().len(),
            groups: scene.groups().len(),
            area: total_area(scene),
            low: low.to_array(),
            high: high.to_array(),
        }
    }
}

/// The area of all triangles, one side.
pub(crate) fn total_area(scene: &Scene) -> f64 {
    scene.ids().map(|id| scene.area(id)).sum()
}

/// How a stop is called in reports.
pub(crate) fn reason(reason: StopReason) -> &'static str {
    match reason {
        StopReason::Converged => "converged",
        StopReason::NoLight => "no light",
        StopReason::ShotLimit => "shot limit",
        StopReason::Stopped => "stopped",
        StopReason::Stalled => "stalled",
        StopReason::Singular => "singular",
        StopReason::Diverged => "diverged",
    }
}

/// What a run of `solve` knows at its end.
pub(crate) struct Run<'a> {
    pub(crate) file: &'a str,
    pub(crate) imported: &'a Imported,
    pub(crate) read: &'a Read,
    pub(crate) converge: f64,
    pub(crate) prepared: &'a Prepared,
    pub(crate) solved: &'a Solved,
    pub(crate) read_seconds: f64,
    pub(crate) output_seconds: f64,
    pub(crate) outputs: Vec<String>,
}

impl Report {
    /// Gathers the report of a run.
    pub(crate) fn of(run: Run) -> Self {
        let Run { prepared, solved, read, .. } = run;
        let ledger = &solved.ledger;
        let channels = |Rgb(c): Rgb| c;
        let point = |(seconds, step): &(f64, StepReport)| CurvePoint {
            seconds: *seconds,
            shots: step.shots,
            rays: step.rays,
            form_factors: step.form_factors,
            unshot: step.unshot,
        };
        Self {
            schema: SCHEMA,
            program: "radiosity",
            version: env!("CARGO_PKG_VERSION"),
            scene: SceneFacts::of(run.file, run.imported),
            warnings: run.imported.diagnostics.iter().map(ToString::to_string).collect(),
            settings: Settings {
                converge: run.converge,
                exchange: match read.exchange {
                    Exchange::OneSided => "one-sided",
                    Exchange::Paired => "paired",
                },
                threads: prepared.threads(),
                light: read.options.tri_light,
                reflect: read.options.tri_reflect,
            },
            mesh: MeshFacts {
                elements: prepared.mesh.elements().len(),
                patches: prepared.mesh.patches().len(),
                receiver_points: prepared.mesh.points().len(),
            },
            occluder: OccluderFacts {
                kind: prepared.occluder_name,
                bytes: prepared.occluder_bytes,
            },
            solve: SolveFacts {
                stopped: reason(solved.reason),
                unshot: solved.work.unshot,
                shots: solved.work.shots,
                rays: solved.work.rays,
                form_factors: solved.work.form_factors,
            },
            energy: Energy {
                emitted: channels(ledger.emitted),
                absorbed: channels(ledger.absorbed),
                escaped: channels(ledger.escaped),
                form_factor_defect: channels(ledger.form_factor_defect),
                wrong_side: channels(ledger.wrong_side),
                unshot: channels(ledger.unshot),
                imbalance: ledger.imbalance(),
            },
            seconds: Seconds {
                read: run.read_seconds,
                mesh: prepared.mesh_seconds,
                occluder: prepared.occluder_seconds,
                census: prepared.census_seconds,
                shooting: solved.seconds,
                output: run.output_seconds,
            },
            curve: solved.curve.iter().map(point).collect(),
            outputs: run.outputs,
        }
    }

    /// Writes the report, all of it or not at all.
    pub(crate) fn write(&self, path: &Path) -> Result<(), Failure> {
        output::replace_file(path, |out| {
            serde_json::to_writer_pretty(&mut *out, self).map_err(std::io::Error::from)?;
            Ok(writeln!(out)?)
        })?;
        Ok(())
    }
}
