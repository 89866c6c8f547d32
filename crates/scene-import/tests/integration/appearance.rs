//! glTF materials: factors, textures, vertex colours, emission, sides.

use std::f64::consts::PI;

use scene::{Material, Rgb, Sides, TriangleId};
use scene_import::Imported;

use crate::glb::{Glb, TRIANGLE, with_material};
use crate::{failure, import, warnings};

fn material(imported: &Imported) -> &Material {
    imported.scene.material_of(TriangleId(0))
}

fn assert_near(a: Rgb, b: [f64; 3]) {
    let distance = (a - Rgb(b)).map(f64::abs).max_channel();
    assert!(distance < 1e-7, "{a:?} {b:?}");
}

#[test]
fn reflectance_is_what_the_metal_leaves_of_the_base_colour() {
    let imported = import(
        "a.glb",
        with_material(
            r#""name":"steel","pbrMetallicRoughness":{"baseColorFactor":[0.8,0.4,0.2,1],"metallicFactor":0.25}"#,
        ),
    );
    assert_eq!(material(&imported).name, "steel");
    assert_near(material(&imported).reflectance, [0.6, 0.3, 0.15]);
    assert_eq!(material(&imported).sides, Sides::Front);
    assert_eq!(
        warnings(&imported),
        ["materials[0]: left out: the mirror-like share of the reflectance (metallic 0.25)"]
    );
}

#[test]
fn emission_is_pi_times_radiance_times_strength() {
    let imported = import(
        "a.glb",
        with_material(
            r#""emissiveFactor":[1,0.5,0],"extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":8}},
        "doubleSided":true,"alphaMode":"BLEND","pbrMetallicRoughness":{"baseColorFactor":[0,0,0,0.5],"metallicFactor":0}"#,
        ),
    );
    assert_near(material(&imported).emittance, [8.0 * PI, 4.0 * PI, 0.0]);
    assert_eq!(material(&imported).sides, Sides::Both);
    assert_eq!(imported.summary.emitters, 1);
    assert_eq!(warnings(&imported), ["materials[0]: left out: alpha: the surface is opaque"]);
}

#[test]
fn a_primitive_without_material_is_grey() {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    let imported = import(
        "a.glb",
        glb.build(
            r#""meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]"#,
        ),
    );
    assert_eq!(material(&imported).reflectance, Rgb::splat(0.5));
    assert_eq!(
        warnings(&imported),
        [
            "nodes[0].mesh[0].primitives[0]: the primitive's material is missing: grey of reflectance 0.5 is used"
        ]
    );
}

