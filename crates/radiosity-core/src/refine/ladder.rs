//! How many elements each level has, and what its predecessors say of it.

mod keep;

use scene::Solution;

use super::difference;
use super::growth::Growth;
use super::level::{Level, Setting};
use super::place;
use super::sample::Sampled;
use super::statement::{
    Measured, Parts, Statement, Step, foreseen, mesh_error, stated, unbalanced,
};
use super::{Asked, Reached, RefineConfig, Refined};
use crate::checkpoint::Kept;
use crate::executor::Executor;
use crate::mesh::Mesh;
use crate::observer::{Control, LevelReport, Observer, Stage, StepReport, Stopper};
use crate::shooting::{Progress, StopReason};
use keep::Climb;
pub(crate) use keep::Climbed;

/// Elements of the first level, or the scene's own triangles if those are more.
const FIRST_ELEMENTS: usize = 100;

/// No mesh with fewer elements ends the work, however good it seems: too little of the scene is
/// seen for its differences to say anything.
const LEAST_ELEMENTS: usize = 1000;

/// Growth of the elements from level to level.
const GROWTH: f64 = 4.0;

/// The next level aims below the asked error by this factor: estimates scatter.
const AIM: f64 = 0.8;

/// Least growth that is worth a level.
const LEAST_GROWTH: f64 = 1.5;

/// Least growth of a mesh of which that was asked: closure and limits on the size of elements leave
/// some out.
const LEAST_FINER: f64 = 1.25;

/// Where no surface but lamps was seen to receive light by a mesh of so many elements, finer ones are
/// not tried.
const MOST_UNSEEN: usize = 20_000;

/// A finished level with what the levels before say of it.
pub(super) struct Rung {
    level: Level,
    /// The step that led here.
    step: Option<[Step; 3]>,
    mesh_errors: [Measured; 3],
    /// Of its own form factors, or, where it was stopped before, of those of the level before.
    sampled: Sampled,
}

pub(super) struct Ladder<'a, E: Executor> {
    pub(super) setting: Setting<'a, E>,
    /// Work on finished levels.
    pub(super) base: StepReport,
    /// The way to the present level's mesh.
    pub(super) grown: Vec<Growth>,
    pub(super) done: Option<Rung>,
}

impl<'a, E: Executor> Ladder<'a, E> {
    /// Below the first level.
    pub(super) fn new(setting: Setting<'a, E>) -> Self {
        Self { setting, base: StepReport::default(), grown: Vec::new(), done: None }
    }

    pub(super) fn climb(&mut self, observer: &mut impl Observer) -> Refined {
        observer.stage(Stage::Mesh);
        let mut elements = self.first();
        let allowed = observer.elements(elements);
        if allowed < elements {
            self.limit(allowed);
            elements = self.first();
        }
        let level = self.solve(elements, observer);
        self.climb_from(level, observer)
    }

    /// Climbs on from a level that is lit.
    fn climb_from(&mut self, mut level: Level, observer: &mut impl Observer) -> Refined {
        let stopper = observer.stopper();
        loop {
            let reason = level.reason;
            observer.stage(Stage::Statement);
            let rung = self.place(level);
            let statement = self.statement(&rung);
            observer.level(&LevelReport {
                elements: rung.level.elements(),
                patches: rung.level.mesh.patches().len(),
                work: self.base,
                statement,
            });
            let reached = match reason {
                StopReason::Stopped => Reached::Stopped,
                StopReason::Converged | StopReason::ShotLimit => {
                    // It has said what it knows: its room is for the next one.
                    self.done = None;
                    observer.stage(Stage::Mesh);
                    match self.next_allowed(&rung, statement.as_ref(), stopper.as_ref(), observer) {
                        Ok(more) => match self.finer(more, &rung.level) {
                            Some(mesh) => {
                                self.done = Some(rung);
                                level = self.light(mesh, None, observer);
                                continue;
                            }
                            None => Reached::SizeLimit,
                        },
                        Err(reached) => reached,
                    }
                }
                _ => Reached::Shooting,
            };
            let left_out = !rung.level.estimated && reached != Reached::Stopped;
            if left_out && matches!(reason, StopReason::Converged | StopReason::ShotLimit) {
                // The last one after all: memory allows no other.
                let Rung { level, step, mesh_errors, .. } = rung;
                let level = self.light_and(true, level.mesh, None, observer);
                let sampled = level.sampled.unwrap_or(Sampled::UNKNOWN);
                let rung = Rung { level, step, mesh_errors, sampled };
                let statement = self.statement(&rung);
                return self.finish(rung, statement, reached);
            }
            return self.finish(rung, statement, reached);
        }
    }

