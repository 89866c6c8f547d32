//! Surfaces that overlap in one plane: the first in the scene's order takes part, what it covers
//! of the others does not.

use glam::DVec3;
use radiosity_core::{Mesh, MeshConfig};
use scene::{Face, MaterialId, Rgb, Scene, Sides};

use crate::models::{Model, Solved, solve_mesh, until};

fn mesh(scene: &Scene, elements: usize) -> Mesh {
    Mesh::from_scene(scene, &MeshConfig::with_elements(elements))
}

/// How deep a place lies inside of a triangle, seen along the normal of its winding: the least
/// distance from an edge.
fn depth(corners: [DVec3; 3], place: DVec3) -> f64 {
    let [a, b, c] = corners;
    let normal = (b - a).cross(c - a).normalize();
    let inward = |p: DVec3, q: DVec3| normal.cross(q - p).normalize().dot(place - p);
    inward(a, b).min(inward(b, c)).min(inward(c, a))
}

/// Whether, at 1500 places spread over the square from `low` to `high` at z = 0, the elements
/// that face up and those that face down are each those of the first triangle there.
fn assert_first_wins(scene: &Scene, mesh: &Mesh, low: f64, high: f64) {
    // So far from edges, all triangles and elements agree on what lies inside.
    let margin = 1e-4 * (high - low);
    for i in 0..1500 {
        // The powers of the plastic number spread over a square (Roberts 2018).
        let [x, y] = [0.754_877_666, 0.569_840_291]
            .map(|step| low + (high - low) * (f64::from(i) * step).fract());
        let place = DVec3::new(x, y, 0.0);
        for up in [true, false] {
            // Each triangle's sides at the place, in the scene's order.
            let sides = scene.ids().flat_map(|id| {
                let corners = scene.corners(id);
                let flat = corners.iter().all(|p| p.z.abs() < 1e-5);
                let faces_up = (corners[1] - corners[0]).cross(corners[2] - corners[0]).z > 0.0;
                let lit = faces_up == up || scene.material_of(id).sides == Sides::Both;
                (flat && lit).then(|| (id, depth(corners, place)))
            });
            let sides: Vec<_> = sides.collect();
            if sides.iter().any(|(_, depth)| depth.abs() < margin) {
                continue;
            }
            let expected = sides.iter().find(|(_, depth)| *depth > 0.0).map(|(id, _)| *id);
            let found: Vec<_> = mesh
                .elements()
                .iter()
                .filter(|e| (mesh.root_of(e).normal.z > 0.9) == up)
                .filter(|e| mesh.root_of(e).normal.z.abs() > 0.9)
                .map(|e| (mesh.root_of(e).triangle, e.vertices.map(|v| mesh.vertices()[v.index()])))
                .filter(|(_, corners)| corners[0].z.abs() < 1e-5 && depth(*corners, place) > 0.0)
                .map(|(triangle, _)| triangle)
                .collect();
            assert_eq!(found, Vec::from_iter(expected), "at {place}, up: {up}");
        }
    }
}

/// The area of the elements that face up near z = 0.
fn area_up(mesh: &Mesh) -> f64 {
    let flat = mesh.elements().iter().filter(|e| {
        mesh.root_of(e).normal.z > 0.9
            && e.vertices.iter().all(|v| mesh.vertices()[v.index()].z.abs() < 1e-5)
    });
    flat.map(|e| e.area).sum()
}

/// A square around `middle`, with corners `reach` from it, turned by `turn` radians.
fn square(middle: [f64; 2], reach: f64, turn: f64, z: f64) -> [[f64; 3]; 4] {
    [0.0, 1.0, 2.0, 3.0].map(|k| {
        let (y, x) = (turn + k * std::f64::consts::FRAC_PI_2).sin_cos();
        [middle[0] + reach * x, middle[1] + reach * y, z]
    })
}

/// Quadrilaterals in the plane z = 0 or near it, in their order.
fn sheets(quads: &[([[f64; 3]; 4], Sides)]) -> Scene {
    let mut model = Model::new();
    for &(quad, sides) in quads {
        let material = model.sided(0.5, 0.0, sides);
        model.quad(quad, material);
    }
    model.scene()
}

