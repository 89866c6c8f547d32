//! One cell of the matrix: what a process of its own is started for, again and again.

use clap::ValueEnum;
use serde::{Deserialize, Serialize};

use super::scene::Scene;
use crate::precision::numbers::{goal, grouped};

/// No solve takes longer; one that would has no time that counts.
const MOST_TIME: &str = "10m";

/// One way to solve one scene.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Cell {
    pub(super) scene: Scene,
    pub(super) method: Method,
    /// As asked for; nothing where meshes are refined to a stated error.
    pub(super) elements: Option<usize>,
    /// The unshot share, or the stated error, that ends the work.
    pub(super) goal: f64,
    /// How shooters follow each other; nothing where the method or the program decides.
    pub(super) schedule: Option<String>,
    /// How loops are shared out; nothing where the program decides.
    #[serde(rename = "loop")]
    pub(super) sharing: Option<String>,
    /// What finds occluders; nothing where the program decides.
    pub(super) accel: Option<Accel>,
    pub(super) threads: usize,
    /// How many programs run at once, each with so many threads.
    pub(super) programs: usize,
}

/// How light is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(super) enum Method {
    /// One mesh of --elements, shot until a share of the power is unshot
    Mesh,
    /// The same by plain progressive refinement: one patch at a time, neither overshooting nor
    /// corrections
    Plain,
    /// Meshes that become finer where the light changes, until the stated error is the goal
    Refine,
    /// The same with elements of one size
    Uniform,
    /// The same with elements cut into three at their centroids
    Centroid,
}

/// What finds occluders.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum)]
#[serde(rename_all = "lowercase")]
pub(super) enum Accel {
    Bvh,
    Octree,
}

impl Method {
    /// Whether the goal is a stated error, and the number of elements follows from it.
    pub(super) fn refines(self) -> bool {
        matches!(self, Self::Refine | Self::Uniform | Self::Centroid)
    }

    /// How it is called on the command line, in records and in legends.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Mesh => "mesh",
            Self::Plain => "plain",
            Self::Refine => "refine",
            Self::Uniform => "uniform",
            Self::Centroid => "centroid",
        }
    }
}

impl Accel {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Bvh => "bvh",
            Self::Octree => "octree",
        }
    }
}

impl Cell {
    /// The command line after `radiosity solve SCENE`.
    pub(super) fn settings(&self) -> Vec<String> {
        let mut line = self.goal_flags();
        match self.method {
            Method::Mesh | Method::Refine => {}
            Method::Plain => line += " --no-overshoot --no-corrections",
            Method::Uniform => line += " --split none",
            Method::Centroid => line += " --split centroid",
        }
        line += &format!("{} --threads {} --max-time {MOST_TIME}", self.choices(), self.threads);
        line.split_whitespace().map(str::to_owned).collect()
    }

    fn goal_flags(&self) -> String {
        match self.elements {
            Some(elements) => {
                format!("--elements {elements} --converge {} --no-statement", self.goal)
            }
            None => format!("--error {}", self.goal),
        }
    }

    /// The flags of schedule, loop and occluder, each after a blank; nothing where none is given.
    pub(super) fn choices(&self) -> String {
        let plain = (self.method == Method::Plain).then_some("single");
        let flags = [
            ("--schedule", self.schedule.as_deref().or(plain)),
            ("--loop", self.sharing.as_deref()),
            ("--accel", self.accel.map(Accel::name)),
        ];
        let given = flags.into_iter().filter_map(|(flag, value)| Some((flag, value?)));
        given.map(|(flag, value)| format!(" {flag} {value}")).collect()
    }

    /// How it is called while it runs and in comparisons.
    pub(super) fn name(&self) -> String {
        let work = match self.elements {
            Some(elements) => {
                format!("{} elements to {} unshot", grouped(elements as u64), goal(self.goal))
            }
            None => format!("to a stated {}", goal(self.goal)),
        };
        let at_once = match self.programs {
            1 => String::new(),
            programs => format!(", {programs} programs at once"),
        };
        let (scene, method, threads) = (self.scene.name(), self.method.name(), self.threads);
        format!("{scene}, {method}, {work},{} --threads {threads}{at_once}", self.choices())
    }

    /// The cell whose solution must have the same bytes: on one thread, with the program's own
    /// loops and occluder. Schedules take other steps, so their last digits are their own.
    pub(super) fn light(&self) -> Self {
        Self { sharing: None, accel: None, threads: 1, programs: 1, ..self.clone() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bench::sample;

    #[test]
    fn each_method_has_its_command_line() {
        let mesh = sample::cell();
        let line = |cell: &Cell| cell.settings().join(" ");
        let fixed = "--elements 8000 --converge 0.001 --no-statement";
        assert_eq!(line(&mesh), format!("{fixed} --threads 2 --max-time 10m"));
        let plain = Cell { method: Method::Plain, ..mesh.clone() };
        let expected = format!(
            "{fixed} --no-overshoot --no-corrections --schedule single --threads 2 --max-time 10m"
        );
        assert_eq!(line(&plain), expected);
        let refine = Cell { method: Method::Refine, elements: None, goal: 0.02, ..mesh.clone() };
        assert_eq!(line(&refine), "--error 0.02 --threads 2 --max-time 10m");
        let uniform = Cell { method: Method::Uniform, ..refine.clone() };
        assert_eq!(line(&uniform), "--error 0.02 --split none --threads 2 --max-time 10m");
        let chosen = Cell {
            schedule: Some("multi:4".into()),
            sharing: Some("static".into()),
            accel: Some(Accel::Octree),
            ..mesh
        };
        assert_eq!(
            line(&chosen),
            format!(
                "{fixed} --schedule multi:4 --loop static --accel octree --threads 2 --max-time 10m"
            )
        );
    }

    #[test]
    fn names_say_what_is_solved() {
        let cell = sample::cell();
        assert_eq!(cell.name(), "room, mesh, 8,000 elements to 0.1 % unshot, --threads 2");
        let refine = Cell { method: Method::Refine, elements: None, programs: 2, ..cell };
        assert_eq!(
            refine.name(),
            "room, refine, to a stated 0.1 %, --threads 2, 2 programs at once"
        );
    }

    #[test]
    fn methods_are_called_alike_everywhere() {
        for method in Method::value_variants() {
            assert_eq!(method.to_possible_value().unwrap().get_name(), method.name());
            assert_eq!(serde_json::to_value(method).unwrap(), method.name());
        }
        for accel in Accel::value_variants() {
            assert_eq!(accel.to_possible_value().unwrap().get_name(), accel.name());
        }
    }
}