#[test]
fn a_white_base_colour_is_kept_and_named() {
    let imported = import("a.glb", with_material(r#""pbrMetallicRoughness":{"metallicFactor":0}"#));
    assert_eq!(material(&imported).reflectance, Rgb::splat(1.0));
    assert_eq!(
        warnings(&imported),
        ["materials[0]: material material 0: a reflectance of exactly 1 loses no light"]
    );
}

#[test]
fn factors_that_no_surface_can_have_are_refused_with_the_way_to_them() {
    let strength = "extensions.KHR_materials_emissive_strength.emissiveStrength";
    let (unit, emission) = ("a reflectance from 0 to 1", "a finite number of at least 0");
    for (material, place, expected, found) in [
        (
            r#""pbrMetallicRoughness":{"baseColorFactor":[1.2,0,0,1]}"#,
            "pbrMetallicRoughness.baseColorFactor[0]",
            unit,
            "1.2",
        ),
        (
            r#""pbrMetallicRoughness":{"baseColorFactor":[0,0,-0.1,1]}"#,
            "pbrMetallicRoughness.baseColorFactor[2]",
            unit,
            "-0.1",
        ),
        // Less than no metal would reflect more than the base.
        (
            r#""pbrMetallicRoughness":{"metallicFactor":-0.5}"#,
            "pbrMetallicRoughness.metallicFactor",
            "a number from 0 to 1",
            "-0.5",
        ),
        (r#""emissiveFactor":[0,-1,0]"#, "emissiveFactor[1]", emission, "-1"),
        (
            r#""extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":-2}}"#,
            strength,
            emission,
            "-2",
        ),
    ] {
        assert_eq!(
            failure("a.glb", with_material(material)),
            format!("a.glb: materials[0].{place}: expected {expected}, found {found}")
        );
    }
    // JSON has no other numbers that are not finite than those that are too large for their
    // type, here f32.
    for wild in [
        r#""emissiveFactor":[1e39,0,0]"#,
        r#""emissiveFactor":[0,1e999,0]"#,
        r#""pbrMetallicRoughness":{"baseColorFactor":[0,1e39,0,1]}"#,
        r#""extensions":{"KHR_materials_emissive_strength":{"emissiveStrength":1e39}}"#,
    ] {
        let text = failure("a.glb", with_material(wild));
        assert!(text.starts_with("a.glb:1:"), "the place in the JSON: {text}");
        assert!(text.ends_with(": expected glTF JSON: number out of range"), "{text}");
    }
}

#[test]
fn a_base_colour_above_one_by_a_rounding_is_one() {
    // The neighbour of 1 in f32.
    let file = with_material(
        r#""pbrMetallicRoughness":{"baseColorFactor":[1.00000012,0.5,0.5,1],"metallicFactor":0}"#,
    );
    let imported = import("a.glb", file);
    assert_eq!(material(&imported).reflectance, Rgb::new(1.0, 0.5, 0.5));
    assert_eq!(
        warnings(&imported),
        [
            "materials[0]: material material 0: reflectance [1.0000001192092896, 0.5, 0.5] is above 1 by a rounding: 1 is used"
        ]
    );
}

#[test]
fn vertex_colours_are_clamped_as_the_standard_says() {
    let file = |colours: [[f32; 3]; 3]| {
        let mut glb = Glb::default();
        glb.floats(&TRIANGLE);
        glb.floats(&colours);
        glb.build(
            r#""materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"metallicFactor":0}}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],"nodes":[{"mesh":0}]"#,
        )
    };
    let imported = import("a.glb", file([[1.5, 0.25, -0.5], [1.0, 0.25, 0.5], [1.0, 0.25, 1.0]]));
    assert_near(material(&imported).reflectance, [0.5, 0.25, 0.5]);
    assert_eq!(
        warnings(&imported),
        ["accessors[1]: left out: what COLOR_0 has beyond [0, 1], as glTF demands"]
    );
    let wild = file([[0.0; 3], [0.0, f32::NAN, 0.0], [0.0; 3]]);
    assert_eq!(
        failure("a.glb", wild),
        "a.glb: accessors[1]: expected finite numbers, found NaN in entry 1"
    );
}

#[test]
fn vertex_colours_are_averaged() {
    for (component, view) in [
        (5126, [1.0_f32, 0.0, 0.0, 0.5, 0.3, 0.0, 0.0, 0.0, 0.9].map(f32::to_le_bytes).concat()),
        // Bytes, padded to four an entry: 255, 0, 0; 127.5 has no byte, so 51·k are used.
        (5121, vec![255, 0, 0, 0, 51, 51, 0, 0, 0, 0, 255, 0]),
    ] {
        let mut glb = Glb::default();
        glb.floats(&TRIANGLE);
        let view = glb.view(&view);
        let normalized = component == 5121;
        let kind = if normalized { "VEC4" } else { "VEC3" };
        glb.accessor(&format!(
            r#""bufferView":{view},"componentType":{component},"normalized":{normalized},"count":3,"type":"{kind}""#
        ));
        let imported = import("a.glb", glb.build(
            r#""materials":[{"pbrMetallicRoughness":{"baseColorFactor":[0.5,1,1,1],"metallicFactor":0}}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],"nodes":[{"mesh":0}]"#,
        ));
        let expected = if normalized {
            [0.5 * (1.0 + 0.2) / 3.0, 0.2 / 3.0, 1.0 / 3.0]
        } else {
            [0.5 * 1.5 / 3.0, 0.3 / 3.0, 0.9 / 3.0]
        };
        assert_near(material(&imported).reflectance, expected);
    }
}

/// A triangle with texture coordinates and one image, a PNG in rows of two texels.
fn textured(texels: &[[u8; 3]], uv: [[f32; 2]; 3], material: &str, sampler: &str) -> Imported {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.floats(&uv);
    let view = glb.png(2, texels);
    import("a.glb", glb.build(&format!(
        r#""images":[{{"bufferView":{view},"mimeType":"image/png"}}],"samplers":[{{{sampler}}}],
        "textures":[{{"source":0,"sampler":0}}],"materials":[{{{material}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1}},"material":0}}]}}],"nodes":[{{"mesh":0}}]"#
    )))
}

const WHITE: [u8; 3] = [255; 3];
const BLACK: [u8; 3] = [0; 3];
const CHECKER: [[u8; 3]; 4] = [WHITE, BLACK, BLACK, WHITE];
/// Half the unit square, on the upper left; v counts downwards.
const HALF: [[f32; 2]; 3] = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];

