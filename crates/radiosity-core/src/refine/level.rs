//! One mesh of the ladder, lit.

use accel::{Bvh, Occluder};
use scene::{Rgb, Scene, Solution};

use super::difference::Lit;
use super::place::{self, Probe};
use super::sample::{self, Sampled};
use super::statement::Measured;
use super::surface::{Counted, Sides};
use super::{Asked, RefineConfig};
use crate::census::Census;
use crate::config::ShootingConfig;
use crate::energy::Ledger;
use crate::executor::Executor;
use crate::mesh::{Mesh, ReceiverPoint};
use crate::observer::{Control, Observer, Stage, StepReport};
use crate::reconstruct::Light;
use crate::shooting::{Course, Progress, Shooting, StopReason};

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
    /// What the solution is made of.
    pub(super) light: Light,
    pub(super) ledger: Ledger,
    pub(super) reason: StopReason,
    pub(super) work: StepReport,
    pub(super) corrected: bool,
    pub(super) closed_rows: Option<[f64; 2]>,
    /// Irradiance at the probes.
    pub(super) probes: Vec<Rgb>,
    pub(super) counted: Counted,
    /// There is light, and surfaces that could reflect it, but none was found on them: then
    /// nothing is known of what was missed.
    pub(super) unseen: bool,
    pub(super) iteration: Measured,
    /// `None` if the work was stopped before that was known, or it was left out.
    pub(super) sampled: Option<Sampled>,
    /// Whether it was not left out.
    pub(super) estimated: bool,
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
    /// The probes that shots have to reach.
    pub(super) fn receivers(&self) -> Vec<ReceiverPoint> {
        self.probes.iter().filter_map(|p| p.receiver(self.scene)).collect()
    }

    /// Shoots on a mesh until what is unshot no longer matters or the observer says stop; from
    /// where it was `kept` on, if it was. Its form factors are `estimated` a second time, or not. A level that is stopped before its first step shows what
    /// its surfaces emit.
    pub(super) fn level(
        &self,
        mesh: Mesh,
        first: bool,
        estimated: bool,
        kept: Option<Progress>,
        observer: &mut impl Observer,
    ) -> Level {
        let (scene, executor) = (self.scene, self.executor);
        let (stopper, exchange) = (observer.stopper(), self.config.exchange);
        observer.stage(Stage::Census);
        let census = match self.config.needs.census {
            true => {
                Census::take_unless(scene, &mesh, self.bvh, exchange, executor, stopper.as_ref())
            }
            false => Some(Census::closed()),
        };
        let stopped = census.is_none();
        let census = census.unwrap_or_default();
        observer.stage(Stage::Select);
        let receivers = self.receivers();
        let (occluder, config) = (self.occluder, self.config);
        let mut shooting =
            Shooting::with_probes(&mesh, occluder, &census, executor, config, &receivers);
        if let Some(progress) = kept {
            shooting.restore(progress);
        }
        let counted = Counted::of(&mesh);
        let reason = if stopped {
            StopReason::Stopped
        } else {
            self.shoot(&mesh, &mut shooting, counted, first, observer)
        };
        observer.stage(Stage::Statement);
        let shown = shooting.shown();
        let solution = shooting.solution_showing(&shown);
        let whole = Sides::of(scene, &mesh, &solution, counted);
        let remaining = shooting.remaining();
        let sampled = match (self.refining.asked.stated(), reason) {
            (false, _) => Some(Sampled::default()),
            (true, StopReason::Converged | StopReason::ShotLimit) if !estimated => None,
            (true, StopReason::Stopped) => None,
            (true, _) => {
                let stopper = stopper.as_ref();
                sample::form_factors(scene, &mesh, &shooting, &solution, counted, stopper)
            }
        };
        if stopped || sampled.is_none() && estimated && reason != StopReason::Stopped {
            shooting.hand_out(observer);
        }
        let iteration = Measured {
            e1: remaining.power.share_of(whole.power),
            einf: remaining.local.share_of(whole.mean()),
        };
        let received = shooting.at_probes();
        let could = mesh
            .elements
            .iter()
            .any(|e| counted.counts(&mesh, e) && mesh.root_of(e).reflectance != Rgb::ZERO);
        let lit = reason != StopReason::NoLight;
        let (ledger, work) = (shooting.ledger(), shooting.report());
        let (corrected, closed_rows) = (shooting.corrected(), shooting.closed_rows());
        let light = shooting.into_light(shown);
        Level {
            unseen: lit && could && whole.power == Rgb::ZERO,
            probes: place::irradiance(scene, &mesh, &light, self.probes, &received),
            ledger,
            work,
            corrected,
            closed_rows,
            solution,
            light,
            reason,
            counted,
            iteration,
            sampled,
            estimated,
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
        if shooting.course().tightened == 0 {
            shooting.tighten(most);
        }
        loop {
            // A level that was kept may have been past this.
            if !shooting.course().completing {
                let reason = shooting.run(observer);
                observer.stage(Stage::Statement);
                if reason != StopReason::Converged || self.missing(mesh, shooting, counted) <= most
                {
                    return reason;
                }
            }
            observer.stage(Stage::Select);
            if shooting.complete(observer) == Control::Stop {
                return StopReason::Stopped;
            }
            observer.stage(Stage::Statement);
            let Course { unshot, tightened, .. } = shooting.course();
            if tightened >= MOST_TIGHTENINGS {
                return StopReason::Converged;
            }
            let missing = self.missing(mesh, shooting, counted);
            // A little further than needed, and never so far that one loose bound costs sweeps.
            shooting.tighten(unshot * (0.95 * most / missing).clamp(0.1, 0.9));
        }
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
