//! View3D's .vs3: surfaces into triangles, groups, emissivities; parts of surfaces; mistakes.

use glam::DVec3;
use scene::{Rgb, Scene, TriangleId};
use scene_import::{ErrorKind, Imported, Options, open_bytes};

use crate::{failure, import, warnings};

/// An L-shaped room of height 3, 1 wide and 3 long along both of its legs; the floor and the
/// ceiling are three squares and rectangles each, which are combined.
const L_ROOM: &str = "\
T L-shaped room\r
C encl=1 list=2 eps=1.e-4, maxu=8
F  3
!  #   x    y    z
V  1   0.   3.   3.
V  2   1.   3.   3.
V  3   0.   3.   0.
V  4   1.   3.   0.
V  5   0.   1.   0.
V  6   1.   1.   0.
V  7   3.   1.   0.
V  8   0.   0.   0.
V  9   1.   0.   0.
V 10   3.   0.   0.
V 11   0.   0.   3.
V 12   1.   0.   3.
V 13   3.   0.   3.
V 14   0.   1.   3.
V 15   1.   1.   3.
V 16   3.   1.   3.
/  #   v1  v2  v3  v4 base cmb  emit  name
S  1   11  13  10   8   0   0   0.90  south\r
S  2   10  13  16   7   0   0   0.90  east
S  3    6   7  16  15   0   0   0.90  north
S  4    4   6  15   2   0   0   0.90  inner
S  5    3   4   2   1   0   0   0.90  end
S  6    8   3   1  11   0   0   0.75  west
S  7   11  14  15  12   0   0   0.90  ceiling
S  8    8   9   6   5   0   0   0.90  floor
S  9    1   2  15  14   0   7   0.90  ceiling-b    ! joined
S 10   15  16  13  12   0   7   0.90  ceiling-c
s 11    5   6   4   3   0   8   0.90  floor-b
s 12    9  10   7   6   0   8   0.90  floor-c
End of data
V 1 this is not read
";

/// One wall 6 long and 3 high that faces +y, ready for parts.
const WALL: &str = "\
V 1 0 0 0
V 2 6 0 0
V 3 6 0 3
V 4 0 0 3
V 5 1 0 0
V 6 2 0 0
V 7 2 0 2
V 8 1 0 2
S 1 4 3 2 1 0 0 0.9 wall
";

fn area_of_group(scene: &Scene, name: &str) -> f64 {
    let group = scene.groups().iter().position(|g| g == name).expect("the group is there");
    scene.ids().filter(|id| in_group(scene, *id, group)).map(|id| scene.area(id)).sum()
}

fn in_group(scene: &Scene, id: TriangleId, group: usize) -> bool {
    scene.triangles()[id.index()].group.index() == group
}

/// Twice the area, along the front.
fn front(scene: &Scene, id: TriangleId) -> DVec3 {
    let [a, b, c] = scene.corners(id);
    (b - a).cross(c - a)
}

#[test]
fn an_l_shaped_room_looks_inwards() {
    let imported = import("l.VS3", L_ROOM);
    let scene = &imported.scene;
    assert_eq!(warnings(&imported), [""; 0]);
    assert_eq!(
        imported.summary.to_string(),
        "View3D: 24 triangles (0 emit), 16 vertices, 2 materials, 8 groups, 0 cameras"
    );
    let names = ["south", "east", "north", "inner", "end", "west", "ceiling", "floor"];
    assert_eq!(scene.groups(), names);
    for (name, area) in names.into_iter().zip([9.0, 3.0, 6.0, 6.0, 3.0, 9.0, 5.0, 5.0]) {
        assert_eq!(area_of_group(scene, name), area, "{name}");
    }
    // Divergence theorem: the sum of p·n over a closed surface that faces inwards is −3 times
    // its volume, 5 · 3, whatever its shape.
    let flux: f64 = scene
        .ids()
        .map(|id| scene.corners(id).iter().sum::<DVec3>().dot(front(scene, id)) / 6.0)
        .sum();
    assert!((flux + 3.0 * 15.0).abs() < 1e-12, "{flux}");
    let west = scene.ids().nth(10).expect("24 triangles");
    assert_eq!(scene.material_of(west).reflectance, Rgb::splat(0.25));
    assert_eq!(scene.material_of(west).emittance, Rgb::ZERO);
}

#[test]
fn a_triangle_has_no_fourth_corner() {
    let imported = import("a.vs3", "V 1 0 0 0\nV 2 4 0 0\nV,3,0,3,0\nS 1 1 2 3 0 0 0 1 t");
    assert_eq!(imported.scene.triangles().len(), 1);
    assert_eq!(front(&imported.scene, TriangleId(0)), DVec3::new(0.0, 0.0, 12.0));
    assert_eq!(imported.scene.material_of(TriangleId(0)).reflectance, Rgb::ZERO);
}

