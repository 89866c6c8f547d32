//! What `--log json` says: an object a line, described in docs/log.md.

use radiosity_core::{Ledger, LevelReport, Parts, Plan, Refined, Statement, StepReport};
use scene::Rgb;
use scene_import::Imported;
use serde::Serialize;

/// Version of the kinds of lines, their fields and their meaning.
const VERSION: u32 = 1;

/// Something worth a line.
#[derive(Serialize)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub(crate) enum Event<'a> {
    /// The first line.
    Start {
        log: u32,
        program: &'a str,
        version: &'a str,
    },
    /// A line of text that has no fields.
    Message {
        text: String,
    },
    /// What should be looked at.
    Warning {
        text: &'a str,
    },
    /// Why the program fails.
    Error {
        text: &'a str,
        exit_code: u8,
    },
    Scene(SceneFacts<'a>),
    Plan(PlanFacts),
    /// Work of another kind begins.
    Stage {
        stage: &'static str,
        level: Option<u32>,
        elements: Option<u64>,
        left_seconds: Option<f64>,
    },
    Step(StepFacts),
    Level(LevelFacts),
    /// The last mesh.
    Mesh {
        elements: u64,
        patches: u64,
        receiver_points: u64,
        covered_triangles: u64,
        occluders: &'a str,
        threads: u64,
    },
    /// All that was done.
    Work {
        #[serde(flatten)]
        work: WorkFacts,
        ambient_corrections: bool,
    },
    /// What ended the work before its goal.
    Limit {
        limit: &'a str,
        text: &'a str,
    },
    Statement(StatementFacts),
    /// Sums of form factors before rows were closed.
    Rows {
        least: f64,
        most: f64,
    },
    Energy(EnergyFacts),
    /// Light on its way was written.
    Snapshot {
        number: u32,
        #[serde(flatten)]
        work: WorkFacts,
        elements: u64,
        files: Vec<String>,
    },
    Time {
        read_seconds: f64,
        plan_seconds: f64,
        occluder_seconds: f64,
        solve_seconds: f64,
        output_seconds: f64,
    },
    Written {
        files: &'a [String],
    },
}

/// What the scene file held.
#[derive(Serialize)]
pub(crate) struct SceneFacts<'a> {
    file: &'a str,
    format: String,
    triangles: u64,
    emitters: u64,
    materials: u64,
    groups: u64,
}

/// What is left out, and the work foreseen.
#[derive(Serialize)]
pub(crate) struct PlanFacts {
    left_out: Vec<&'static str>,
    foreseen_elements: f64,
    foreseen_shots: f64,
    foreseen_form_factors: f64,
    foreseen_segments: f64,
    foreseen_seconds_on_one_thread: f64,
}

/// Work so far, on all levels.
#[derive(Serialize)]
pub(crate) struct WorkFacts {
    shots: u64,
    segments: u64,
    form_factors: u64,
    directions: u64,
    unshot_share: f64,
}

/// A step on its way.
#[derive(Serialize)]
pub(crate) struct StepFacts {
    pub(crate) level: u32,
    pub(crate) elements: Option<u64>,
    #[serde(flatten)]
    pub(crate) work: WorkFacts,
    pub(crate) segments_per_second: f64,
    /// What is left, as far as that is foreseen.
    pub(crate) left_seconds: Option<f64>,
}

/// A level of refinement that is done.
#[derive(Serialize)]
pub(crate) struct LevelFacts {
    level: u32,
    elements: u64,
    patches: u64,
    #[serde(flatten)]
    work: WorkFacts,
    #[serde(flatten)]
    error: ErrorShares,
}

/// A relative error in parts; `null` is unknown.
#[derive(Default, Serialize)]
struct ErrorShares {
    error_share: Option<f64>,
    iteration_share: Option<f64>,
    form_factor_share: Option<f64>,
    mesh_share: Option<f64>,
}

/// How wrong the light may be.
#[derive(Serialize)]
pub(crate) struct StatementFacts {
    #[serde(flatten)]
    triangles: ErrorShares,
    largest_share: Option<f64>,
    points_share: Option<f64>,
    points_largest_share: Option<f64>,
    probes_share: Option<f64>,
    least_row: f64,
    most_row: f64,
    sampled_elements: u64,
}

