//! Which cells there are: studies, each a product of axes, together without doubles.

use std::path::Path;

use clap::ValueEnum;

use super::cell::{Accel, Cell, Method};
use super::scene::Scene;
use super::threads::Threads;

/// A question, and the axes that answer it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Study {
    /// Time against threads, by each way to share loops
    Threads,
    /// Error against time, where there is a reference
    Precision,
    /// Time and memory against elements
    Growth,
    /// Hierarchy and octree
    Occluders,
}

/// What was asked for on the command line; nothing where it is left to the studies.
#[derive(Clone, Debug, Default)]
pub(super) struct Asked {
    pub(super) studies: Vec<Study>,
    pub(super) scenes: Vec<Scene>,
    pub(super) elements: Vec<usize>,
    pub(super) methods: Vec<Method>,
    pub(super) schedules: Vec<String>,
    pub(super) loops: Vec<String>,
    pub(super) accels: Vec<Accel>,
    pub(super) threads: Option<Threads>,
    pub(super) quick: bool,
}

/// Values along which cells differ.
struct Axes {
    scenes: &'static [Scene],
    methods: &'static [Method],
    elements: &'static [usize],
    /// Unshot shares of fixed meshes.
    converge: &'static [f64],
    /// Stated errors of refinements.
    errors: &'static [f64],
    loops: &'static [&'static str],
    accels: &'static [Accel],
}

/// Those that are held against a reference where there is one. The church, whose every triangle
/// shoots, takes a minute a run: it is for those who ask for it.
const REFERENCED: &[Scene] = &[Scene::Room, Scene::Blocks, Scene::Cornell];

const THREADS: Axes = Axes {
    scenes: REFERENCED,
    methods: &[Method::Mesh],
    elements: &[20_000],
    converge: &[1e-3],
    errors: &[0.02],
    loops: &["tasks", "static", "dynamic:1", "guided:1"],
    accels: &[],
};

const PRECISION: Axes = Axes {
    scenes: REFERENCED,
    methods: &[Method::Refine, Method::Uniform, Method::Mesh, Method::Plain],
    elements: &[4000, 16_000],
    converge: &[1e-1, 1e-2, 1e-3],
    errors: &[0.08, 0.04, 0.02, 0.01],
    loops: &[],
    accels: &[],
};

/// From 1,000 to a million elements, two or three steps a decade.
const GROWTH: Axes = Axes {
    scenes: &[Scene::Room, Scene::Blocks],
    methods: &[Method::Mesh],
    elements: &[1000, 3000, 10_000, 30_000, 100_000, 300_000, 1_000_000],
    converge: &[1e-2],
    errors: &[0.02],
    loops: &[],
    accels: &[],
};

const OCCLUDERS: Axes = Axes {
    scenes: REFERENCED,
    methods: &[Method::Mesh],
    elements: &[20_000],
    converge: &[1e-3],
    errors: &[0.02],
    loops: &[],
    accels: &[Accel::Bvh, Accel::Octree],
};

/// What `--quick` keeps: two scenes, coarse meshes.
const QUICK: Axes = Axes {
    scenes: &[Scene::Room, Scene::Blocks],
    methods: &[Method::Refine, Method::Mesh],
    elements: &[1000, 2000, 4000],
    converge: &[1e-2],
    errors: &[0.08, 0.04],
    loops: &["tasks", "static"],
    accels: &[],
};

impl Study {
    fn axes(self) -> Axes {
        match self {
            Self::Threads => THREADS,
            Self::Precision => PRECISION,
            Self::Growth => GROWTH,
            Self::Occluders => OCCLUDERS,
        }
    }

    /// The same in less than a minute.
    fn quick_axes(self) -> Axes {
        let few = self.axes();
        let methods = if self == Self::Precision { QUICK.methods } else { few.methods };
        let elements = if self == Self::Growth { QUICK.elements } else { &QUICK.elements[1..2] };
        let loops = if self == Self::Threads { QUICK.loops } else { few.loops };
        Axes { scenes: QUICK.scenes, methods, elements, loops, ..QUICK }.with_accels(few.accels)
    }
}

impl Axes {
    fn with_accels(self, accels: &'static [Accel]) -> Self {
        Self { accels, ..self }
    }
}

impl Asked {
    /// All cells, each once, in the order in which a round runs them.
    pub(super) fn cells(&self, root: &Path, cores: usize) -> Vec<Cell> {
        let mut cells: Vec<Cell> = Vec::new();
        for study in Study::value_variants() {
            if !self.studies.is_empty() && !self.studies.contains(study) {
                continue;
            }
            for cell in self.of_study(*study, root, cores) {
                if !cells.contains(&cell) {
                    cells.push(cell);
                }
            }
        }
        cells
    }

    fn of_study(&self, study: Study, root: &Path, cores: usize) -> Vec<Cell> {
        let axes = if self.quick { study.quick_axes() } else { study.axes() };
        let scenes = either(&self.scenes, axes.scenes).into_iter();
        let scenes = scenes.filter(|s| study != Study::Precision || s.reference(root).is_some());
        let most = self.threads.iter().flat_map(Threads::iter).filter(|t| *t <= cores).max();
        let threads: Vec<usize> = match (study, &self.threads) {
            (Study::Threads, Some(threads)) => threads.iter().collect(),
            (Study::Threads, None) => (1..=cores).collect(),
            _ => vec![most.unwrap_or(cores)],
        };
        let loops: Vec<_> = axes.loops.iter().map(|l| (*l).to_owned()).collect();
        let loops = choices(&self.loops, &loops);
        let mut cells = Vec::new();
        for scene in scenes {
            for (method, elements, goal) in self.work(&axes) {
                for schedule in choices(&self.schedules, &[]) {
                    for sharing in &loops {
                        for accel in choices(&self.accels, axes.accels) {
                            cells.extend(threads.iter().map(|threads| Cell {
                                scene,
                                method,
                                elements,
                                goal,
                                schedule: schedule.clone(),
                                sharing: sharing.clone(),
                                accel,
                                threads: *threads,
                                programs: 1,
                            }));
                        }
                    }
                }
            }
        }
        if study == Study::Threads && cores > 1 {
            ceilings(&mut cells, cores);
        }
        cells
    }

