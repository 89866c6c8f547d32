//! Kernels of the mesh: cuts, growth, grading and splitting where a density asks for it.

use radiosity_core::{Mesh, MeshConfig};

use crate::count::count;
use crate::scenes;

/// Elements that a room of 16 triangles is split into.
const ELEMENTS: usize = 5000;

/// A mesh of one size, patches and receiver points included.
pub(crate) fn growth() -> f64 {
    let scene = scenes::room(scenes::WIDE, 1);
    elements(&count(|| Mesh::from_scene(&scene, &even(ELEMENTS))))
}

/// The same number of elements, more of them round a small lamp.
pub(crate) fn grading() -> f64 {
    let scene = scenes::room(scenes::NARROW, 1);
    let config = MeshConfig { graded: true, ..even(ELEMENTS) };
    elements(&count(|| Mesh::from_scene(&scene, &config)))
}

/// A furnished room, cut where its triangles touch, and split no further.
pub(crate) fn cuts() -> f64 {
    let scene = scenes::grey(&scenes::read(scenes::FURNISHED));
    let config = MeshConfig { cut: true, ..even(0) };
    elements(&count(|| Mesh::from_scene(&scene, &config)))
}

/// A coarse mesh, split further in every other element.
pub(crate) fn refined() -> f64 {
    let coarse = Mesh::from_scene(&scenes::room(scenes::WIDE, 1), &even(ELEMENTS / 4));
    let density: Vec<f64> =
        (0..coarse.elements().len()).map(|i| if i % 2 == 0 { 1.0 } else { 16.0 }).collect();
    elements(&count(|| coarse.refined(&density, &even(ELEMENTS))))
}

/// About so many elements of one size, of triangles that are not cut.
fn even(elements: usize) -> MeshConfig {
    MeshConfig { cut: false, graded: false, ..MeshConfig::with_elements(elements) }
}

fn elements(mesh: &Mesh) -> f64 {
    mesh.elements().len() as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn meshes_have_about_as_many_elements_as_asked() {
        for elements in [growth(), grading(), refined()] {
            assert!((elements / ELEMENTS as f64 - 1.0).abs() < 0.02, "{elements}");
        }
    }

    /// The table of the scene's cuts: a floor under furniture comes apart.
    #[test]
    fn a_furnished_room_is_cut() {
        assert!(cuts() > 1.1 * 1472.0, "{}", cuts());
    }

    /// Grading has nothing to do for a wide lamp, and much for a narrow one.
    #[test]
    fn the_narrow_lamp_is_one_to_be_graded_round() {
        let finer = |lamp: scenes::Lamp| {
            let scene = scenes::room(lamp, 1);
            let graded = MeshConfig { graded: true, ..even(ELEMENTS) };
            let areas = [graded, even(ELEMENTS)].map(|config| {
                let mesh = Mesh::from_scene(&scene, &config);
                mesh.elements().iter().map(|e| e.area).fold(f64::MAX, f64::min)
            });
            areas[1] / areas[0]
        };
        assert_eq!(finer(scenes::WIDE), 1.0);
        assert!(finer(scenes::NARROW) >= 4.0, "{}", finer(scenes::NARROW));
    }
}
