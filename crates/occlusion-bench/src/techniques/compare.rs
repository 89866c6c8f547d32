//! All variants in turn on the same segments, slice by slice, on one thread.

use std::hint::black_box;
use std::time::Instant;

use accel::{Occluder, Segment};

use super::specimens;
use super::switches::{Effect, Technique, VARIANTS};
use crate::{Limits, Triangle, Workload};

/// Segments that are timed together: some milliseconds' work, less than a busy system's time slice.
const SLICE: usize = 2048;

/// Builds of each variant in a round: they are short beside the questions.
const BUILDS: usize = 3;

/// What was measured of one variant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The variant's name.
    pub name: &'static str,
    /// Seconds for all segments, made up of the quickest time of each slice.
    pub seconds: f64,
    /// Seconds of the quickest build.
    pub build: f64,
}

/// What was measured of all variants on one scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Comparison {
    /// The scene's name.
    pub scene: String,
    /// Segments asked in each round.
    pub segments: usize,
    /// Rounds.
    pub rounds: usize,
    /// The variants, as in [`VARIANTS`].
    pub measured: Vec<Measured>,
}

impl Comparison {
    /// Returns how many times as fast a technique makes what it is to quicken.
    pub fn gain(&self, technique: &Technique) -> f64 {
        let seconds = |name: &str| {
            let measured = self.measured.iter().find(|measured| measured.name == name);
            measured.map_or(f64::NAN, |measured| match technique.effect {
                Effect::Questions => measured.seconds,
                Effect::Build => measured.build,
            })
        };
        seconds(technique.off) / seconds(technique.on)
    }
}

/// Measures every variant on a scene's shooting segments.
///
/// Each slice of segments is put to all variants before the next, and a build of each variant
/// begins every round, so that whatever disturbs the machine disturbs all alike.
pub fn compare(scene: &str, workload: &Workload, limits: &Limits) -> Comparison {
    let segments = shooting(workload);
    let slices: Vec<&[Segment]> = segments.chunks(SLICE).collect();
    let mut best = vec![vec![f64::INFINITY; slices.len()]; VARIANTS.len()];
    let mut builds = vec![f64::INFINITY; VARIANTS.len()];
    let mut built: Vec<Option<Box<dyn Occluder>>> = Vec::new();
    built.resize_with(VARIANTS.len(), || None);
    let begin = Instant::now();
    let mut rounds = 0;
    while rounds < limits.runs.max(1)
        && (rounds == 0 || begin.elapsed().as_secs_f64() < limits.seconds)
    {
        // Each round of builds begins with another variant, since the first finds caches cold.
        for turn in 0..BUILDS * VARIANTS.len() {
            let variant = (5 * rounds + turn) % VARIANTS.len();
            let (occluder, seconds) = timed(|| specimens::build(variant, &workload.occluders));
            built[variant] = Some(occluder);
            builds[variant] = builds[variant].min(seconds);
        }
        let built: Vec<_> = built.iter().flatten().collect();
        for (i, slice) in slices.iter().enumerate() {
            for turn in 0..VARIANTS.len() {
                let variant = (rounds + turn) % VARIANTS.len();
                let ((), seconds) = timed(|| ask(&**built[variant], slice));
                best[variant][i] = best[variant][i].min(seconds);
            }
        }
        rounds += 1;
    }
    let measured = VARIANTS.iter().zip(best).zip(builds).map(|((variant, best), build)| Measured {
        name: variant.name,
        seconds: best.iter().sum(),
        build,
    });
    let measured = measured.collect();
    Comparison { scene: scene.to_owned(), segments: segments.len(), rounds, measured }
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let begin = Instant::now();
    let result = black_box(work());
    (result, begin.elapsed().as_secs_f64())
}

/// The segments of all batches, one by one.
pub(super) fn shooting(workload: &Workload) -> Vec<Segment> {
    let batches = workload.shooting.iter();
    batches
        .flat_map(|batch| batch.targets.iter().map(|t| Segment::new(batch.from, t.point)))
        .collect()
}

/// Asks; the name is that by which a profiler is told what to count.
#[inline(never)]
pub(super) fn ask(occluder: &dyn Occluder, segments: &[Segment]) {
    for segment in segments {
        black_box(occluder.occluded(black_box(segment)));
    }
}

/// Builds; the name is that by which a profiler is told what to count.
#[inline(never)]
pub(super) fn raise(variant: usize, triangles: &[Triangle]) -> Box<dyn Occluder> {
    specimens::build(variant, triangles)
}
