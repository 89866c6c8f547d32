//! Builds a lit room in code and estimates its light on the back of an envelope, without a solver.
//!
//! `cargo run -p radiosity-scene --example room_by_hand`
//!
//! In a closed room every bounce loses the share 1 − ρ̄ that its surfaces absorb on average, so a lamp
//! of Φ watts brings the mean exitance to about Φ / (A (1 − ρ̄)): the "integrating sphere" estimate
//! (Goebel 1967), exact where all surfaces see one another alike. The scene is asked for its areas,
//! materials and groups, and for what a closed surface must be: its area vectors sum to zero, and
//! they enclose the volume it was built with. Exit code 1 if they do not.

#![expect(clippy::print_stdout, reason = "a program for the terminal")]

use std::error::Error;

use glam::{DVec3, dvec3};
use scene::{GroupId, Material, MaterialId, Rgb, Scene, SceneBuilder, Sides};

/// Width, height and depth of the room in metres.
const ROOM: DVec3 = dvec3(4.0, 2.5, 5.0);
/// Width, height and depth of the cupboard on its floor.
const CUPBOARD: DVec3 = dvec3(1.0, 1.5, 0.5);
/// Reflectance of the walls and of the cupboard, and what the whole ceiling gives off, W·m⁻².
const WHITE: f64 = 0.8;
const WOOD: Rgb = Rgb::new(0.5, 0.35, 0.2);
const CEILING: f64 = 10.0;
/// Relative, of sums over some tens of triangles: some hundred roundings of f64.
const ROUNDING: f64 = 1e-13;

fn main() -> Result<(), Box<dyn Error>> {
    let scene = room()?;
    println!("{} triangles in {} groups", scene.triangles().len(), scene.groups().len());
    for (number, group) in scene.groups().iter().enumerate() {
        let area: f64 = of_group(&scene, GroupId::from(number)).map(|id| scene.area(id)).sum();
        println!("  {group:9} {area:6.2} m²");
    }

    let area: f64 = scene.ids().map(|id| scene.area(id)).sum();
    let (mut absorbed, mut power) = (Rgb::ZERO, Rgb::ZERO);
    for id in scene.ids() {
        let Material { reflectance, emittance, .. } = *scene.material_of(id);
        absorbed += (Rgb::splat(1.0) - reflectance) * scene.area(id);
        power += emittance * scene.area(id);
    }
    println!("emitted: {:.1} W per channel", power[0]);
    for (channel, name) in ["red", "green", "blue"].iter().enumerate() {
        let absorbs = absorbed[channel] / area;
        let exitance = power[channel] / absorbed[channel];
        println!("  {name:5} absorbs {:.1} %, mean exitance {exitance:.2} W·m⁻²", 100.0 * absorbs);
    }

    // Half the cross product is a triangle's area vector; a third of its height times it, a cone.
    let (mut closed, mut volume) = (DVec3::ZERO, 0.0);
    for id in scene.ids() {
        let [a, b, c] = scene.corners(id);
        let vector = 0.5 * (b - a).cross(c - a);
        closed += vector;
        // Fronts face the room's inside.
        volume -= vector.dot(a) / 3.0;
    }
    let expected = ROOM.element_product() - CUPBOARD.element_product();
    println!("encloses {volume:.3} m³; area vectors sum to {:.0e} m²", closed.length());
    let good = closed.length() <= ROUNDING * area && (volume / expected - 1.0).abs() <= ROUNDING;
    if good { Ok(()) } else { Err(format!("not closed around {expected} m³").into()) }
}

fn of_group(scene: &Scene, group: GroupId) -> impl Iterator<Item = scene::TriangleId> + '_ {
    scene.ids().filter(move |id| scene.triangles()[id.index()].group == group)
}

/// The room from inside, the cupboard from outside, and of the floor what the cupboard leaves free.
fn room() -> Result<Scene, scene::Error> {
    let mut builder = SceneBuilder::new();
    let mut material = |name: &str, reflectance, emittance| {
        let emittance = Rgb::splat(emittance);
        builder.material(Material {
            name: name.into(),
            reflectance,
            emittance,
            sides: Sides::Front,
        })
    };
    let white = material("white", Rgb::splat(WHITE), 0.0)?;
    let wood = material("wood", WOOD, 0.0)?;
    let shining = material("shining", Rgb::splat(WHITE), CEILING)?;
    let names = ["walls", "ceiling", "floor", "cupboard"];
    let [walls, ceiling, floor, cupboard] = names.map(|name| builder.group(name));

    let (x, y, z) = (DVec3::X * ROOM.x, DVec3::Y * ROOM.y, DVec3::Z * ROOM.z);
    for (from, u, v) in [(DVec3::ZERO, x, y), (x, z, y), (x + z, -x, y), (z, -z, y)] {
        quad(&mut builder, from, u, v, white, walls)?;
    }
    quad(&mut builder, y, x, z, shining, ceiling)?;

    let (a, h, d) = (DVec3::X * CUPBOARD.x, DVec3::Y * CUPBOARD.y, DVec3::Z * CUPBOARD.z);
    // Against no wall: 0.5 m of floor behind it and beside it.
    let at = dvec3(0.5, 0.0, 0.5);
    for (from, u, v) in [(a, -a, h), (a + d, -d, h), (d, a, h), (DVec3::ZERO, d, h), (h, d, a)] {
        quad(&mut builder, at + from, u, v, wood, cupboard)?;
    }
    let (left, front) = (DVec3::X * at.x, DVec3::Z * at.z);
    quad(&mut builder, DVec3::ZERO, z, left, white, floor)?;
    quad(&mut builder, left + a, z, x - left - a, white, floor)?;
    quad(&mut builder, left, front, a, white, floor)?;
    quad(&mut builder, at + d, z - front - d, a, white, floor)?;
    Ok(builder.finish())
}

/// A rectangle at `from`, which faces u × v.
fn quad(
    builder: &mut SceneBuilder,
    from: DVec3,
    u: DVec3,
    v: DVec3,
    material: MaterialId,
    group: GroupId,
) -> Result<(), scene::Error> {
    let [a, b, c, d] = [from, from + u, from + u + v, from + v].map(|p| builder.vertex(p));
    builder.triangle([a, b, c], material, group)?;
    builder.triangle([a, c, d], material, group)?;
    Ok(())
}
