//! Bakes ambient occlusion into the vertex colours of a PLY file.
//!
//! `cargo run -p radiosity-accel --example ambient_occlusion [-- SCENE.obj [OUT.ply]]`
//!
//! Ambient occlusion at a place is the share of an even sky that it sees, weighted by the cosine: 1
//! in the open, 0 where everything is covered. Without arguments: a square plate above a floor. The
//! middle of that floor sees all but the form factor to the plate, F = (4/π) k atan k with
//! k = a / √(a² + h²), a half the plate's side and h its height (Howell, *A Catalog of Radiation Heat
//! Transfer Configuration Factors*, B-4, four times); exit code 1 if it does not.
//!
//! Directions are a Hammersley set of 4^m points (i / 4^m, bits of i reversed), the first coordinate
//! the squared sine of the polar angle, the second the azimuth: equal areas of the unit square are
//! equal shares of the cosine-weighted sky (Malley's method).

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use accel::{Bvh, BvhConfig, NO_TRIANGLE, Occluder, Target, rounding_band};
use glam::{DVec3, dvec3};

/// Powers of 4 of directions for each corner, and for the one place that is checked.
const BAKED: u32 = 4;
const CHECKED: u32 = 8;
/// The plate's side and its height above the floor; the floor's side, and squares along it.
const PLATE: f64 = 1.0;
const HEIGHT: f64 = 0.5;
const FLOOR: f64 = 4.0;
const SQUARES: u32 = 12;
/// Corners are looked at from so far inside their triangle: on its rim, neighbours are edge on.
const INSIDE: f64 = 0.02;

type Triangle = [DVec3; 3];

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args_os().skip(1).map(PathBuf::from);
    let scene = arguments.next();
    let out = arguments.next().unwrap_or_else(|| std::env::temp_dir().join("occlusion.ply"));
    let triangles = match &scene {
        Some(path) => read(path)?,
        None => floor_and_plate(),
    };
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let sky = Sky { bvh: &bvh, reach: 4.0 * bvh.extent(), directions: directions(BAKED) };

    // One light per corner, not shared between triangles: creases stay sharp.
    let seen: Vec<[f64; 3]> = triangles
        .iter()
        .map(|&corners| {
            let [a, b, c] = corners;
            let (middle, normal) = ((a + b + c) / 3.0, (b - a).cross(c - a).normalize_or_zero());
            corners.map(|corner| sky.seen_from(corner.lerp(middle, INSIDE), normal))
        })
        .collect();
    write_ply(&out, &triangles, &seen)?;
    let mean = seen.as_flattened().iter().sum::<f64>() / (3 * seen.len()).max(1) as f64;
    println!("{} triangles, mean of {mean:.3} at their corners: {}", seen.len(), out.display());
    if scene.is_some() { Ok(()) } else { check(&bvh) }
}

/// What a place sees of the sky.
struct Sky<'a> {
    bvh: &'a Bvh,
    /// Farther than any triangle.
    reach: f64,
    /// Around +z.
    directions: Vec<DVec3>,
}

impl Sky<'_> {
    /// The share that is open from a place on a surface with this normal.
    fn seen_from(&self, place: DVec3, normal: DVec3) -> f64 {
        let (x, y) = normal.any_orthonormal_pair();
        let from = place + 2.0 * rounding_band(self.bvh.extent()) * normal;
        let to = |d: &DVec3| from + self.reach * (d.x * x + d.y * y + d.z * normal);
        let aim = |d| Target { point: to(d), ignore: NO_TRIANGLE };
        let targets: Vec<Target> = self.directions.iter().map(aim).collect();
        let mut blocked = vec![false; targets.len()];
        self.bvh.occluded_batch(from, NO_TRIANGLE, &targets, &mut blocked);
        1.0 - blocked.iter().filter(|b| **b).count() as f64 / blocked.len() as f64
    }
}

