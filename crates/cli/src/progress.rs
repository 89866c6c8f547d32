//! How far a solve is: what it is busy with, what is left, and a bar that shows it.

#[cfg_attr(not(feature = "progress"), path = "progress/absent.rs")]
mod bar;
mod course;

use std::time::{Duration, Instant};

use radiosity_core::{LevelReport, Stage, StepReport};

use crate::screen::{self, Event, StepFacts, WorkFacts, count, percent};
use crate::settings::Goal;
use bar::Bar;
pub(crate) use bar::Bars;
use course::Course;
pub(crate) use course::Foreseen;

/// Between two drawings of the bar: what the eye can follow costs nothing worth mentioning.
const DRAWN: Duration = Duration::from_millis(100);

/// Between two steps in the log.
const LOGGED: Duration = Duration::from_millis(250);

/// Hears how far the work is, and shows it where someone looks.
pub(crate) struct Progress {
    /// Nobody looks, so nothing is reckoned.
    idle: bool,
    bar: Option<Bar>,
    goal: Goal,
    /// Of the solve, once it began.
    clock: Instant,
    course: Option<Course>,
    phase: &'static str,
    /// Levels that are done.
    levels: u32,
    /// What the present level's mesh is to have.
    elements: Option<usize>,
    error: Option<f64>,
    work: StepReport,
    rate: Rate,
    drawn: Instant,
    logged: Instant,
}

/// Segments a second, of late.
struct Rate {
    since: Instant,
    segments: u64,
    per_second: f64,
}

impl Rate {
    /// Long enough for many steps, short enough to see the work change.
    const SPAN: Duration = Duration::from_secs(1);

    fn hear(&mut self, segments: u64, now: Instant) {
        let span = now - self.since;
        if span >= Self::SPAN || self.per_second == 0.0 && span >= DRAWN {
            self.per_second = segments.saturating_sub(self.segments) as f64 / span.as_secs_f64();
            (self.since, self.segments) = (now, segments);
        }
    }
}

impl Progress {
    /// Of work that begins now.
    pub(crate) fn new(goal: Goal) -> Self {
        let now = Instant::now();
        let shown = screen::bars().shown();
        Self {
            idle: !shown && !screen::logs(),
            bar: shown.then(|| screen::bars().bar()),
            goal,
            clock: now,
            course: None,
            phase: "",
            levels: 0,
            elements: None,
            error: None,
            work: StepReport::default(),
            rate: Rate { since: now, segments: 0, per_second: 0.0 },
            drawn: now,
            logged: now,
        }
    }

    /// Work of another kind begins.
    pub(crate) fn phase(&mut self, phase: &'static str) {
        if self.idle || phase == self.phase {
            return;
        }
        self.phase = phase;
        let level = self.course.as_ref().map(|_| self.levels + 1);
        let elements = self.elements.map(|n| n as u64);
        let now = Instant::now();
        let left_seconds = self.left(now);
        screen::log(|| Event::Stage { stage: phase, level, elements, left_seconds });
        self.draw(now);
    }

    /// The solve begins, of which so much is foreseen.
    pub(crate) fn solve(&mut self, foreseen: Foreseen) {
        self.clock = Instant::now();
        self.course = Some(Course::of(foreseen));
    }

    /// Takes the bar away: the work is done.
    pub(crate) fn clear(&mut self) {
        if let Some(bar) = self.bar.take() {
            bar.clear();
        }
    }

    /// The solver is busy with something else.
    pub(crate) fn stage(&mut self, stage: Stage) {
        match stage {
            // Whether there will be another mesh is known when its elements are.
            Stage::Mesh => {}
            Stage::Census => self.phase("census"),
            Stage::Statement => self.phase("statement"),
            Stage::Select | Stage::Prepare | Stage::Transfer | Stage::Commit | Stage::Correct => {
                self.phase("shooting");
            }
        }
    }

    /// The next level's mesh is to have so many elements.
    pub(crate) fn planned(&mut self, elements: usize) {
        self.elements = Some(elements);
        let seconds = self.clock.elapsed().as_secs_f64();
        if let Some(course) = &mut self.course {
            course.planned(elements, seconds);
        }
        self.phase("mesh");
    }

