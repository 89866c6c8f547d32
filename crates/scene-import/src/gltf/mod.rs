//! glTF 2.0: JSON with buffers beside it, or one binary file.
//!
//! The gltf crate reads and validates the JSON. Buffers, accessors and images are read here
//! with checked arithmetic: the crate's own readers panic on some malformed files.

mod accessor;
mod budget;
mod document;
mod kept;
mod layer;
mod light;
mod primitive;
mod range;
mod restore;
mod stated;
mod surface;
mod uri;
mod walk;

use scene::{Camera, Face, TriangleId};

use crate::assembler::Assembler;
use crate::beside::Beside;
use crate::open::Source;
use crate::shortened::shortened;
use crate::{DiagnosticKind, Error, Format, Imported, Lit, Options, SidesRule};
use budget::Budget;
use document::{Parsed, Wanted};
use kept::Keeper;
use layer::Images;
use light::Light;
use stated::Stated;
use surface::Surfaces;
use walk::Placed;

/// Extensions that are understood, or that concern nothing a scene holds.
const KNOWN_EXTENSIONS: &[&str] = &[
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_texture_transform",
    "KHR_materials_ior",
    "KHR_materials_specular",
    "KHR_xmp_json_ld",
];

/// Materials that are shown as they are, without lamps.
const UNLIT_EXTENSION: &str = "KHR_materials_unlit";

/// Triangles from one primitive under one node: the first of them, and the way to it.
struct Run {
    first: usize,
    path: String,
}

/// Reads a glTF scene: the default scene, or the first, or all nodes if there is none.
pub(crate) fn read(
    source: &Source<'_>,
    format: Format,
    options: &Options,
) -> Result<Imported, Error> {
    read_document(source, format, options, None)
}

/// Reads the elements of a file that this project has lit, each from its own side, and their light.
pub(crate) fn read_lit(source: &Source<'_>) -> Result<Lit, Error> {
    let mut light = Light::default();
    let options = Options { sides: SidesRule::Front, ..Options::default() };
    let Imported { scene, mut diagnostics, .. } =
        read_document(source, Format::Glb, &options, Some(&mut light))?;
    // What is odd about single triangles was so before they were lit, or comes of their being cut.
    diagnostics.retain(|diagnostic| diagnostic.triangle.is_none());
    let (solution, exposure) = light.solution(&scene, source.name)?;
    Ok(Lit { scene, solution, exposure, diagnostics })
}

/// Reads a document; its light, and the primitives of backs, only where they are wanted.
fn read_document(
    source: &Source<'_>,
    format: Format,
    options: &Options,
    mut light: Option<&mut Light>,
) -> Result<Imported, Error> {
    let mut beside = Beside::new(source.folder, options.allow_outside);
    let wanted = Wanted { text: options.keep_document, light: light.is_some() };
    let parsed = Parsed::new(source, wanted, &mut beside)?;
    if let Some(light) = light.as_deref_mut() {
        light.read_exposure(&parsed, source.name)?;
    }
    let bytes = source.bytes.len().saturating_add(beside.bytes());
    let mut assembler = Assembler::new(source.name, options.sides, bytes);
    let stated = Stated::new(&parsed.document, source.name, &mut assembler)?;
    range::check(source.name, parsed.document.as_json(), &stated)?;
    warn_about_document(&parsed, &stated, source.name, &mut assembler);
    let mut budget = Budget::new(source.name, bytes);
    let images = Images::new(&parsed, source.bytes.len(), beside);
    let mut surfaces = Surfaces::new(images, &parsed, &stated);
    let mut runs = Vec::new();
    let mut keeper = Keeper::new(options.keep_document);
    for placed in walk::walk(&parsed.document, &stated, source.name)? {
        let Placed { node, world } = &placed;
        let path = format!("nodes[{}]", node.index());
        if let Some(camera) = node.camera() {
            match convert_camera(&camera, &stated, &placed) {
                Ok(camera) => assembler.camera(camera)?,
                Err(what) => assembler.warn(DiagnosticKind::Ignored { what }, None, path.as_str()),
            }
        }
        if let Some(light) = node.light() {
            let what = format!(
                "light {}: only surfaces emit",
                shortened(light.name().unwrap_or("without a name"))
            );
            assembler.warn(DiagnosticKind::Ignored { what }, None, path.as_str());
        }
        let Some(mesh) = node.mesh() else { continue };
        if node.skin().is_some() {
            let what = "skin: the mesh stands as modelled".to_owned();
            assembler.warn(DiagnosticKind::Ignored { what }, None, path.as_str());
        }
        let group = match node.name().or(mesh.name()) {
            Some(name) => assembler.new_group(name)?,
            None => assembler.new_group(&format!("node {}", node.index()))?,
        };
        for primitive in mesh.primitives() {
            let is_back = stated.is_back(mesh.index(), primitive.index());
            if is_back && light.is_none() {
                continue;
            }
            let path = format!("{path}.mesh[{}].primitives[{}]", mesh.index(), primitive.index());
            runs.push(Run { first: assembler.triangle_count(), path: path.clone() });
            let place = primitive::Place { path: &path, mesh: mesh.index(), world: *world, group };
            let first = TriangleId::from(assembler.triangle_count());
            let added = primitive::add(
                &primitive,
                &place,
                &parsed,
                &mut surfaces,
                &mut budget,
                &mut assembler,
            )?;
            if let Some(light) = light.as_deref_mut() {
                let face = if is_back { Face::Back } else { Face::Front };
                light.add(&primitive, face, first, &added, &parsed, &mut budget)?;
            }
            keeper.add([node.index(), mesh.index(), primitive.index()], first, &added);
        }
    }
    drop(surfaces);
    let beside = Beside::new(source.folder, options.allow_outside);
    let document = keeper.finish(parsed, beside, &mut assembler);
    let imported = assembler.finish(format, |id| place(&runs, id));
    Ok(Imported { document, ..imported })
}

