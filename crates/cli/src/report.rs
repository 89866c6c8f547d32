//! The JSON report: wire types at the edge, described in docs/report.md.

mod error;
mod plan;

use std::path::Path;

use radiosity_core::{Exchange, Plan, Reached, Statement, StopReason};
use scene::{Rgb, Scene};
use scene_import::Imported;
use serde::Serialize;

use crate::failure::Failure;
use crate::memory;
use crate::pipeline::{self, Solved};
use crate::prepared::Prepared;
use crate::settings::{Goal, Solve};
use crate::snapshot::Snapshot;
use crate::stages::StageSeconds;
use error::ErrorFacts;
use plan::PlanFacts;

/// Version of the fields and their meaning.
pub(crate) const SCHEMA: u32 = 2;

#[derive(Serialize)]
pub(crate) struct Report {
    schema: u32,
    program: &'static str,
    version: &'static str,
    scene: SceneFacts,
    warnings: Vec<String>,
    settings: Settings,
    mesh: MeshFacts,
    plan: PlanFacts,
    occluder: OccluderFacts,
    solve: SolveFacts,
    error: Option<ErrorFacts>,
    energy: Energy,
    seconds: Seconds,
    memory: Memory,
    curve: Vec<CurvePoint>,
    snapshots: Vec<SnapshotFacts>,
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
    error: Option<f64>,
    converge: Option<f64>,
    elements: Option<usize>,
    max_seconds: Option<f64>,
    max_elements: Option<usize>,
    max_bytes: Option<u64>,
    resume: Option<String>,
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
    covered_triangles: usize,
}

#[derive(Serialize)]
struct OccluderFacts {
    kind: &'static str,
    bytes: usize,
}

#[derive(Serialize)]
struct SolveFacts {
    reached: &'static str,
    limit: Option<&'static str>,
    stopped: &'static str,
    unshot: f64,
    shots: u64,
    rays: u64,
    form_factors: u64,
    directions: u64,
    ambient_corrections: bool,
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
    plan: f64,
    occluder: f64,
    solve: f64,
    stages: StageSeconds,
    output: f64,
}

#[derive(Serialize)]
struct Memory {
    peak: Option<u64>,
}

#[derive(Serialize)]
struct CurvePoint {
    seconds: f64,
    shots: u64,
    rays: u64,
    form_factors: u64,
    unshot: f64,
    /// After a level of refinement.
    elements: Option<usize>,
    error: Option<f64>,
    largest: Option<f64>,
    points: Option<f64>,
}

/// The light on its way.
#[derive(Serialize)]
struct SnapshotFacts {
    number: u32,
    seconds: f64,
    shots: u64,
    unshot: f64,
    elements: usize,
    files: Vec<String>,
}

impl SnapshotFacts {
    fn of(snapshot: &Snapshot) -> Self {
        let Snapshot { number, seconds, elements, work, files } = snapshot;
        Self {
            number: *number,
            seconds: *seconds,
            shots: work.shots,
            unshot: work.unshot,
            elements: *elements,
            files: files.iter().map(|path| path.display().to_string()).collect(),
        }
    }
}

impl CurvePoint {
    fn of(point: &pipeline::CurvePoint) -> Self {
        let known = |x: f64| x.is_finite().then_some(x);
        let statement = point.level.and_then(|(_, statement)| statement);
        let of = |f: fn(&Statement) -> f64| statement.as_ref().map(f).and_then(known);
        Self {
            seconds: point.seconds,
            shots: point.work.shots,
            rays: point.work.rays,
            form_factors: point.work.form_factors,
            unshot: point.work.unshot,
            elements: point.level.map(|(elements, _)| elements),
            error: of(|s| s.triangles.e1.total()),
            largest: of(|s| s.triangles.einf.total()),
            points: of(|s| s.points.e1.total()),
        }
    }
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

/// How the end of refinement is called in reports.
fn reached(reached: Reached) -> &'static str {
    match reached {
        Reached::Error => "error",
        Reached::Elements => "elements",
        Reached::ElementLimit | Reached::SizeLimit | Reached::Stopped => "limit",
        Reached::Unseen => "unseen",
        Reached::Shooting => "shooting",
    }
}

/// What a run of `solve` knows at its end.
pub(crate) struct Run<'a> {
    pub(crate) file: &'a str,
    pub(crate) imported: &'a Imported,
    pub(crate) settings: &'a Solve,
    pub(crate) prepared: &'a Prepared,
    pub(crate) solved: &'a Solved,
    pub(crate) read_seconds: f64,
    pub(crate) output_seconds: f64,
    pub(crate) outputs: Vec<String>,
}

