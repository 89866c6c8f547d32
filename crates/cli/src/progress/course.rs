//! What is left of a solve: foreseen by the plan at first, then by what its levels have really cost.
//!
//! How right this is, and where not: docs/progress.md.

mod ladder;
mod shape;

use radiosity_core::plan::Work;
use radiosity_core::{Asked, LevelReport, StepReport};

use ladder::{Ahead, Judged};
use shape::Shape;

/// How the seconds of shooting and of the statement grow with the elements, where no two levels tell: the
/// middle of what docs/progress.md measured.
const SHOOTING_GROWTH: f64 = 0.7;
const STATEMENT_GROWTH: f64 = 0.6;

/// Measured growth of the shooting is believed within these.
const GROWTHS: (f64, f64) = (0.5, 1.3);

/// Form factors that take as long as the statement of a mesh of so many elements, where none was made yet:
/// cornell, blocks, room, gallery and hall lie within a factor of two.
const STATEMENT: f64 = 1.2e6;
const STATEMENT_ELEMENTS: f64 = 1500.0;

/// Meshes of fewer elements get no second estimate of their form factors.
const JUDGED: f64 = 1000.0;

/// Planned seconds are those of a good machine; the rest is a guess that the first steps replace.
const SLOWER: f64 = 1.5;

/// The share of a level after which its own speed says how long it takes.
const TELLING: f64 = 0.6;

/// Work that takes longer than foreseen takes this share longer still.
const LONGER: f64 = 0.05;

/// Elements of a level and of the one before, about; shooting on levels before the last adds its share
/// to the planned work.
const LEVELS: f64 = 4.0;

/// What is known of a solve before it begins.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Foreseen {
    pub(crate) asked: Asked,
    /// Unshot share at which a fixed mesh is done.
    pub(crate) converge: f64,
    /// The work of the plan.
    pub(crate) planned: Work,
    pub(crate) threads: usize,
    /// Triangles of the scene: no mesh has fewer elements.
    pub(crate) triangles: usize,
    pub(crate) most_elements: usize,
    /// Seconds after which the work ends in any case.
    pub(crate) most_seconds: Option<f64>,
}

/// How far a solve is. Seconds are those since it began.
pub(crate) struct Course {
    foreseen: Foreseen,
    /// Form factors of the last level's shooting, as planned.
    form_factors: f64,
    done: Vec<Done>,
    judged: Judged,
    /// Form factors of the levels that are done.
    before: u64,
    now: Option<Now>,
}

/// A level that is done, its statement with it.
struct Done {
    elements: f64,
    shooting: f64,
    statement: f64,
    /// Seconds of a form factor.
    each: f64,
    shape: Shape,
}

/// The present level.
struct Now {
    elements: f64,
    began: f64,
    shape: Shape,
    last: Option<Last>,
}

/// Its last step.
#[derive(Clone, Copy)]
struct Last {
    unshot: f64,
    form_factors: f64,
    /// Since the level began.
    seconds: f64,
}

impl Last {
    /// Seconds of a form factor.
    fn each(&self) -> f64 {
        self.seconds / self.form_factors.max(1.0)
    }
}

impl Course {
    pub(crate) fn of(foreseen: Foreseen) -> Self {
        let before = 1.0 / LEVELS.powf(SHOOTING_GROWTH);
        let last = match foreseen.asked {
            Asked::Error(_) => 1.0 / (1.0 + before + before * before),
            Asked::Elements(_) | Asked::Unstated(_) => 1.0,
        };
        Self {
            foreseen,
            form_factors: foreseen.planned.form_factors * last,
            done: Vec::new(),
            judged: Judged::default(),
            before: 0,
            now: None,
        }
    }

    /// A level begins, with so many elements as planned.
    pub(crate) fn planned(&mut self, elements: usize, seconds: f64) {
        let least = elements.max(self.foreseen.triangles).max(1) as f64;
        let elements = match self.foreseen.asked {
            // The plan knows into how many pieces triangles are cut.
            Asked::Elements(n) | Asked::Unstated(n) if elements >= n => {
                least.max(self.foreseen.planned.elements)
            }
            _ => least,
        };
        self.now = Some(Now { elements, began: seconds, shape: Shape::default(), last: None });
    }

