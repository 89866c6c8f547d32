//! Rounds of all contenders in turn, on one thread, timed slice by slice.

use std::hint::black_box;
use std::time::Instant;

use accel::{NO_TRIANGLE, Segment, Target};
use glam::DVec3;

use crate::contender::Subject;
use crate::{Contender, Structure, Structures, Workload};

/// Segments that are timed together: about a millisecond's work, less than a busy system's time
/// slice, so that some round runs it undisturbed, and enough that reading the clock costs nothing.
const SLICE: usize = 4096;

/// Which segments of a workload are asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// From sources to the vertices that face them.
    Shooting,
    /// Between random points; nothing is shared, so nobody is asked in batches.
    Random,
}

/// When to stop.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// Rounds, at most.
    pub runs: usize,
    /// Seconds after which no new round begins; one round is always run.
    pub seconds: f64,
}

/// What was measured of one contender.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The scene's name.
    pub scene: String,
    /// Which segments were asked.
    pub kind: Kind,
    /// The contender's name.
    pub name: &'static str,
    /// Triangles of the scene.
    pub triangles: usize,
    /// Segments asked in each round.
    pub segments: usize,
    /// Of these, how many are blocked according to this contender.
    pub blocked: usize,
    /// Answers that differ from those of accel's BVH; `None` if that was not measured.
    pub disagreements: Option<usize>,
    /// Rounds.
    pub runs: usize,
    /// Seconds of one round, made up of the quickest time of each slice of segments.
    pub best: f64,
    /// The median over the rounds of their seconds.
    pub median: f64,
    /// Seconds of the quickest build.
    pub build: f64,
    /// Heap memory, in bytes.
    pub bytes: usize,
}

/// Measures `contenders` on one kind of segments; those without a structure are left out.
///
/// A first round, not timed, takes the answers. Then each contender answers all segments in turn,
/// round after round, each round beginning with another one.
pub fn measure(
    scene: &str,
    workload: &Workload,
    kind: Kind,
    contenders: &[Contender],
    structures: &Structures,
    limits: &Limits,
) -> Vec<Row> {
    let slices = slices(workload, kind);
    let segments = slices.iter().map(Slice::len).sum();
    let mut runners: Vec<Runner<'_>> = contenders
        .iter()
        .filter(|contender| kind == Kind::Shooting || contender.asking != crate::Asking::Batch)
        .filter_map(|contender| Runner::new(contender, structures, slices.len()))
        .collect();
    let mut blocked = vec![false; SLICE];
    for runner in &mut runners {
        for slice in &slices {
            runner.subject.answer(slice, &mut blocked[..slice.len()]);
            runner.answers.extend_from_slice(&blocked[..slice.len()]);
        }
    }
    let begin = Instant::now();
    for run in 0..limits.runs.max(1) {
        if run > 0 && begin.elapsed().as_secs_f64() > limits.seconds {
            break;
        }
        for turn in 0..runners.len() {
            let first = run % runners.len();
            let count = runners.len();
            runners[(first + turn) % count].run(&slices, &mut blocked);
        }
    }
    let reference = runners
        .iter()
        .find(|runner| runner.contender.structure == Structure::AccelBvh)
        .map(|runner| runner.answers.clone());
    runners
        .iter()
        .map(|runner| runner.row(scene, kind, workload, segments, reference.as_deref()))
        .collect()
}

/// Segments that are timed together.
enum Slice<'a> {
    Shared(DVec3, &'a [Target]),
    Apart(&'a [Segment]),
}

impl Slice<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Shared(_, targets) => targets.len(),
            Self::Apart(segments) => segments.len(),
        }
    }
}

fn slices(workload: &Workload, kind: Kind) -> Vec<Slice<'_>> {
    match kind {
        Kind::Shooting => workload
            .shooting
            .iter()
            .flat_map(|batch| {
                batch.targets.chunks(SLICE).map(|targets| Slice::Shared(batch.from, targets))
            })
            .collect(),
        Kind::Random => workload.random.chunks(SLICE).map(Slice::Apart).collect(),
    }
}

impl Subject<'_> {
    fn answer(&self, slice: &Slice<'_>, blocked: &mut [bool]) {
        match (self, slice) {
            (Self::Batch(occluder), Slice::Shared(from, targets)) => {
                occluder.occluded_batch(*from, NO_TRIANGLE, targets, blocked);
            }
            (Self::Single(occluder), Slice::Shared(from, targets)) => {
                for (target, answer) in targets.iter().zip(blocked) {
                    *answer = occluder.occluded(&Segment::new(*from, target.point));
                }
            }
            (Self::Single(occluder) | Self::Batch(occluder), Slice::Apart(segments)) => {
                for (segment, answer) in segments.iter().zip(blocked) {
                    *answer = occluder.occluded(segment);
                }
            }
            (Self::Packets(embree), Slice::Shared(from, targets)) => {
                accel::Occluder::occluded_batch(embree, *from, NO_TRIANGLE, targets, blocked);
            }
            (Self::Packets(embree), Slice::Apart(segments)) => {
                embree.occluded_stream(segments, blocked);
            }
        }
    }
}

/// A contender with its times so far.
struct Runner<'a> {
    contender: Contender,
    subject: Subject<'a>,
    build: f64,
    bytes: usize,
    answers: Vec<bool>,
    /// The quickest time of each slice, in seconds.
    slices: Vec<f64>,
    /// The time of each round, in seconds.
    rounds: Vec<f64>,
}

impl<'a> Runner<'a> {
    fn new(contender: &Contender, structures: &'a Structures, slices: usize) -> Option<Self> {
        let built = structures.get(contender.structure)?;
        Some(Self {
            contender: *contender,
            subject: built.subject(contender.asking),
            build: built.seconds,
            bytes: built.bytes,
            answers: Vec::new(),
            slices: vec![f64::INFINITY; slices],
            rounds: Vec::new(),
        })
    }

    fn run(&mut self, slices: &[Slice<'_>], blocked: &mut [bool]) {
        let mut round = 0.0;
        for (slice, best) in slices.iter().zip(&mut self.slices) {
            let begin = Instant::now();
            self.subject.answer(black_box(slice), &mut blocked[..slice.len()]);
            black_box(&mut *blocked);
            let seconds = begin.elapsed().as_secs_f64();
            *best = best.min(seconds);
            round += seconds;
        }
        self.rounds.push(round);
    }

    fn row(
        &self,
        scene: &str,
        kind: Kind,
        workload: &Workload,
        segments: usize,
        reference: Option<&[bool]>,
    ) -> Row {
        let differ = |(a, b): &(&bool, &bool)| a != b;
        let mut rounds = self.rounds.clone();
        rounds.sort_by(f64::total_cmp);
        Row {
            scene: scene.to_owned(),
            kind,
            name: self.contender.name,
            triangles: workload.occluders.len(),
            segments,
            blocked: self.answers.iter().filter(|blocked| **blocked).count(),
            disagreements: reference.map(|r| r.iter().zip(&self.answers).filter(differ).count()),
            runs: rounds.len(),
            best: self.slices.iter().sum(),
            median: 0.5 * (rounds[(rounds.len() - 1) / 2] + rounds[rounds.len() / 2]),
            build: self.build,
            bytes: self.bytes,
        }
    }
}
