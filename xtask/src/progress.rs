//! `cargo xtask progress`: how right `radiosity solve` is about the time that it still takes.
//!
//! Each case is solved with `--log json`. What the lines said was left is compared, all along the way,
//! with what it then took. The table goes to docs/progress.md by hand, with the day and the machine.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;

use crate::built;

/// What to measure.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// The program to measure [default: a release build]
    #[arg(long)]
    program: Option<PathBuf>,

    /// Only the scenes with this in their name
    #[arg(long)]
    only: Option<String>,
}

/// Scenes, and what is asked of each: a refinement that takes some levels, a stated mesh, one mesh.
const CASES: [(&str, [&str; 3]); 6] = [
    ("cornell.glb", ["--error 1%", "--elements 20000", "--elements 20000 --no-statement"]),
    ("blocks.tri", ["--error 5%", "--elements 10000", "--elements 10000 --no-statement"]),
    ("room.tri", ["--error 5%", "--elements 10000", "--elements 10000 --no-statement"]),
    ("hall.tri", ["--error 10%", "--elements 10000", "--elements 10000 --no-statement"]),
    ("gallery.glb", ["--error 5%", "--elements 10000", "--elements 10000 --no-statement"]),
    ("church.tri", ["--error 20%", "--elements 20000", "--elements 20000 --no-statement"]),
];

/// Instants that are looked at, evenly over a solve.
const INSTANTS: usize = 400;

/// Where the ratio is shown, in per cent of the time.
const SHOWN: [usize; 5] = [10, 25, 50, 75, 90];

/// What was said to be left at one time, both in seconds.
type Said = (f64, Option<f64>);

/// What a solve said of its time.
struct Course {
    begin: f64,
    end: f64,
    said: Vec<Said>,
}

/// Measures, and prints the table.
pub(crate) fn run(root: &Path, arguments: &Arguments) -> Result<(), String> {
    let program = match &arguments.program {
        Some(program) => program.clone(),
        None => built::program(root, "radiosity", "radiosity")?,
    };
    let shown = SHOWN.map(|percent| format!(" at {percent} % |")).concat();
    println!("| scene | flags | seconds | within two |{shown}");
    println!("|---|---|---|---|{}", "---|".repeat(SHOWN.len()));
    let wanted = |name: &str| arguments.only.as_ref().is_none_or(|part| name.contains(part));
    for (scene, all) in CASES.iter().filter(|(scene, _)| wanted(scene)) {
        for flags in all {
            let course = solve(&program, &root.join("scenes").join(scene), flags)?;
            println!("| {scene} | `{flags}` {}", course.row());
        }
    }
    Ok(())
}

fn solve(program: &Path, scene: &Path, flags: &str) -> Result<Course, String> {
    let mut command = Command::new(program);
    command.arg("solve").arg(scene).args(flags.split(' ')).args(["-o", "-", "--log", "json"]);
    let output = command.output().map_err(|e| format!("{}: {e}", program.display()))?;
    let text = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(format!("{} {flags}: {text}", scene.display()));
    }
    Course::of(&text).ok_or_else(|| format!("{} {flags}: expected a solve's log", scene.display()))
}

impl Course {
    /// Of the lines of `--log json`.
    fn of(text: &str) -> Option<Self> {
        let lines =
            text.lines().map(serde_json::from_str).collect::<Result<Vec<Value>, _>>().ok()?;
        let stage = |name: &str| lines.iter().find(|line| line["stage"] == name);
        let begin = stage("mesh")?["seconds"].as_f64()?;
        let end = stage("writing")?["seconds"].as_f64()?;
        let said = lines.iter().filter(|line| line.get("left_seconds").is_some());
        let said = said
            .filter_map(|line| Some((line["seconds"].as_f64()?, line["left_seconds"].as_f64())));
        Some(Self { begin, end, said: said.filter(|(seconds, _)| *seconds < end).collect() })
    }

    /// What was said to be left over what was, after a share of the time; counted down from when it was said.
    fn ratio(&self, share: f64) -> Option<f64> {
        let now = self.begin + share * (self.end - self.begin);
        let (then, left) = self.said.iter().rfind(|(seconds, _)| *seconds <= now)?;
        Some((left.as_ref()? - (now - then)).max(0.0) / (self.end - now))
    }

    fn row(&self) -> String {
        let at = |i: usize| self.ratio((i as f64 + 0.5) / INSTANTS as f64);
        let right = (0..INSTANTS).filter(|i| at(*i).is_some_and(|r| (0.5..=2.0).contains(&r)));
        let right = 100.0 * right.count() as f64 / INSTANTS as f64;
        let cell = |percent: &usize| match self.ratio(*percent as f64 / 100.0) {
            Some(ratio) => format!(" {ratio:.2} |"),
            None => " none |".into(),
        };
        let cells: String = SHOWN.iter().map(cell).collect();
        format!("| {:.1} | {right:.0} % |{cells}", self.end - self.begin)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_said_is_counted_down() {
        let text = "{\"kind\":\"stage\",\"stage\":\"mesh\",\"left_seconds\":null,\"seconds\":1.0}\n\
                    {\"kind\":\"step\",\"left_seconds\":12.0,\"seconds\":2.0}\n\
                    {\"kind\":\"step\",\"left_seconds\":4.0,\"seconds\":9.0}\n\
                    {\"kind\":\"stage\",\"stage\":\"writing\",\"left_seconds\":0.0,\"seconds\":11.0}\n";
        let course = Course::of(text).unwrap();
        // At 1.5 s nothing is known; at 6 s 12 - 4 of 5; at 10 s 4 - 1 of 1.
        assert_eq!(course.ratio(0.05), None);
        assert_eq!(course.ratio(0.5), Some(8.0 / 5.0));
        assert_eq!(course.ratio(0.9), Some(3.0));
        assert!(course.row().starts_with("| 10.0 | "), "{}", course.row());
        assert!(Course::of("radiosity: error: no\n").is_none());
    }
}
