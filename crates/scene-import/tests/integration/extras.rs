//! `extras.radiosity`: what the crate `output` writes into its GLB files, spelt as it does.

use glam::DVec3;
use scene::{Rgb, Sides, TriangleId};
use scene_import::{Imported, Options, SidesRule, open_bytes};

use crate::glb::{Glb, TRIANGLE};
use crate::{failure, import, warnings};

const THIRD: f64 = 1.0 / 3.0;

/// White and unlit, as our materials are shown, with these extras.
fn material(name: &str, extras: &str) -> String {
    format!(
        r#"{{"name":"{name}","pbrMetallicRoughness":{{"baseColorFactor":[1.0,1.0,1.0,1.0],"metallicFactor":0.0,"roughnessFactor":1.0}},"doubleSided":false,"extensions":{{"KHR_materials_unlit":{{}}}},"extras":{extras}}}"#
    )
}

/// A floor, and beside it a two-sided lamp with its back, both dark in `COLOR_0`; the lamp's
/// extras and further nodes and members as given.
fn lit(lamp: &str, root: &str, members: &str) -> Vec<u8> {
    lit_by(&material("lamp", lamp), root, members)
}

/// The same with the lamp's whole material as given.
fn lit_by(lamp: &str, root: &str, members: &str) -> Vec<u8> {
    let mut glb = Glb::default();
    let aside = TRIANGLE.map(|[x, y, z]| [x + 2.0, y, z]);
    let corners = [glb.floats(&TRIANGLE), glb.floats(&aside)];
    let colours = glb.floats(&[[0.125_f32, 0.25, 0.5]; 3]);
    let (front, back) = (glb.indices(&[0, 1, 2]), glb.indices(&[0, 2, 1]));
    let primitive = |material: usize, indices: usize, rest: &str| {
        format!(
            r#"{{"attributes":{{"POSITION":{},"COLOR_0":{colours}}},"material":{material},"indices":{indices}{rest}}}"#,
            corners[material]
        )
    };
    let floor = material(
        "floor",
        r#"{"radiosity":{"emittance":[0.0,0.0,0.0],"reflectance":[0.3333333333333333,0.5,0.1],"sides":"front"}}"#,
    );
    glb.build(&format!(
        r#""extensionsUsed":["KHR_materials_unlit"],"materials":[{floor},{lamp}],
        "meshes":[{{"name":"room","primitives":[{},{},{}]}}],
        "nodes":[{{"name":"room","mesh":0}}{root}]{members}"#,
        primitive(0, front, ""),
        primitive(1, front, ""),
        primitive(1, back, r#","extras":{"radiosity":{"face":"back"}}"#),
    ))
}

const LAMP: &str = r#"{"radiosity":{"emittance":[123.456,0.1,1e+300],"reflectance":[0.7,0.0,1e-9],"sides":"both"}}"#;

fn surface(imported: &Imported, triangle: u32) -> (&str, Rgb, Rgb, Sides) {
    let material = imported.scene.material_of(TriangleId(triangle));
    (&material.name, material.reflectance, material.emittance, material.sides)
}

#[test]
fn surfaces_are_what_was_solved_and_not_what_is_shown() {
    let imported = import("lit.glb", lit(LAMP, "", ""));
    assert_eq!(imported.diagnostics, []);
    // The back is no triangle of its own: the lamp is one triangle with two sides.
    assert_eq!(imported.scene.triangles().len(), 2);
    let floor = ("floor", Rgb::new(THIRD, 0.5, 0.1), Rgb::ZERO, Sides::Front);
    assert_eq!(surface(&imported, 0), floor);
    let lamp = (Rgb::new(0.7, 0.0, 1e-9), Rgb::new(123.456, 0.1, 1e300));
    assert_eq!(surface(&imported, 1), ("lamp", lamp.0, lamp.1, Sides::Both));
    let [a, b, c] = imported.scene.corners(TriangleId(1));
    assert_eq!((b - a).cross(c - a), DVec3::Z);
    assert_eq!(imported.scene.groups(), ["room"]);
}

#[test]
fn a_rule_for_sides_still_rules() {
    let options = Options { sides: SidesRule::Front, ..Options::default() };
    let imported = open_bytes("lit.glb", &lit(LAMP, "", ""), &options).unwrap();
    assert_eq!(surface(&imported, 1).3, Sides::Front);
    assert_eq!(imported.scene.triangles().len(), 2);
}

#[test]
fn malformed_extras_are_told_and_gltfs_own_rule_holds() {
    for (extras, cause) in [
        (r#"{"radiosity":{"reflectance":[0,0,0],"sides":"both"}}"#, "missing field `emittance`"),
        (
            r#"{"radiosity":{"reflectance":[0,0],"emittance":[0,0,0],"sides":"both"}}"#,
            "invalid length 2, expected an array of length 3",
        ),
        (
            r#"{"radiosity":{"reflectance":[0,0,0],"emittance":[0,0,0],"sides":"left"}}"#,
            "unknown variant `left`, expected `front` or `both`",
        ),
        (r#"{"radiosity":7}"#, "invalid type: integer `7`, expected struct Surface"),
    ] {
        let imported = import("lit.glb", lit(extras, "", ""));
        assert_eq!(
            warnings(&imported),
            [
                format!("materials[1]: left out: extras.radiosity: {cause}"),
                // Nothing else tells what an unlit surface does with light.
                "lit.glb: extensionsUsed: left out: extension KHR_materials_unlit".to_owned(),
            ]
        );
        // White times the vertex colour.
        let shown = ("lamp", Rgb::new(0.125, 0.25, 0.5), Rgb::ZERO, Sides::Front);
        assert_eq!(surface(&imported, 1), shown);
        assert_eq!(surface(&imported, 0).1, Rgb::new(THIRD, 0.5, 0.1));
    }
}

#[test]
fn values_that_no_surface_can_have_are_refused() {
    let path = "lit.glb: materials[1].extras.radiosity";
    for (reflectance, emittance, message) in [
        ("0,1.5,0", "0,0,0", "reflectance[1]: expected a reflectance from 0 to 1, found 1.5"),
        ("-0.1,0,0", "0,0,0", "reflectance[0]: expected a reflectance from 0 to 1, found -0.1"),
        ("0,0,0", "0,0,-1", "emittance[2]: expected a finite number of at least 0, found -1"),
    ] {
        let wild = format!(
            r#"{{"radiosity":{{"reflectance":[{reflectance}],"emittance":[{emittance}],"sides":"front"}}}}"#
        );
        assert_eq!(failure("lit.glb", lit(&wild, "", "")), format!("{path}.{message}"));
    }
    let wild = r#"{"radiosity":{"reflectance":[0,0,0],"emittance":[1e999,0,2],"sides":"front"}}"#;
    assert_eq!(
        failure("lit.glb", lit(wild, "", "")),
        format!("{path}: expected numbers that f64 can hold: number out of range")
    );
    // Elsewhere in extras such a number is none of ours.
    let other = LAMP.replacen('{', r#"{"theirs":1e999,"#, 1);
    assert_eq!(import("lit.glb", lit(&other, "", "")).diagnostics, []);
    // As emittance it is a number, though as radiance it would not be.
    let bright = LAMP.replace("1e+300", "1e308");
    assert_eq!(surface(&import("lit.glb", lit(&bright, "", "")), 1).2[2], 1e308);
    // What is only shown counts for nothing where a surface is stated.
    let shown = material("lamp", LAMP).replace("[1.0,1.0,1.0,1.0]", "[7.0,1.0,1.0,1.0]");
    assert_eq!(import("lit.glb", lit_by(&shown, "", "")).diagnostics, []);
    // Another program may leave the last digit of a double off.
    let near = LAMP.replace("0.7,", "1.0000000000000002,");
    let imported = import("lit.glb", lit(&near, "", ""));
    assert_eq!(surface(&imported, 1).1, Rgb::new(1.0, 0.0, 1e-9));
    assert_eq!(imported.diagnostics.len(), 1);
}

#[test]
fn extras_of_others_change_nothing() {
    for extras in ["[1,2]", "7", r#""radiosity""#, r#"{"radiance":{"sides":"both"}}"#] {
        let imported = import("lit.glb", lit(extras, "", ""));
        assert_eq!(surface(&imported, 1).1, Rgb::new(0.125, 0.25, 0.5));
        assert_eq!(imported.diagnostics.len(), 1, "the unlit extension alone");
    }
}

/// Where the offset of a scene far from the origin puts the floor's first corner.
fn offset(root: &str) -> (DVec3, Vec<String>) {
    let root = format!(r#",{{"name":"offset from the origin","children":[0],{root}}}"#);
    let members = r#","scenes":[{"nodes":[1]}],"scene":0"#;
    let imported = import("lit.glb", lit(LAMP, &root, members));
    (imported.scene.corners(TriangleId(0))[0], warnings(&imported))
}

#[test]
fn an_offset_from_the_origin_keeps_its_digits_unless_the_node_was_moved() {
    // 16777217.25 is 2^24 + 1.25, which f32 narrows to 2^24 + 2.
    let exact = DVec3::new(16_777_217.25, -0.1, 1e30);
    let stated = r#""extras":{"radiosity":{"translation":[16777217.25,-0.1,1e+30]}}"#;
    let same = r#""translation":[16777217.25,-0.1,1e+30]"#;
    assert_eq!(offset(&format!("{same},{stated}")), (exact, vec![]));
    let moved = r#""translation":[5,-0.5,0.25]"#;
    assert_eq!(offset(&format!("{moved},{stated}")), (DVec3::new(5.0, -0.5, 0.25), vec![]));
    let (corner, told) = offset(&format!(r#"{moved},"extras":{{"radiosity":[[5,-0.5]]}}"#));
    assert_eq!(corner, DVec3::new(5.0, -0.5, 0.25));
    assert_eq!(
        told,
        ["nodes[1]: left out: extras.radiosity: invalid length 2, expected an array of length 3"]
    );
}

#[test]
fn cameras_come_back_with_their_targets() {
    // A quarter turn about x looks along +y with +z up.
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let place = format!(r#""translation":[0.1,-4.7,2.3],"rotation":[{half},0.0,0.0,{half}]"#);
    let node =
        format!(r#",{{"name":"door","camera":0,{place},"extras":{{"radiosity":{{{place}}}}}}}"#);
    let camera = |rest: &str| {
        format!(
            r#","cameras":[{{"name":"door","type":"perspective","perspective":{{"yfov":0.7,"znear":0.004}}{rest}}}]"#
        )
    };
    let extras = r#","extras":{"radiosity":{"targetDistance":4.1,"yfov":0.7}}"#;
    let imported = import("lit.glb", lit(LAMP, &node, &camera(extras)));
    assert_eq!(imported.diagnostics, []);
    let [door] = imported.scene.cameras() else { panic!("one camera") };
    assert_eq!((door.name.as_str(), door.vertical_fov), ("door", 0.7));
    assert_eq!(door.position, DVec3::new(0.1, -4.7, 2.3));
    // A few roundings of numbers near 5.
    assert!(door.target.distance(DVec3::new(0.1, -0.6, 2.3)) < 1e-14, "{}", door.target);
    assert!(door.up.distance(DVec3::Z) < 1e-14, "{}", door.up);
    // Without the doubles, f32 and a target at unit distance.
    let imported = import("lit.glb", lit(LAMP, &node, &camera("")));
    let [door] = imported.scene.cameras() else { panic!("one camera") };
    assert_eq!(door.vertical_fov, f64::from(0.7_f32));
    assert!(door.target.distance(DVec3::new(0.1, -3.7, 2.3)) < 1e-14, "{}", door.target);
    // Another field of view than the stated one: somebody has changed it.
    let changed = extras.replace("0.7", "0.9");
    let imported = import("lit.glb", lit(LAMP, &node, &camera(&changed)));
    assert_eq!(imported.scene.cameras()[0].vertical_fov, f64::from(0.7_f32));
}
