//! Which settings are run, and how often.

use std::num::NonZero;

use super::diagram;
use super::measurement::{Machine, Measurement, Method, Series, Solve};
use super::numbers::{percent, seconds};
use super::program::{Program, Said};
use super::subject::Subject;

/// Runs of one solve; five and more also show how much the machine's moods weigh.
const RUNS: usize = 1;

/// Runs of a solve that takes longer than [`LONG`]: the machine's moods average out.
const LONG_RUNS: usize = 2;
const LONG: f64 = 10.0;

/// What every scene is solved with.
pub(super) struct Plan {
    /// Stated errors to refine to.
    errors: Vec<f64>,
    /// Refinement stops here in any case.
    most_seconds: u32,
    /// Sizes of fixed meshes.
    elements: Vec<usize>,
    /// Unshot shares to shoot each mesh to.
    shares: Vec<f64>,
    /// The mesh and its unshot share that every occluder is tried with.
    occluders: (usize, f64),
    runs: usize,
}

/// One solve to be run.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Job {
    method: Method,
    goal: f64,
}

impl Plan {
    /// What docs/precision.md shows.
    pub(super) fn full() -> Self {
        Self {
            errors: vec![0.08, 0.04, 0.02, 0.01],
            most_seconds: 120,
            elements: vec![1000, 4000, 16_000],
            shares: vec![1e-1, 1e-2, 1e-3, 1e-4, 1e-5],
            occluders: (16_000, 1e-3),
            runs: RUNS,
        }
    }

    /// Seconds, not hours: whether everything works.
    pub(super) fn quick() -> Self {
        Self {
            errors: vec![0.08, 0.04, 0.02],
            most_seconds: 20,
            elements: vec![1000, 4000],
            shares: vec![1e-1, 1e-2, 1e-3],
            occluders: (4000, 1e-3),
            runs: 1,
        }
    }

    /// Runs everything for one scene. Rounds over all solves, rather than all runs of one solve
    /// in a row, spread the machine's moods evenly.
    pub(super) fn measure(
        &self,
        program: &Program,
        subject: Subject,
        threads: usize,
    ) -> Result<Measurement, String> {
        let mut done: Vec<(Job, Solve)> = Vec::new();
        let (mut reference_error, mut used_threads) = (0.0, 0);
        for job in self.jobs() {
            let said = self.solve(program, subject, job, threads)?;
            let compared = program.compare(&subject.reference())?;
            println!(
                "{}: {} to {}: {}, E1 {}",
                subject.name(),
                diagram::name(job.method),
                job.goal,
                seconds(said.seconds),
                percent(compared.errors.e1)
            );
            (reference_error, used_threads) = (compared.reference, said.threads);
            let Said { seconds, work, stated, .. } = said;
            let measured = compared.errors;
            let solve = Solve { goal: job.goal, seconds: vec![seconds], work, stated, measured };
            done.push((job, solve));
        }
        for round in 1..self.runs {
            println!("{}: round {} of {}", subject.name(), round + 1, self.runs);
            for (job, solve) in &mut done {
                if round >= LONG_RUNS && solve.time().median > LONG {
                    continue;
                }
                let said = self.solve(program, subject, *job, threads)?;
                // The clock decides where a limit ends the work; nothing else may depend on it.
                if said.work != solve.work && solve.work.limit.is_none() {
                    return Err(format!(
                        "{}: {job:?}: run {} did {:?}, but the first did {:?}",
                        subject.name(),
                        round + 1,
                        said.work,
                        solve.work
                    ));
                }
                solve.seconds.push(said.seconds);
            }
        }
        let (machine, threads) = (Machine::this(), used_threads);
        Ok(Measurement { subject, machine, threads, reference_error, series: series(done) })
    }

