//! Time of one step of the shooting, by elements and occluder, and of the little of it that is not
//! transfer, by receiver points.
//!
//! To select a patch, and to commit what arrived, are not public by themselves. The group `commit`
//! measures a step whose transfer is as small as can be: a small lamp of one patch, far away, so
//! that each receiver point takes one kernel value, and nothing that could be in between. What is
//! left is light added to points, elements and patches.

#![expect(clippy::unwrap_used, reason = "a bench that cannot go on may panic")]

use std::time::Duration;

use accel::{Bvh, BvhConfig, Nothing, Occluder, Octree, OctreeConfig};
use criterion::{
    BatchSize, Bencher, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use radiosity_core::{Census, Mesh, MeshConfig, Schedule, Sequential, Shooting, ShootingConfig};
use scene::Scene;

#[path = "../tests/integration/models.rs"]
#[allow(dead_code, reason = "shared with the tests, which use all of it")]
mod models;

use models::Model;

/// Elements of each mesh.
const ELEMENTS: [usize; 3] = [1000, 10_000, 100_000];

/// A closed cube with a lamp below its ceiling and 5 × 5 tilted boards half way down.
fn room() -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    let bright = model.surface(0.0, 1.0);
    model.cube([wall; 6]);
    for (i, j) in (0..5).flat_map(|i| (0..5).map(move |j| (i, j))) {
        let [x, y] = [i, j].map(|k| 0.2 * f64::from(k) + 0.05);
        let [far_x, far_y] = [x + 0.1, y + 0.1];
        model.quad([[x, y, 0.5], [far_x, y, 0.5], [far_x, far_y, 0.53], [x, far_y, 0.53]], wall);
    }
    model.quad([[0.4, 0.4, 0.97], [0.4, 0.6, 0.97], [0.6, 0.6, 0.97], [0.6, 0.4, 0.97]], bright);
    model.scene()
}

/// A floor of side 1 and, twenty of its own edges above, a lamp that is split no further.
fn floor() -> Scene {
    let mut model = Model::new();
    let grey = model.surface(0.5, 0.0);
    let bright = model.surface(0.0, 1.0);
    model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]], grey);
    let edge = 1e-3;
    model.triangle([[0.5, 0.5, 0.02], [0.5, 0.5 + edge, 0.02], [0.5 + edge, 0.5, 0.02]], bright);
    model.scene()
}

/// One patch shoots: the first of a new solve, its buffers included.
fn first_step(mesh: &Mesh, occluder: &dyn Occluder, config: ShootingConfig, bencher: &mut Bencher) {
    let none = Census::default();
    bencher.iter_batched_ref(
        || Shooting::new(mesh, occluder, &none, &Sequential, config),
        |shooting| shooting.step(),
        BatchSize::LargeInput,
    );
}

fn step(criterion: &mut Criterion) {
    let scene = room();
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let octree = Octree::build(&triangles, &OctreeConfig::default());
    let occluders: [(&str, &dyn Occluder); 3] =
        [("nothing", &Nothing), ("bvh", &bvh), ("octree", &octree)];
    let config = ShootingConfig { schedule: Schedule::Single, ..ShootingConfig::until(1e-3) };
    let meshes = ELEMENTS.map(|n| Mesh::from_scene(&scene, &MeshConfig::with_elements(n)));
    for (name, occluder) in occluders {
        let mut group = criterion.benchmark_group(format!("step/{name}"));
        for mesh in &meshes {
            let elements = mesh.elements().len();
            group.throughput(Throughput::Elements(elements as u64));
            group.bench_function(BenchmarkId::from_parameter(elements), |bencher| {
                first_step(mesh, occluder, config, bencher);
            });
        }
    }
}

fn commit(criterion: &mut Criterion) {
    let scene = floor();
    // No cell of the lamp is split, and no element gets points inside.
    let shooting = ShootingConfig {
        schedule: Schedule::Single,
        cell_share: f64::INFINITY,
        bright: f64::INFINITY,
        ..ShootingConfig::until(1e-3)
    };
    let mut group = criterion.benchmark_group("commit");
    for elements in ELEMENTS {
        let config = MeshConfig { graded: false, ..MeshConfig::with_elements(elements) };
        let mesh = Mesh::from_scene(&scene, &config);
        let points = mesh.points().len();
        group.throughput(Throughput::Elements(points as u64));
        group.bench_function(BenchmarkId::from_parameter(points), |bencher| {
            first_step(&mesh, &Nothing, shooting, bencher);
        });
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default()
        .sample_size(10)
        .warm_up_time(Duration::from_millis(300))
        .measurement_time(Duration::from_secs(1));
    targets = step, commit
}
criterion_main!(benches);
