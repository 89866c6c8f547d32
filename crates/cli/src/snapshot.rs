//! The light on its way: files beside the outputs, written while the work goes on.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::time::Duration;

use radiosity_core::StepReport;
use scene::{Scene, Solution};

use crate::args::Every;
use crate::failure::Failure;
use crate::files;
use crate::screen::{self, Event, WorkFacts, count, percent, seconds};
use crate::settings::{Solve, Target};

/// Writes snapshots when they are due.
pub(crate) struct Snapshots<'a> {
    every: Every,
    scene: &'a Scene,
    options: &'a output::Options,
    /// The outputs that snapshots stand beside.
    targets: Vec<&'a Path>,
    /// What must not be written over.
    others: Vec<&'a Path>,
    read: Option<&'a Path>,
    /// Shots, or time, at which the next is due.
    next_shots: u64,
    next_time: Duration,
    failed: u32,
    pub(crate) written: Vec<Snapshot>,
}

/// A snapshot that was taken.
pub(crate) struct Snapshot {
    pub(crate) number: u32,
    pub(crate) seconds: f64,
    pub(crate) elements: usize,
    pub(crate) work: StepReport,
    pub(crate) files: Vec<PathBuf>,
}

impl<'a> Snapshots<'a> {
    /// Those that the settings ask for.
    pub(crate) fn of(
        settings: &'a Solve,
        scene: &'a Scene,
        options: &'a output::Options,
    ) -> Option<Self> {
        let every = settings.snapshot?;
        let path = |target: &'a Target| match target {
            Target::File(path) => Some(path.as_path()),
            Target::Stdout | Target::Probes(_) => None,
            #[cfg(feature = "html")]
            Target::Page(_) => None,
        };
        let targets: Vec<_> = settings.outputs.iter().filter_map(path).collect();
        let report = settings.report.as_deref();
        let (next_shots, next_time) = match every {
            Every::Shots(shots) => (shots, Duration::MAX),
            Every::Time(time) => (u64::MAX, time),
        };
        Some(Self {
            every,
            scene,
            options,
            others: targets.iter().copied().chain(report).collect(),
            targets,
            read: settings.scene.as_deref(),
            next_shots,
            next_time,
            failed: 0,
            written: Vec::new(),
        })
    }

    /// Whether one is due.
    pub(crate) fn due(&self, report: &StepReport, elapsed: Duration) -> bool {
        report.shots >= self.next_shots || elapsed >= self.next_time
    }

    /// Writes one beside each output. What cannot be written is warned of, once: the work is
    /// worth more than its snapshots.
    pub(crate) fn take(
        &mut self,
        work: &StepReport,
        solution: &Solution,
        elapsed: impl Fn() -> Duration,
    ) {
        let number = self.written.len() as u32 + 1;
        let taken = elapsed().as_secs_f64();
        let mut written = Vec::new();
        for target in &self.targets {
            let path = numbered(target, number);
            match self.write(&path, solution) {
                Ok(()) => written.push(path),
                Err(failure) => {
                    if self.failed == 0 {
                        screen::warning(&format!(
                            "snapshot: {failure}; the work goes on, and further ones that fail \
                             are only counted"
                        ));
                    }
                    self.failed += 1;
                }
            }
        }
        let names: Vec<_> = written.iter().map(|path| path.display().to_string()).collect();
        if !names.is_empty() {
            let line = format!(
                "snapshot after {} shots, {}: {} unshot; {}",
                count(work.shots),
                seconds(taken),
                percent(work.unshot),
                names.join(", ")
            );
            let event = || Event::Snapshot {
                number,
                work: WorkFacts::of(work),
                elements: solution.elements.len() as u64,
                files: names.clone(),
            };
            screen::tell(event, &line);
        }
        let (elements, work) = (solution.elements.len(), *work);
        self.written.push(Snapshot { number, seconds: taken, elements, work, files: written });
        match self.every {
            Every::Shots(shots) => self.next_shots = (work.shots / shots + 1) * shots,
            // From its end: writing must never take all of the time.
            Every::Time(time) => self.next_time = elapsed().saturating_add(time),
        }
    }

    /// Says how many could not be written.
    pub(crate) fn say_failed(&self) {
        if self.failed > 1 {
            screen::warning(&format!("{} files of snapshots could not be written", self.failed));
        }
    }

    fn write(&self, path: &Path, solution: &Solution) -> Result<(), Failure> {
        files::check(path)?;
        let mut all = self.others.clone();
        all.push(path);
        files::check_apart(self.read, &all)?;
        output::write_file(path, self.scene, solution, self.options)?;
        Ok(())
    }
}

/// `lit.glb` becomes `lit.00001.glb`.
fn numbered(path: &Path, number: u32) -> PathBuf {
    let mut name = path.file_stem().map_or_else(OsString::new, OsString::from);
    name.push(format!(".{number:05}"));
    if let Some(extension) = path.extension() {
        name.push(".");
        name.push(extension);
    }
    path.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_stand_before_the_extension() {
        assert_eq!(numbered(Path::new("out/lit.glb"), 7), Path::new("out/lit.00007.glb"));
        assert_eq!(numbered(Path::new("a.b.csv"), 123_456), Path::new("a.b.123456.csv"));
    }
}
