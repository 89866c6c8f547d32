//! The plan as the report has it: decisions, and work foreseen beside work done.

use radiosity_core::plan::Work;
use radiosity_core::{Plan, Refined};
use serde::Serialize;

/// A plan.
#[derive(Serialize)]
pub(crate) struct PlanFacts {
    decisions: Vec<DecisionFacts>,
    foreseen: WorkFacts,
    /// If nothing were left out.
    everything: WorkFacts,
    /// What it was, after a solve.
    actual: Option<WorkFacts>,
}

#[derive(Serialize)]
struct DecisionFacts {
    topic: &'static str,
    choice: String,
    leaves_out: bool,
    why: String,
    saves: Saving,
    effect: &'static str,
}

#[derive(Serialize)]
struct Saving {
    form_factors: f64,
    segments: f64,
    directions: f64,
    seconds: f64,
}

/// Work, with the seconds that it would take on one thread, or took.
#[derive(Serialize)]
pub(crate) struct WorkFacts {
    elements: f64,
    shots: f64,
    form_factors: f64,
    segments: f64,
    directions: f64,
    seconds: f64,
}

impl PlanFacts {
    /// Of a plan; `solved` with the seconds that it took.
    pub(crate) fn of(plan: &Plan, solved: Option<(&Refined, f64)>) -> Self {
        let decisions = plan.decisions.iter().map(|d| DecisionFacts {
            topic: d.topic.name(),
            choice: d.choice.clone(),
            leaves_out: d.leaves_out,
            why: d.why.clone(),
            saves: Saving {
                form_factors: d.saves.form_factors.round(),
                segments: d.saves.segments.round(),
                directions: d.saves.directions.round(),
                seconds: d.saves.seconds,
            },
            effect: d.effect.text(),
        });
        Self {
            decisions: decisions.collect(),
            foreseen: WorkFacts::of(&plan.planned),
            everything: WorkFacts::of(&plan.everything),
            actual: solved.map(|(refined, seconds)| WorkFacts::done(refined, seconds)),
        }
    }
}

impl WorkFacts {
    fn of(work: &Work) -> Self {
        Self {
            elements: work.elements.round(),
            shots: work.shots.round(),
            form_factors: work.form_factors.round(),
            segments: work.segments.round(),
            directions: work.directions.round(),
            seconds: work.seconds,
        }
    }

    fn done(refined: &Refined, seconds: f64) -> Self {
        let work = &refined.total_work;
        Self {
            elements: refined.mesh.elements().len() as f64,
            shots: work.shots as f64,
            form_factors: work.form_factors as f64,
            segments: work.rays as f64,
            directions: work.directions as f64,
            seconds,
        }
    }
}
