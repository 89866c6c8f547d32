//! A solve with an occluder and an observer of one's own: a lamp, a floor, and a round disc between.
//!
//! `cargo run -p radiosity-core --example own_occluder [-- ELEMENTS]`
//!
//! What may stand in between is an argument, `accel::Occluder`, of one required function. The disc here
//! is no triangles at all: three lines of geometry beside a BVH over the scene. The floor's middle sees
//! a square lamp of half side a at height h less the disc's shadow on it, so the irradiance there is
//! E (F_square − F_disc), both in closed form (Howell, *A Catalog of Radiation Heat Transfer
//! Configuration Factors*, B-4 four times, and B-12); exit code 1 if it is not, to 1 %, which is what
//! is asked of each form factor.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;
use std::f64::consts::PI;

use accel::{Bvh, BvhConfig, Occluder, Segment};
use glam::{DVec3, dvec3};
use radiosity_core::{
    Census, Control, Mesh, MeshConfig, Observer, ReceiverPoint, Sequential, Shooting,
    ShootingConfig, Stage, StepReport,
};
use scene::{Material, Rgb, Scene, SceneBuilder, Sides};

/// The lamp's half side, its height, and the disc's radius at half that height.
const HALF_SIDE: f64 = 1.0;
const HEIGHT: f64 = 1.0;
const RADIUS: f64 = 0.25;
/// What the lamp gives off, W·m⁻².
const EMITTANCE: f64 = 100.0;
/// [`ShootingConfig::cell_share`], a twenty-fifth of the default: the lamp is looked at in so many more
/// places, since the disc's edge parts what is seen of it from what is not.
const CELL_SHARE: f64 = 2e-3;
/// Relative: [`ShootingConfig::tolerance`].
const TOLERANCE: f64 = 1e-2;

/// A disc parallel to the floor, in front of whatever the triangles block.
struct Disc<'a> {
    triangles: &'a Bvh,
    centre: DVec3,
    radius: f64,
}

impl Occluder for Disc<'_> {
    fn occluded(&self, segment: &Segment) -> bool {
        let (from, to) = (segment.from - self.centre, segment.to - self.centre);
        // Ends on different sides of the disc's plane: where the segment crosses it.
        let crosses = from.z * to.z < 0.0
            && from.lerp(to, from.z / (from.z - to.z)).truncate().length() <= self.radius;
        crosses || self.triangles.occluded(segment)
    }
}

/// Says when the work changes, and where it is each time the unshot light has halved.
#[derive(Default)]
struct Progress {
    stages: Vec<Stage>,
    said: Option<f64>,
}

impl Observer for Progress {
    fn step(&mut self, report: &StepReport) -> Control {
        if self.said.is_none_or(|said| report.unshot <= 0.5 * said) {
            println!(
                "{:5} shots, {:8} segments, {:6.2} % unshot",
                report.shots,
                report.rays,
                100.0 * report.unshot
            );
            self.said = Some(report.unshot);
        }
        Control::Continue
    }

    fn stage(&mut self, stage: Stage) {
        if !self.stages.contains(&stage) {
            self.stages.push(stage);
        }
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let elements = match std::env::args().nth(1) {
        Some(text) => text.parse().map_err(|error| format!("elements {text}: {error}"))?,
        None => 1000,
    };
    let scene = lamp_above_floor()?;
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    let bvh = Bvh::build(&triangles, &BvhConfig::default());
    let centre = dvec3(0.0, 0.0, 0.5 * HEIGHT);
    let occluder = Disc { triangles: &bvh, centre, radius: RADIUS };

    let mesh = Mesh::from_scene(&scene, &MeshConfig::with_elements(elements));
    // Triangle 0 is of the floor; a segment from it does not meet it again.
    let middle = ReceiverPoint { position: DVec3::ZERO, normal: DVec3::Z, triangle: 0 };
    let census = Census::default();
    let config = ShootingConfig { cell_share: CELL_SHARE, ..ShootingConfig::until(1e-3) };
    let mut shooting =
        Shooting::with_probes(&mesh, &occluder, &census, &Sequential, config, &[middle]);
    let mut progress = Progress::default();
    let reason = shooting.run(&mut progress);
    println!("{reason:?} after {:?}", progress.stages);

    let found = shooting.at_probes()[0][0];
    let k = HALF_SIDE / f64::hypot(HALF_SIDE, HEIGHT);
    let shadow = 2.0 * RADIUS; // on the lamp, seen from the floor
    let square = 4.0 / PI * k * k.atan();
    let disc = shadow * shadow / (shadow * shadow + HEIGHT * HEIGHT);
    let exact = EMITTANCE * (square - disc);
    println!("irradiance of the floor's middle: {found:.3} W·m⁻², closed form {exact:.3}");
    println!("without the disc: {:.3}", EMITTANCE * square);
    match (found / exact - 1.0).abs() <= TOLERANCE {
        true => Ok(()),
        false => Err(format!("the closed form was missed by more than {TOLERANCE}").into()),
    }
}

/// A black lamp that faces down, above a floor that reflects half: no light comes back a second time.
fn lamp_above_floor() -> Result<Scene, scene::Error> {
    let mut builder = SceneBuilder::new();
    let group = builder.group("all");
    for (name, half, height, reflectance, emittance) in
        [("floor", 3.0, 0.0, 0.5, 0.0), ("lamp", HALF_SIDE, HEIGHT, 0.0, EMITTANCE)]
    {
        let material = builder.material(Material {
            name: name.into(),
            reflectance: Rgb::splat(reflectance),
            emittance: Rgb::splat(emittance),
            sides: Sides::Front,
        })?;
        let rim = [(-half, -half), (half, -half), (half, half), (-half, half)];
        let [a, b, c, d] = rim.map(|(x, y)| builder.vertex(dvec3(x, y, height)));
        for [p, q, r] in [[a, b, c], [a, c, d]] {
            let corners = if name == "lamp" { [p, r, q] } else { [p, q, r] };
            builder.triangle(corners, material, group)?;
        }
    }
    Ok(builder.finish())
}
