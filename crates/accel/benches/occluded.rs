//! Segments per second, by scene, kind of segment and structure, on one thread.

use std::hint::black_box;
use std::time::Duration;

use accel::{Occluder, Segment, Target};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};

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

    // From one point to all triangles in the order of the file, as a solver shoots.
    let from = segments::shooting(scene, offset, &mut rng);
    let targets: Vec<Target> = (0..COUNT)
        .map(|i| {
            let triangle = i * scene.len() / COUNT;
            Target { point: rng.on(&scene[triangle]), ignore: triangle as u32 }
        })
        .collect();
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
    targets = occluded
}
criterion_main!(benches);
