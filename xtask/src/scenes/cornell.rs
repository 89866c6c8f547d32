//! The Cornell box: the published measured geometry, as OBJ with MTL and as GLB.
//!
//! Lengths are millimetres. The corners are those of the Cornell University Program of Computer
//! Graphics, "Cornell Box Data" (1998); the reflectances are the measured spectra rounded to
//! RGB, and the light is a panel 0.1 mm under the ceiling, so that nothing coincides with it.

use serde_json::json;

use super::glb::{Glb, Surface};
use super::mesh::{Point, Shape};
use super::shapes::quad;

/// A material: MTL `Kd` is the reflectance, `Ke` the radiance.
pub(crate) struct Material {
    pub(crate) name: &'static str,
    pub(crate) reflectance: [f64; 3],
    pub(crate) radiance: [f64; 3],
}

/// One named thing in the box.
pub(crate) struct Part {
    pub(crate) name: &'static str,
    /// Index into [`MATERIALS`].
    pub(crate) material: usize,
    /// Corners counter-clockwise as seen from where light arrives.
    pub(crate) quads: &'static [[Point; 4]],
}

const WHITE: usize = 0;
const RED: usize = 1;
const GREEN: usize = 2;
const LIGHT: usize = 3;

pub(crate) const MATERIALS: [Material; 4] = [
    Material { name: "white", reflectance: [0.725, 0.71, 0.68], radiance: [0.0; 3] },
    Material { name: "red", reflectance: [0.63, 0.065, 0.05], radiance: [0.0; 3] },
    Material { name: "green", reflectance: [0.14, 0.45, 0.091], radiance: [0.0; 3] },
    Material { name: "light", reflectance: [0.78, 0.78, 0.78], radiance: [17.0, 12.0, 4.0] },
];

pub(crate) const PARTS: [Part; 8] = [
    Part {
        name: "floor",
        material: WHITE,
        quads: &[[[552.8, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 559.2], [549.6, 0.0, 559.2]]],
    },
    Part {
        name: "ceiling",
        material: WHITE,
        quads: &[[
            [556.0, 548.8, 0.0],
            [556.0, 548.8, 559.2],
            [0.0, 548.8, 559.2],
            [0.0, 548.8, 0.0],
        ]],
    },
    Part {
        name: "back_wall",
        material: WHITE,
        quads: &[[
            [549.6, 0.0, 559.2],
            [0.0, 0.0, 559.2],
            [0.0, 548.8, 559.2],
            [556.0, 548.8, 559.2],
        ]],
    },
    Part {
        name: "right_wall",
        material: GREEN,
        quads: &[[[0.0, 0.0, 559.2], [0.0, 0.0, 0.0], [0.0, 548.8, 0.0], [0.0, 548.8, 559.2]]],
    },
    Part {
        name: "left_wall",
        material: RED,
        quads: &[[
            [552.8, 0.0, 0.0],
            [549.6, 0.0, 559.2],
            [556.0, 548.8, 559.2],
            [556.0, 548.8, 0.0],
        ]],
    },
    Part {
        name: "light",
        material: LIGHT,
        quads: &[[
            [343.0, 548.7, 227.0],
            [343.0, 548.7, 332.0],
            [213.0, 548.7, 332.0],
            [213.0, 548.7, 227.0],
        ]],
    },
    Part {
        name: "short_block",
        material: WHITE,
        quads: &[
            [
                [130.0, 165.0, 65.0],
                [82.0, 165.0, 225.0],
                [240.0, 165.0, 272.0],
                [290.0, 165.0, 114.0],
            ],
            [
                [290.0, 0.0, 114.0],
                [290.0, 165.0, 114.0],
                [240.0, 165.0, 272.0],
                [240.0, 0.0, 272.0],
            ],
            [[130.0, 0.0, 65.0], [130.0, 165.0, 65.0], [290.0, 165.0, 114.0], [290.0, 0.0, 114.0]],
            [[82.0, 0.0, 225.0], [82.0, 165.0, 225.0], [130.0, 165.0, 65.0], [130.0, 0.0, 65.0]],
            [[240.0, 0.0, 272.0], [240.0, 165.0, 272.0], [82.0, 165.0, 225.0], [82.0, 0.0, 225.0]],
        ],
    },
    Part {
        name: "tall_block",
        material: WHITE,
        quads: &[
            [
                [423.0, 330.0, 247.0],
                [265.0, 330.0, 296.0],
                [314.0, 330.0, 456.0],
                [472.0, 330.0, 406.0],
            ],
            [
                [423.0, 0.0, 247.0],
                [423.0, 330.0, 247.0],
                [472.0, 330.0, 406.0],
                [472.0, 0.0, 406.0],
            ],
            [
                [472.0, 0.0, 406.0],
                [472.0, 330.0, 406.0],
                [314.0, 330.0, 456.0],
                [314.0, 0.0, 456.0],
            ],
            [
                [314.0, 0.0, 456.0],
                [314.0, 330.0, 456.0],
                [265.0, 330.0, 296.0],
                [265.0, 0.0, 296.0],
            ],
            [
                [265.0, 0.0, 296.0],
                [265.0, 330.0, 296.0],
                [423.0, 330.0, 247.0],
                [423.0, 0.0, 247.0],
            ],
        ],
    },
];

/// Vertical field of view of the published camera: 2 atan(0.025 / 2 / 0.035), from a film
/// 0.025 high behind a focal length of 0.035. A literal, so that no platform's atan is asked.
const VERTICAL_FOV: f64 = 0.686_047_880_841_406_8;

/// The box as GLB: a node and a mesh per part, and the published viewpoint.
pub(crate) fn glb() -> Vec<u8> {
    let mut glb = Glb::default();
    for material in &MATERIALS {
        glb.material(&Surface {
            name: material.name,
            base_color: material.reflectance,
            radiance: material.radiance,
            ..Surface::default()
        });
    }
    let mut roots = Vec::new();
    for part in &PARTS {
        let shape = Shape::all(part.quads.iter().map(|&corners| quad(corners)));
        let mesh = glb.mesh(part.name, &shape, part.material, None);
        roots.push(glb.node(json!({ "name": part.name, "mesh": mesh })));
    }
    // The focal plane is square; the far plane lies well behind the back wall.
    let camera = glb.camera("camera", VERTICAL_FOV, 1.0, 10.0, 5000.0);
    // A glTF camera looks along its own -z; half a turn about y makes that the scene's +z.
    roots.push(glb.node(json!({
        "name": "camera",
        "camera": camera,
        "translation": [278.0, 273.0, -800.0],
        "rotation": [0.0, 1.0, 0.0, 0.0],
    })));
    glb.finish("cornell", &roots)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_field_of_view_is_that_of_the_film() {
        assert!((VERTICAL_FOV - 2.0 * (0.025_f64 / 2.0 / 0.035).atan()).abs() < 1e-15);
    }

    #[test]
    fn the_box_has_the_published_number_of_polygons() {
        assert_eq!(PARTS.iter().map(|part| part.quads.len()).sum::<usize>(), 16);
    }
}
