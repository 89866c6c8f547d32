//! One mesh of the ladder, lit.

use accel::{Bvh, Occluder};
use scene::{Rgb, Scene, Solution};

use super::difference::Lit;
use super::mark;
use super::place::{self, Probe};
use super::sample::{self, Sampled};
use super::statement::Measured;
use super::surface::{Counted, Sides};
use super::{Asked, RefineConfig};
use crate::census::Census;
use crate::config::{MeshConfig, ShootingConfig, Split};
use crate::energy::Ledger;
use crate::executor::Executor;
use crate::mesh::Mesh;
use crate::observer::{Control, Observer, StepReport};
use crate::shooting::{Shooting, StopReason};

/// Share of the asked error that unshot light may take.
const ITERATION_SHARE: f64 = 0.1;

/// What the bound may be on the first level, whatever is asked: its mesh errs by more, and no
/// statement can come of it alone.
const FIRST_ITERATION: f64 = 5e-3;

/// How often the unshot share is lowered before the bound is taken as it is.
const MOST_TIGHTENINGS: u32 = 12;

/// A mesh with its light and what is known of it.
pub(super) struct Level {
    pub(super) mesh: Mesh,
    pub(super) solution: Solution,
    pub(super) ledger: Ledger,
    pub(super) reason: StopReason,
    pub(super) work: StepReport,
    pub(super) corrected: bool,
    pub(super) closed_rows: Option<[f64; 2]>,
    /// Exitance at the probes.
    pub(super) probes: Vec<Rgb>,
    pub(super) counted: Counted,
    /// There is light, and surfaces that could reflect it, but none was found on them: then
    /// nothing is known of what was missed.
    pub(super) unseen: bool,
    pub(super) iteration: Measured,
    pub(super) sampled: Sampled,
}

/// What all levels have in common.
pub(super) struct Setting<'a, E: Executor> {
    pub(super) scene: &'a Scene,
    pub(super) bvh: &'a Bvh,
    pub(super) occluder: &'a dyn Occluder,
    pub(super) executor: &'a E,
    pub(super) config: ShootingConfig,
    pub(super) refining: RefineConfig,
    pub(super) probes: &'a [Probe],
}

impl<E: Executor> Setting<'_, E> {
    /// The mesh of about so many elements: of elements of one size, or finer than the one before
    /// where its light says so.
    pub(super) fn mesh(&self, elements: usize, before: Option<&Level>) -> Mesh {
        let RefineConfig { least_area, most_depth, split, .. } = self.refining;
        let config =
            MeshConfig { least_area, most_depth, split, ..MeshConfig::with_elements(elements) };
        match before {
            Some(level) if self.adaptive() => {
                let Level { mesh, solution, counted, .. } = level;
                let mean = Sides::of(self.scene, mesh, solution, *counted).mean();
                let density = mark::densities(level.lit(), mean, *counted, self.executor);
                mesh.refined(&density, &config)
            }
            _ => Mesh::from_scene(self.scene, &config),
        }
    }

    /// Whether levels follow the light.
    pub(super) fn adaptive(&self) -> bool {
        matches!(self.refining.asked, Asked::Error(_)) && self.refining.split != Split::None
    }

    /// Shoots on a mesh until what is unshot no longer matters or the observer says stop.
    pub(super) fn level(&self, mesh: Mesh, first: bool, observer: &mut impl Observer) -> Level {
        let (scene, executor) = (self.scene, self.executor);
        let census = Census::take(scene, &mesh, self.bvh, self.config.exchange, executor);
        let receivers: Vec<_> = self.probes.iter().filter_map(|p| p.receiver(scene)).collect();
        let (occluder, config) = (self.occluder, self.config);
        let mut shooting =
            Shooting::with_probes(&mesh, occluder, &census, executor, config, &receivers);
        let counted = Counted::of(&mesh);
        let reason = self.shoot(&mesh, &mut shooting, counted, first, observer);
        let solution = shooting.solution();
        let whole = Sides::of(scene, &mesh, &solution, counted);
        let remaining = shooting.remaining();
        let sampled = if self.refining.asked.stated() {
            sample::form_factors(scene, &mesh, &shooting, &solution, counted)
        } else {
            Sampled::default()
        };
        let iteration = Measured {
            e1: remaining.power.share_of(whole.power),
            einf: remaining.local.share_of(whole.mean()),
        };
        let received = shooting.at_probes();
        let probes = place::exitance(scene, &mesh, &solution, self.probes, received);
        let could = mesh
            .elements
            .iter()
            .any(|e| counted.counts(&mesh, e) && mesh.root_of(e).reflectance != Rgb::ZERO);
        let lit = reason != StopReason::NoLight;
        Level {
            unseen: lit && could && whole.power == Rgb::ZERO,
            probes,
            ledger: shooting.ledger(),
            work: shooting.report(),
            corrected: shooting.corrected(),
            closed_rows: shooting.closed_rows(),
            solution,
            reason,
            counted,
            iteration,
            sampled,
            mesh,
        }
    }

    /// Shoots to the asked unshot share, or until the bound on what is missing is a small
    /// share of the asked error.
    fn shoot(
        &self,
        mesh: &Mesh,
        shooting: &mut Shooting<'_, E>,
        counted: Counted,
        first: bool,
        observer: &mut impl Observer,
    ) -> StopReason {
        let Asked::Error(target) = self.refining.asked else { return shooting.run(observer) };
        let most = (ITERATION_SHARE * target).max(if first { FIRST_ITERATION } else { 0.0 });
        let mut unshot = most;
        for _ in 0..MOST_TIGHTENINGS {
            shooting.tighten(unshot);
            let reason = shooting.run(observer);
            if reason != StopReason::Converged {
                return reason;
            }
            let missing = self.missing(mesh, shooting, counted);
            if missing <= most {
                return reason;
            }
            if shooting.complete(observer) == Control::Stop {
                return StopReason::Stopped;
            }
            let missing = self.missing(mesh, shooting, counted);
            // A little further than needed, and never so far that one loose bound costs sweeps.
            unshot *= (0.95 * most / missing).clamp(0.1, 0.9);
        }
        StopReason::Converged
    }

    /// The bound on what further shooting would add, relative, worst channel.
    fn missing(&self, mesh: &Mesh, shooting: &Shooting<'_, E>, counted: Counted) -> f64 {
        let whole = Sides::of(self.scene, mesh, &shooting.solution(), counted);
        shooting.remaining().power.share_of(whole.power).max_channel()
    }
}

impl Level {
    pub(super) fn lit(&self) -> Lit<'_> {
        Lit { mesh: &self.mesh, solution: &self.solution }
    }

    pub(super) fn elements(&self) -> usize {
        self.mesh.elements().len()
    }
}