/// Where the emitted power went.
#[derive(Serialize)]
pub(crate) struct EnergyFacts {
    emitted_power: [f64; 3],
    absorbed_power: [f64; 3],
    escaped_power: [f64; 3],
    form_factor_defect_power: [f64; 3],
    wrong_side_power: [f64; 3],
    unshot_power: [f64; 3],
    imbalance_share: f64,
}

fn known(x: f64) -> Option<f64> {
    x.is_finite().then_some(x)
}

impl Event<'_> {
    pub(super) fn start() -> Self {
        Self::Start { log: VERSION, program: "radiosity", version: env!("CARGO_PKG_VERSION") }
    }

    pub(crate) fn level(level: u32, report: &LevelReport) -> Self {
        Self::Level(LevelFacts {
            level,
            elements: report.elements as u64,
            patches: report.patches as u64,
            work: WorkFacts::of(&report.work),
            error: report.statement.map(|s| ErrorShares::of(&s.triangles.e1)).unwrap_or_default(),
        })
    }

    pub(crate) fn mesh(refined: &Refined, occluders: &'static str, threads: usize) -> Self {
        Self::Mesh {
            elements: refined.mesh.elements().len() as u64,
            patches: refined.mesh.patches().len() as u64,
            receiver_points: refined.mesh.points().len() as u64,
            covered_triangles: refined.mesh.covered() as u64,
            occluders,
            threads: threads as u64,
        }
    }

    pub(crate) fn work(refined: &Refined) -> Self {
        let work = WorkFacts::of(&refined.total_work);
        Self::Work { work, ambient_corrections: refined.corrected }
    }

    pub(crate) fn statement(statement: &Statement) -> Self {
        let [least_row, most_row] = statement.rows;
        let (triangles, points) = (&statement.triangles, &statement.points);
        Self::Statement(StatementFacts {
            triangles: ErrorShares::of(&triangles.e1),
            largest_share: known(triangles.einf.total()),
            points_share: known(points.e1.total()),
            points_largest_share: known(points.einf.total()),
            probes_share: statement.probes.and_then(|probes| known(probes.e1.total())),
            least_row,
            most_row,
            sampled_elements: statement.sample as u64,
        })
    }

    pub(crate) fn energy(ledger: &Ledger) -> Self {
        let channels = |Rgb(c): Rgb| c;
        Self::Energy(EnergyFacts {
            emitted_power: channels(ledger.emitted),
            absorbed_power: channels(ledger.absorbed),
            escaped_power: channels(ledger.escaped),
            form_factor_defect_power: channels(ledger.form_factor_defect),
            wrong_side_power: channels(ledger.wrong_side),
            unshot_power: channels(ledger.unshot),
            imbalance_share: ledger.imbalance(),
        })
    }

    pub(crate) fn plan(plan: &Plan) -> Self {
        let left_out = plan.decisions.iter().filter(|decision| decision.leaves_out);
        let planned = &plan.planned;
        Self::Plan(PlanFacts {
            left_out: left_out.map(|decision| decision.topic.name()).collect(),
            foreseen_elements: planned.elements.round(),
            foreseen_shots: planned.shots.round(),
            foreseen_form_factors: planned.form_factors.round(),
            foreseen_segments: planned.segments.round(),
            foreseen_seconds_on_one_thread: planned.seconds,
        })
    }
}

impl<'a> Event<'a> {
    pub(crate) fn scene(file: &'a str, imported: &Imported) -> Self {
        let (summary, scene) = (&imported.summary, &imported.scene);
        Self::Scene(SceneFacts {
            file,
            format: summary.format.to_string(),
            triangles: scene.triangles().len() as u64,
            emitters: summary.emitters as u64,
            materials: scene.materials().len() as u64,
            groups: scene.groups().len() as u64,
        })
    }
}

impl WorkFacts {
    pub(crate) fn of(work: &StepReport) -> Self {
        Self {
            shots: work.shots,
            segments: work.rays,
            form_factors: work.form_factors,
            directions: work.directions,
            unshot_share: work.unshot,
        }
    }
}

impl ErrorShares {
    fn of(parts: &Parts) -> Self {
        Self {
            error_share: known(parts.total()),
            iteration_share: known(parts.iteration),
            form_factor_share: known(parts.form_factor),
            mesh_share: known(parts.mesh),
        }
    }
}
