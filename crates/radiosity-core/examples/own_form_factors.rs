//! Form factors of one's own, by following rays, solved through the stored matrix.
//!
//! `cargo run -p radiosity-core --example own_form_factors [-- RAYS]`
//!
//! The shooting solver has no seam for another estimator: its form factors are part of how it sees near
//! and far light. The stored matrix takes anybody's: `Matrix::from_rows` with a standard error each.
//! Here every element of a mesh sends out rays (quasi-random places and directions, weighted by the
//! cosine), and F_ij is the share of them that first meets element j. Both directions of a pair estimate
//! one exchange, so their mean is taken; `Matrix::close` then brings the rows of the closed room back to
//! 1, and `MatrixShooting` solves. The light is compared with that of the shooting solver, whose form
//! factors are analytic; exit code 1 if they are further apart than rays so few explain.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::f64::consts::TAU;

use accel::{Bvh, BvhConfig, rounding_band};
use glam::DVec3;
use radiosity_core::matrix::{Entry, Matrix, MatrixConfig, MatrixShooting};
use radiosity_core::{Census, Exchange, Mesh, MeshConfig, Sequential, Shooting, ShootingConfig};
use scene::{Material, Rgb, Scene, SceneBuilder, Sides};

/// Rays from each element.
const RAYS: u32 = 1024;
const ELEMENTS: usize = 300;
/// Both solvers stop here, as a share of what is emitted.
const UNSHOT: f64 = 1e-5;
/// Relative: a matrix has constant light on each element, the solver interpolates between corners. Of
/// second order in an element over the room, 1/8 here.
const MESH: f64 = 1.0 / 64.0;

fn main() -> Result<(), Box<dyn Error>> {
    let rays = match std::env::args().nth(1) {
        Some(text) => text.parse().map_err(|error| format!("rays {text}: {error}"))?,
        None => RAYS,
    };
    let scene = room()?;
    let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(ELEMENTS));

    let surface = |of: fn(&Material) -> Rgb| -> Vec<Rgb> {
        mesh.elements().iter().map(|e| of(scene.material_of(mesh.root_of(e).triangle))).collect()
    };
    let (reflectance, emittance) = (surface(|m| m.reflectance), surface(|m| m.emittance));
    let solved = |first: u32| -> Result<Vec<Rgb>, Box<dyn Error>> {
        let mut matrix = by_rays(&mesh, rays, first)?;
        let raw = matrix.defects().map_or(0.0, |defects| defects.closure());
        let closed = matrix.close()?;
        let stored = matrix.values().len();
        println!("{stored} form factors from {rays} rays of each of {} elements", matrix.len());
        println!("  rows off by {raw:.3} at most; {:.0e} when closed", closed.after);
        let config = MatrixConfig::until(UNSHOT);
        let mut solver = MatrixShooting::new(&matrix, &reflectance, &emittance, config)?;
        solver.run();
        Ok(solver.exitance())
    };
    let (ours, again) = (solved(0)?, solved(rays * ELEMENTS as u32 * 2)?);

    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let census = Census::take(&scene, &mesh, &bvh, Exchange::OneSided, &Sequential);
    let config = ShootingConfig::until(UNSHOT);
    let mut shooting = Shooting::new(&mesh, &bvh, &census, &Sequential, config);
    shooting.run(&mut ());
    let theirs: Vec<Rgb> = shooting.solution().elements.iter().map(|e| e.exitance).collect();

    // E1: what is misplaced, of the light that is reflected.
    let apart = |one: &[Rgb], other: &[Rgb]| {
        let (mut misplaced, mut reflected) = (0.0, 0.0);
        for (i, element) in mesh.elements().iter().enumerate() {
            misplaced += element.area * (one[i] - other[i]).abs()[0];
            reflected += element.area * (other[i] - emittance[i])[0];
        }
        misplaced / reflected
    };
    let (noise, e1) = (apart(&ours, &again), apart(&ours, &theirs));
    println!("two sets of rays differ by {:.2} %", 100.0 * noise);
    println!("rays and the shooting solver by {:.2} %", 100.0 * e1);
    match e1 <= noise + MESH {
        true => Ok(()),
        false => Err("further apart than noise and mesh explain".into()),
    }
}

