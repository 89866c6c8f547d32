//! Time to build each structure, per triangle, by scene and by the number of triangles.

use std::hint::black_box;
use std::time::Duration;

use accel::{Bvh, BvhConfig, Octree, OctreeConfig};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

#[path = "../tests/integration/support/mod.rs"]
#[allow(dead_code, clippy::print_stdout, reason = "shared with the tests, which use all of it")]
mod support;

use support::{Triangle, scenes, shared};

fn bench_scene(criterion: &mut Criterion, name: &str, scene: &[Triangle]) {
    let mut group = criterion.benchmark_group(format!("build/{name}"));
    group.throughput(Throughput::Elements(scene.len() as u64));
    for bins in [8, 16, 32] {
        let config = BvhConfig { bins };
        group.bench_function(format!("bvh_{bins}_bins"), |bencher| {
            bencher.iter(|| Bvh::build(black_box(scene), &config));
        });
    }
    group.bench_function("octree", |bencher| {
        bencher.iter(|| Octree::build(black_box(scene), &OctreeConfig::default()));
    });
}

fn build(criterion: &mut Criterion) {
    for name in ["room", "church"] {
        if let Some(scene) = shared::scene(name) {
            bench_scene(criterion, name, &scene);
        }
    }
    bench_scene(criterion, "columns", &scenes::columns(16, 16));
}

/// Halls of ever more columns.
fn by_triangles(criterion: &mut Criterion) {
    for structure in ["bvh", "octree"] {
        let mut group = criterion.benchmark_group(format!("build/triangles/{structure}"));
        for columns in [2, 4, 8, 16, 32] {
            let scene = scenes::columns(columns, 16);
            group.throughput(Throughput::Elements(scene.len() as u64));
            group.bench_function(BenchmarkId::from_parameter(scene.len()), |bencher| {
                if structure == "bvh" {
                    bencher.iter(|| Bvh::build(black_box(&scene), &BvhConfig::default()));
                } else {
                    bencher.iter(|| Octree::build(black_box(&scene), &OctreeConfig::default()));
                }
            });
        }
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    targets = build, by_triangles
}
criterion_main!(benches);