    /// Never more elements than these from now on.
    fn limit(&mut self, elements: usize) {
        let most = &mut self.setting.refining.most_elements;
        *most = elements.clamp(1, *most);
    }

    /// How many elements the next level has by the observer's leave, or why there is none.
    fn next_allowed(
        &mut self,
        rung: &Rung,
        statement: Option<&Statement>,
        stopper: Option<&Stopper>,
        observer: &mut impl Observer,
    ) -> Result<usize, Reached> {
        let planned = self.next(rung, statement)?;
        if stopper.is_some_and(|stop| stop()) {
            return Err(Reached::Stopped);
        }
        let allowed = observer.elements(planned);
        if allowed >= planned {
            return Ok(planned);
        }
        self.limit(allowed);
        self.next(rung, statement)
    }

    /// How many elements the first level has.
    fn first(&self) -> usize {
        let most = self.setting.refining.most_elements;
        match self.setting.refining.asked {
            Asked::Error(_) => FIRST_ELEMENTS.min(most),
            Asked::Unstated(n) => n.min(most),
            // Two levels below the asked one, as far as the scene's own pieces allow.
            Asked::Elements(n) => {
                let n = n.min(most);
                let least = Mesh::from_scene(self.setting.scene, &self.setting.least());
                let least = least.elements().len();
                let start = n as f64 / (GROWTH * GROWTH);
                let coarser = n as f64 / GROWTH;
                if start >= least as f64 {
                    start as usize
                } else if coarser >= least as f64 {
                    coarser as usize
                } else if n as f64 >= LEAST_GROWTH * least as f64 {
                    least
                } else {
                    n
                }
            }
        }
    }

    /// How many elements the next level has, or why there is none.
    fn next(&self, rung: &Rung, statement: Option<&Statement>) -> Result<usize, Reached> {
        let (have, most) = (rung.level.elements(), self.setting.refining.most_elements);
        match self.setting.refining.asked {
            Asked::Unstated(n) if n > most => Err(Reached::ElementLimit),
            Asked::Unstated(_) => Err(Reached::Elements),
            Asked::Elements(asked) => {
                let n = asked.min(most);
                if have as f64 * LEAST_GROWTH > n as f64 {
                    return Err(if n < asked { Reached::ElementLimit } else { Reached::Elements });
                }
                let more = (have as f64 * GROWTH).ceil() as usize;
                // No level shortly below the asked one.
                Ok(if more as f64 * LEAST_GROWTH > n as f64 { n } else { more })
            }
            Asked::Error(target) => {
                let parts = statement.map_or_else(Parts::default, |s| s.triangles.e1);
                let seen = have >= LEAST_ELEMENTS.min(most);
                if statement.is_some() && parts.total() <= target && seen {
                    return Err(Reached::Error);
                }
                if rung.level.unseen && have >= MOST_UNSEEN {
                    return Err(Reached::Unseen);
                }
                let left = target * AIM - parts.iteration - parts.form_factor;
                // No level that is too coarse to be the last one, however little is asked.
                let least = if seen { LEAST_GROWTH } else { GROWTH };
                let wanted = if parts.mesh.is_finite() && left > 0.0 {
                    (parts.mesh / left).powi(2).clamp(least, GROWTH)
                } else {
                    GROWTH
                };
                let more = (have as f64 * wanted).ceil();
                if more <= most as f64 {
                    Ok(more as usize)
                } else if have as f64 * LEAST_GROWTH <= most as f64 {
                    Ok(most)
                } else {
                    Err(Reached::ElementLimit)
                }
            }
        }
    }