const FLOOR: [[f64; 3]; 4] = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
const POSTER: [[f64; 3]; 4] =
    [[0.25, 0.25, 0.], [0.75, 0.25, 0.], [0.75, 0.75, 0.], [0.25, 0.75, 0.]];

fn fronts<const N: usize>(quads: [[[f64; 3]; 4]; N]) -> Scene {
    sheets(&quads.map(|quad| (quad, Sides::Front)))
}

#[test]
fn the_first_wins_and_the_union_is_covered_once() {
    let turned = square([0.5, 0.5], 0.3, 0.4, 0.0);
    let over_a_corner = square([0.9, 0.8], 0.4, 0.2, 0.0);
    let larger = square([0.5, 0.5], 2.0, 0.3, 0.0);
    let lifted = square([0.4, 0.6], 0.3, 1.1, 1e-6);
    let flush = [[0., 0., 0.], [0.4, 0., 0.], [0.4, 1., 0.], [0., 1., 0.]];
    let beside = flush.map(|[x, y, z]| [x + 0.4, y, z]);
    // The areas of the unions are known where one lies within the other: the floor's 1, or twice
    // the square of a reach. What it is elsewhere is left to the places.
    let cases = [
        ("poster after the floor", fronts([FLOOR, POSTER]), Some(1.0), 2),
        ("poster before the floor", fronts([POSTER, FLOOR]), Some(1.0), 2),
        ("turned, after", fronts([FLOOR, turned]), Some(1.0), 2),
        ("turned, before", fronts([turned, FLOOR]), Some(1.0), 2),
        ("over a corner, after", fronts([FLOOR, over_a_corner]), None, 2),
        ("over a corner, before", fronts([over_a_corner, FLOOR]), None, 2),
        ("larger, after", fronts([FLOOR, larger]), Some(8.0), 2),
        ("larger, before", fronts([larger, FLOOR]), Some(8.0), 2),
        ("lifted, after", fronts([FLOOR, lifted]), Some(1.0), 2),
        ("lifted, before", fronts([lifted, FLOOR]), Some(1.0), 2),
        ("flush with edges", fronts([flush, beside, FLOOR]), Some(1.0), 2),
        ("three layers", fronts([turned, over_a_corner, FLOOR]), None, 4),
        ("three layers, middle first", fronts([FLOOR, turned, over_a_corner]), None, 4),
        ("star", fronts([square([0.5, 0.5], 0.4, 0.7, 0.0), turned, POSTER, FLOOR]), Some(1.0), 6),
        (
            "the other diagonal",
            fronts([FLOOR, [FLOOR[1], FLOOR[2], FLOOR[3], FLOOR[0]]]),
            Some(1.0),
            2,
        ),
    ];
    for (name, scene, union, covered) in &cases {
        for elements in [1, 300] {
            println!("{name}, {elements} elements");
            let mesh = mesh(scene, elements);
            assert_first_wins(scene, &mesh, -0.6, 1.6);
            if let Some(union) = union {
                // The extent times what counts as near, along a handful of edges.
                assert!((area_up(&mesh) - union).abs() < 1e-5, "{}", area_up(&mesh));
            }
            for e in mesh.elements() {
                let [a, b, c] = e.vertices.map(|v| mesh.vertices()[v.index()]);
                assert!((b - a).cross(c - a).dot(mesh.root_of(e).normal) > 0.0);
            }
        }
        assert!((1..=*covered).contains(&mesh(scene, 1).covered()), "{name}");
    }
}

#[test]
fn fronts_and_backs_each_follow_the_rule() {
    let down = [POSTER[0], POSTER[3], POSTER[2], POSTER[1]];
    let turned = square([0.6, 0.4], 0.3, 0.4, 0.0);
    for quads in [
        [(FLOOR, Sides::Both), (POSTER, Sides::Front)],
        [(FLOOR, Sides::Both), (down, Sides::Front)],
        [(FLOOR, Sides::Front), (POSTER, Sides::Both)],
        [(FLOOR, Sides::Front), (turned, Sides::Both)],
        [(down, Sides::Both), (FLOOR, Sides::Both)],
        [(down, Sides::Front), (FLOOR, Sides::Both)],
        [(turned, Sides::Both), (FLOOR, Sides::Front)],
        [(down, Sides::Both), (POSTER, Sides::Both)],
        [(POSTER, Sides::Front), (POSTER, Sides::Both)],
        [(down, Sides::Front), (POSTER, Sides::Both)],
    ] {
        let scene = sheets(&quads);
        for elements in [1, 200] {
            let mesh = mesh(&scene, elements);
            assert_first_wins(&scene, &mesh, 0.0, 1.0);
            assert!(mesh.covered() > 0);
        }
    }
}

