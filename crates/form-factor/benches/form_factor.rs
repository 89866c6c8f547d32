//! Nanoseconds per form factor: each estimator on the same pairs of point and triangle.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use form_factor::{centroid_kernel, lambert, three_point_kernel};
use glam::DVec3;

/// Points on a floor and unit triangles above it, at distances of 1 to 20.
fn pairs() -> Vec<(DVec3, [DVec3; 3])> {
    (0..256)
        .map(|i| {
            let t = f64::from(i);
            let point = DVec3::new((t * 0.37).fract() * 4.0, (t * 0.71).fract() * 4.0, 0.0);
            let at = DVec3::new((t * 0.13).fract() * 4.0, 0.0, 1.0 + (t * 0.29).fract() * 19.0);
            (point, [at, at + DVec3::Y, at + DVec3::X])
        })
        .collect()
}

fn form_factors(c: &mut Criterion) {
    let pairs = pairs();
    let mut group = c.benchmark_group("form_factor");
    group.throughput(Throughput::Elements(pairs.len() as u64));
    let mut sum_of = |name: &str, f: &dyn Fn(DVec3, [DVec3; 3]) -> f64| {
        group.bench_function(name, |b| {
            b.iter(|| black_box(&pairs).iter().map(|(p, t)| f(*p, *t)).sum::<f64>());
        });
    };
    let down = DVec3::NEG_Z;
    sum_of("centroid_kernel", &|p, t| {
        centroid_kernel(p, DVec3::Z, (t[0] + t[1] + t[2]) / 3.0, down, 0.5)
    });
    sum_of("three_point_kernel", &|p, t| three_point_kernel(p, DVec3::Z, t, down, 0.5));
    sum_of("lambert", &|p, t| lambert(p, DVec3::Z, t).form_factor);
    sum_of("lambert_cut", &|p, t| lambert(p, DVec3::X, t).form_factor);
}

criterion_group!(benches, form_factors);
criterion_main!(benches);