    /// A step is done.
    pub(crate) fn step(&mut self, report: &StepReport, seconds: f64) {
        let Some(now) = &mut self.now else { return };
        let seconds = seconds - now.began;
        now.shape.hear(report.unshot, seconds);
        let form_factors = report.form_factors.saturating_sub(self.before) as f64;
        now.last = Some(Last { unshot: report.unshot, form_factors, seconds });
    }

    /// A level is done.
    pub(crate) fn level(&mut self, report: &LevelReport, seconds: f64) {
        self.before = report.work.form_factors;
        self.judged = Judged::of(report);
        let Some(Now { began, shape, last: Some(last), .. }) = self.now.take() else { return };
        self.done.push(Done {
            elements: report.elements.max(1) as f64,
            shooting: last.seconds,
            statement: (seconds - began - last.seconds).max(0.0),
            each: last.each(),
            shape,
        });
    }

    /// Seconds that are left, as far as anything is known of them.
    pub(crate) fn left(&self, seconds: f64) -> Option<f64> {
        let now = self.now.as_ref()?;
        let shooting = self.shooting(now);
        let level = |elements: f64| {
            let shooting = shooting * (elements / now.elements).powf(self.growth());
            shooting + self.statement(elements, now)
        };
        let present = level(now.elements);
        let rest = (present - (seconds - now.began)).max(LONGER * present);
        let Foreseen { asked, most_elements, .. } = self.foreseen;
        let ahead = Ahead {
            asked,
            most: most_elements as f64,
            judged: self.judged,
            planned: self.foreseen.planned.elements,
        };
        let left = rest + ahead.levels(now.elements).into_iter().map(level).sum::<f64>();
        let most = self.foreseen.most_seconds.map_or(f64::INFINITY, |most| most - seconds);
        Some(left.min(most).max(0.0)).filter(|left| left.is_finite())
    }

    /// Seconds of the present level until its shooting ends: by its own speed once that tells, else
    /// by the level before, or the plan.
    fn shooting(&self, now: &Now) -> f64 {
        let foreseen = match (self.done.last(), now.last) {
            (Some(done), _) => done.shooting * (now.elements / done.elements).powf(self.growth()),
            (None, last) => {
                let last = last.filter(|last| last.form_factors > 0.0);
                let whole =
                    last.map_or_else(|| self.guess(), |last| self.form_factors * last.each());
                let planned = self.foreseen.planned.elements.max(1.0);
                whole * (now.elements / planned).powf(SHOOTING_GROWTH)
            }
        };
        let Some(last) = now.last else { return foreseen };
        let share = match self.done.last().filter(|done| done.shape.tells()) {
            Some(done) => done.shape.share(last.unshot, self.end()),
            None => shape::straight(last.unshot, self.end()),
        };
        let own = last.seconds / share.max(f64::MIN_POSITIVE);
        let weight = (share / TELLING).min(1.0);
        if foreseen <= 0.0 || share <= 0.0 {
            return own.max(foreseen);
        }
        own.powf(weight) * foreseen.powf(1.0 - weight)
    }

    /// Seconds of the last level's shooting, by the plan alone.
    fn guess(&self) -> f64 {
        let Foreseen { planned, threads, .. } = &self.foreseen;
        let share = self.form_factors / planned.form_factors.max(1.0);
        SLOWER * share * planned.seconds / (*threads).max(1) as f64
    }

    /// The unshot share at which the present level's shooting is expected to end.
    fn end(&self) -> f64 {
        /// Bounds on what is missing are some times the unshot share, and ask for a tenth of the error.
        const OF_ERROR: f64 = 0.05;
        /// The first level asks for less.
        const FIRST: f64 = 2.5e-3;
        match self.foreseen.asked {
            Asked::Error(error) if self.done.is_empty() => (OF_ERROR * error).max(FIRST),
            Asked::Error(error) => OF_ERROR * error,
            Asked::Elements(_) | Asked::Unstated(_) => self.foreseen.converge,
        }
    }

