//! Segments per second, by scene, kind of segment and structure, by triangles, and by the size of a
//! batch; on one thread.

use std::hint::black_box;
use std::time::Duration;

use accel::{Occluder, Segment, Target};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

#[path = "../tests/integration/support/mod.rs"]
#[allow(dead_code, clippy::print_stdout, reason = "shared with the tests, which use all of it")]
mod support;

use support::all::All;
use support::rng::Rng;
use support::{Triangle, scenes, segments, shared};

/// Segments per iteration: enough that no branch predictor learns them by heart.
const COUNT: usize = 16_384;

fn bench_scene(criterion: &mut Criterion, name: &str, scene: &[Triangle]) {
    let all = All::build(scene);
    let (lo, hi) = scenes::bounds(scene);
    let mut rng = Rng(1);
    let random: Vec<Segment> = (0..COUNT).map(|_| segments::random(lo, hi, &mut rng)).collect();
    let offset = 1e-3 * all.bvh.extent();
    let shooting: Vec<Segment> =
        (0..COUNT).map(|_| segments::shooting(scene, offset, &mut rng)).collect();
    let occluders: [(&str, &dyn Occluder); 3] =
        [("bvh", &all.bvh), ("octree", &all.octree), ("brute_force", &all.brute)];
    for (kind, segments) in [("random", &random), ("shooting", &shooting)] {
        let mut group = criterion.benchmark_group(format!("{name}/{kind}"));
        group.throughput(Throughput::Elements(COUNT as u64));
        for (structure, occluder) in occluders {
            if structure == "brute_force" && scene.len() > 1000 {
                continue;
            }
            group.bench_function(structure, |bencher| {
                bencher
                    .iter(|| segments.iter().filter(|s| occluder.occluded(black_box(s))).count());
            });
        }
    }

    let (from, targets) = one_to_all(scene, offset, &mut rng);
    let mut group = criterion.benchmark_group(format!("{name}/batch"));
    group.throughput(Throughput::Elements(COUNT as u64));
    for (structure, occluder) in &occluders[..2] {
        let mut blocked = vec![false; COUNT];
        group.bench_function(*structure, |bencher| {
            bencher.iter(|| {
                let (from, ignore) = (black_box(from.from), from.ignore[0]);
                occluder.occluded_batch(from, ignore, &targets, &mut blocked);
            });
        });
    }
}

/// From one point to all triangles in the order of the file, as a solver shoots.
fn one_to_all(scene: &[Triangle], offset: f64, rng: &mut Rng) -> (Segment, Vec<Target>) {
    let from = segments::shooting(scene, offset, rng);
    let targets = (0..COUNT)
        .map(|i| {
            let triangle = i * scene.len() / COUNT;
            Target { point: rng.on(&scene[triangle]), ignore: triangle as u32 }
        })
        .collect();
    (from, targets)
}

/// Halls of ever more columns: how the time of a segment grows with the triangles.
fn by_triangles(criterion: &mut Criterion) {
    for kind in ["single", "batch"] {
        for structure in ["bvh", "octree"] {
            let mut group = criterion.benchmark_group(format!("triangles/{kind}/{structure}"));
            group.throughput(Throughput::Elements(COUNT as u64));
            for columns in [2, 4, 8, 16, 32] {
                let scene = scenes::columns(columns, 16);
                let all = All::build(&scene);
                let occluder: &dyn Occluder =
                    if structure == "bvh" { &all.bvh } else { &all.octree };
                let mut rng = Rng(2);
                let offset = 1e-3 * all.bvh.extent();
                let segments: Vec<Segment> =
                    (0..COUNT).map(|_| segments::shooting(&scene, offset, &mut rng)).collect();
                let (from, targets) = one_to_all(&scene, offset, &mut rng);
                let mut blocked = vec![false; COUNT];
                group.bench_function(BenchmarkId::from_parameter(scene.len()), |bencher| {
                    if kind == "single" {
                        let asked = |s: &&Segment| occluder.occluded(black_box(s));
                        bencher.iter(|| segments.iter().filter(asked).count());
                    } else {
                        bencher.iter(|| {
                            let (from, ignore) = (black_box(from.from), from.ignore[0]);
                            occluder.occluded_batch(from, ignore, &targets, &mut blocked);
                        });
                    }
                });
            }
        }
    }
}

/// The same segments in batches of so many: what asking for more at once is worth.
fn by_batch(criterion: &mut Criterion) {
    let scene = scenes::columns(16, 16);
    let all = All::build(&scene);
    let (from, targets) = one_to_all(&scene, 1e-3 * all.bvh.extent(), &mut Rng(3));
    let occluders: [(&str, &dyn Occluder); 2] = [("bvh", &all.bvh), ("octree", &all.octree)];
    for (structure, occluder) in occluders {
        let mut group = criterion.benchmark_group(format!("batch_of/{structure}"));
        group.throughput(Throughput::Elements(COUNT as u64));
        for size in [1, 4, 16, 64, 256, 1024, COUNT] {
            let mut blocked = vec![false; COUNT];
            group.bench_function(BenchmarkId::from_parameter(size), |bencher| {
                bencher.iter(|| {
                    let (from, ignore) = (black_box(from.from), from.ignore[0]);
                    for (targets, blocked) in targets.chunks(size).zip(blocked.chunks_mut(size)) {
                        occluder.occluded_batch(from, ignore, targets, blocked);
                    }
                });
            });
        }
    }
}

fn occluded(criterion: &mut Criterion) {
    for name in ["room", "blocks", "church"] {
        if let Some(scene) = shared::scene(name) {
            bench_scene(criterion, name, &scene);
        }
    }
    bench_scene(criterion, "made_room", &scenes::room());
    bench_scene(criterion, "columns", &scenes::columns(16, 16));
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(20)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    targets = occluded, by_triangles, by_batch
}
criterion_main!(benches);