    /// Method, elements and goal of each kind of work.
    fn work(&self, axes: &Axes) -> Vec<(Method, Option<usize>, f64)> {
        let mut work = Vec::new();
        for method in either(&self.methods, axes.methods) {
            if method.refines() {
                work.extend(axes.errors.iter().map(|goal| (method, None, *goal)));
                continue;
            }
            for elements in either(&self.elements, axes.elements) {
                work.extend(axes.converge.iter().map(|goal| (method, Some(elements), *goal)));
            }
        }
        work
    }
}

/// As many programs at once as there are cores, for each kind of work: they share nothing but the
/// machine, so no program's threads can do more. Each beside the one thread it is held against.
fn ceilings(cells: &mut Vec<Cell>, cores: usize) {
    let mut seen: Vec<Cell> = Vec::new();
    let mut place = 0;
    while place < cells.len() {
        let alone = &cells[place];
        place += 1;
        let light = alone.light();
        if alone.threads == 1 && !seen.contains(&light) {
            let many = Cell { programs: cores, ..alone.clone() };
            seen.push(light);
            cells.insert(place, many);
            place += 1;
        }
    }
}

/// What is asked for, or else what there is.
fn either<T: Clone>(asked: &[T], preset: &[T]) -> Vec<T> {
    if asked.is_empty() { preset.to_vec() } else { asked.to_vec() }
}

/// The same, with the program's own choice where nothing is given.
fn choices<T: Clone>(asked: &[T], preset: &[T]) -> Vec<Option<T>> {
    let given = either(asked, preset);
    if given.is_empty() { vec![None] } else { given.into_iter().map(Some).collect() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn nowhere() -> &'static Path {
        Path::new("/nonexistent/checkout")
    }

    fn only(study: Study) -> Asked {
        Asked { studies: vec![study], scenes: vec![Scene::Room], ..Asked::default() }
    }

    #[test]
    fn no_cell_is_there_twice() {
        let cells = Asked::default().cells(&crate::root(), 4);
        for (i, cell) in cells.iter().enumerate() {
            assert!(!cells[..i].contains(cell), "{}", cell.name());
        }
        assert!(cells.len() > 50, "{}", cells.len());
    }

    #[test]
    fn threads_go_with_every_loop() {
        let cells = only(Study::Threads).cells(nowhere(), 2);
        // Four loops on one and two threads; two programs at once for them all.
        assert_eq!(cells.len(), 4 * 2 + 1);
        let asked = Asked {
            threads: Some("1..24".parse().unwrap()),
            loops: vec!["static".into()],
            schedules: vec!["auto".into(), "single".into()],
            ..only(Study::Threads)
        };
        let cells = asked.cells(nowhere(), 2);
        assert_eq!(cells.len(), 2 * (24 + 1));
        assert_eq!((cells[0].threads, cells[1].programs, cells[25].threads), (1, 2, 1));
        // One core has no ceiling but itself.
        assert!(only(Study::Threads).cells(nowhere(), 1).iter().all(|cell| cell.programs == 1));
    }

    #[test]
    fn other_studies_take_what_the_machine_has() {
        let threads = |cores| {
            let asked = Asked { threads: Some("1..24".parse().unwrap()), ..only(Study::Growth) };
            let cells = asked.cells(nowhere(), cores);
            assert_eq!(cells.len(), 7);
            cells[0].threads
        };
        assert_eq!([threads(2), threads(64)], [2, 24]);
        assert_eq!(only(Study::Growth).cells(nowhere(), 3)[0].threads, 3);
    }

    #[test]
    fn without_a_reference_nothing_is_precise() {
        assert_eq!(only(Study::Precision).cells(nowhere(), 2), []);
    }

    #[test]
    fn what_is_asked_for_takes_the_place_of_the_studys_own() {
        let asked = Asked {
            elements: vec![500, 600],
            methods: vec![Method::Plain, Method::Refine],
            accels: vec![Accel::Octree],
            ..only(Study::Growth)
        };
        let cells = asked.cells(nowhere(), 1);
        let sizes: Vec<_> = cells.iter().map(|c| (c.method, c.elements, c.goal)).collect();
        let expected = [
            (Method::Plain, Some(500), 1e-2),
            (Method::Plain, Some(600), 1e-2),
            (Method::Refine, None, 0.02),
        ];
        assert_eq!(sizes, expected);
        assert!(cells.iter().all(|cell| cell.accel == Some(Accel::Octree)));
    }

    #[test]
    fn quick_is_small() {
        let quick = Asked { quick: true, ..Asked::default() };
        let cells = quick.cells(&crate::root(), 2);
        assert!((20..40).contains(&cells.len()), "{}", cells.len());
        assert!(cells.iter().all(|cell| cell.elements.is_none_or(|n| n <= 4000)));
    }
}