#[test]
fn what_does_not_face_the_same_way_in_one_plane_stays_as_it_is() {
    let down = [POSTER[0], POSTER[3], POSTER[2], POSTER[1]];
    let above = POSTER.map(|[x, y, z]| [x, y, z + 1e-4]);
    // One with a vertex on the floor's edge, and one that reaches over it by a hair.
    let beside = [[1., 0.2, 0.], [2., 0.2, 0.], [2., 0.7, 0.], [1., 0.7, 0.]];
    let hair = beside.map(|[x, y, z]| [x - 1e-7, y, z]);
    for other in [down, above, beside, hair] {
        let scene = fronts([FLOOR, other]);
        let config = MeshConfig { cut: false, ..MeshConfig::with_elements(300) };
        let (with, without) = (mesh(&scene, 300), Mesh::from_scene(&scene, &config));
        assert_eq!(with.covered(), 0);
        assert_eq!(with.vertices(), without.vertices());
        assert_eq!(with.elements(), without.elements());
        assert_eq!(with.points(), without.points());
    }
}

#[test]
fn what_is_wholly_covered_leaves_no_trace_but_its_emittance() {
    let mut plain = Model::new();
    let m = plain.surface(0.5, 0.0);
    plain.quad(square([0.5, 0.5], 1.0, 0.1, 0.0), m);
    let plain = plain.scene();
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    let lamp = model.surface(0.5, 3.0);
    model.quad(square([0.5, 0.5], 1.0, 0.1, 0.0), m);
    // Within the first of the two triangles, and copies of both.
    model.triangle([[0.6, 0.7, 0.], [0.7, 0.7, 0.], [0.65, 0.8, 0.]], lamp);
    model.quad(square([0.5, 0.5], 1.0, 0.1, 0.0), m);
    let scene = model.scene();
    let (with, without) = (mesh(&scene, 200), mesh(&plain, 200));
    assert_eq!((with.covered(), without.covered()), (3, 0));
    assert_eq!(with.elements().len(), without.elements().len());
    assert_eq!(with.points().len(), without.points().len());
    let solved = solve_mesh(&scene, &with, until(1e-3));
    assert_eq!(solved.solution.triangle_exitance(&scene)[2], Rgb::new(3.0, 1.5, 0.0));
    assert_eq!(solved.ledger.emitted, Rgb::ZERO);
}

/// A cube with a lamp for a ceiling and a poster in the floor's plane, or before the cube.
fn posted(poster: Option<[[f64; 3]; 4]>, first: bool, reflectance: f64) -> Scene {
    let mut model = Model::new();
    let wall = model.surface(0.5, 0.0);
    let lamp = model.surface(0.5, 1.0);
    let paper = model.surface(reflectance, 0.0);
    let add = |model: &mut Model, material: MaterialId| {
        if let Some(quad) = poster {
            model.quad(quad, material);
        }
    };
    if first {
        add(&mut model, paper);
    }
    model.cube([wall, lamp, wall, wall, wall, wall]);
    if !first {
        add(&mut model, paper);
    }
    model.scene()
}

/// The mean exitance of what lies at z = 0, and the light's account must close without a defect.
fn floor_light(scene: &Scene, elements: usize) -> f64 {
    let mesh = mesh(scene, elements);
    let Solved { solution, ledger, .. } = solve_mesh(scene, &mesh, until(1e-6));
    let (absorbed, defect) =
        (ledger.share(ledger.absorbed), ledger.share(ledger.form_factor_defect));
    assert!(ledger.imbalance() <= 1e-12);
    // The bare cube of 400 elements has a defect of 5e-3; a floor lit twice has one of 8e-2.
    assert!((absorbed - 1.0).abs() <= 1e-2 && defect.abs() <= 1e-2, "{absorbed} {defect}");
    let (mut light, mut area) = (0.0, 0.0);
    for (element, lit) in mesh.elements().iter().zip(&solution.elements) {
        if mesh.root_of(element).normal.z > 0.9 {
            assert_eq!(lit.face, Face::Front);
            light += lit.exitance[0] * element.area;
            area += element.area;
        }
    }
    assert!((area - 1.0).abs() < 1e-5, "{area}");
    light / area
}

