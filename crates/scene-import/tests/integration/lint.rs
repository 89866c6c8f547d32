//! The warnings about triangles that are probably mistakes.

use scene::TriangleId;
use scene_import::{DiagnosticKind, Imported, Options, SidesRule, open_bytes};

use crate::{import, warnings};

const NONE: [u32; 0] = [];

/// .tri text of triangles over the corners of the unit cube, numbered x + 2y + 4z.
fn cube_corners(triangles: &[[u8; 3]]) -> String {
    let corner = |i: u8| format!("{} {} {}\n", i & 1, i >> 1 & 1, i >> 2);
    let record = |t: &[u8; 3]| format!("Triangle\n9 9 9 0 0 0\n{}", t.map(corner).concat());
    triangles.iter().map(record).collect()
}

/// The cube, outside front: two triangles a face.
const CUBE: [[u8; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

fn reversed(imported: &Imported) -> Vec<u32> {
    let suspects =
        imported.diagnostics.iter().filter(|d| d.kind == DiagnosticKind::ReversedWinding);
    suspects.map(|d| d.triangle.expect("a winding belongs to a triangle").0).collect()
}

fn flip([a, b, c]: [u8; 3]) -> [u8; 3] {
    [a, c, b]
}

#[test]
fn the_reversed_face_of_a_cube_is_named_whichever_way_the_cube_faces() {
    assert_eq!(reversed(&import("a.tri", cube_corners(&CUBE))), NONE);
    let inwards = CUBE.map(flip);
    assert_eq!(reversed(&import("a.tri", cube_corners(&inwards))), NONE);
    for mut cube in [CUBE, inwards] {
        cube[6] = flip(cube[6]);
        cube[7] = flip(cube[7]);
        assert_eq!(reversed(&import("a.tri", cube_corners(&cube))), [6, 7]);
    }
    // The first triangle may itself be the wrong one.
    let mut cube = CUBE;
    cube[0] = flip(cube[0]);
    assert_eq!(reversed(&import("a.tri", cube_corners(&cube))), [0]);
    // A cube without a lid is mostly closed; a square alone is not, whoever is reversed.
    assert_eq!(reversed(&import("a.tri", cube_corners(&cube[..10]))), [0]);
    assert_eq!(reversed(&import("a.tri", cube_corners(&cube[..2]))), NONE);
}

#[test]
fn half_against_half_is_not_decided() {
    let mut cube = CUBE;
    for face in &mut cube[..6] {
        *face = flip(*face);
    }
    assert_eq!(reversed(&import("a.tri", cube_corners(&cube))), NONE);
}

#[test]
fn winding_does_not_matter_on_two_sided_surfaces() {
    let mut cube = CUBE;
    cube[0] = flip(cube[0]);
    let options = Options { sides: SidesRule::Both, ..Options::default() };
    let imported = open_bytes("a.tri", cube_corners(&cube).as_bytes(), &options).unwrap();
    assert_eq!(reversed(&imported), NONE);
}

#[test]
fn repeats_and_triangles_without_area_stay_and_are_named() {
    // A triangle; itself turned; its back; a line; a point; itself again.
    let text = cube_corners(&[[1, 2, 4], [4, 1, 2], [4, 2, 1], [1, 1, 2], [3, 3, 3], [1, 2, 4]]);
    let imported = import("a.tri", text);
    assert_eq!(imported.scene.triangles().len(), 6);
    assert_eq!(
        warnings(&imported),
        [
            "a.tri:6: the triangle repeats triangle 0",
            "a.tri:16: the triangle has no area",
            "a.tri:21: the triangle has no area",
            "a.tri:26: the triangle repeats triangle 0",
        ]
    );
    assert_eq!(imported.diagnostics[0].kind, DiagnosticKind::Duplicate { of: TriangleId(0) });
}

#[test]
fn a_fin_on_a_cube_excuses_only_its_own_edge() {
    // The fin gives the edge 0-1 a third triangle; the rest of the cube still tells.
    let mut triangles = CUBE.to_vec();
    triangles[10] = flip(triangles[10]);
    let mut text = cube_corners(&triangles);
    text += "Triangle\n9 9 9 0 0 0\n0 0 0\n1 0 0\n0 -1 -1\n";
    assert_eq!(reversed(&import("a.tri", text)), [10]);
}