fn place(runs: &[Run], id: TriangleId) -> String {
    // Runs without triangles share their start with the next: the last of them has the id.
    let after = runs.partition_point(|run| run.first <= id.index());
    let run = &runs[after - 1];
    format!("{}.triangle {}", run.path, id.index() - run.first)
}

fn warn_about_document(
    parsed: &Parsed,
    stated: &Stated,
    file: &str,
    assembler: &mut Assembler<'_>,
) {
    let document = &parsed.document;
    let mut ignore = |what: String, place: &str| {
        assembler.warn(DiagnosticKind::Ignored { what }, None, format!("{file}: {place}"));
    };
    // How a material is shown does not matter where it states its surface.
    let known = |name: &&str| {
        KNOWN_EXTENSIONS.contains(name) || *name == UNLIT_EXTENSION && stated.all_surfaces()
    };
    for name in document.extensions_used().filter(|name| !known(name)) {
        ignore(format!("extension {name}"), "extensionsUsed");
    }
    if document.animations().len() > 0 {
        ignore("animations: the scene stands at rest".to_owned(), "animations");
    }
    let read = walk::scene(document).map(|scene| scene.index());
    for scene in document.scenes().filter(|scene| Some(scene.index()) != read) {
        ignore(
            format!("scene {}", scene.name().unwrap_or("without a name")),
            &format!("scenes[{}]", scene.index()),
        );
    }
}

/// A camera of the scene; the error says what is left out.
fn convert_camera(
    camera: &gltf::Camera<'_>,
    stated: &Stated,
    placed: &Placed<'_>,
) -> Result<Camera, String> {
    let gltf::camera::Projection::Perspective(perspective) = camera.projection() else {
        return Err("orthographic camera".to_owned());
    };
    // Cameras look along −z, with +y up.
    let position = placed.world.w_axis.truncate();
    let target = match stated.target(camera.index()) {
        Some(target) => placed.world.transform_point3(target),
        None => position - placed.world.z_axis.truncate().normalize_or_zero(),
    };
    let up = placed.world.y_axis.truncate().normalize_or_zero();
    let vertical_fov = stated.yfov(camera.index(), perspective.yfov());
    let sound = position.is_finite()
        && target.is_finite()
        && target != position
        && up != glam::DVec3::ZERO
        && vertical_fov > 0.0
        && vertical_fov < std::f64::consts::PI;
    if !sound {
        return Err("camera without a direction or field of view".to_owned());
    }
    let name = placed.node.name().or(camera.name());
    let name = name.map_or_else(|| format!("camera {}", camera.index()), str::to_owned);
    Ok(Camera { name, position, target, up, vertical_fov })
}
