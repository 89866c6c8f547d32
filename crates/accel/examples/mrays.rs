//! Millions of segments per second, single and in batches, by scene, on one thread.
//!
//! `cargo run --release -p radiosity-accel --example mrays [SCENE]...`
//!
//! Segments run from a source, a little in front of a triangle's centroid, to all vertices that
//! face it, in the order of the triangles; as many sources as make a million segments. Every
//! variant of a scene is timed in turn and the best of several rounds counts, because other work
//! on the machine only ever adds time.

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a program for the terminal")]

use std::time::Instant;

use accel::{Bvh, BvhConfig, NO_TRIANGLE, Occluder, Segment, Target, Width};
use glam::{DVec3, dvec3};

#[path = "../tests/integration/support/mod.rs"]
#[allow(dead_code, reason = "shared with the tests, which use all of it")]
mod support;

use support::rng::Rng;
use support::{Triangle, scenes, shared};

/// Segments per scene.
const SEGMENTS: usize = 1_000_000;
/// Rounds of which the best counts.
const ROUNDS: usize = 7;

/// Triangles that may block, and those whose vertices are aimed at.
struct Scene {
    name: &'static str,
    occluders: Vec<Triangle>,
    receivers: Vec<Triangle>,
}

fn main() {
    let only: Vec<String> = std::env::args().skip(1).collect();
    println!(
        "{:<16}{:>9}{:>10}{:>9}{:>8}{:>8}{:>8}{:>9}{:>10}{:>8}{:>7}",
        "scene",
        "triangles",
        "blocked",
        "single",
        "x4",
        "x8",
        "x16",
        "random",
        "shuffled",
        "ns/tri",
        "B/tri"
    );
    for make in [room, columns, church, fine_church, terrain, unsplit_church] {
        if let Some(scene) = make(&only) {
            measure(&scene);
        }
    }
}

fn wanted(name: &'static str, only: &[String]) -> bool {
    only.is_empty() || only.iter().any(|o| o == name)
}

fn scene(
    name: &'static str,
    only: &[String],
    make: impl Fn() -> Option<Vec<Triangle>>,
) -> Option<Scene> {
    let occluders = wanted(name, only).then(make)??;
    Some(Scene { name, receivers: occluders.clone(), occluders })
}

fn room(only: &[String]) -> Option<Scene> {
    scene("room", only, || shared::scene("room"))
}

fn columns(only: &[String]) -> Option<Scene> {
    scene("columns", only, || Some(scenes::columns(16, 16)))
}

fn church(only: &[String]) -> Option<Scene> {
    scene("church", only, || shared::scene("church"))
}

fn fine_church(only: &[String]) -> Option<Scene> {
    scene("church_1m", only, || shared::scene("church").map(|scene| refined(&scene, 1_000_000)))
}

fn unsplit_church(only: &[String]) -> Option<Scene> {
    let mut scene = scene("church_unsplit", only, || shared::scene("church"))?;
    scene.receivers = refined(&scene.occluders, 1_000_000);
    Some(scene)
}

/// Hills of several sizes over a square, a million triangles in rows.
fn terrain(only: &[String]) -> Option<Scene> {
    scene("terrain_1m", only, || {
        let n = 708;
        let height = |x: f64, y: f64| {
            (0..6)
                .map(|k| {
                    let f = 3.0 * f64::from(1 << k);
                    (f * x + 1.3 * f64::from(k)).sin() * (f * y + 0.7 * f64::from(k)).cos()
                        / (1.7 * f)
                })
                .sum::<f64>()
        };
        let at = |i: usize, j: usize| {
            let (x, y) = (i as f64 / n as f64, j as f64 / n as f64);
            dvec3(x, y, height(x, y))
        };
        Some(
            (0..n * n)
                .flat_map(|k| {
                    let (i, j) = (k / n, k % n);
                    [
                        [at(i, j), at(i + 1, j), at(i + 1, j + 1)],
                        [at(i, j), at(i + 1, j + 1), at(i, j + 1)],
                    ]
                })
                .collect(),
        )
    })
}

/// Cuts the largest triangles into four until there are at least `count`, each in its own place.
fn refined(scene: &[Triangle], count: usize) -> Vec<Triangle> {
    let area = |t: &Triangle| (t[1] - t[0]).cross(t[2] - t[0]).length();
    let total: f64 = scene.iter().map(area).sum();
    let mut limit = 4.0 * total / count as f64;
    loop {
        let mut fine = Vec::new();
        for triangle in scene {
            cut(triangle, limit, &mut fine);
        }
        if fine.len() >= count {
            return fine;
        }
        limit *= 0.9;
    }
}

fn cut(t: &Triangle, limit: f64, fine: &mut Vec<Triangle>) {
    if (t[1] - t[0]).cross(t[2] - t[0]).length() <= limit {
        fine.push(*t);
        return;
    }
    let [a, b, c] = *t;
    let (ab, bc, ca) = (0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a));
    for part in [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]] {
        cut(&part, limit, fine);
    }
}

/// A source and the vertices that face it.
struct Shot {
    from: DVec3,
    targets: Vec<Target>,
}