/// 4^m directions, spread by their cosine.
fn directions(m: u32) -> Vec<DVec3> {
    let n = 1_u32 << (2 * m);
    let direction = |i: u32| {
        let u = (f64::from(i) + 0.5) / f64::from(n);
        let v = f64::from(i.reverse_bits()) / 2.0_f64.powi(32);
        let (sin, cos) = (TAU * v).sin_cos();
        dvec3(u.sqrt() * cos, u.sqrt() * sin, (1.0 - u).sqrt())
    };
    (0..n).map(direction).collect()
}

fn read(path: &Path) -> Result<Vec<Triangle>, Box<dyn Error>> {
    let (models, _) = tobj::load_obj(path, &tobj::GPU_LOAD_OPTIONS)
        .map_err(|error| format!("{}: {error}", path.display()))?;
    let triangles = models.iter().flat_map(|model| {
        let corner = |i| DVec3::from_slice(&model.mesh.positions[3 * i as usize..]);
        model.mesh.indices.chunks_exact(3).map(move |t| [t[0], t[1], t[2]].map(corner))
    });
    Ok(triangles.collect())
}

/// A floor that faces up, in squares, and a plate above its middle that faces down.
fn floor_and_plate() -> Vec<Triangle> {
    let at = |i: u32, j: u32| {
        let along = |k: u32| FLOOR * (f64::from(k) / f64::from(SQUARES) - 0.5);
        dvec3(along(i), along(j), 0.0)
    };
    let cells = (0..SQUARES * SQUARES).map(|k| (k / SQUARES, k % SQUARES));
    let quad = |[a, b, c, d]: [DVec3; 4]| [[a, b, c], [a, c, d]];
    let floor =
        cells.flat_map(|(i, j)| quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]));
    let rim = [(-1.0, -1.0), (-1.0, 1.0), (1.0, 1.0), (1.0, -1.0)];
    let plate = quad(rim.map(|(x, y)| dvec3(0.5 * PLATE * x, 0.5 * PLATE * y, HEIGHT)));
    floor.chain(plate).collect()
}

/// Compares the floor's middle with the closed form.
fn check(bvh: &Bvh) -> Result<(), Box<dyn Error>> {
    let sky = Sky { bvh, reach: 4.0 * FLOOR, directions: directions(CHECKED) };
    let seen = sky.seen_from(DVec3::ZERO, DVec3::Z);
    let k = 0.5 * PLATE / f64::hypot(0.5 * PLATE, HEIGHT);
    let exact = 1.0 - 4.0 / PI * k * k.atan();
    // The set has one point in each of 2^m × 2^m cells. In (u, v) the plate's outline is eight
    // monotone arcs, each over 1/8 of v and 1/6 of u, so it meets fewer than 8 (1/8 + 1/6) 2^m + 8
    // cells, less than 2.5 · 2^m; only those can err.
    let allowed = 2.5 / f64::from(1_u32 << CHECKED);
    println!("the middle of the floor sees {seen:.5}; closed form {exact:.5} ± {allowed:.5}");
    match (seen - exact).abs() <= allowed {
        true => Ok(()),
        false => Err("the closed form was missed".into()),
    }
}

fn write_ply(path: &Path, triangles: &[Triangle], seen: &[[f64; 3]]) -> Result<(), Box<dyn Error>> {
    let mut out = BufWriter::new(std::fs::File::create(path)?);
    writeln!(out, "ply\nformat ascii 1.0\nelement vertex {}", 3 * triangles.len())?;
    for (kind, names) in [("double", ["x", "y", "z"]), ("uchar", ["red", "green", "blue"])] {
        names.iter().try_for_each(|name| writeln!(out, "property {kind} {name}"))?;
    }
    writeln!(out, "element face {}", triangles.len())?;
    writeln!(out, "property list uchar uint vertex_indices\nend_header")?;
    for (corner, light) in triangles.as_flattened().iter().zip(seen.as_flattened()) {
        let grey = (255.0 * light).round() as u8;
        writeln!(out, "{} {} {} {grey} {grey} {grey}", corner.x, corner.y, corner.z)?;
    }
    (0..triangles.len())
        .try_for_each(|t| writeln!(out, "3 {} {} {}", 3 * t, 3 * t + 1, 3 * t + 2))?;
    out.flush()?;
    Ok(())
}
