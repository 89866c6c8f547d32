//! Time to split a scene into a mesh, by its number of elements: longest edges halved, cuts,
//! patches and receiver points included.
//!
//! Halving alone is not public; of a cube of twelve triangles, which nothing cuts, it is two thirds
//! of the work, and the rest is receiver points. Time grows as N·log N.

#![expect(clippy::unwrap_used, reason = "a bench that cannot go on may panic")]

use std::hint::black_box;
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use radiosity_core::{Mesh, MeshConfig, Split};
use scene::Scene;

#[path = "../tests/integration/models.rs"]
#[allow(dead_code, reason = "shared with the tests, which use all of it")]
mod models;

use models::Model;

/// Elements of each mesh.
const ELEMENTS: [usize; 3] = [1000, 10_000, 100_000];

/// A cube seen from inside, with a lamp of this side a little above its floor.
fn cube(lamp: f64) -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    let bright = model.surface(0.5, 1.0);
    model.cube([wall; 6]);
    let (low, high, up) = (0.5 - lamp / 2.0, 0.5 + lamp / 2.0, lamp);
    model.quad([[low, low, up], [low, high, up], [high, high, up], [high, low, up]], bright);
    model.scene()
}

/// From the scene's triangles: elements of one size, and smaller ones round a narrow lamp.
fn growth(criterion: &mut Criterion) {
    for (name, graded, lamp) in [("even", false, 0.3), ("graded", true, 0.01)] {
        let scene = cube(lamp);
        let mut group = criterion.benchmark_group(format!("mesh/{name}"));
        for elements in ELEMENTS {
            let config = MeshConfig { graded, ..MeshConfig::with_elements(elements) };
            group.throughput(Throughput::Elements(elements as u64));
            group.bench_function(BenchmarkId::from_parameter(elements), |bencher| {
                bencher.iter_with_large_drop(|| Mesh::from_scene(black_box(&scene), &config));
            });
        }
    }
}

/// From a mesh of a quarter as many elements, more of them where a density asks for it.
fn refined(criterion: &mut Criterion) {
    let scene = cube(0.3);
    for (name, split) in [("halved", Split::LongestEdge), ("centroid", Split::Centroid)] {
        let mut group = criterion.benchmark_group(format!("refined/{name}"));
        for elements in ELEMENTS {
            let coarse = Mesh::from_scene(&scene, &MeshConfig::with_elements(elements / 4));
            let density: Vec<f64> =
                (0..coarse.elements().len()).map(|i| if i % 2 == 0 { 1.0 } else { 16.0 }).collect();
            let config = MeshConfig { split, ..MeshConfig::with_elements(elements) };
            group.throughput(Throughput::Elements(elements as u64));
            group.bench_function(BenchmarkId::from_parameter(elements), |bencher| {
                bencher.iter_with_large_drop(|| coarse.refined(black_box(&density), &config));
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
    targets = growth, refined
}
criterion_main!(benches);
