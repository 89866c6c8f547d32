//! `radiosity plan`: what a scene file holds, what looks wrong, and what a solve would leave out, and why.

use std::time::Duration;

use radiosity_core::plan::Work;
use radiosity_core::{Census, Correction, Mesh, Plan};
use radiosity_par::Loop;
use scene::{Rgb, Scene, Sides};
use scene_import::Imported;

use crate::args::PlanArgs;
use crate::commands::solve;
use crate::failure::Failure;
use crate::files;
use crate::memory;
use crate::pipeline;
use crate::prepared;
use crate::report::{PlanReport, total_area};
use crate::screen::{count, percent, result, rough, seconds};
use crate::settings::{self, DEFAULT_CONVERGE, Goal};

/// Reads the scene, builds what a solve would use, and prints both.
pub(crate) fn run(args: &PlanArgs) -> Result<(), Failure> {
    let read = settings::read(&args.read)?;
    let work = settings::work(&args.work)?;
    if args.error == 0.0 {
        return Err(Failure::Usage("--error: expected more than 0, such as 1%".into()));
    }
    if let Some(path) = &args.report {
        settings::check_report(path)?;
        files::check_apart(Some(&args.scene), &[path])?;
        files::check(path)?;
    }
    let (file, imported) = solve::open(Some(&args.scene), &read)?;
    solve::check_factors(&file, &imported, &read)?;
    solve::check_paired(&imported.scene, &read)?;
    result(&format!("{file}: {}", imported.summary))?;
    say_scene(&imported)?;
    let goal = match args.work.elements {
        Some(n) => Goal::Mesh { elements: Some(n), converge: DEFAULT_CONVERGE, stated: true },
        None => Goal::Error(args.error),
    };
    let how = (goal, Correction::Auto, false);
    let prepared = prepared::prepare(&imported.scene, &work, &read, how, Loop::default(), |_| {})?;
    let config = work.mesh(imported.scene.triangles().len());
    let (mesh, census, time) = pipeline::mesh(&imported.scene, &prepared, &config, &read);
    solve::warn_of_coarseness(&imported.scene, &mesh);
    say_mesh(&imported.scene, &mesh, &census, time)?;
    say_decisions(&prepared.plan)?;
    match &args.report {
        Some(path) => PlanReport::of(&file, &imported, &prepared.plan).write(path),
        None => Ok(()),
    }
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

/// What is decided, why, what that spares, and what it can do to the light.
fn say_decisions(plan: &Plan) -> Result<(), Failure> {
    result("")?;
    for decision in &plan.decisions {
        let name = decision.topic.name();
        result(&format!("{name:<12}{}", decision.choice))?;
        result(&format!("            why: {}", decision.why))?;
        if decision.leaves_out {
            if let Some(saved) = saving(&decision.saves) {
                result(&format!("            saves: {saved}"))?;
            }
            result(&format!("            changes of the light: {}", decision.effect.text()))?;
        }
    }
    result("")?;
    result(&format!("foreseen    {}", amounts(&plan.planned)))?;
    result(&format!("everything  {}", amounts(&plan.everything)))
}

/// Work that is foreseen to be spared, if it is any.
fn saving(saved: &Work) -> Option<String> {
    let all = [
        (saved.form_factors, "form factors"),
        (saved.segments, "segments"),
        (saved.directions, "directions"),
    ];
    let mut parts: Vec<String> = all
        .into_iter()
        .filter(|(amount, _)| *amount >= 1.0)
        .map(|(amount, of)| format!("{} {of}", rough(amount)))
        .collect();
    if saved.seconds > 0.0 {
        parts.push(format!("about {} on one thread", seconds(saved.seconds)));
    }
    (!parts.is_empty()).then(|| parts.join(", "))
}

/// All work that is foreseen.
fn amounts(work: &Work) -> String {
    format!(
        "{} elements, {} shots, {} form factors, {} segments, {} directions, about {} on one thread",
        rough(work.elements),
        rough(work.shots),
        rough(work.form_factors),
        rough(work.segments),
        rough(work.directions),
        seconds(work.seconds)
    )
}

/// The mesh that a solve without refinement would have, and how open the scene is.
fn say_mesh(scene: &Scene, mesh: &Mesh, census: &Census, time: Duration) -> Result<(), Failure> {
    let elements = mesh.elements().len();
    result(&format!(
        "mesh      {} elements in {} patches, {} receiver points, at most about {} ({})",
        count(elements as u64),
        count(mesh.patches().len() as u64),
        count(mesh.points().len() as u64),
        memory::size(memory::foreseen(scene.triangles().len(), mesh.patches().len(), elements)),
        seconds(time.as_secs_f64())
    ))?;
    let (escapes, backs) = mean_fate(mesh, census);
    result(&format!(
        "openness  {} of the directions from lit surfaces leave the scene, {} meet a back",
        percent(escapes),
        percent(backs)
    ))
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
