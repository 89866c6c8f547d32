//! OBJ and MTL: order, forms of faces, materials, missing files.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use glam::DVec3;
use scene::{Rgb, TriangleId};
use scene_import::{Imported, Options, open, open_bytes};

use crate::{import, warnings};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

fn corners(imported: &Imported, triangle: u32) -> [[f64; 3]; 3] {
    imported.scene.corners(TriangleId(triangle)).map(|p: DVec3| p.to_array())
}

fn group_of(imported: &Imported, triangle: usize) -> &str {
    let scene = &imported.scene;
    &scene.groups()[scene.triangles()[triangle].group.index()]
}

#[test]
fn polygons_become_fans_in_order() {
    let text = "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 3 0\nv 0 1 0\nf 1 2 3 4 5\n";
    let imported = import("a.obj", text);
    let p = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 1.0, 0.0], [1.0, 3.0, 0.0], [0.0, 1.0, 0.0]];
    assert_eq!(imported.scene.triangles().len(), 3);
    assert_eq!(corners(&imported, 0), [p[0], p[1], p[2]]);
    assert_eq!(corners(&imported, 1), [p[0], p[2], p[3]]);
    assert_eq!(corners(&imported, 2), [p[0], p[3], p[4]]);
}

#[test]
fn recurring_groups_and_materials_keep_the_order_of_the_file() {
    let mut text = String::from("mtllib a.mtl\n");
    for (x, head) in
        ["g low\nusemtl a", "g high\nusemtl b", "g low", "usemtl a", "o high"].iter().enumerate()
    {
        text += &format!("{head}\nv {x} 0 0\nv {x} 1 0\nv {x} 0 1\nf -3 -2 -1\n");
    }
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.obj"), text).unwrap();
    fs::write(folder.path().join("a.mtl"), "newmtl a\nKd 0.1 0.1 0.1\nnewmtl b\nKd 0.2 0.2 0.2\n")
        .unwrap();
    let imported = open(&folder.path().join("a.obj"), &Options::default()).unwrap();
    assert_eq!(imported.diagnostics, []);
    assert_eq!(imported.scene.groups(), ["low", "high"]);
    for (triangle, (group, material)) in
        [("low", "a"), ("high", "b"), ("low", "b"), ("low", "a"), ("high", "a")]
            .into_iter()
            .enumerate()
    {
        let id = TriangleId::from(triangle);
        assert_eq!(imported.scene.corners(id)[0].x, triangle as f64);
        assert_eq!(group_of(&imported, triangle), group);
        assert_eq!(imported.scene.material_of(id).name, material);
    }
}

#[test]
fn every_form_of_a_corner_means_the_same_triangle() {
    let head = format!("{SQUARE}vt 0 0\nvt 1 0\nvt 1 1\nvn 0 0 1\n");
    let plain = corners(&import("a.obj", format!("{SQUARE}f 1 2 3")), 0);
    for face in [
        "f 1/1 2/2 3/3",
        "f 1//1 2//1 3//1",
        "f 1/1/1 2/2/1 3/3/1",
        "f -4 -3 -2",
        "f -4/-3/-1 2//-1 3",
        "f 1/ 2/ 3/",
        "f 1 2 \\\n3",
        "f 1 2 3 # a comment",
        "\tf  1  2  3\r",
    ] {
        assert_eq!(corners(&import("a.obj", format!("{head}{face}\n")), 0), plain, "{face}");
    }
    // Faces may come before their vertices.
    assert_eq!(corners(&import("a.obj", format!("f 1 2 3\n{SQUARE}")), 0), plain);
}

#[test]
fn coordinates_keep_all_their_digits() {
    let imported = import("a.obj", "v 1000000.123456789 0.1 1e-300\nv 1 0 0\nv 0 1 0\nf 1 2 3");
    assert_eq!(corners(&imported, 0)[0], [1_000_000.123_456_789, 0.1, 1e-300]);
}

#[test]
fn lines_points_and_short_faces_make_no_triangles_and_are_named() {
    let text = format!("{SQUARE}l 1 2 3 4\np 1\nf 1 2\nf 3\nf 1 2 3\nf\ncurv 1 2\n");
    let imported = import("a.obj", text);
    assert_eq!(imported.scene.triangles().len(), 1);
    assert_eq!(
        warnings(&imported),
        [
            "a.obj:5: left out: line elements",
            "a.obj:6: left out: point elements",
            "a.obj:7: a face of 2 corners makes no triangle",
            "a.obj:8: a face of 1 corners makes no triangle",
            "a.obj:10: a face of 0 corners makes no triangle",
            "a.obj:11: left out: statements \"curv\"",
            "a.obj:9: a usemtl before this face is missing: grey of reflectance 0.5 is used",
        ]
    );
    assert_eq!(imported.scene.material_of(TriangleId(0)).reflectance, Rgb::splat(0.5));
    assert_eq!(group_of(&imported, 0), "default");
}