#[test]
fn parts_of_a_surface_are_taken_out_of_it() {
    // A door, and a pane that is a part of the door.
    let text = format!(
        "{WALL}S 2 8 7 6 5 1 0 0.5 door\nV 9 1.5 0 1\nV 10 2 0 1\nV 11 2 0 1.5\nS 3 9 11 10 0 2 0 0.1 pane\n"
    );
    let imported = import("a.vs3", text);
    assert_eq!(warnings(&imported), [""; 0]);
    let areas = ["wall", "door", "pane"].map(|name| area_of_group(&imported.scene, name));
    // 6·3 − 1·2, 1·2 − ½·½·½ and ½·½·½.
    assert_eq!(areas, [16.0, 1.875, 0.125]);
    assert!(imported.scene.ids().all(|id| front(&imported.scene, id).y > 0.0));
}

#[test]
fn parts_that_break_the_rules_are_named() {
    let off = format!("{WALL}V 9 1 0.1 2\nS 2 9 7 6 5 1 0 0.5 door\n");
    assert_eq!(
        warnings(&import("a.vs3", &off)),
        ["a.vs3:11: the four corners are not those of a flat convex quadrilateral"]
    );
    let beside = format!("{WALL}V 9 1 1 0\nV 10 2 1 0\nS 2 9 10 6 5 1 0 0.5 step\n");
    let imported = import("a.vs3", beside);
    assert_eq!(
        warnings(&imported),
        ["a.vs3:12: the surface does not lie in the plane of its base: both count in full"]
    );
    assert_eq!(area_of_group(&imported.scene, "wall"), 18.0);
    let back = format!("{WALL}S 2 5 6 7 8 1 0 0.5 door\n");
    let imported = import("a.vs3", back);
    assert_eq!(warnings(&imported), ["a.vs3:10: the surface faces away from its base"]);
    assert_eq!(area_of_group(&imported.scene, "wall"), 16.0);
    let bow = "V 1 0 0 0\nV 2 1 0 0\nV 3 1 1 0\nV 4 0 1 0\nS 1 1 3 2 4 0 0 .5 bow\n";
    assert!(warnings(&import("a.vs3", bow))[0].starts_with("a.vs3:5: the four corners"));
}

#[test]
fn what_blocks_without_radiating_is_black_and_apart() {
    let text = format!(
        "{WALL}N 2 5 6 7 8 1 0 0.9 hole\nO 3 1 2 3 4\nS 4 8 7 6 5 3 0 0.5 panel\nS 5 4 3 2 1 0 0 1 again\n"
    );
    let imported = import("a.vs3", text);
    let scene = &imported.scene;
    assert_eq!(scene.groups(), ["wall", "obstructions", "panel", "again"]);
    assert_eq!(area_of_group(scene, "wall"), 16.0);
    // The hole, turned to face as the wall does, and the obstruction without its panel.
    assert_eq!(area_of_group(scene, "obstructions"), 2.0 + 16.0);
    let hole = scene.ids().find(|&id| in_group(scene, id, 1)).expect("it has an area");
    assert!(front(scene, hole).y > 0.0);
    for id in scene.ids().filter(|&id| in_group(scene, id, 1)) {
        assert_eq!(scene.material_of(id).reflectance, Rgb::ZERO);
    }
    let mask = import("a.vs3", format!("{WALL}M 2 5 6 7 8 1 0 0.9 mask\n"));
    assert_eq!(area_of_group(&mask.scene, "wall"), 16.0);
    assert_eq!(
        warnings(&mask),
        [
            "a.vs3:10: left out: what a masking surface and its base exchange; the place blocks and is black"
        ]
    );
}

