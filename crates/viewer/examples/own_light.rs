//! A page of light that no solver made: a scene built in code, its exitance from a formula.
//!
//! `cargo run -p radiosity-viewer --example own_light [OUT.html]`
//!
//! Any program that has light on triangles can show it: here a square floor is lit by a point of
//! light above it, E = Φ cos θ / (4π r²). What the page shows as irradiance is (B − E) / ρ of what
//! it was given, so a click on the floor answers with the formula's value.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::f64::consts::PI;
use std::fs::File;
use std::path::PathBuf;

use glam::DVec3;
use scene::{Face, Material, Rgb, SceneBuilder, Sides, Solution, SolutionElement};
use serde_json::Value;
use viewer::{Means, Page, Shown};

/// Squares along a side of the floor, which is 4 m long.
const SQUARES: usize = 40;
const SIDE: f64 = 4.0;
/// Watts of the point, and where it hangs.
const POWER: f64 = 100.0;
const POINT: DVec3 = DVec3::new(2.0, 1.5, 2.0);
const REFLECTANCE: f64 = 0.6;

fn main() -> Result<(), Box<dyn Error>> {
    let mut builder = SceneBuilder::new();
    let floor = builder.group("floor");
    let grey = builder.material(Material {
        name: "grey".into(),
        reflectance: Rgb::splat(REFLECTANCE),
        emittance: Rgb::ZERO,
        sides: Sides::Front,
    })?;
    let step = SIDE / SQUARES as f64;
    let mut solution = Solution::default();
    for square in 0..SQUARES * SQUARES {
        let (i, j) = ((square % SQUARES) as f64, (square / SQUARES) as f64);
        let corner = |x: f64, z: f64| DVec3::new(step * (i + x), 0.0, step * (j + z));
        let [a, b, c, d] = [corner(0.0, 0.0), corner(0.0, 1.0), corner(1.0, 1.0), corner(1.0, 0.0)];
        for triangle in [[a, b, c], [a, c, d]] {
            let vertices = triangle.map(|place| {
                solution.vertices.push(place);
                builder.vertex(place)
            });
            let corner_exitance = triangle.map(|place| Rgb::splat(REFLECTANCE * irradiance(place)));
            solution.elements.push(SolutionElement {
                vertices,
                triangle: builder.triangle(vertices, grey, floor)?,
                face: Face::Front,
                exitance: corner_exitance.into_iter().sum::<Rgb>() / 3.0,
                corner_exitance,
            });
        }
    }
    let scene = builder.finish();

    // Seen over the whole sphere the point gives off all its power; the floor takes the share of the
    // solid angle that it fills: by the closed form for a rectangle below a point, 4 atan(…) / 4π.
    let arriving: f64 =
        solution.elements.iter().map(|e| e.exitance.0[0] / REFLECTANCE * solution.area(e)).sum();
    let (half, height) = (SIDE / 2.0, POINT.y);
    let angle =
        4.0 * (half * half / (height * (2.0 * half * half + height * height).sqrt())).atan();
    let expected = POWER * angle / (4.0 * PI);
    println!("{arriving:.3} W arrive on the floor, {expected:.3} W by the solid angle");

    let shown = Shown {
        scene: &scene,
        solution: &solution,
        unit: "W/m²",
        exposure: 0.3, // display light per exitance
        view: None,
        means: Means::OfElements,
    };
    let path = std::env::args_os().nth(1).map(PathBuf::from);
    let path = path.unwrap_or_else(|| std::env::temp_dir().join("own-light.html"));
    Page::new("a floor below a point of light", &shown, &Value::Null)?
        .write(&mut File::create(&path)?)?;
    println!("written: {}", path.display());
    // Corners of 10 cm squares, interpolated.
    let off = (arriving / expected - 1.0).abs();
    if off > 2e-3 {
        Err(format!("the floor gets {off:.1e} too much or too little").into())
    } else {
        Ok(())
    }
}

/// What arrives on the floor at a place, W·m⁻².
fn irradiance(place: DVec3) -> f64 {
    let way = POINT - place;
    POWER * way.y / way.length() / (4.0 * PI * way.length_squared())
}