#[test]
fn numbers_that_no_surface_can_have_are_refused_where_they_stand() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.obj");
    fs::write(&path, format!("mtllib a.mtl\nusemtl a\n{SQUARE}f 1 2 3\n")).unwrap();
    let opened = |library: &str| {
        fs::write(folder.path().join("a.mtl"), library).unwrap();
        open(&path, &Options::default())
    };
    let reflectance = "a reflectance from 0 to 1 as Kd";
    let radiance = "a finite radiance of at least 0 as Ke";
    for (statement, expected, found) in [
        ("Kd 1.2 0 0", reflectance, "1.2"),
        ("Kd 0 0 -.1", reflectance, "-.1"),
        ("Kd nan 0 0", reflectance, "nan"),
        ("Kd inf", reflectance, "inf"),
        ("Ke 0 -1 0", radiance, "-1"),
        ("Ke 0 1e999 0", radiance, "1e999"),
        // Its emittance, π times as much, is not finite.
        ("Ke 1e308", radiance, "1e308"),
    ] {
        // No face uses the material: what it says is wrong all the same.
        let library = format!("newmtl a\nKd 0.5\n\nnewmtl b c\nNs 1\n{statement}\n");
        let error = opened(&library).unwrap_err();
        let column = statement.find(found).unwrap() + 1;
        assert_eq!(
            error.to_string(),
            format!("a.mtl:6:{column}: expected {expected} of material b c, found {found:?}")
        );
        assert_eq!((error.line(), error.column()), (Some(6), Some(column as u64)));
    }
    // Off by the seventh digit at most, it stands for 1.
    let imported = opened("# Ours.\nnewmtl a\nKd 1.000001 0 0\n").unwrap();
    assert_eq!(imported.scene.material_of(TriangleId(0)).reflectance, Rgb::new(1.0, 0.0, 0.0));
    let told = "a.mtl:2: material a: reflectance [1.000001, 0.0, 0.0] is above 1 by a rounding: \
                1 is used";
    assert_eq!(warnings(&imported), [told]);
    // The smallest numbers are numbers.
    let imported = opened("newmtl a\nKd 1e-320 0 0\nKe 0 0 1e-320\n").unwrap();
    assert_eq!(imported.diagnostics, []);
    assert!(imported.scene.material_of(TriangleId(0)).emits());
}

#[test]
fn warnings_about_a_material_tell_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let library = "newmtl a\nKd 1 1 1\n\nnewmtl b\nNs 3\n\nnewmtl c\nKd 1\nmap_Kd gone.png\n";
    fs::write(folder.path().join("a.mtl"), library).unwrap();
    let text =
        format!("mtllib a.mtl\n{SQUARE}usemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\nusemtl c\nf 2 3 4\n");
    fs::write(folder.path().join("a.obj"), text).unwrap();
    let told = warnings(&open(&folder.path().join("a.obj"), &Options::default()).unwrap());
    assert_eq!(told[0], "a.mtl:1: material a: a reflectance of exactly 1 loses no light");
    assert_eq!(told[1], "a.mtl:4: Kd of material b is missing: grey of reflectance 0.5 is used");
    assert!(told[2].starts_with("a.mtl:7: texture gone.png is left out, white is used: "));
    assert_eq!(told[3], "a.mtl:7: material c: a reflectance of exactly 1 loses no light");
    assert_eq!(told.len(), 4);
}

#[test]
fn materials_and_what_is_missing_of_them() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write(
        "my lib.mtl",
        "newmtl lamp\nKd 0.1 0.2 0.3\nKe 17 12 0\nnewmtl bare\nNs 3\nnewmtl hot\nKd 1 0 0\n",
    );
    write("other.mtl", "newmtl wall\nKd 0.9 0.9 0.9\nmap_Kd absent.png\n");
    let mut text = format!("mtllib my lib.mtl\nmtllib other.mtl gone.mtl\n{SQUARE}");
    for name in ["lamp", "bare", "hot", "wall", "nobody", "nobody"] {
        text += &format!("usemtl {name}\nf 1 2 3\n");
    }
    write("a.obj", &text);
    let imported = open(&folder.path().join("a.obj"), &Options::default()).unwrap();
    let material = |i: u32| imported.scene.material_of(TriangleId(i));
    assert_eq!(material(0).reflectance, Rgb::new(0.1, 0.2, 0.3));
    // A Lambertian emitter of radiance L has exitance πL.
    assert_eq!(material(0).emittance, Rgb::new(17.0 * PI, 12.0 * PI, 0.0));
    assert_eq!(material(1).reflectance, Rgb::splat(0.5));
    assert_eq!(material(2).reflectance, Rgb::new(1.0, 0.0, 0.0));
    assert_eq!(material(3).reflectance, Rgb::splat(0.9));
    assert_eq!(material(4).reflectance, Rgb::splat(0.5));
    let file_notes: Vec<_> = imported
        .diagnostics
        .iter()
        .filter(|d| d.triangle.is_none())
        .map(ToString::to_string)
        .collect();
    let gone = "a.obj:2: material library \"gone.mtl\" (";
    assert!(file_notes[0].starts_with(gone), "{file_notes:?}");
    assert!(file_notes[0].ends_with("is missing: grey of reflectance 0.5 is used"));
    assert_eq!(
        file_notes[1],
        "my lib.mtl:4: Kd of material bare is missing: grey of reflectance 0.5 is used"
    );
    assert_eq!(
        file_notes[2],
        "my lib.mtl:6: material hot: a reflectance of exactly 1 loses no light"
    );
    let absent = "other.mtl:1: texture absent.png is left out, white is used: ";
    assert!(file_notes[3].starts_with(absent));
    assert_eq!(
        file_notes[4],
        "a.obj:15: material nobody is missing: grey of reflectance 0.5 is used"
    );
    assert_eq!(file_notes.len(), 5);
}

