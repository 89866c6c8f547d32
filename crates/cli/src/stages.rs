//! How long a solve was busy with what.

use std::time::{Duration, Instant};

use radiosity_core::Stage;
use serde::Serialize;

/// A clock for each stage, of which one runs at a time.
#[derive(Default)]
pub(crate) struct Stages {
    taken: [Duration; Stage::ALL.len()],
    running: Option<(Stage, Instant)>,
}

/// Seconds of each stage, as the report has them.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct StageSeconds {
    mesh: f64,
    census: f64,
    select: f64,
    prepare: f64,
    transfer: f64,
    commit: f64,
    correct: f64,
    statement: f64,
}

impl Stages {
    /// Stops the clock that runs, and starts that of `stage`.
    pub(crate) fn begin(&mut self, stage: Stage) {
        self.stop();
        self.running = Some((stage, Instant::now()));
    }

    /// Stops the clock that runs, if any.
    pub(crate) fn stop(&mut self) {
        if let Some((stage, since)) = self.running.take() {
            self.taken[stage as usize] += since.elapsed();
        }
    }

    /// What each clock shows.
    pub(crate) fn seconds(&self) -> StageSeconds {
        let of = |stage: Stage| self.taken[stage as usize].as_secs_f64();
        StageSeconds {
            mesh: of(Stage::Mesh),
            census: of(Stage::Census),
            select: of(Stage::Select),
            prepare: of(Stage::Prepare),
            transfer: of(Stage::Transfer),
            commit: of(Stage::Commit),
            correct: of(Stage::Correct),
            statement: of(Stage::Statement),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_clock_runs_at_a_time() {
        let mut stages = Stages::default();
        for (place, stage) in Stage::ALL.into_iter().enumerate() {
            // Each has a clock of its own.
            assert_eq!(stage as usize, place);
        }
        stages.begin(Stage::Mesh);
        while stages.running.is_some_and(|(_, since)| since.elapsed().is_zero()) {}
        stages.begin(Stage::Transfer);
        stages.stop();
        let mesh = stages.seconds().mesh;
        stages.stop();
        assert!(mesh > 0.0 && stages.seconds().mesh == mesh);
        assert_eq!(stages.seconds().commit, 0.0);
    }
}
