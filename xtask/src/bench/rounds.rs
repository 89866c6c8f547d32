//! Which configurations are run, in which order, and what must not depend on them.

use std::collections::BTreeMap;
use std::path::Path;

use super::measurement::{Copies, Mode, Series, Solved, Timed};
use super::others::Clock;
use super::scene::Scene;
use super::threads::Threads;
use crate::precision::Program;
use crate::precision::numbers::seconds;

/// The unshot share that every mesh is shot to.
pub(super) const CONVERGE: &str = "1e-3";

/// What every scene is solved with.
pub(super) struct Plan {
    pub(super) elements: usize,
    pub(super) modes: Vec<Mode>,
    pub(super) threads: Threads,
    /// Rounds: runs of each configuration.
    pub(super) runs: usize,
}

/// Every way to share loops with every schedule; the program's own choice where none is asked
/// for.
pub(super) fn modes(loops: &[String], schedules: &[String]) -> Vec<Mode> {
    let choices = |asked: &[String]| match asked {
        [] => vec![None],
        asked => asked.iter().cloned().map(Some).collect(),
    };
    let schedules = choices(schedules);
    let modes = choices(loops).into_iter().flat_map(|sharing| {
        schedules
            .iter()
            .map(move |schedule| Mode { sharing: sharing.clone(), schedule: schedule.clone() })
    });
    modes.collect()
}

impl Plan {
    /// Runs everything for one scene. A round runs each configuration once, so that the
    /// machine's drift hits all alike.
    ///
    /// # Errors
    /// Where the program fails, runs on other threads than asked for, or writes a solution that
    /// differs from that of the first run with the same schedule: schedules take other steps.
    pub(super) fn measure(
        &self,
        program: &Program,
        root: &Path,
        scene: Scene,
        cores: usize,
    ) -> Result<Solved, String> {
        let file = scene.path(root);
        let series = self.series();
        let programs = self.threads.iter().filter(|t| (2..=cores).contains(t)).max();
        let copies = programs.map(|programs| Copies { programs, seconds: Vec::new() });
        let mut solved = Solved { scene, file, elements: 0, others: None, series, copies };
        let start = Clock::now();
        let mut firsts: BTreeMap<Option<String>, (String, String)> = BTreeMap::new();
        for round in 0..self.runs {
            println!("{}: round {} of {}", scene.name(), round + 1, self.runs);
            for series in &mut solved.series {
                for point in &mut series.points {
                    let settings = self.settings(&series.mode, point.threads);
                    let failed =
                        |e: String| format!("{}: {}: {e}", scene.name(), settings.join(" "));
                    let said = program.solve(&solved.file, &settings).map_err(failed)?;
                    if said.threads != point.threads {
                        return Err(failed(format!("{} threads did the work", said.threads)));
                    }
                    let solution = program.solution().map_err(failed)?;
                    let (words, expected) = firsts
                        .entry(series.mode.schedule.clone())
                        .or_insert_with(|| (settings.join(" "), solution.clone()));
                    same(expected, &solution).map_err(|e| {
                        failed(format!("the solution is not that of `{words}`: {e}"))
                    })?;
                    println!(
                        "  {}: {}",
                        configuration(&series.mode, point.threads),
                        seconds(said.seconds)
                    );
                    solved.elements = said.work.elements;
                    point.seconds.push(said.seconds);
                }
            }
            if let Some(Copies { programs, seconds: means }) = &mut solved.copies {
                let settings = self.settings(&solved.series[0].mode, 1);
                let said = program.solve_at_once(*programs, &solved.file, &settings)?;
                let mean = said.iter().map(|s| s.seconds).sum::<f64>() / *programs as f64;
                println!("  {programs} programs of one thread at once: {}", seconds(mean));
                means.push(mean);
            }
        }
        solved.others = start.zip(Clock::now()).and_then(|(start, end)| start.others_until(end));
        Ok(solved)
    }

    /// Every configuration, not yet timed.
    fn series(&self) -> Vec<Series> {
        let points: Vec<_> =
            self.threads.iter().map(|threads| Timed { threads, seconds: Vec::new() }).collect();
        let series =
            self.modes.iter().map(|mode| Series { mode: mode.clone(), points: points.clone() });
        series.collect()
    }

    /// The command line of a configuration, after the scene.
    fn settings(&self, mode: &Mode, threads: usize) -> Vec<String> {
        let mesh = format!("--elements {} --converge {CONVERGE} --no-statement", self.elements);
        let line = format!("{mesh} --threads {threads}");
        line.split(' ').map(str::to_owned).chain(mode.flags()).collect()
    }
}

/// How a configuration is called while it runs.
fn configuration(mode: &Mode, threads: usize) -> String {
    let flags = mode.flags().into_iter().map(|word| format!(" {word}"));
    format!("--threads {threads}{}", flags.collect::<String>())
}

/// Whether two solutions are the same to the last byte; says where they are not.
fn same(expected: &str, found: &str) -> Result<(), String> {
    if expected == found {
        return Ok(());
    }
    // Line ends count, too.
    let (mut ours, mut theirs) = (found.split_inclusive('\n'), expected.split_inclusive('\n'));
    let mut line = 1;
    loop {
        match (ours.next(), theirs.next()) {
            (Some(a), Some(b)) if a == b => line += 1,
            (a, b) => {
                let [a, b] = [a, b].map(|text| text.map_or("nothing".into(), |t| format!("{t:?}")));
                return Err(format!("line {line} is {a}, expected {b}"));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(words: &[&str]) -> Vec<String> {
        words.iter().map(|word| (*word).to_owned()).collect()
    }

    fn lines(loops: &[&str], schedules: &[&str]) -> Vec<String> {
        let modes = modes(&texts(loops), &texts(schedules));
        let plan = Plan { elements: 8000, modes, threads: Threads::up_to(2), runs: 1 };
        let series = plan.series();
        let lines = series
            .iter()
            .flat_map(|s| s.points.iter().map(|p| plan.settings(&s.mode, p.threads).join(" ")));
        lines.collect()
    }

    #[test]
    fn each_configuration_has_its_command_line() {
        let mesh = "--elements 8000 --converge 1e-3 --no-statement";
        let expected = [format!("{mesh} --threads 1"), format!("{mesh} --threads 2")];
        assert_eq!(lines(&[], &[]), expected);
        let all = lines(&["static", "dynamic:1"], &["single", "multi:4"]);
        assert_eq!(all.len(), 2 * 2 * 2);
        assert_eq!(all[0], format!("{mesh} --threads 1 --loop static --schedule single"));
        assert_eq!(all[7], format!("{mesh} --threads 2 --loop dynamic:1 --schedule multi:4"));
    }

    #[test]
    fn solutions_that_differ_are_told_apart_with_their_place() {
        assert_eq!(same("a,1\nb,2\n", "a,1\nb,2\n"), Ok(()));
        let error = same("a,1\nb,2\n", "a,1\nb,3\n").unwrap_err();
        assert_eq!(error, r#"line 2 is "b,3\n", expected "b,2\n""#);
        let short = same("a,1\nb,2\n", "a,1\n").unwrap_err();
        assert_eq!(short, r#"line 2 is nothing, expected "b,2\n""#);
        let ends = same("a,1\n", "a,1\r\n").unwrap_err();
        assert_eq!(ends, r#"line 1 is "a,1\r\n", expected "a,1\n""#);
    }
}