#[test]
fn a_mistake_in_a_library_names_the_library() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("a.obj"), "mtllib b.mtl\n").unwrap();
    fs::write(folder.path().join("b.mtl"), "newmtl x\nKd 1 1\n").unwrap();
    let error = open(&folder.path().join("a.obj"), &Options::default()).unwrap_err();
    assert_eq!(error.to_string(), "b.mtl:2:6: expected red, green and blue, found \"1\"");
}

#[test]
fn a_texture_multiplies_kd_and_counts_v_upwards() {
    let folder = tempfile::tempdir().unwrap();
    // White above, black below.
    let image =
        image::RgbImage::from_fn(2, 2, |_, y| image::Rgb([if y == 0 { 255 } else { 0 }; 3]));
    image.save(folder.path().join("tiles.png")).unwrap();
    fs::write(folder.path().join("a.mtl"), "newmtl t\nKd 0.8 0.4 0.2\nmap_Kd tiles.png\n").unwrap();
    let text = format!(
        "mtllib a.mtl\nusemtl t\n{SQUARE}vt 0 0\nvt 1 0\nvt 0 0.5\nvt 0 1\nvt 1 1\n\
         f 1/1 2/2 3/3\nf 1/4 2/5 3/3\nf 1/1 2/2 3/4\nf 1 2 3\n"
    );
    fs::write(folder.path().join("a.obj"), text).unwrap();
    let imported = open(&folder.path().join("a.obj"), &Options::default()).unwrap();
    assert!(warnings(&imported).contains(
        &"a.obj:15: texture of material t is left out, white is used: a face has no texture coordinates".to_owned()
    ));
    // Wholly in the lower, black half; wholly in the white one; the lower left half of the
    // square, of whose area 1/2 the upper corner above v = 1/2 is 1/8: a quarter. A face without
    // texture coordinates counts as white.
    for (triangle, share) in [(0, 0.0), (1, 1.0), (2, 0.25), (3, 1.0)] {
        let reflectance = imported.scene.material_of(TriangleId(triangle)).reflectance;
        for (channel, kd) in reflectance.0.into_iter().zip([0.8, 0.4, 0.2]) {
            assert!((channel - kd * share).abs() < 1e-12, "{triangle}: {reflectance:?}");
        }
    }
}

#[test]
fn libraries_are_not_sought_outside_plain_files() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("folder.mtl")).unwrap();
    fs::write(folder.path().join("a.obj"), format!("mtllib folder.mtl\n{SQUARE}usemtl m\nf 1 2 3"))
        .unwrap();
    let imported = open(&folder.path().join("a.obj"), &Options::default()).unwrap();
    assert!(warnings(&imported)[0].contains("it is not a plain file"));
    assert_eq!(imported.scene.triangles().len(), 1);
    let missing = Path::new("b.obj");
    assert!(open(missing, &Options::default()).is_err());
}

#[test]
fn damaged_text_never_panics() {
    let whole = format!(
        "{SQUARE}vt 0 0\nvt 1 0\nvn 0 0 1\ng a b\nusemtl m\nf 1/1/1 -3/2/1 3//1 4\nl 1 2\no c\nf 1 2 3\n"
    );
    for position in 0..whole.len() {
        for damage in *b" \n\\#-/09e\xff\0" {
            let mut bytes = whole.clone().into_bytes();
            bytes[position] = damage;
            // Either way is fine: many damaged files are still files.
            let _ = open_bytes("a.obj", &bytes, &Options::default());
        }
    }
    for wild in [
        "f 9223372036854775807 1 2",
        "f -9223372036854775808 1 2",
        "f 1/-9223372036854775808 1 2",
        "f 1/9999999999 1 2",
    ] {
        assert!(
            open_bytes("a.obj", format!("{SQUARE}{wild}").as_bytes(), &Options::default()).is_err()
        );
    }
}