fn normal(t: &Triangle) -> DVec3 {
    (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero()
}

fn shots(scene: &Scene, lift: f64) -> Vec<Shot> {
    let mut rng = Rng(17);
    let mut shots = Vec::new();
    let mut count = 0;
    while count < SEGMENTS {
        let source = &scene.receivers[rng.below(scene.receivers.len())];
        let n = normal(source);
        let from = (source[0] + source[1] + source[2]) / 3.0 + lift * n;
        let mut targets = Vec::new();
        for triangle in &scene.receivers {
            let m = normal(triangle);
            // One corner each: about as many as there are vertices, twice over.
            for vertex in &triangle[..1] {
                // Off the edges, where an end would lie in a neighbour's plane.
                let point = 0.99 * *vertex + 0.005 * (triangle[1] + triangle[2]) + lift * m;
                if (point - from).dot(n) > 0.0 && (from - point).dot(m) > 0.0 {
                    targets.push(Target { point, ignore: NO_TRIANGLE });
                }
            }
        }
        count += targets.len();
        if !targets.is_empty() {
            shots.push(Shot { from, targets });
        }
    }
    shots
}

/// Segments timed at once: a few milliseconds, between two interruptions.
const SLICE: usize = 16_384;

/// The best time of each slice of the work, over the rounds so far.
#[derive(Default)]
struct Clock {
    best: Vec<f64>,
}

impl Clock {
    /// Runs every slice once.
    fn round(&mut self, slices: usize, mut work: impl FnMut(usize)) {
        self.best.resize(slices, f64::INFINITY);
        for (slice, best) in self.best.iter_mut().enumerate() {
            let start = Instant::now();
            work(slice);
            *best = best.min(start.elapsed().as_secs_f64());
        }
    }

    fn seconds(&self) -> f64 {
        self.best.iter().sum()
    }
}

fn measure(scene: &Scene) {
    let (lo, hi) = scenes::bounds(&scene.occluders);
    let lift = 1e-4 * (hi - lo).max_element();
    let config = BvhConfig::default();
    let bvh = Bvh::build(&scene.occluders, &config);
    let mut shots = shots(scene, lift);
    let count: usize = shots.iter().map(|s| s.targets.len()).sum();
    let mut rng = Rng(5);
    let random: Vec<Segment> =
        (0..SEGMENTS).map(|_| Segment::new(rng.point(lo, hi), rng.point(lo, hi))).collect();

    // Small shots together, large ones cut.
    let mut slices: Vec<Vec<(usize, std::ops::Range<usize>)>> = vec![Vec::new()];
    let mut room = SLICE;
    for (i, shot) in shots.iter().enumerate() {
        let mut at = 0;
        while at < shot.targets.len() {
            let next = shot.targets.len().min(at + room);
            slices.last_mut().unwrap().push((i, at..next));
            room -= next - at;
            if room == 0 {
                slices.push(Vec::new());
                room = SLICE;
            }
            at = next;
        }
    }

    let mut answers = vec![false; SLICE];
    let (mut single, mut other, mut shuffled) =
        (Clock::default(), Clock::default(), Clock::default());
    let mut batches = Width::ALL.map(|width| (bvh.clone().with_width(width), Clock::default()));
    let mut blocked = 0;
    for _ in 0..ROUNDS {
        blocked = 0;
        single.round(slices.len(), |slice| {
            for (shot, range) in &slices[slice] {
                let shot = &shots[*shot];
                for target in &shot.targets[range.clone()] {
                    blocked += usize::from(bvh.occluded(&Segment::new(shot.from, target.point)));
                }
            }
        });
        for (bvh, clock) in &mut batches {
            let mut again = 0;
            clock.round(slices.len(), |slice| {
                for (shot, range) in &slices[slice] {
                    let shot = &shots[*shot];
                    let answers = &mut answers[..range.len()];
                    bvh.occluded_batch(
                        shot.from,
                        NO_TRIANGLE,
                        &shot.targets[range.clone()],
                        answers,
                    );
                    again += answers.iter().filter(|b| **b).count();
                }
            });
            assert_eq!(again, blocked, "{}", scene.name);
        }
        other.round(SEGMENTS / SLICE, |slice| {
            let random = &random[slice * SLICE..][..SLICE];
            assert!(random.iter().filter(|s| bvh.occluded(s)).count() <= SLICE);
        });
    }
    for shot in &mut shots {
        for i in (1..shot.targets.len()).rev() {
            shot.targets.swap(i, rng.below(i + 1));
        }
    }
    for _ in 0..ROUNDS {
        shuffled.round(slices.len(), |slice| {
            for (shot, range) in &slices[slice] {
                let shot = &shots[*shot];
                let answers = &mut answers[..range.len()];
                bvh.occluded_batch(shot.from, NO_TRIANGLE, &shot.targets[range.clone()], answers);
            }
        });
    }
    let mut build = Clock::default();
    for _ in 0..3 {
        build.round(1, |_| drop(Bvh::build(&scene.occluders, &config)));
    }
    let triangles = scene.occluders.len();
    let rate = |clock: &Clock, n: usize| n as f64 / clock.seconds() / 1e6;
    println!(
        "{:<16}{:>9}{:>9.1}%{:>9.1}{:>8.1}{:>8.1}{:>8.1}{:>9.1}{:>10.1}{:>8.0}{:>7.1}",
        scene.name,
        triangles,
        100.0 * blocked as f64 / count as f64,
        rate(&single, count),
        rate(&batches[0].1, count),
        rate(&batches[1].1, count),
        rate(&batches[2].1, count),
        rate(&other, SEGMENTS / SLICE * SLICE),
        rate(&shuffled, count),
        build.seconds() / triangles as f64 * 1e9,
        bvh.bytes() as f64 / triangles as f64,
    );
}
