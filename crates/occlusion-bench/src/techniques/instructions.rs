//! Instructions, counted by callgrind in a process of its own for each variant.

use std::process::Command;

use super::compare::{ask, raise, shooting};
use super::specimens;
use super::switches::{Effect, Technique, VARIANTS};
use crate::Workload;

/// What was counted of one variant on one scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Counted {
    /// The variant's name.
    pub name: &'static str,
    /// Instructions per segment.
    pub question: f64,
    /// Instructions of the build, per triangle.
    pub build: f64,
}

impl Counted {
    /// Returns how many times as many instructions something takes without a technique.
    pub fn gain(counted: &[Self], technique: &Technique) -> f64 {
        let instructions = |name: &str| {
            let counted = counted.iter().find(|counted| counted.name == name);
            counted.map_or(f64::NAN, |counted| match technique.effect {
                Effect::Questions => counted.question,
                Effect::Build => counted.build,
            })
        };
        instructions(technique.off) / instructions(technique.on)
    }
}

/// Builds one variant and asks all segments, once and without a clock: what callgrind runs.
///
/// # Errors
/// No variant has this name.
pub fn answer_uncounted(name: &str, workload: &Workload) -> Result<(), String> {
    let known = || VARIANTS.map(|variant| variant.name).join(", ");
    let variant = specimens::number(name)
        .ok_or_else(|| format!("no variant is called `{name}`; there are {}", known()))?;
    ask(&*raise(variant, &workload.occluders), &shooting(workload));
    Ok(())
}

/// Counts the instructions of every variant: runs `program techniques --only VARIANT` for `scene`
/// under `valgrind --tool=callgrind`, twice, to count the questions and the build.
///
/// # Errors
/// Valgrind is not installed, or a run fails.
pub fn count(
    program: &std::path::Path,
    scene: &str,
    workload: &Workload,
    asked: usize,
) -> Result<Vec<Counted>, String> {
    let run = |name: &str, function: &str| {
        let mut command = Command::new("valgrind");
        command
            .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
            .arg(format!("--toggle-collect=*techniques::compare::{function}*"))
            .arg(program)
            .args(["techniques", "--scenes", scene, "--only", name, "--segments"])
            .arg(asked.to_string());
        let output = command.output().map_err(|error| format!("valgrind: {error}"))?;
        let text = String::from_utf8_lossy(&output.stderr);
        collected(&text).ok_or_else(|| format!("valgrind counted nothing for {name}: {text}"))
    };
    let segments = shooting(workload).len().min(asked).max(1) as f64;
    let triangles = workload.occluders.len().max(1) as f64;
    VARIANTS
        .iter()
        .map(|&super::Variant { name, .. }| {
            let question = run(name, "ask")? / segments;
            Ok(Counted { name, question, build: run(name, "raise")? / triangles })
        })
        .collect()
}

/// The number after `Collected :`.
fn collected(text: &str) -> Option<f64> {
    let (_, rest) = text.split_once("Collected :")?;
    rest.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_count_is_found_among_what_valgrind_says() {
        let text = "==7== Events    : Ir\n==7== Collected : 1234567\n==7== \n";
        assert_eq!(super::collected(text), Some(1_234_567.0));
        assert_eq!(super::collected("valgrind: no such program"), None);
    }
}
