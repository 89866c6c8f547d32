//! Scenes that were never solved.

use glam::DVec3;
use output::{Format, Options, unlit};
use scene::{Face, Rgb, Scene, Sides, TriangleId};

use crate::common::{Lit, bytes, rectangle};

/// A grey floor, a two-sided lamp above it, and a triangle without area between them.
fn scene() -> Scene {
    let mut lit = Lit::default();
    let group = lit.builder.group("room");
    let grey = lit.material("grey", 0.0, Sides::Front);
    let lamp = lit.material("lamp", 7.0, Sides::Both);
    lit.quad(rectangle(0.0), group, grey, |_| Rgb::ZERO);
    let flat = [0.0, 1.0, 2.0].map(|x| lit.builder.vertex(DVec3::new(x, 0.0, 0.5)));
    lit.builder.triangle(flat, lamp, group).unwrap();
    let panel = rectangle(1.0).map(|p| lit.builder.vertex(p));
    lit.builder.triangle([panel[0], panel[1], panel[2]], lamp, group).unwrap();
    lit.builder.finish()
}

#[test]
fn each_side_with_area_shows_what_it_emits() {
    let scene = scene();
    let solution = unlit(&scene);
    let sides: Vec<_> = solution.elements.iter().map(|e| (e.triangle.0, e.face)).collect();
    let front = Face::Front;
    assert_eq!(sides, [(0, front), (1, front), (3, front), (3, Face::Back)]);
    for element in &solution.elements {
        let emittance = scene.material_of(element.triangle).emittance;
        assert_eq!((element.exitance, element.corner_exitance), (emittance, [emittance; 3]));
        // Half of a rectangle of 2 by 1.
        assert_eq!(solution.area(element), 1.0);
        let [a, b, c] = solution.corners(element);
        let up = (b - a).cross(c - a).z;
        assert_eq!(up > 0.0, element.face == Face::Front);
    }
    assert_eq!(solution.triangle_exitance(&scene)[2], scene.material_of(TriangleId(2)).emittance);
}

#[test]
fn every_format_takes_it() {
    let scene = scene();
    let lit = (scene.clone(), unlit(&scene));
    let formats = [
        Format::Csv,
        Format::Tri,
        Format::Ply,
        #[cfg(feature = "glb")]
        Format::Glb,
    ];
    for format in formats {
        assert!(!bytes(format, &lit, &Options::default()).is_empty());
    }
    let csv = String::from_utf8(bytes(Format::Csv, &lit, &Options::default())).unwrap();
    assert_eq!(csv, "triangle,area,B_r,B_g,B_b\n0,1,0,0,0\n1,1,0,0,0\n2,0,7,7,7\n3,1,7,7,7\n");
    assert_eq!(unlit(&Scene::default()).elements, []);
}