/// The form factors between all elements of a mesh, by following `rays` rays from each.
fn by_rays(mesh: &Mesh, rays: u32, first: u32) -> Result<Matrix, Box<dyn Error>> {
    let elements = mesh.elements();
    let corners = |i: usize| elements[i].vertices.map(|v| mesh.vertices()[v.index()]);
    let triangles: Vec<_> = (0..elements.len()).map(corners).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let lift = 2.0 * rounding_band(bvh.extent());

    // hits[i][j]: how many rays of i first meet the front of j.
    let mut hits = vec![vec![0_u32; elements.len()]; elements.len()];
    for (i, row) in hits.iter_mut().enumerate() {
        let normal = mesh.root_of(&elements[i]).normal;
        let (x, y) = normal.any_orthonormal_pair();
        for k in 0..rays {
            let [u, v, s, t] = quasi_random(first + i as u32 * rays + k);
            let [a, b, c] = triangles[i];
            // Evenly over a triangle (Turk 1990).
            let place = a + (b - a) * (u.sqrt() * (1.0 - v)) + (c - a) * (u.sqrt() * v);
            let (sin, cos) = (TAU * t).sin_cos();
            let way = s.sqrt() * (cos * x + sin * y) + (1.0 - s).sqrt() * normal;
            if let Some(hit) = bvh.nearest(place + lift * normal, way).filter(|hit| hit.front) {
                row[hit.triangle as usize] += 1;
            }
        }
    }

    let n = f64::from(rays);
    let areas: Vec<f64> = elements.iter().map(|e| e.area).collect();
    let rows = (0..elements.len()).map(|i| {
        let entry = |j: usize| {
            let exchange =
                0.5 * (areas[i] * f64::from(hits[i][j]) + areas[j] * f64::from(hits[j][i]));
            // Of a share of n rays; half its variance, since two estimates are averaged.
            let value = exchange / (areas[i] * n);
            Entry { column: j as u32, value, error: (0.5 * value / n).sqrt() }
        };
        (0..elements.len()).filter(|&j| hits[i][j] + hits[j][i] > 0).map(entry).collect()
    });
    let names = (0..elements.len()).map(|i| i.to_string()).collect();
    Ok(Matrix::from_rows(names, areas.clone(), rows.collect())?)
}

/// The k-th point of Roberts' additive sequence in four dimensions (2018), from the root of x⁵ = x + 1.
fn quasi_random(k: u32) -> [f64; 4] {
    const ROOT: f64 = 1.167_303_978_261_418_7;
    [1, 2, 3, 4].map(|power| (0.5 + f64::from(k) * ROOT.powi(-power)).fract())
}

/// A cube whose ceiling shines, with a smaller one that floats in it.
fn room() -> Result<Scene, scene::Error> {
    let mut builder = SceneBuilder::new();
    let group = builder.group("room");
    let mut material = |reflectance, emittance| {
        let (reflectance, emittance) = (Rgb::splat(reflectance), Rgb::splat(emittance));
        let (name, sides) = ("grey".into(), Sides::Front);
        builder.material(Material { name, reflectance, emittance, sides })
    };
    let (grey, shining) = (material(0.5, 0.0)?, material(0.5, 1.0)?);
    // Counter-clockwise seen from inside: below, above, and four sides.
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    for (low, high, outside) in [(0.0, 1.0, false), (0.3, 0.6, true)] {
        let corner = |i: usize| [0, 1, 2].map(|k| if i >> k & 1 == 0 { low } else { high });
        let vertices = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| builder.vertex(DVec3::from(corner(i))));
        for (face, corners) in faces.iter().enumerate() {
            let [a, b, c, d] = corners.map(|corner: usize| vertices[corner]);
            let material = if face == 1 && !outside { shining } else { grey };
            for [p, q, r] in [[a, b, c], [a, c, d]] {
                builder.triangle(if outside { [p, r, q] } else { [p, q, r] }, material, group)?;
            }
        }
    }
    Ok(builder.finish())
}