#[test]
fn a_base_texture_is_averaged_in_linear_light() {
    let base = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0},"baseColorFactor":[0.8,0.8,0.4,1],"metallicFactor":0}"#;
    // Half the area of the triangle lies on the white texel, a quarter on each black one.
    assert_near(material(&textured(&CHECKER, HALF, base, "")).reflectance, [0.4, 0.4, 0.2]);
    // One colour everywhere: 0.8 times the sRGB value of code 188, 0.5028864580.
    let grey = textured(&[[188; 3]; 4], HALF, base, "");
    assert_near(material(&grey).reflectance, [0.402_309_166, 0.402_309_166, 0.201_154_583]);
}

#[test]
fn wraps_are_honoured() {
    let base = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0}"#;
    // Within texel 3 along the row: texel 1 repeated or clamped, texel 0 mirrored.
    let uv = HALF.map(|[u, v]| [1.55 + 0.4 * u, 0.05 + 0.4 * v]);
    for (code, value) in [(10497, 0.0), (33071, 0.0), (33648, 1.0)] {
        let sampler = format!(r#""wrapS":{code},"wrapT":{code}"#);
        assert_near(material(&textured(&CHECKER, uv, base, &sampler)).reflectance, [value; 3]);
    }
}

#[test]
fn texture_transforms_are_honoured() {
    // Shrunk into the white texel at the lower right.
    let base = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
        {"scale":[0.4,0.4],"offset":[0.55,0.55]}}},"metallicFactor":0}"#;
    assert_near(material(&textured(&CHECKER, HALF, base, "")).reflectance, [1.0; 3]);
}

#[test]
fn texture_transforms_turn_counter_clockwise() {
    // A quarter turn takes (u, v) to (v, −u), v counted downwards; the shift brings that into
    // the white texel at the upper left. Turned the other way it would straddle two texels.
    let base = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":{"KHR_texture_transform":
        {"scale":[0.4,0.4],"rotation":1.5707963267948966,"offset":[0.05,0.45]}}},"metallicFactor":0}"#;
    assert_near(material(&textured(&CHECKER, HALF, base, "")).reflectance, [1.0; 3]);
}

#[test]
fn a_metallic_texture_is_linear_and_in_the_blue_channel() {
    let metal = r#""pbrMetallicRoughness":{"baseColorFactor":[0.5,0.5,0.5,1],"metallicRoughnessTexture":{"index":0}}"#;
    // 1 − 51/255 = 0.8.
    let imported = textured(&[[255, 255, 51]; 4], HALF, metal, "");
    assert_near(material(&imported).reflectance, [0.4; 3]);
}

#[test]
fn base_and_metal_are_averaged_together() {
    // The same checker for both: where the base is white all is metal, elsewhere the base
    // is black, so nothing is reflected; the product of the means would be 1/4.
    let both = r#""pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicRoughnessTexture":{"index":0}}"#;
    assert_near(material(&textured(&CHECKER, HALF, both, "")).reflectance, [0.0; 3]);
}

#[test]
fn an_emission_texture_is_averaged_likewise() {
    let glow = r#""emissiveTexture":{"index":0},"emissiveFactor":[1,0.5,0],"pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]}"#;
    assert_near(material(&textured(&CHECKER, HALF, glow, "")).emittance, [PI / 2.0, PI / 4.0, 0.0]);
}

#[test]
fn textures_that_cannot_be_used_are_named_and_white() {
    let mut glb = Glb::default();
    glb.floats(&TRIANGLE);
    glb.floats(&HALF);
    let view = glb.view(b"not an image");
    let file = |image: &str, attributes: &str| {
        glb.build(&format!(
        r#""images":[{{{image}}}],"textures":[{{"source":0}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}},"baseColorFactor":[0.5,0.5,0.5,1],"metallicFactor":0}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{attributes}}},"material":0}}]}}],"nodes":[{{"mesh":0}}]"#
    ))
    };
    let uv = r#","TEXCOORD_0":1"#;
    for (image, named) in [
        (format!(r#""bufferView":{view},"mimeType":"image/png""#), "without a name"),
        (format!(r#""bufferView":{view},"name":"brick""#), "\"brick\""),
        (r#""uri":"gone.png""#.to_owned(), "\"gone.png\""),
        (String::new(), "without a name"),
    ] {
        let imported = import("a.glb", file(&image, uv));
        assert_eq!(material(&imported).reflectance, Rgb::splat(0.5));
        let [note] = &warnings(&imported)[..] else { panic!("one warning") };
        assert!(
            note.starts_with(&format!("images[0]: texture {named} is left out, white is used: ")),
            "{note}"
        );
    }
}