impl Report {
    /// Gathers the report of a run.
    pub(crate) fn of(run: Run) -> Self {
        let Run { prepared, solved, settings, .. } = run;
        let (read, limits, refined) = (&settings.read, &settings.limits, &solved.refined);
        let (ledger, work) = (&refined.ledger, &refined.total_work);
        let channels = |Rgb(c): Rgb| c;
        let error = |s: &Statement| ErrorFacts::of(s, refined.closed_rows);
        Self {
            schema: SCHEMA,
            program: "radiosity",
            version: env!("CARGO_PKG_VERSION"),
            scene: SceneFacts::of(run.file, run.imported),
            warnings: run.imported.diagnostics.iter().map(ToString::to_string).collect(),
            settings: Settings {
                error: match settings.goal {
                    Goal::Error(target) => Some(target),
                    Goal::Mesh { .. } => None,
                },
                converge: match settings.goal {
                    Goal::Error(_) => None,
                    Goal::Mesh { converge, .. } => Some(converge),
                },
                elements: settings.work.elements,
                max_seconds: limits.time.map(|t| t.as_secs_f64()),
                max_elements: limits.elements,
                max_bytes: limits.memory,
                resume: settings.keeping.resume.as_ref().map(|path| path.display().to_string()),
                exchange: match read.exchange {
                    Exchange::OneSided => "one-sided",
                    Exchange::Paired => "paired",
                },
                threads: prepared.threads(),
                light: read.options.tri_light,
                reflect: read.options.tri_reflect,
            },
            mesh: MeshFacts {
                elements: refined.mesh.elements().len(),
                patches: refined.mesh.patches().len(),
                receiver_points: refined.mesh.points().len(),
                covered_triangles: refined.mesh.covered(),
            },
            plan: PlanFacts::of(&prepared.plan, Some((refined, solved.seconds))),
            occluder: OccluderFacts {
                kind: prepared.occluder_name,
                bytes: prepared.occluder_bytes,
            },
            solve: SolveFacts {
                reached: reached(refined.reached),
                limit: solved.limit,
                stopped: reason(refined.reason),
                unshot: work.unshot,
                shots: work.shots,
                rays: work.rays,
                form_factors: work.form_factors,
                directions: work.directions,
                ambient_corrections: refined.corrected,
            },
            error: refined.statement.as_ref().map(error),
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
                plan: prepared.plan_seconds,
                occluder: prepared.occluder_seconds,
                solve: solved.seconds,
                stages: solved.stages,
                output: run.output_seconds,
            },
            memory: Memory { peak: memory::peak() },
            curve: solved.curve.iter().map(CurvePoint::of).collect(),
            snapshots: solved.snapshots.iter().map(SnapshotFacts::of).collect(),
            outputs: run.outputs,
        }
    }

    /// The name of the scene's file.
    #[cfg(feature = "html")]
    pub(crate) fn file(&self) -> &str {
        &self.scene.file
    }

    /// The report as what is written of it.
    #[cfg(feature = "html")]
    pub(crate) fn value(&self) -> serde_json::Value {
        serde_json::to_value(self).expect("all fields have names and are numbers or text")
    }

    /// Writes the report, all of it or not at all.
    pub(crate) fn write(&self, path: &Path) -> Result<(), Failure> {
        write(path, self)
    }
}

/// The report of `plan`.
#[derive(Serialize)]
pub(crate) struct PlanReport {
    schema: u32,
    program: &'static str,
    version: &'static str,
    scene: SceneFacts,
    warnings: Vec<String>,
    plan: PlanFacts,
}

impl PlanReport {
    /// Of a scene that is not solved.
    pub(crate) fn of(file: &str, imported: &Imported, plan: &Plan) -> Self {
        Self {
            schema: SCHEMA,
            program: "radiosity",
            version: env!("CARGO_PKG_VERSION"),
            scene: SceneFacts::of(file, imported),
            warnings: imported.diagnostics.iter().map(ToString::to_string).collect(),
            plan: PlanFacts::of(plan, None),
        }
    }

    /// Writes the report, all of it or not at all.
    pub(crate) fn write(&self, path: &Path) -> Result<(), Failure> {
        write(path, self)
    }
}

fn write(path: &Path, report: &impl Serialize) -> Result<(), Failure> {
    output::replace_file(path, |out| {
        serde_json::to_writer_pretty(&mut *out, report).map_err(std::io::Error::from)?;
        Ok(writeln!(out)?)
    })?;
    Ok(())
}
