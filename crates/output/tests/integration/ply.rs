//! Binary PLY through a parser of its own.

use glam::DVec3;
use output::tone::screen;
use output::{Exposure, Format, Options};
use scene::{Rgb, Sides};

use crate::common::{Lit, bytes, rectangle, square};

struct Ply {
    header: String,
    /// x, y, z, exitance.
    vertices: Vec<([f64; 3], [f32; 3], [u8; 3])>,
    /// Corners, input triangle.
    faces: Vec<([u32; 3], u32)>,
}

fn take<'a>(bytes: &mut &'a [u8], count: usize) -> &'a [u8] {
    let (head, tail) = bytes.split_at(count);
    *bytes = tail;
    head
}

fn float(bytes: &mut &[u8]) -> f32 {
    f32::from_le_bytes(take(bytes, 4).try_into().unwrap())
}

fn parse(bytes: &[u8]) -> Ply {
    let end = b"end_header\n";
    let at = bytes.windows(end.len()).position(|w| w == end).unwrap() + end.len();
    let header = String::from_utf8(bytes[..at].to_vec()).unwrap();
    let count = |what: &str| -> usize {
        let line = header.lines().find_map(|l| l.strip_prefix(what)).unwrap();
        line.trim().parse().unwrap()
    };
    let wide = header.contains("property double x");
    let mut rest = &bytes[at..];
    let vertices = (0..count("element vertex"))
        .map(|_| {
            let position = [0; 3].map(|_| match wide {
                true => f64::from_le_bytes(take(&mut rest, 8).try_into().unwrap()),
                false => f64::from(float(&mut rest)),
            });
            let light = [0; 3].map(|_| float(&mut rest));
            (position, light, take(&mut rest, 3).try_into().unwrap())
        })
        .collect();
    let faces = (0..count("element face"))
        .map(|_| {
            assert_eq!(take(&mut rest, 1), [3]);
            let mut word = || u32::from_le_bytes(take(&mut rest, 4).try_into().unwrap());
            ([word(), word(), word()], word())
        })
        .collect();
    assert!(rest.is_empty());
    Ply { header, vertices, faces }
}

#[test]
fn a_rectangle_is_four_vertices_with_light_and_colour() {
    let light = Rgb::new(0.2, 0.6, 1.8);
    let options = Options { exposure: Exposure::Scale(0.5), ..Options::default() };
    let ply = parse(&bytes(Format::Ply, &square(light), &options));
    assert_eq!(ply.faces, [([0, 1, 2], 0), ([0, 2, 3], 1)]);
    let at: Vec<_> = ply.vertices.iter().map(|v| v.0).collect();
    assert_eq!(at, [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    for vertex in &ply.vertices {
        assert_eq!(vertex.1, [0.2, 0.6, 1.8]);
        // 0.1, 0.3 and 0.9, which the shoulder bends to 1 − 0.2/1.5, through the sRGB
        // formula by hand: 89.04, 148.9 and 239.4.
        assert_eq!(vertex.2, [89, 149, 239]);
        assert_eq!(vertex.2, screen(light, 0.5));
    }
    let properties = "property float x\nproperty float y\nproperty float z\n\
        property float exitance_r\nproperty float exitance_g\nproperty float exitance_b\n\
        property uchar red\nproperty uchar green\nproperty uchar blue\n";
    assert!(ply.header.contains(properties));
}

#[test]
fn a_crease_in_the_light_keeps_its_vertices_apart() {
    let mut lit = Lit::default();
    let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
    lit.quad(rectangle(0.0), group, grey, |p| Rgb::splat(p.x));
    lit.solution.elements[1].corner_exitance[0] = Rgb::splat(5.0);
    let ply = parse(&bytes(Format::Ply, &lit.finish(), &Options::default()));
    // The shared diagonal is smooth at one end and creased at the other.
    assert_eq!(ply.vertices.len(), 5);
    assert_eq!(ply.faces[1], ([3, 2, 4], 1));
}

#[test]
fn separate_vertices_in_one_place_are_welded() {
    let mut lit = Lit::default();
    let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
    lit.quad(rectangle(0.0), group, grey, |_| Rgb::splat(1.0));
    lit.quad(rectangle(0.0).map(|p| p + DVec3::Y), group, grey, |_| Rgb::splat(1.0));
    let ply = parse(&bytes(Format::Ply, &lit.finish(), &Options::default()));
    assert_eq!(ply.vertices.len(), 6);
}

#[test]
fn a_scene_far_from_the_origin_keeps_its_shape() {
    for (offset, real) in [(0.0, "float"), (4.5, "float"), (1e7, "double")] {
        let mut lit = Lit::default();
        let (group, grey) = (lit.builder.group("g"), lit.material("grey", 0.0, Sides::Front));
        let corners = rectangle(0.0).map(|p| p * 0.7 + DVec3::X * offset);
        lit.quad(corners, group, grey, |_| Rgb::splat(1.0));
        let ply = parse(&bytes(Format::Ply, &lit.finish(), &Options::default()));
        assert!(ply.header.contains(&format!("property {real} x")), "{offset}");
        for (vertex, corner) in ply.vertices.iter().zip(corners) {
            // Half the f32 spacing at 8, or none at all.
            let bound = if real == "float" { 2.4e-7 } else { 0.0 };
            assert!((vertex.0[0] - corner.x).abs() <= bound, "{vertex:?} {corner}");
        }
    }
}