    /// A step is done.
    pub(crate) fn step(&mut self, report: &StepReport) {
        if self.idle {
            return;
        }
        let now = Instant::now();
        self.work = *report;
        if let Some(course) = &mut self.course {
            course.step(report, (now - self.clock).as_secs_f64());
        }
        if now - self.drawn >= DRAWN {
            self.rate.hear(report.rays, now);
            self.draw(now);
        }
        if now - self.logged >= LOGGED {
            self.logged = now;
            screen::log(|| Event::Step(self.facts(now)));
        }
    }

    /// A level is done; its number, from 1.
    pub(crate) fn level(&mut self, report: &LevelReport) -> u32 {
        self.levels += 1;
        self.elements = None;
        self.error = report.statement.map(|s| s.triangles.e1.total()).filter(|e| e.is_finite());
        self.work = report.work;
        let seconds = self.clock.elapsed().as_secs_f64();
        if let Some(course) = &mut self.course {
            course.level(report, seconds);
        }
        self.levels
    }

    fn facts(&self, now: Instant) -> StepFacts {
        StepFacts {
            level: self.levels + 1,
            elements: self.elements.map(|n| n as u64),
            work: WorkFacts::of(&self.work),
            segments_per_second: self.rate.per_second,
            left_seconds: self.left(now),
        }
    }

    fn left(&self, now: Instant) -> Option<f64> {
        self.course.as_ref().and_then(|course| course.left((now - self.clock).as_secs_f64()))
    }

    fn draw(&mut self, now: Instant) {
        self.drawn = now;
        let Some(bar) = &self.bar else { return };
        let elapsed = (now - self.clock).as_secs_f64();
        let left = self.left(now);
        let done = match left {
            Some(left) => elapsed / (elapsed + left).max(f64::MIN_POSITIVE),
            // All but the outputs, or nothing.
            None => f64::from(u8::from(self.levels > 0)),
        };
        bar.show(done, &self.text(left));
    }

    /// What the bar says.
    fn text(&self, left: Option<f64>) -> String {
        // What does not fit is cut off: what matters most comes first.
        let mut parts: Vec<String> =
            left.map(|left| format!("about {} left", time(left))).into_iter().collect();
        parts.push(match self.elements {
            Some(n) => {
                format!("level {}, {} elements: {}", self.levels + 1, count(n as u64), self.phase)
            }
            None => self.phase.to_owned(),
        });
        match (self.goal, self.error) {
            (Goal::Error(target), Some(error)) => {
                parts.push(format!("error {} of {}", percent(error), percent(target)));
            }
            (_, Some(error)) => parts.push(format!("error {}", percent(error))),
            (_, None) => {}
        }
        if self.work.shots > 0 {
            parts.push(match self.goal {
                Goal::Mesh { converge, .. } => {
                    format!("unshot {} of {}", percent(self.work.unshot), percent(converge))
                }
                Goal::Error(_) => format!("unshot {}", percent(self.work.unshot)),
            });
        }
        if self.rate.per_second > 0.0 {
            parts.push(format!("{} segments/s", amount(self.rate.per_second)));
        }
        parts.join(", ")
    }
}

/// An amount in three digits, with a letter for thousands.
fn amount(n: f64) -> String {
    match n {
        n if n >= 1e9 => format!("{:.1} G", n / 1e9),
        n if n >= 1e6 => format!("{:.1} M", n / 1e6),
        n if n >= 1e3 => format!("{:.0} k", n / 1e3),
        n => format!("{n:.0}"),
    }
}

/// A time that is foreseen, in the two largest units.
fn time(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        0..60 => format!("{} s", whole.max(1)),
        60..3600 => format!("{} min {} s", whole / 60, whole % 60),
        _ => format!("{} h {} min", whole / 3600, whole % 3600 / 60),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts_and_times_are_short() {
        assert_eq!(
            [0.0, 999.0, 12_300.0, 4_560_000.0, 1e9].map(amount),
            ["0", "999", "12 k", "4.6 M", "1.0 G"]
        );
        assert_eq!(
            [0.0, 59.4, 60.0, 3599.0, 7260.0].map(time),
            ["1 s", "59 s", "1 min 0 s", "59 min 59 s", "2 h 1 min"]
        );
    }
}
