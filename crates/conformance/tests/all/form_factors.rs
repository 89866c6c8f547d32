//! Lambert's form factor against exact values for 97 pairs, where that data is present.
//!
//! A point to a polygon is one closed form. A polygon to a polygon is its mean over the
//! smaller one, by Gauss's rule: it converges fast where the two are apart, slowly where they
//! touch, and the difference between two rules tells which.

use form_factor::lambert;
use glam::DVec3;
use serde_json::Value;

/// Largest difference of a closed form at a point, absolute: some hundred roundings of
/// numbers up to 1.
const CLOSED: f64 = 1e-12;

/// Nodes per side of the rule that is held to the exact value, and of the coarser one that
/// estimates its error.
const NODES: [usize; 2] = [24, 16];

/// A pair is apart when the two rules agree to this, relative to F.
const APART: f64 = 1e-9;

/// Nearer pairs count up to here; beyond, 24 nodes a side say too little.
const LOOSE: f64 = 1e-3;

/// The error of the finer rule, in differences between the two. On touching pairs errors fall
/// like n⁻² or faster, so the finer one errs by at most 1 / (1.5² − 1) = .8 of the difference;
/// the rest is for pairs where the two happen to agree.
const SAFETY: f64 = 10.0;

/// Length over width of a polygon beyond which 24 nodes a side do not resolve its ends, so that
/// two rules may agree on a wrong number.
const SLENDER: f64 = 50.0;

/// Rounding of a sum of angles that cancel, absolute: what is left where F is below 1e-6.
const CANCELS: f64 = 1e-15;

#[test]
fn exact_form_factors() {
    let Some(data) = crate::exact_cases::data() else { return };
    let (mut run, mut not_run) = (0, 0);
    for entry in data["form_factors"].as_array().unwrap() {
        let id = entry["id"].as_str().unwrap();
        match check(entry) {
            Ok(line) => {
                run += 1;
                println!("{id}: {line}");
            }
            Err(reason) => {
                not_run += 1;
                println!("{id}: not run: {reason}");
            }
        }
    }
    println!("{run} form factors checked, {not_run} not run");
    assert!(run >= 70, "the data holds more pairs that can be checked: {run}");
}

/// What was measured, or why nothing was.
fn check(entry: &Value) -> Result<String, &'static str> {
    let id = &entry["id"];
    match entry["kind"].as_str().unwrap() {
        "coaxial_discs" => return Err("discs are not polygons"),
        "occluded" => return Err("something is in between, which is visibility's concern"),
        "point_to_polygon" => {
            let normal = point(&entry["normal"]).normalize();
            let f = from_point(point(&entry["point"]), normal, &polygon(&entry["poly2"]));
            let exact = number(&entry["F12"]);
            assert!((f - exact).abs() <= CLOSED, "{id}: {f} {exact}");
            return Ok(format!("point, error {:.1e}", (f - exact).abs()));
        }
        _ => {}
    }
    let (one, two) = (polygon(&entry["poly1"]), polygon(&entry["poly2"]));
    let (from, to, exact) = if longest(&one) <= longest(&two) {
        (one, two, number(&entry["F12"]))
    } else {
        (two, one, number(&entry["F21"]))
    };
    if longest(&from).powi(2) > SLENDER * area(&from) {
        return Err("too slender for 24 nodes a side");
    }
    let [fine, coarse] = NODES.map(|n| mean(&from, &to, n));
    let difference = (fine - coarse).abs();
    let error = (fine - exact).abs();
    if difference > LOOSE * fine || fine == 0.0 {
        return Err("so near that 24 nodes a side settle less than three digits");
    }
    let bound = SAFETY * difference.max(APART * fine) + CANCELS;
    assert!(error <= bound, "{id}: {fine} {exact}, error {error:e}, at most {bound:e}");
    let how = if difference <= APART * fine { "apart" } else { "near" };
    Ok(format!("{how}, error {:.1e} of F, at most {:.1e}", error / exact, bound / exact))
}

/// The mean over `from` of the form factor to `to`: Gauss's rule on each triangle of the fan,
/// laid over the unit square by collapsing one side (Duffy 1982).
fn mean(from: &[DVec3], to: &[DVec3], nodes: usize) -> f64 {
    let rule = gauss(nodes);
    let (mut sum, mut total) = (0.0, 0.0);
    for [a, b, c] in fan(from) {
        let cross = (b - a).cross(c - a);
        let (area, normal) = (cross.length() / 2.0, cross.normalize());
        for &(u, wu) in &rule {
            for &(v, wv) in &rule {
                let at = a + (b - a) * (u * (1.0 - v)) + (c - a) * (u * v);
                sum += area * 2.0 * u * wu * wv * from_point(at, normal, to);
            }
        }
        total += area;
    }
    sum / total
}

fn from_point(at: DVec3, normal: DVec3, to: &[DVec3]) -> f64 {
    fan(to).map(|corners| lambert(at, normal, corners).form_factor).sum()
}

fn fan(polygon: &[DVec3]) -> impl Iterator<Item = [DVec3; 3]> {
    (2..polygon.len()).map(|i| [polygon[0], polygon[i - 1], polygon[i]])
}

fn longest(polygon: &[DVec3]) -> f64 {
    let edges = (0..polygon.len()).map(|i| polygon[i].distance(polygon[(i + 1) % polygon.len()]));
    edges.fold(0.0, f64::max)
}

fn area(polygon: &[DVec3]) -> f64 {
    fan(polygon).map(|[a, b, c]| (b - a).cross(c - a).length() / 2.0).sum()
}

/// Nodes and weights on [0, 1]: roots of the Legendre polynomial by Newton's method.
fn gauss(n: usize) -> Vec<(f64, f64)> {
    let node = |i: usize| {
        let mut x = (std::f64::consts::PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
        let mut slope = 1.0;
        for _ in 0..20 {
            let (mut p, mut before) = (1.0, 0.0);
            for k in 0..n {
                let k = k as f64;
                (p, before) = (((2.0 * k + 1.0) * x * p - k * before) / (k + 1.0), p);
            }
            slope = n as f64 * (x * p - before) / (x * x - 1.0);
            x -= p / slope;
        }
        ((1.0 + x) / 2.0, 1.0 / ((1.0 - x * x) * slope * slope))
    };
    (0..n).map(node).collect()
}

fn polygon(value: &Value) -> Vec<DVec3> {
    value.as_array().unwrap().iter().map(point).collect()
}

fn point(value: &Value) -> DVec3 {
    let [x, y, z] = [0, 1, 2].map(|i| value[i].as_f64().unwrap());
    DVec3::new(x, y, z)
}

fn number(value: &Value) -> f64 {
    value.as_str().unwrap().parse().unwrap()
}

#[test]
fn the_rule_integrates_polynomials() {
    // ∫ x⁹ = 1/10 with 5 nodes, exact to degree 9.
    let sum: f64 = gauss(5).into_iter().map(|(x, w)| w * x.powi(9)).sum();
    assert!((sum - 0.1).abs() < 1e-15, "{sum}");
}
