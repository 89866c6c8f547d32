//! .tri: colours to reflectance and emittance, normals, sides.

use scene::{Rgb, Sides, TriangleId};
use scene_import::{ErrorKind, Options, SidesRule, open_bytes};

use crate::{import, warnings};

const LAMP: &str = "Triangle\n51 102 255 0 254 254\n0 0 0\n1 0 0\n0 1 0\n\
                    Triangle\n0 0 0 255 10 0\n0 0 1\n1 0 1\n0 1 1\n";

#[test]
fn colours_become_reflectance_and_emittance() {
    let imported = import("some.lamp.TRI", LAMP);
    let scene = &imported.scene;
    assert_eq!(scene.groups(), ["some.lamp"]);
    let [plain, lamp] = [0, 1].map(|i| scene.material_of(TriangleId(i)));
    // 0.5 · 51/255, 0.5 · 102/255, 0.5 · 255/255; 254 does not emit.
    assert_eq!(plain.reflectance, Rgb::new(0.1, 0.2, 0.5));
    assert_eq!(plain.emittance, Rgb::ZERO);
    assert_eq!(plain.name, "51 102 255");
    // 100 · 255 and 100 · 10.
    assert_eq!(lamp.emittance, Rgb::new(25_500.0, 1_000.0, 0.0));
    assert_eq!(lamp.sides, Sides::Front);
    assert_eq!(imported.diagnostics, []);
    assert_eq!(
        imported.summary.to_string(),
        ".tri: 2 triangles (1 emit), 6 vertices, 2 materials, 1 groups, 0 cameras"
    );
}

#[test]
fn options_scale_light_and_reflectance_and_choose_sides() {
    let options =
        Options { tri_light: 2.0, tri_reflect: 0.25, sides: SidesRule::Both, ..Options::default() };
    let imported = open_bytes("a.tri", LAMP.as_bytes(), &options).unwrap();
    let [plain, lamp] = [0, 1].map(|i| imported.scene.material_of(TriangleId(i)));
    assert_eq!(lamp.emittance, Rgb::new(51_000.0, 2_000.0, 0.0));
    assert_eq!(lamp.sides, Sides::Both);
    // 0.25 · 51/255, 0.25 · 102/255 and 0.25 · 255/255.
    assert_eq!(plain.reflectance, Rgb::new(0.05, 0.1, 0.25));
    assert_eq!(imported.diagnostics, []);
}

#[test]
fn options_that_make_impossible_surfaces_are_refused() {
    for (tri_light, tri_reflect, what) in [
        (1.0, 1.5, "reflectance [0.3"),
        (1.0, -1.0, "reflectance [-0.2, "),
        (1.0, f64::NAN, "reflectance [NaN, "),
        (-1.0, 0.5, "emittance [-25500.0, "),
        (f64::INFINITY, 0.5, "emittance [inf, "),
        (f64::NAN, 0.5, "emittance [NaN, "),
    ] {
        let options = Options { tri_light, tri_reflect, ..Options::default() };
        let error = open_bytes("a.tri", LAMP.as_bytes(), &options).unwrap_err();
        assert_eq!(error.kind(), ErrorKind::Invalid);
        let text = error.to_string();
        assert!(text.starts_with("a.tri: material ") && text.contains(what), "{text}");
    }
}

#[test]
fn a_reflectance_of_exactly_one_is_kept_and_named() {
    let options = Options { tri_reflect: 1.0, ..Options::default() };
    let imported = open_bytes("a.tri", LAMP.as_bytes(), &options).unwrap();
    assert_eq!(imported.scene.material_of(TriangleId(0)).reflectance[2], 1.0);
    assert_eq!(
        warnings(&imported),
        ["a.tri:1: material 51 102 255: a reflectance of exactly 1 loses no light"]
    );
}

#[test]
fn normals_are_checked_against_the_winding() {
    let with_normal =
        |z: f64| format!("Triangle\n9 9 9 0 0 0\n0 0 0 0 0 {z}\n1 0 0 0 0 {z}\n0 1 0 0 0 {z}\n");
    assert_eq!(import("a.tri", with_normal(1.0)).diagnostics, []);
    assert_eq!(import("a.tri", with_normal(0.0)).diagnostics, []);
    assert_eq!(
        warnings(&import("a.tri", with_normal(-1.0))),
        ["a.tri:1: the normals point to the triangle's back"]
    );
}

#[test]
fn equal_corners_are_one_vertex_even_across_the_sign_of_zero() {
    let text = "Triangle\n9 9 9 0 0 0\n0 0 0\n1 0 0\n0 1 0\n\
                Triangle\n9 9 9 0 0 0\n1 -0 0\n1 1 0\n-0 1 0\n";
    assert_eq!(import("a.tri", text).scene.vertices().len(), 4);
}

#[test]
fn an_empty_file_is_an_empty_scene() {
    let imported = import("a.tri", "");
    assert_eq!(imported.scene.triangles(), []);
    assert_eq!(imported.diagnostics, []);
}