    /// The first level.
    fn solve(&mut self, elements: usize, observer: &mut impl Observer) -> Level {
        let growth = self.setting.growth(elements, None);
        let mesh = self.setting.mesh(&growth, None);
        self.grown.push(growth);
        self.light(mesh, None, observer)
    }

    /// The next level's mesh, or `None` where it may hardly be split any more: levels on meshes that
    /// are nearly the same agree, and would say that the error is small.
    fn finer(&mut self, elements: usize, before: &Level) -> Option<Mesh> {
        let growth = self.setting.growth(elements, Some(before));
        let mesh = self.setting.mesh(&growth, Some(&before.mesh));
        let least = before.elements() as f64 * LEAST_FINER;
        (mesh.elements().len() as f64 >= least).then(|| {
            self.grown.push(growth);
            mesh
        })
    }

    /// Lights the present level's mesh, from where it was `kept` on, if it was.
    fn light(&mut self, mesh: Mesh, kept: Option<Progress>, observer: &mut impl Observer) -> Level {
        let estimated = self.may_be_last(mesh.elements().len());
        self.light_and(estimated, mesh, kept, observer)
    }

    /// The same, with a second estimate of its form factors if it is to be `estimated`.
    fn light_and(
        &mut self,
        estimated: bool,
        mesh: Mesh,
        kept: Option<Progress>,
        observer: &mut impl Observer,
    ) -> Level {
        let base = self.base;
        let most_elements = self.setting.refining.most_elements;
        let done = self.done.as_ref();
        let climb = Climb { base, most_elements, grown: &self.grown, done };
        let mut relay = Relay { climb, observer };
        let first = done.is_none();
        let level = self.setting.level(mesh, first, estimated, kept, &mut relay);
        self.base = base.and(&level.work);
        level
    }

    /// Whether the work may end with a mesh of so many elements. If not, what its form factors err by
    /// decides nothing.
    fn may_be_last(&self, elements: usize) -> bool {
        let RefineConfig { asked, most_elements, least_area, most_depth, .. } =
            self.setting.refining;
        let asked = match asked {
            Asked::Error(_) => usize::MAX,
            Asked::Elements(n) | Asked::Unstated(n) => n,
        };
        let most = asked.min(most_elements);
        let limited = least_area > 0.0 || most_depth < u32::MAX;
        self.setting.config.needs.early_estimates
            || limited
            || elements >= LEAST_ELEMENTS
            || elements as f64 * LEAST_GROWTH > most as f64
    }

    /// Compares a level with the one before.
    fn place(&self, level: Level) -> Rung {
        let Some(before) = &self.done else {
            let sampled = level.sampled.unwrap_or(Sampled::UNKNOWN);
            return Rung { level, step: None, mesh_errors: [Measured::UNKNOWN; 3], sampled };
        };
        let sampled = level.sampled.unwrap_or(before.sampled);
        let (from, to) = (before.level.elements(), level.elements());
        if level.reason == StopReason::Stopped {
            let mesh_errors = before.mesh_errors.map(|e| foreseen(e, from, to));
            return Rung { level, step: None, mesh_errors, sampled };
        }
        let (scene, counted) = (self.setting.scene, level.counted);
        let (coarse, fine) = (before.level.lit(), level.lit());
        let differences = [
            difference::of_triangles(scene, coarse, fine, counted),
            difference::of_points(scene, coarse, fine, counted),
            difference::of_places(scene, self.setting.probes, &before.level.probes, &level.probes),
        ];
        let finer = difference::finer(&before.level.mesh, &level.mesh);
        let step = differences.map(|difference| Step { difference, finer });
        let mut mesh_errors = [Measured::UNKNOWN; 3];
        for (i, error) in mesh_errors.iter_mut().enumerate() {
            *error = mesh_error(before.step.map(|s| s[i]), step[i]);
        }
        Rung { level, step: Some(step), mesh_errors, sampled }
    }

