//! Nanoseconds per form factor: estimators from a point by distance over size, pairs of triangles by
//! distance and tolerance, and pairs behind occluders.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use form_factor::{
    Occluders, Polygon, REFERENCE, between, between_occluded, centroid_kernel, lambert,
    three_point_kernel,
};
use glam::DVec3;

/// Distances in longest edges. A tolerance of 1 % takes the exact form up to 2, three points up to
/// 10, one beyond.
const DISTANCES: [f64; 7] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0];

/// Points on a floor and triangles of longest edge 1 above it, at a distance.
fn pairs(distance: f64) -> Vec<(DVec3, [DVec3; 3])> {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    (0..256)
        .map(|i| {
            let t = f64::from(i);
            let point = DVec3::new((t * 0.37).fract() * 4.0, (t * 0.71).fract() * 4.0, 0.0);
            // Up to 45° off the normal.
            let aside = DVec3::new((t * 0.13).fract() - 0.5, (t * 0.29).fract() - 0.5, 1.0);
            let at = point + aside.normalize() * distance;
            (point, [at, at + DVec3::Y * half, at + DVec3::X * half])
        })
        .collect()
}

fn from_points(c: &mut Criterion) {
    let down = DVec3::NEG_Z;
    by_distance(c, "centroid_kernel", |p, t| {
        centroid_kernel(p, DVec3::Z, (t[0] + t[1] + t[2]) / 3.0, down, 0.25)
    });
    by_distance(c, "three_point_kernel", |p, t| three_point_kernel(p, DVec3::Z, t, down, 0.25));
    by_distance(c, "lambert", |p, t| lambert(p, DVec3::Z, t).form_factor);
    // The horizon of a normal along the floor runs through many of the triangles.
    by_distance(c, "lambert_cut", |p, t| lambert(p, DVec3::X, t).form_factor);
}

fn by_distance(c: &mut Criterion, name: &str, f: impl Fn(DVec3, [DVec3; 3]) -> f64) {
    let mut group = c.benchmark_group(format!("form_factor/{name}"));
    for distance in DISTANCES {
        let pairs = pairs(distance);
        group.throughput(Throughput::Elements(pairs.len() as u64));
        group.bench_function(BenchmarkId::from_parameter(distance), |b| {
            b.iter(|| black_box(&pairs).iter().map(|(p, t)| f(*p, *t)).sum::<f64>());
        });
    }
}

/// Numbers in 0..1 that look random (xorshift, Marsaglia 2003).
struct Random(u64);

impl Random {
    fn number(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    fn vector(&mut self) -> DVec3 {
        DVec3::new(self.number() - 0.5, self.number() - 0.5, self.number() - 0.5)
    }

    /// A triangle of edges near 1 around a place, turned towards another place.
    fn triangle(&mut self, at: DVec3, towards: DVec3) -> Polygon {
        loop {
            let [p, q, r] = [(); 3].map(|()| at + self.vector());
            let Some(triangle) = Polygon::triangle([p, q, r]) else { continue };
            if triangle.area() < 0.1 {
                continue;
            }
            if triangle.normal().dot(towards - at) > 0.0 {
                return triangle;
            }
            return Polygon::triangle([p, r, q]).expect("it has the same area");
        }
    }
}

/// Random pairs that face one another at a distance in edges.
fn apart(random: &mut Random, distance: [f64; 2]) -> Vec<(Polygon, Polygon)> {
    (0..256)
        .map(|_| {
            let far = distance[0] + (distance[1] - distance[0]) * random.number();
            let at = random.vector().normalize() * far;
            (random.triangle(DVec3::ZERO, at), random.triangle(at, DVec3::ZERO))
        })
        .collect()
}

/// Random pairs that share an edge, at angles of 30° to 150°.
fn touching(random: &mut Random) -> Vec<(Polygon, Polygon)> {
    (0..256)
        .map(|_| {
            let (sin, cos) = (0.5 + 2.0 * random.number()).sin_cos();
            let [x, y] = [random.number(), 0.3 + random.number()];
            let one = [DVec3::ZERO, DVec3::X, DVec3::new(x, y, 0.0)];
            let two = [DVec3::X, DVec3::ZERO, DVec3::new(y, x * cos + cos, sin + x * sin)];
            let [one, two] = [one, two].map(|t| Polygon::triangle(t).expect("it has an area"));
            (one, two)
        })
        .collect()
}

fn between_triangles(c: &mut Criterion) {
    let mut random = Random(88_172_645_463_325_252);
    let sets = [
        ("far", apart(&mut random, [10.0, 30.0])),
        ("middle", apart(&mut random, [3.0, 10.0])),
        ("near", apart(&mut random, [0.8, 2.0])),
        ("touching", touching(&mut random)),
    ];
    for (name, pairs) in &sets {
        let mut group = c.benchmark_group(format!("between/{name}"));
        group.throughput(Throughput::Elements(pairs.len() as u64));
        for tolerance in [1e-1, 1e-2, 1e-3, 1e-4, REFERENCE] {
            group.bench_function(format!("{tolerance:e}"), |b| {
                let f = |(one, two): &(Polygon, Polygon)| between(one, two, tolerance).value;
                b.iter(|| black_box(pairs).iter().map(f).sum::<f64>());
            });
        }
    }
}

fn behind_occluders(c: &mut Criterion) {
    let mut random = Random(362_436_069_521_288_629);
    let pairs = &apart(&mut random, [2.0, 4.0])[..32];
    for count in [1, 4] {
        // Around the middle of each pair, so that most stand in between.
        let cases: Vec<_> = pairs
            .iter()
            .map(|(one, two)| {
                let middle = (one.corners()[0] + two.corners()[0]) / 2.0;
                let screens: Vec<_> = (0..count)
                    .map(|_| {
                        let at = middle + random.vector() * 0.5;
                        [(); 3].map(|()| at + random.vector())
                    })
                    .collect();
                (one, two, Occluders::build(&screens))
            })
            .collect();
        let mut group = c.benchmark_group(format!("between_occluded/{count}"));
        group.throughput(Throughput::Elements(cases.len() as u64));
        group.sample_size(10);
        for tolerance in [1e-1, 1e-2, 1e-3] {
            group.bench_function(format!("{tolerance:e}"), |b| {
                b.iter(|| {
                    let f =
                        cases.iter().map(|(a, b, o)| between_occluded(a, b, o, tolerance).value);
                    f.sum::<f64>()
                });
            });
        }
    }
}

criterion_group!(benches, from_points, between_triangles, behind_occluders);
criterion_main!(benches);
