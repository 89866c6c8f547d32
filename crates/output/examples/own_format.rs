//! A format of one's own, a plan of the floor as SVG, written whole or not at all.
//!
//! `cargo run -p radiosity-output --example own_format [-- OUT.svg]`
//!
//! Three of this crate's parts, without its formats: `replace_file` writes beside the place and renames,
//! `tone` turns exitance into colours as pictures do, and a `Solution` is plain data, here by hand: a
//! floor below a small lamp, whose irradiance falls with the fourth power of the cosine. The plan names
//! the mean exitance, which is compared with the lamp's form factor to the floor; and a writer that
//! fails half way must leave the file as it was. Exit code 1 otherwise.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::f64::consts::PI;
use std::io::Write;
use std::path::{Path, PathBuf};

use glam::dvec3;
use output::{Exposure, replace_file, tone};
use scene::{Face, Material, Rgb, Scene, SceneBuilder, Sides, Solution, SolutionElement};

/// Half the floor's side, the lamp's height above its middle, metres; the lamp's power, W.
const HALF: f64 = 3.0;
const HEIGHT: f64 = 2.0;
const POWER: f64 = 100.0;
const REFLECTANCE: Rgb = Rgb::new(0.7, 0.6, 0.4);
/// Squares along the floor's side, pixels a square.
const SQUARES: usize = 24;
const PIXELS: usize = 16;
/// Relative, between the mean over squares' centres and the integral: second order in a square over
/// the height, (1/8)² at most.
const SQUARE_RULE: f64 = 1.0 / 64.0;

fn main() -> Result<(), Box<dyn Error>> {
    let path = std::env::args_os().nth(1).map(PathBuf::from);
    let path = path.unwrap_or_else(|| std::env::temp_dir().join("plan.svg"));
    let (scene, solution) = lit_floor()?;
    let written = replace_file(&path, |out| plan(out, &scene, &solution))?;
    println!("{}: {} bytes, {} triangles", path.display(), written.bytes, solution.elements.len());

    let mean = mean_exitance(&scene, &solution);
    // To a square below its middle, a quarter of it four times (Howell, *A Catalog of Radiation Heat
    // Transfer Configuration Factors*, B-4).
    let k = HALF / f64::hypot(HALF, HEIGHT);
    let arrives = POWER * 4.0 / PI * k * k.atan();
    let exact = REFLECTANCE * (arrives / (4.0 * HALF * HALF));
    println!("mean exitance {:.3} W·m⁻² in red, closed form {:.3}", mean[0], exact[0]);
    if (mean[0] / exact[0] - 1.0).abs() > SQUARE_RULE {
        return Err("the mean exitance is not that of the closed form".into());
    }
    survives_failure(&path)
}

/// A writer that fails after some bytes: the file must stay as it was.
fn survives_failure(path: &Path) -> Result<(), Box<dyn Error>> {
    let before = std::fs::read(path)?;
    let failed = replace_file(path, |out| {
        writeln!(out, "<svg> half of")?;
        Err(std::io::Error::other("the pen broke").into())
    });
    println!("{}", failed.as_ref().err().map_or("no error".into(), ToString::to_string));
    match failed.is_err() && std::fs::read(path)? == before {
        true => Ok(()),
        false => Err("a failed writer changed the file".into()),
    }
}

/// The plan: a polygon for each element, seen from above.
fn plan(out: &mut dyn Write, scene: &Scene, solution: &Solution) -> Result<(), output::Error> {
    let side = SQUARES * PIXELS;
    let scale = Exposure::Auto.scale_for(scene, solution);
    writeln!(out, r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {side} {side}">"#)?;
    let mean = mean_exitance(scene, solution);
    writeln!(
        out,
        "<title>mean exitance {:.3} {:.3} {:.3} W·m⁻²</title>",
        mean[0], mean[1], mean[2]
    )?;
    for element in &solution.elements {
        let [r, g, b] = tone::screen(element.exitance, scale);
        let at = |x: f64| (x + HALF) / (2.0 * HALF) * side as f64;
        let points = solution.corners(element).map(|p| format!("{},{}", at(p.x), at(-p.y)));
        writeln!(out, r##"<path fill="#{r:02x}{g:02x}{b:02x}" d="M{}Z"/>"##, points.join("L"))?;
    }
    writeln!(out, "</svg>")?;
    Ok(())
}

fn mean_exitance(scene: &Scene, solution: &Solution) -> Rgb {
    let of_triangles = solution.triangle_exitance(scene);
    let power: Rgb = scene.ids().zip(of_triangles).map(|(id, b)| b * scene.area(id)).sum();
    power / scene.ids().map(|id| scene.area(id)).sum()
}

/// A floor in squares, two triangles each, with the light of a small diffuse lamp that faces down.
fn lit_floor() -> Result<(Scene, Solution), scene::Error> {
    let mut builder = SceneBuilder::new();
    let group = builder.group("floor");
    let (name, emittance, sides) = ("wood".into(), Rgb::ZERO, Sides::Front);
    let wood = builder.material(Material { name, reflectance: REFLECTANCE, emittance, sides })?;
    let along = |i: usize| HALF * (2.0 * i as f64 / SQUARES as f64 - 1.0);
    let mut solution = Solution::default();
    for (i, j) in (0..SQUARES * SQUARES).map(|k| (k / SQUARES, k % SQUARES)) {
        let rim = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)];
        let places = rim.map(|(i, j)| dvec3(along(i), along(j), 0.0));
        let [a, b, c, d] = places.map(|place| builder.vertex(place));
        solution.vertices.extend(places);
        for vertices in [[a, b, c], [a, c, d]] {
            let triangle = builder.triangle(vertices, wood, group)?;
            let corners = vertices.map(|v| solution.vertices[v.index()]);
            // Irradiance of a small diffuse lamp: (Φ/π) cos⁴ / h² on a floor parallel to it.
            let at = |x: f64, y: f64| {
                let square = HEIGHT * HEIGHT / (HEIGHT * HEIGHT + x * x + y * y);
                REFLECTANCE * (POWER / PI * square * square / (HEIGHT * HEIGHT))
            };
            let middle = corners.iter().sum::<glam::DVec3>() / 3.0;
            let exitance = at(middle.x, middle.y);
            let corner_exitance = corners.map(|p| at(p.x, p.y));
            let face = Face::Front;
            solution.elements.push(SolutionElement {
                vertices,
                triangle,
                face,
                exitance,
                corner_exitance,
            });
        }
    }
    Ok((builder.finish(), solution))
}
