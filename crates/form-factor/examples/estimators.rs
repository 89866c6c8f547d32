//! What each estimator costs and how wrong it is, for random pairs of triangles, as CSV:
//! `cargo run --release -p radiosity-form-factor --example estimators`. `cargo xtask numerics` draws it.
//!
//! Pairs are of one size: longest edge 1, not thin, each wholly in front of the other, their
//! centroids `distance` apart. `error` is the 95th percentile of the relative error against
//! `between` at its finest tolerance, `nanoseconds` the least of several means per pair.

#![expect(clippy::print_stdout, reason = "its output is its purpose")]

use std::f64::consts::TAU;
use std::hint::black_box;
use std::time::Instant;

use form_factor::{Polygon, REFERENCE, between, centroid_kernel, lambert, three_point_kernel};
use glam::DVec3;

const DISTANCES: [f64; 6] = [0.6, 1.0, 2.0, 4.0, 10.0, 30.0];

/// Tolerances of `between`; finer ones come too near to that of the reference.
const TOLERANCES: [f64; 5] = [1e-1, 1e-2, 1e-4, 1e-6, 1e-8];

const PAIRS: usize = 512;

/// Of so many timings of all pairs the least counts: the others were disturbed.
const TIMINGS: usize = 7;

/// Longest edges squared that a triangle's area must be, so as not to be thin.
const FAT: f64 = 0.15;

/// The three-point rule on a triangle, exact for quadratics (Strang & Fix 1973).
const THREE_POINTS: [[f64; 3]; 3] = [
    [2.0 / 3.0, 1.0 / 6.0, 1.0 / 6.0],
    [1.0 / 6.0, 2.0 / 3.0, 1.0 / 6.0],
    [1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0],
];

/// A triangle with what estimators ask for.
struct Triangle {
    corners: [DVec3; 3],
    centroid: DVec3,
    normal: DVec3,
    area: f64,
    polygon: Polygon,
}

type Pair = (Triangle, Triangle);

fn main() {
    println!("distance,estimator,tolerance,nanoseconds,error");
    for distance in DISTANCES {
        let mut random = Random(1);
        let pairs: Vec<Pair> =
            std::iter::repeat_with(|| pair(&mut random, distance)).flatten().take(PAIRS).collect();
        let exact: Vec<f64> =
            pairs.iter().map(|(a, b)| between(&a.polygon, &b.polygon, REFERENCE).value).collect();
        let row = |name: &str, tolerance: &str, (nanoseconds, error): (f64, f64)| {
            println!("{distance},{name},{tolerance},{nanoseconds:.2},{error:.3e}");
        };
        row("kernel 1", "", judge(&pairs, &exact, kernel_1));
        row("kernel 3x3", "", judge(&pairs, &exact, kernel_3));
        row("lambert 1", "", judge(&pairs, &exact, lambert_1));
        row("lambert 3", "", judge(&pairs, &exact, lambert_3));
        for tolerance in TOLERANCES {
            let estimate = |(a, b): &Pair| between(&a.polygon, &b.polygon, tolerance).value;
            row("between", &format!("{tolerance:e}"), judge(&pairs, &exact, estimate));
        }
    }
}

fn kernel_1((a, b): &Pair) -> f64 {
    centroid_kernel(a.centroid, a.normal, b.centroid, b.normal, b.area)
}

fn kernel_3((a, b): &Pair) -> f64 {
    let at = |point| three_point_kernel(point, a.normal, b.corners, b.normal, b.area);
    a.three_points().map(at).iter().sum::<f64>() / 3.0
}

fn lambert_1((a, b): &Pair) -> f64 {
    lambert(a.centroid, a.normal, b.corners).form_factor
}

fn lambert_3((a, b): &Pair) -> f64 {
    let at = |point| lambert(point, a.normal, b.corners).form_factor;
    a.three_points().map(at).iter().sum::<f64>() / 3.0
}

/// Nanoseconds per pair and 95th percentile of the relative error.
fn judge(pairs: &[Pair], exact: &[f64], estimate: impl Fn(&Pair) -> f64) -> (f64, f64) {
    let mut errors: Vec<f64> =
        pairs.iter().zip(exact).map(|(pair, f)| (estimate(pair) / f - 1.0).abs()).collect();
    errors.sort_by(f64::total_cmp);
    let mut least = f64::INFINITY;
    for _ in 0..TIMINGS {
        let clock = Instant::now();
        for pair in pairs {
            black_box(estimate(black_box(pair)));
        }
        least = least.min(clock.elapsed().as_secs_f64() * 1e9 / pairs.len() as f64);
    }
    (least, errors[errors.len() * 95 / 100])
}

/// A pair whose triangles see all of one another; `None` if the next one does not.
fn pair(random: &mut Random, distance: f64) -> Option<Pair> {
    let (a, b) = (random.triangle(DVec3::ZERO)?, random.direction() * distance);
    let b = random.triangle(b)?;
    let sees = |from: &Triangle, to: &Triangle| {
        to.corners.iter().all(|corner| from.normal.dot(*corner - from.centroid) > 0.0)
    };
    (sees(&a, &b) && sees(&b, &a)).then_some((a, b))
}

impl Triangle {
    fn three_points(&self) -> [DVec3; 3] {
        let [a, b, c] = self.corners;
        THREE_POINTS.map(|w| a * w[0] + b * w[1] + c * w[2])
    }
}

/// Numbers that look random: SplitMix64 (Steele, Lea & Flood 2014).
struct Random(u64);

impl Random {
    /// From 0 to 1.
    fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Evenly over all directions.
    fn direction(&mut self) -> DVec3 {
        let (z, angle) = (2.0 * self.number() - 1.0, TAU * self.number());
        let (sine, cosine) = angle.sin_cos();
        let radius = (1.0 - z * z).sqrt();
        DVec3::new(radius * cosine, radius * sine, z)
    }

    /// A triangle around a centroid with a longest edge of 1; `None` if the next is thin.
    fn triangle(&mut self, centroid: DVec3) -> Option<Triangle> {
        let corners = [(); 3].map(|()| self.direction() * self.number());
        let [a, b, c] = corners;
        let longest = a.distance(b).max(b.distance(c)).max(c.distance(a));
        let middle = (a + b + c) / 3.0;
        let corners = corners.map(|corner| centroid + (corner - middle) / longest);
        let polygon = Polygon::triangle(corners)?;
        let (normal, area) = (polygon.normal(), polygon.area());
        (area > FAT).then_some(Triangle { corners, centroid, normal, area, polygon })
    }
}