#[test]
fn mistakes_are_placed() {
    for (text, message) in [
        ("V 1 0 0", "1:8: expected a finite number for z, found the end of the line"),
        ("V 1 0 0 ! 3", "1:12: expected a finite number for z, found the end of the line"),
        ("V 1 0 0 0\r\nV 2 0 0 x\r\n", "2:9: expected a finite number for z, found \"x\""),
        ("V 1 0 0 0\nV 3 0 0 0", "2:3: expected 2, the number of the next vertex, found \"3\""),
        (
            "V 1 0 0 0\nS 1 1 1 2 0 0 0 .9 a",
            "2:9: expected the number of a vertex from 1 to 1, found \"2\"",
        ),
        (
            "V 1 0 0 0\nS 1 1 1 1 -1 0 0 .9 a",
            "2:11: expected the number of a vertex from 1 to 1, or 0 for a triangle, found \"-1\"",
        ),
        ("S 1 1 1 1 0 0 0 .9 a", "1:5: expected the number of a vertex from 1 to 0, found \"1\""),
        (
            "V 1 0 0 0\nS 1 1 1 1 99999999999999999999999 0 0 .9 a",
            "2:11: expected the number of a vertex from 1 to 1, or 0 for a triangle, \
             found \"99999999999999999999999\"",
        ),
        (
            "V 1 0 0 0\nS 1 1 1 1 0 1 0 .9 a",
            "2:13: expected the number of an earlier surface or of an obstruction as base \
             (0 for none, S only), found \"1\"",
        ),
        (
            "V 1 0 0 0\nN 1 1 1 1 0 0 0 .9 a",
            "2:13: expected the number of an earlier surface or of an obstruction as base \
             (0 for none, S only), found \"0\"",
        ),
        (
            "V 1 0 0 0\nS 1 1 1 1 0 0 1 .9 a",
            "2:15: expected 0 or the number of an earlier S surface to combine it with, found \"1\"",
        ),
        (
            "V 1 0 0 0\nS 1 1 1 1 0 0 0",
            "2:16: expected an emissivity from 0 to 1, found the end of the line",
        ),
        (
            "V 1 0 0 0\nS 1 1 1 1 0 0 0 .9",
            "2:19: expected the surface's name, found the end of the line",
        ),
        ("V 1 nan 0 0", "1:5: expected a finite number for x, found \"nan\""),
        ("V 1 0 -inf 0", "1:7: expected a finite number for y, found \"-inf\""),
        ("V 1 0 0 1e999", "1:9: expected a finite number for z, found \"1e999\""),
        (
            "V 1 0 0 0\nS 1 1 1 1 0 0 0 1.2 a",
            "2:17: expected an emissivity from 0 to 1, found \"1.2\"",
        ),
        (
            "V 1 0 0 0\nS 1 1 1 1 0 0 0 -.1 a",
            "2:17: expected an emissivity from 0 to 1, found \"-.1\"",
        ),
        (
            "V 1 0 0 0\nS 1 1 1 1 0 0 0 nan a",
            "2:17: expected an emissivity from 0 to 1, found \"nan\"",
        ),
        ("F 3a", "1:3: expected format 3, which lists vertices and surfaces, found \"3a\""),
        (
            "hello",
            "1:1: expected a line that begins with T, C, F, V, S, M, N, O or E, found \"hello\"",
        ),
    ] {
        assert_eq!(failure("a.vs3", text), format!("a.vs3:{message}"), "{text}");
    }
}

#[test]
fn odd_words_and_sizes_are_warnings() {
    let text = "X 1 2\nV 1 0 0 0 origin\nV 2 1e-320 0 0\nV 3 0 1e-320 0\nS 1 1 2 3 0 0 0 0 a b\n";
    assert_eq!(
        warnings(&import("a.vs3", text)),
        [
            "a.vs3:1: left out: a coordinate transformation",
            "a.vs3:2: left out: the line from \"origin\" on",
            "a.vs3:5: left out: the line from \"b\" on",
            "a.vs3:5: material emissivity 0: a reflectance of exactly 1 loses no light",
            "a.vs3:5: the triangle has no area",
        ]
    );
}

#[test]
fn hostile_files_end_in_a_scene_or_one_line() {
    assert_eq!(import("a.vs3", "").scene.triangles(), []);
    assert_eq!(import("a.vs3", "\u{feff}E").scene.triangles(), []);
    let latin =
        import("a.vs3", b"T caf\xe9\nV 1 0 0 0\nV 2 1 0 0\nV 3 0 1 0\nS 1 1 2 3 0 0 0 .5 \xff\xfe");
    assert_eq!(latin.scene.groups(), ["\u{fffd}\u{fffd}"]);
    assert!(failure("a.vs3", b"\0\0\xff").starts_with("a.vs3:1:3: expected a line"));
    // Every prefix, and every file with one byte overwritten, is read or refused.
    let whole = format!("{WALL}S 2 8 7 6 5 1 0 0.5 door\nO 3 1 2 3 4\nS 4 1 2 3 0 3 2 0.5 panel\n");
    for end in 0..whole.len() {
        let _: Result<Imported, _> =
            open_bytes("a.vs3", &whole.as_bytes()[..end], &Options::default());
        for byte in *b"09e-\n!\xff" {
            let mut bytes = whole.clone().into_bytes();
            bytes[end] = byte;
            let _: Result<Imported, _> = open_bytes("a.vs3", &bytes, &Options::default());
        }
    }
}

#[test]
fn a_wall_of_too_many_parts_is_refused_at_its_line() {
    use std::fmt::Write as _;

    let mut text = WALL.to_owned();
    for number in 2..2000 {
        writeln!(text, "S {number} 8 7 6 5 1 0 0.5 door").expect("a String takes all");
    }
    let error = open_bytes("a.vs3", text.as_bytes(), &Options::default()).unwrap_err();
    assert_eq!((error.kind(), error.line()), (ErrorKind::TooLarge, Some(9 + 1025)));
}