    /// Every solve, the harder goals of a method after the easier ones.
    fn jobs(&self) -> Vec<Job> {
        let refine = self.errors.iter().map(|goal| Job { method: Method::Refinement, goal: *goal });
        let meshes = self.elements.iter().flat_map(|elements| {
            let method = Method::Mesh { elements: *elements };
            self.shares.iter().map(move |goal| Job { method, goal: *goal })
        });
        let (elements, goal) = self.occluders;
        let occluders = [Method::Octree { elements }, Method::Bvh { elements }];
        let occluders = occluders.map(|method| Job { method, goal });
        refine.chain(meshes).chain(occluders).collect()
    }

    /// Runs one job.
    fn solve(
        &self,
        program: &Program,
        subject: Subject,
        job: Job,
        threads: usize,
    ) -> Result<Said, String> {
        let mut settings = vec!["--sides".to_owned(), subject.sides().to_owned()];
        settings.extend(self.settings(job, threads));
        program.solve(&subject.scene(), &settings)
    }

    /// The command line of a job, after the scene and its sides.
    fn settings(&self, Job { method, goal }: Job, threads: usize) -> Vec<String> {
        let how = match method {
            Method::Refinement => format!("--error {goal} --max-time {}s", self.most_seconds),
            Method::Mesh { elements } => mesh(elements, goal),
            Method::Octree { elements } => format!("{} --accel octree", mesh(elements, goal)),
            Method::Bvh { elements } => format!("{} --accel bvh", mesh(elements, goal)),
        };
        format!("{how} --threads {threads}").split(' ').map(str::to_owned).collect()
    }
}

fn mesh(elements: usize, goal: f64) -> String {
    format!("--elements {elements} --converge {goal} --no-statement")
}

/// Solves that follow each other by one method are a series.
fn series(done: Vec<(Job, Solve)>) -> Vec<Series> {
    let mut found: Vec<Series> = Vec::new();
    for (Job { method, .. }, solve) in done {
        match found.last_mut().filter(|last| last.method == method) {
            Some(last) => last.solves.push(solve),
            None => found.push(Series { method, solves: vec![solve] }),
        }
    }
    found
}

impl Machine {
    /// This machine, as Linux names it.
    pub(crate) fn this() -> Self {
        let facts = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
        let cores = std::thread::available_parallelism().map_or(1, NonZero::get);
        Self { cpu: cpu(&facts).unwrap_or("unknown processor").to_owned(), cores }
    }
}

/// The first processor's name.
fn cpu(facts: &str) -> Option<&str> {
    let line = facts.lines().find(|line| line.starts_with("model name"))?;
    line.split_once(':').map(|(_, name)| name.trim())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::precision::sample;

    #[test]
    fn each_method_has_its_command_line() {
        let plan = Plan::full();
        let line = |job| plan.settings(job, 2).join(" ");
        let lines: Vec<_> = plan.jobs().into_iter().map(line).collect();
        assert_eq!(lines.len(), 4 + 3 * 5 + 2);
        assert_eq!(lines[0], "--error 0.08 --max-time 120s --threads 2");
        assert_eq!(lines[18], "--elements 16000 --converge 0.00001 --no-statement --threads 2");
        let octree = "--elements 16000 --converge 0.001 --no-statement --accel octree --threads 2";
        assert_eq!(lines[19], octree);
        assert_eq!(lines[20], octree.replace("octree", "bvh"));
    }

    #[test]
    fn goals_only_become_harder() {
        for plan in [Plan::full(), Plan::quick()] {
            for goals in [&plan.errors, &plan.shares] {
                assert!(goals.is_sorted_by(|a, b| a > b), "{goals:?}");
            }
        }
    }

    #[test]
    fn solves_of_one_method_are_gathered() {
        let sample = sample::measurement();
        let done: Vec<_> = sample
            .solves()
            .map(|(method, solve)| (Job { method, goal: solve.goal }, solve.clone()))
            .collect();
        assert_eq!(series(done), sample.series);
    }

    #[test]
    fn the_processor_is_named() {
        let facts = "processor\t: 0\nmodel name\t: Some CPU @ 2.60GHz\n\nmodel name\t: Other\n";
        assert_eq!(cpu(facts), Some("Some CPU @ 2.60GHz"));
        assert_eq!(cpu(""), None);
    }
}