    /// How the seconds of shooting grow with the elements: the power.
    fn growth(&self) -> f64 {
        /// Shorter levels tell nothing, s.
        const LEAST: f64 = 0.1;
        let [.., a, b] = self.done.as_slice() else { return SHOOTING_GROWTH };
        if b.elements < 1.2 * a.elements || a.shooting < LEAST {
            return SHOOTING_GROWTH;
        }
        let growth = (b.shooting / a.shooting).ln() / (b.elements / a.elements).ln();
        growth.clamp(GROWTHS.0, GROWTHS.1)
    }

    /// Seconds of the statement of a level.
    fn statement(&self, elements: f64, now: &Now) -> f64 {
        match (self.foreseen.asked, self.done.last()) {
            (Asked::Unstated(_), _) => 0.0,
            _ if elements < JUDGED => 0.0,
            (_, Some(done)) if done.elements >= JUDGED => {
                done.statement * (elements / done.elements).powf(STATEMENT_GROWTH)
            }
            (_, done) => {
                let each = now.last.map(|last| last.each()).or(done.map(|done| done.each));
                let each = each.unwrap_or_else(|| self.guess() / self.form_factors.max(1.0));
                STATEMENT * each * (elements / STATEMENT_ELEMENTS).powf(STATEMENT_GROWTH)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A solve of one mesh or more on a machine of the test's own, whose levels cost what they are told to
    /// cost and whose unshot power falls by one factor a second.
    fn foreseen(asked: Asked) -> Foreseen {
        let planned =
            Work { elements: 4000.0, form_factors: 1e6, seconds: 10.0, ..Work::default() };
        Foreseen {
            asked,
            converge: 1e-3,
            planned,
            threads: 1,
            triangles: 10,
            most_elements: usize::MAX,
            most_seconds: None,
        }
    }

    /// Walks a level that shoots for so long from `begin` on; what was foreseen at each tenth.
    fn walk(course: &mut Course, begin: f64, elements: usize, long: f64) -> Vec<f64> {
        course.planned(elements, begin);
        let tenth = |i: i32| {
            let share = f64::from(i) / 10.0;
            let form_factors = (1e6 * share) as u64;
            let unshot = 1e-3f64.powf(share);
            let report = StepReport { unshot, form_factors, ..StepReport::default() };
            course.step(&report, begin + share * long);
            course.left(begin + share * long).unwrap()
        };
        (1..=10).map(tenth).collect()
    }

    #[test]
    fn light_that_falls_evenly_is_done_when_it_is_foreseen() {
        // Three times slower than planned, which the second step knows.
        let mut course = Course::of(foreseen(Asked::Unstated(4000)));
        let left = walk(&mut course, 0.0, 4000, 45.0);
        for (i, left) in (1..10).zip(left) {
            let truth = 45.0 * (1.0 - f64::from(i) / 10.0);
            assert!((left / truth - 1.0).abs() < 1e-6, "{i}: {left}, expected {truth}");
        }
    }

    #[test]
    fn a_level_takes_what_those_before_foretell() {
        let mut course = Course::of(foreseen(Asked::Elements(16_000)));
        let level = |elements: usize, form_factors: u64| LevelReport {
            elements,
            patches: 1,
            work: StepReport { form_factors, ..StepReport::default() },
            statement: None,
        };
        // Twice as long for four times the elements, and a quarter of that again for the statement.
        walk(&mut course, 0.0, 1000, 8.0);
        course.level(&level(1000, 1_000_000), 10.0);
        walk(&mut course, 10.0, 4000, 16.0);
        course.level(&level(4000, 2_000_000), 30.0);
        course.planned(16_000, 30.0);
        // The power 1/2 of the shooting, STATEMENT_GROWTH of the statement.
        let expected = 32.0 + 4.0 * 4f64.powf(STATEMENT_GROWTH);
        let left = course.left(30.0).unwrap();
        assert!((left - expected).abs() < 1e-9, "{left}, expected {expected}");
        // Time that is not there is not foreseen.
        course.foreseen.most_seconds = Some(31.0);
        assert_eq!(course.left(30.0), Some(1.0));
        assert_eq!(course.left(32.0), Some(0.0));
    }

    #[test]
    fn before_the_first_step_the_plan_is_all_there_is() {
        let mut course = Course::of(foreseen(Asked::Unstated(4000)));
        assert_eq!(course.left(0.0), None);
        course.planned(4000, 0.0);
        assert_eq!(course.left(1.0), Some(10.0 * SLOWER - 1.0));
    }
}
