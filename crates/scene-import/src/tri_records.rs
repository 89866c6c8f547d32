//! A scene as .tri records: the way back of the import.

use scene::{Material, Rgb, Scene, Sides};
use tri_io::TriRecord;

use crate::{Diagnostic, DiagnosticKind, Options, units};

/// Turns a scene into .tri records, one per triangle in their order, and says what a .tri
/// file cannot hold; with the same options, importing the records gives the scene back.
///
/// Coordinates keep all their bits. Reflectance comes back within half a step, which is
/// `tri_reflect` / 510 (0.00098 by default), and emittance within 50 · `tri_light`; each
/// greater change is a warning about its material:
/// - Reflectance beyond `tri_reflect` is clamped to it.
/// - A .tri emitter has a largest channel of 25500 · `tri_light`, so that of all emitters
///   only those of this strength are kept. The others are scaled to it and keep their
///   colour: their warnings tell by how much.
/// - The format knows no sides; those that the import will choose may not be the scene's.
///
/// Cameras and the names of groups and materials are lost; cameras, and groups where there
/// are several, with a warning.
///
/// # Examples
/// ```
/// use scene_import::{Options, open_bytes, tri_records};
///
/// let text = "Triangle\n51 102 255 255 0 9\n0 0 0\n1 0 0\n0 1 0\n";
/// let options = Options::default();
/// let scene = open_bytes("lamp.tri", text.as_bytes(), &options)?.scene;
/// let (records, warnings) = tri_records(&scene, &options);
/// assert_eq!((records[0].front, records[0].back), ([51, 102, 255], [255, 0, 9]));
/// assert_eq!(records[0].vertices[1], [1.0, 0.0, 0.0]);
/// assert!(warnings.is_empty());
///
/// // A reflectance of 0.5 is more than this .tri can hold, and the lamp too strong.
/// let (_, warnings) = tri_records(&scene, &Options { tri_reflect: 0.4, tri_light: 0.5, ..options });
/// assert_eq!(warnings.len(), 2);
/// # Ok::<(), scene_import::Error>(())
/// ```
#[must_use]
pub fn tri_records(scene: &Scene, options: &Options) -> (Vec<TriRecord>, Vec<Diagnostic>) {
    let mut diagnostics = lost_with_the_file(scene);
    let mut colours: Vec<Option<[[u8; 3]; 2]>> = vec![None; scene.materials().len()];
    let mut records = Vec::with_capacity(scene.triangles().len());
    for id in scene.ids() {
        let index = scene.triangles()[id.index()].material.index();
        let [front, back] = *colours[index].get_or_insert_with(|| {
            colours_of(&scene.materials()[index], options, &mut diagnostics)
        });
        let vertices = scene.corners(id).map(|corner| corner.to_array());
        records.push(TriRecord { front, back, vertices, normals: None });
    }
    (records, diagnostics)
}

/// Front and back of a material, after a warning for each value that they change.
fn colours_of(
    material: &Material,
    options: &Options,
    diagnostics: &mut Vec<Diagnostic>,
) -> [[u8; 3]; 2] {
    let mut warn = |kind| {
        let place = format!("material {}", material.name);
        diagnostics.push(Diagnostic { kind, triangle: None, place });
    };
    let from = material.reflectance;
    let (front, kept) = units::tri_front(from, options.tri_reflect);
    let to = units::tri_reflectance(front, options.tri_reflect);
    // Black is black even where `tri_reflect` is 0, which makes no step of any code.
    if !kept && from != to {
        warn(DiagnosticKind::ReflectanceChanged { from, to });
    }
    let from = material.emittance;
    let (back, kept) = units::tri_back(from, options.tri_light);
    if !kept {
        let to = units::tri_emittance(back, options.tri_light).unwrap_or(Rgb::ZERO);
        warn(DiagnosticKind::EmittanceChanged { from, to });
    }
    let (from, to) = (material.sides, options.sides.decide(Sides::Front));
    if from != to {
        warn(DiagnosticKind::SidesChanged { from, to });
    }
    [front, back]
}

/// What no record has a place for.
fn lost_with_the_file(scene: &Scene) -> Vec<Diagnostic> {
    let (groups, cameras) = (scene.groups().len(), scene.cameras().len());
    let lost = [
        (groups > 1, "groups", format!("the names of {groups} groups")),
        (cameras > 0, "cameras", format!("{cameras} cameras")),
    ];
    lost.into_iter()
        .filter(|(some, ..)| *some)
        .map(|(_, place, what)| {
            let kind =
                DiagnosticKind::Ignored { what: format!("{what}: .tri has no place for them") };
            Diagnostic { kind, triangle: None, place: place.to_owned() }
        })
        .collect()
}
