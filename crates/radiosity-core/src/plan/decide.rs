//! The decisions, one function each, in the order of the way of the light.

mod light;
mod sight;

use accel::{Nothing, Proofs, Proven};
use scene::Scene;

use super::predict::{Shape, Way, Work};
use super::{Decision, Facts, Plan, PlanConfig, Structure};
use crate::config::{Exchange, MeshConfig};
use crate::mesh::Mesh;
use crate::needs::Needs;
use crate::shooting::{SEGMENT_LIFT, survey};

/// Elements of the mesh that is looked at.
const LOOKED_AT: usize = 1000;

/// A solve shorter than this is not worth looking at its mesh first.
const WORTH_LOOKING: f64 = 0.1;

impl Plan {
    /// Decides what a solve of a scene does and leaves out.
    ///
    /// Pure: the same for the same scene and configuration, whatever the machine does meanwhile.
    /// Time: some microseconds a triangle, and for solves of more than about a tenth of a second,
    /// that of making a mesh of a thousand elements.
    #[must_use]
    pub fn of(scene: &Scene, config: &PlanConfig) -> Self {
        let facts = Facts::of(scene);
        let mut draft = Draft::new(&facts, config);
        let pieces = facts.triangles as f64 * if facts.two_sided { 2.0 } else { 1.0 };
        let mut shape = Shape { facts: &facts, config, pieces, survey: None };
        let guess = shape.work(draft.way());
        if guess.seconds >= WORTH_LOOKING && config.exchange == Exchange::OneSided {
            let mesh = Mesh::from_scene(scene, &MeshConfig::with_elements(LOOKED_AT));
            shape.pieces = mesh.roots().len() as f64;
            shape.survey = Some(survey(&mesh, &Proven::new(&Nothing, &draft.proofs)));
        }
        let everything = shape.work(Way { walls: 0, things: 0, spaces: false, ..draft.way() });
        draft.decide(&shape);
        let planned = shape.work(draft.way());
        let all_block = draft.blockers == facts.triangles;
        let Draft { needs, structure, proofs, correction, threads, decisions, .. } = draft;
        Self {
            all_block,
            decisions,
            needs,
            structure,
            proofs,
            correction,
            threads,
            planned,
            everything,
            facts,
        }
    }
}

/// A plan on its way.
struct Draft<'a> {
    facts: &'a Facts,
    config: &'a PlanConfig,
    needs: Needs,
    structure: Structure,
    blockers: usize,
    proofs: Proofs,
    correction: crate::config::Correction,
    threads: usize,
    decisions: Vec<Decision>,
}

impl<'a> Draft<'a> {
    /// Everything is needed, and all that is known is used.
    fn new(facts: &'a Facts, config: &'a PlanConfig) -> Self {
        let lift = SEGMENT_LIFT * facts.extent;
        let proofs = Proofs {
            walls: facts.walls.clone(),
            objects: facts.objects.clone(),
            spaces: facts.spaces.clone(),
            lift,
        };
        Self {
            facts,
            config,
            needs: Needs::EVERYTHING,
            structure: config.structure.unwrap_or(Structure::Bvh),
            blockers: facts.triangles,
            proofs,
            correction: config.correction,
            threads: config.threads.unwrap_or(config.available),
            decisions: Vec::new(),
        }
    }

    fn way(&self) -> Way<'_> {
        Way {
            needs: &self.needs,
            structure: self.structure,
            blockers: self.blockers,
            walls: self.proofs.walls.len(),
            things: self.proofs.objects.as_ref().map_or(0, |o| o.len().max(1)),
            spaces: self.proofs.spaces.shells() > 0,
        }
    }

    fn decide(&mut self, shape: &Shape) {
        if self.config.everything || self.config.exchange == Exchange::Paired {
            self.proofs = Proofs { objects: None, lift: self.proofs.lift, ..Proofs::default() };
        }
        self.decide_sight(shape);
        self.decide_light(shape);
    }

    /// The work that is spared by a change.
    fn spared(&mut self, shape: &Shape, change: impl FnOnce(&mut Self)) -> Work {
        let before = shape.work(self.way());
        change(self);
        before - shape.work(self.way())
    }

    /// Whether anything may be left out at all.
    fn free(&self) -> bool {
        !self.config.everything
    }
}