    fn statement(&self, rung: &Rung) -> Option<Statement> {
        if !self.setting.refining.asked.stated() {
            return None;
        }
        let (sampled, Level { iteration, probes, .. }) = (&rung.sampled, &rung.level);
        let [triangles, points, places] = match rung.level.unseen {
            true => [Measured::UNKNOWN; 3],
            // A balance that is sampled in part says nothing.
            false if !self.setting.config.needs.black => rung.mesh_errors,
            false => rung.mesh_errors.map(|e| e.at_least(unbalanced(&rung.level.ledger))),
        };
        Some(Statement {
            triangles: stated(*iteration, sampled.triangles, triangles),
            points: stated(*iteration, sampled.points, points),
            probes: (!probes.is_empty()).then(|| stated(*iteration, sampled.points, places)),
            rows: sampled.rows,
            sample: sampled.elements,
        })
    }

    /// The result: of a level that was cut short and the one before, the better one.
    fn finish(&mut self, rung: Rung, statement: Option<Statement>, reached: Reached) -> Refined {
        let (rung, statement) = match self.done.take() {
            Some(before) if reached == Reached::Stopped => {
                let earlier = self.statement(&before);
                let total =
                    |s: &Option<Statement>| s.map_or(f64::INFINITY, |s| s.triangles.e1.total());
                if total(&earlier) <= total(&statement) {
                    (before, earlier)
                } else {
                    (rung, statement)
                }
            }
            _ => (rung, statement),
        };
        // A level that was cut short may state what was asked all the same.
        let reached = match (self.setting.refining.asked, reached, &statement) {
            (Asked::Error(target), Reached::Stopped, Some(s))
                if s.triangles.e1.total() <= target =>
            {
                Reached::Error
            }
            _ => reached,
        };
        let level = rung.level;
        Refined {
            mesh: level.mesh,
            solution: level.solution,
            statement,
            ledger: level.ledger,
            reason: level.reason,
            reached,
            work: level.work,
            total_work: StepReport { unshot: level.work.unshot, ..self.base },
            corrected: level.corrected,
            closed_rows: level.closed_rows,
            probes: place::exitance(self.setting.scene, self.setting.probes, &level.probes),
            probe_irradiance: level.probes,
        }
    }
}

/// Adds the work of earlier levels to what the observer hears, and the ladder to what it keeps.
struct Relay<'a, O: Observer> {
    climb: Climb<'a>,
    observer: &'a mut O,
}

impl<O: Observer> Observer for Relay<'_, O> {
    fn stage(&mut self, stage: Stage) {
        self.observer.stage(stage);
    }

    fn step(&mut self, step: &StepReport) -> Control {
        self.observer.step(&self.climb.base.and(step))
    }

    fn stopper(&self) -> Option<Stopper> {
        self.observer.stopper()
    }

    fn wants_solution(&mut self, step: &StepReport) -> bool {
        self.observer.wants_solution(&self.climb.base.and(step))
    }

    fn solution(&mut self, step: &StepReport, mesh: &Mesh, solution: &Solution) {
        self.observer.solution(&self.climb.base.and(step), mesh, solution);
    }

    fn keeps(&mut self) -> bool {
        self.observer.keeps()
    }

    fn keep(&mut self, kept: &Kept<'_>) {
        self.observer.keep(&kept.within(&self.climb));
    }
}

impl StepReport {
    /// The work of both, with the unshot share of the later.
    fn and(&self, later: &Self) -> Self {
        Self {
            shots: self.shots + later.shots,
            rays: self.rays + later.rays,
            form_factors: self.form_factors + later.form_factors,
            directions: self.directions + later.directions,
            unshot: later.unshot,
        }
    }
}