#[test]
fn a_poster_of_the_floors_own_colour_changes_nothing() {
    let turned = square([0.6, 0.4], 0.3, 0.4, 0.0);
    let lifted = POSTER.map(|[x, y, _]| [x, y, 1e-6]);
    let sunk = POSTER.map(|[x, y, _]| [x, y, -1e-6]);
    for elements in [400, 1200] {
        let plain = floor_light(&posted(None, false, 0.5), elements);
        for quad in [POSTER, turned, lifted, sunk] {
            for first in [true, false] {
                let light = floor_light(&posted(Some(quad), first, 0.5), elements);
                let off = light / plain - 1.0;
                println!("off by {off:.1e}");
                assert!(off.abs() <= 3e-3, "{off}");
            }
        }
    }
}

#[test]
fn a_poster_shows_if_it_comes_first() {
    // A black poster before the floor takes a quarter of its light; after it, nothing.
    let plain = floor_light(&posted(None, false, 0.5), 800);
    let after = floor_light(&posted(Some(POSTER), false, 0.0), 800);
    let before = floor_light(&posted(Some(POSTER), true, 0.0), 800);
    assert!((after / plain - 1.0).abs() <= 3e-3, "{after} {plain}");
    // The middle of the floor is brighter than its rim, and the walls get darker, too.
    assert!((0.6..0.75).contains(&(before / plain)), "{before} {plain}");
}

#[test]
fn a_floor_under_many_tiles_is_left_out() {
    let n = 40;
    let (side, gap) = (1.0 / f64::from(n), 0.1 / f64::from(n));
    let mut tiles = Vec::new();
    for k in 0..n * n {
        let [x, y] = [k % n, k / n].map(|i| f64::from(i) * side + gap / 2.0);
        let (u, v) = (x + side - gap, y + side - gap);
        tiles.push(([[x, y, 0.], [u, y, 0.], [u, v, 0.], [x, v, 0.]], Sides::Front));
    }
    let area = |mesh: &Mesh, triangle: std::ops::Range<u32>| -> f64 {
        let of = mesh.elements().iter();
        of.filter(|e| triangle.contains(&mesh.root_of(e).triangle.0)).map(|e| e.area).sum()
    };
    let count = 2 * tiles.len() as u32;
    for floor_first in [false, true] {
        let mut quads = tiles.clone();
        quads.insert(if floor_first { 0 } else { quads.len() }, (FLOOR, Sides::Front));
        let mesh = mesh(&sheets(&quads), 1);
        assert!((area_up(&mesh) - 1.0).abs() < 1e-9);
        let (floor, covered) = if floor_first { (0..2, count) } else { (count..count + 2, 2) };
        let seen = if floor_first { 1.0 } else { 1.0 - 0.81 };
        assert!((area(&mesh, floor) - seen).abs() < 1e-9);
        assert_eq!(mesh.covered(), covered as usize);
    }
}

#[test]
fn piles_and_thickets_end() {
    // Two hundred sheets over one another, all turned: more pieces than there is room for.
    let pile: Vec<_> = (0..200)
        .map(|i| (square([0.5, 0.5], 1.0 - 1e-3 * f64::from(i), f64::from(i), 0.0), Sides::Front))
        .collect();
    let scene = sheets(&pile);
    let mesh = mesh(&scene, 1);
    let sheets: f64 = scene.ids().map(|id| scene.area(id)).sum();
    // The first alone has an area of 2; all of them nearly lie within the circle around it.
    let area = area_up(&mesh);
    println!("{} roots, area {area} of {sheets}", mesh.roots().len());
    assert!(area >= 2.0 && area < sheets && mesh.roots().len() <= 5 * 400 + 1000);
}
