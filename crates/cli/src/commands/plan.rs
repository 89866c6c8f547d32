//! `radiosity plan`: what a scene file holds, what looks wrong, and what a solve would use.

use std::time::Duration;

use radiosity_core::{Census, Mesh};
use radiosity_par::Loop;
use scene::{Rgb, Scene, Sides};
use scene_import::Imported;

use crate::args::PlanArgs;
use crate::commands::solve;
use crate::failure::Failure;
use crate::memory;
use crate::pipeline::{self, Prepared};
use crate::report::total_area;
use crate::screen::{count, percent, result, seconds};
use crate::settings;

/// Reads the scene, builds what a solve would use, and prints both.
pub(crate) fn run(args: &PlanArgs) -> Result<(), Failure> {
    let read = settings::read(&args.read)?;
    let work = settings::work(&args.work)?;
    let (file, imported) = solve::open(Some(&args.scene), &read)?;
    solve::check_factors(&file, &imported, &read)?;
    solve::check_paired(&imported.scene, &read)?;
    result(&format!("{file}: {}", imported.summary))?;
    say_scene(&imported)?;
    let prepared = pipeline::prepare(&imported.scene, &work, Loop::default())?;
    let config = work.mesh(imported.scene.triangles().len());
    let (mesh, census, time) = pipeline::mesh(&imported.scene, &prepared, &config, &read);
    solve::warn_of_coarseness(&imported.scene, &mesh);
    say_plan(&imported.scene, &prepared, &mesh, &census, time)
}

fn say_scene(imported: &Imported) -> Result<(), Failure> {
    let scene = &imported.scene;
    if let Some((low, high)) = scene.bounds() {
        result(&format!(
            "bounds    {:?} to {:?}, area {:.6}",
            low.to_array(),
            high.to_array(),
            total_area(scene)
        ))?;
    }
    let emitted: Rgb = scene.ids().map(|id| emitted_power(scene, id)).sum();
    result(&format!(
        "light     {} emitting triangles, power {:?}",
        imported.summary.emitters, emitted.0
    ))?;
    result(&format!("surfaces  {}", surfaces(scene)))?;
    for camera in scene.cameras() {
        result(&format!("camera    {:?}", camera.name))?;
    }
    result(&format!("warnings  {}", imported.diagnostics.len()))?;
    for diagnostic in &imported.diagnostics {
        result(&format!("          {diagnostic}"))?;
    }
    Ok(())
}

fn emitted_power(scene: &Scene, id: scene::TriangleId) -> Rgb {
    let material = scene.material_of(id);
    let sides = if material.sides == Sides::Both { 2.0 } else { 1.0 };
    material.emittance * (scene.area(id) * sides)
}

/// The range of reflectances, and how many triangles have two sides.
fn surfaces(scene: &Scene) -> String {
    let used = || scene.ids().map(|id| scene.material_of(id));
    let low = used().map(|m| m.reflectance.min_channel()).fold(f64::INFINITY, f64::min);
    let high = used().map(|m| m.reflectance.max_channel()).fold(0.0, f64::max);
    let both = used().filter(|m| m.sides == Sides::Both).count();
    if low > high {
        return "none".into();
    }
    format!("reflectance {low:.4} to {high:.4}, {both} two-sided triangles")
}

fn say_plan(
    scene: &Scene,
    prepared: &Prepared,
    mesh: &Mesh,
    census: &Census,
    time: Duration,
) -> Result<(), Failure> {
    let elements = mesh.elements().len();
    result(&format!(
        "mesh      {} elements in {} patches, {} receiver points, at most about {} ({})",
        count(elements as u64),
        count(mesh.patches().len() as u64),
        count(mesh.points().len() as u64),
        memory::size(memory::foreseen(scene.triangles().len(), mesh.patches().len(), elements)),
        seconds(time.as_secs_f64())
    ))?;
    result(&format!(
        "occluder  {} over {} triangles, {} kB ({}); input triangles block, not elements",
        prepared.occluder_name,
        count(scene.triangles().len() as u64),
        count((prepared.occluder_bytes as u64).div_ceil(1000)),
        seconds(prepared.occluder_seconds)
    ))?;
    let (escapes, backs) = mean_fate(mesh, census);
    result(&format!(
        "openness  {} of the directions from lit surfaces leave the scene, {} meet a back",
        percent(escapes),
        percent(backs)
    ))?;
    let pairs = mesh.patches().len() as u64 * mesh.points().len() as u64;
    result(&format!(
        "work      at most {} form factors and segments for each patch to shoot once; 1 to 5 \
         such sweeps leave 0.1 % unshot",
        count(pairs)
    ))?;
    result(&format!("threads   {}", prepared.threads()))
}

/// Area means over the patches of the shares that escape and that meet backs.
fn mean_fate(mesh: &Mesh, census: &Census) -> (f64, f64) {
    let (mut area, mut escapes, mut backs) = (0.0, 0.0, 0.0);
    for (patch, fate) in mesh.patches().iter().zip(census.fates()) {
        let range = patch.elements.start as usize..patch.elements.end as usize;
        let a: f64 = mesh.elements()[range].iter().map(|e| e.area).sum();
        area += a;
        escapes += a * fate.escapes;
        backs += a * fate.meets_back;
    }
    if area > 0.0 { (escapes / area, backs / area) } else { (0.0, 0.0) }
}
