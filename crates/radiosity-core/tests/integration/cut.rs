//! Contact cuts: no element lies on both sides of what stands on it, and nothing else changes.

use std::collections::HashMap;

use glam::DVec3;
use radiosity_core::mesh::Element;
use radiosity_core::{Correction, Mesh, MeshConfig, ShootingConfig};
use scene::{Rgb, Scene, Sides};

use crate::models::{Model, Solved, solve_mesh, until};

fn cut(scene: &Scene, elements: usize) -> Mesh {
    Mesh::from_scene(scene, &MeshConfig::with_elements(elements))
}

fn uncut(scene: &Scene, elements: usize) -> Mesh {
    Mesh::from_scene(scene, &MeshConfig { cut: false, ..MeshConfig::with_elements(elements) })
}

fn corners(mesh: &Mesh, element: &Element) -> [DVec3; 3] {
    element.vertices.map(|v| mesh.vertices()[v.index()])
}

fn centroid(mesh: &Mesh, element: &Element) -> DVec3 {
    corners(mesh, element).iter().sum::<DVec3>() / 3.0
}

/// How far the corners of an element reach to the two sides of where `height` is 0: the
/// smaller of both.
fn straddle(mesh: &Mesh, element: &Element, height: impl Fn(DVec3) -> f64) -> f64 {
    let heights = corners(mesh, element).map(height);
    let most = |sign: f64| heights.iter().map(|h| sign * h).fold(0.0, f64::max);
    most(1.0).min(most(-1.0))
}

/// The area of each input triangle's elements, both sides together.
fn areas(mesh: &Mesh, scene: &Scene) -> Vec<f64> {
    let mut areas = vec![0.0; scene.triangles().len()];
    for element in mesh.elements() {
        areas[mesh.root_of(element).triangle.index()] += element.area;
    }
    areas
}

fn assert_areas_are_kept(mesh: &Mesh, scene: &Scene) {
    for (id, area) in scene.ids().zip(areas(mesh, scene)) {
        let sides = if scene.material_of(id).sides == Sides::Both { 2.0 } else { 1.0 };
        let whole = sides * scene.area(id);
        assert!((area - whole).abs() <= 1e-12 * whole, "triangle {}: {area} {whole}", id.0);
    }
    for element in mesh.elements() {
        let [a, b, c] = corners(mesh, element);
        assert!((b - a).cross(c - a).dot(mesh.root_of(element).normal) > 0.0);
    }
}

/// Edges of the elements of the floor z = 0 that have an element on one side alone, though they
/// do not lie on the rim of the square from 0 to `side`.
fn open_edges(mesh: &Mesh, side: f64) -> usize {
    let mut count: HashMap<[u32; 2], u32> = HashMap::new();
    let floor = |e: &&Element| corners(mesh, e).iter().all(|p| p.z == 0.0);
    for element in mesh.elements().iter().filter(floor) {
        for k in 0..3 {
            let [a, b] = [element.vertices[k], element.vertices[(k + 1) % 3]];
            let place = [a, b].map(|v| mesh.vertices()[v.index()]);
            // What touches by rounding may have bent the rim.
            let on = |a: f64, b: f64, s: f64| (a - s).abs() < 1e-6 && (b - s).abs() < 1e-6;
            let rim = |p: DVec3, q: DVec3| {
                [0.0, side].iter().any(|&s| on(p.x, q.x, s) || on(p.y, q.y, s))
            };
            if !rim(place[0], place[1]) {
                *count.entry([a.0.min(b.0), a.0.max(b.0)]).or_default() += 1;
            }
        }
    }
    count.values().filter(|&&n| n != 2).count()
}

/// A floor from 0 to `side`, of two triangles that face up.
fn floor(model: &mut Model, side: f64, material: scene::MaterialId) {
    model.quad([[0., 0., 0.], [side, 0., 0.], [side, side, 0.], [0., side, 0.]], material);
}

/// A wall of height 1 on the floor from one place to another.
fn wall(model: &mut Model, [a, b]: [[f64; 2]; 2], material: scene::MaterialId) {
    let at = |p: [f64; 2], z: f64| [p[0], p[1], z];
    model.quad([at(a, 0.0), at(b, 0.0), at(b, 1.0), at(a, 1.0)], material);
}

/// Two rooms 2 by 1 by 1 parted by a thin wall at x = 0.9; one wall of the left one is a lamp.
fn two_rooms() -> Scene {
    let mut model = Model::new();
    let white = model.surface(0.7, 0.0);
    let lamp = model.surface(0.7, 1.0);
    let thin = model.sided(0.7, 0.0, Sides::Both);
    let p = |i: usize| [2.0 * (i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64];
    let faces =
        [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
    for (i, face) in faces.into_iter().enumerate() {
        model.quad(face.map(p), if i == 4 { lamp } else { white });
    }
    let x = 0.9;
    model.quad([[x, 0., 0.], [x, 1., 0.], [x, 1., 1.], [x, 0., 1.]], thin);
    model.scene()
}

/// The most exitance in the dark room, the back of the wall included.
fn beyond_the_wall(mesh: &Mesh, solved: &Solved) -> f64 {
    let dark = |e: &&Element| {
        let c = centroid(mesh, e);
        c.x > 0.9 + 1e-9 || (c.x - 0.9).abs() < 1e-9 && mesh.root_of(e).normal.x > 0.0
    };
    let number = mesh.elements().iter().zip(&solved.solution.elements);
    number
        .filter(|(e, _)| dark(e))
        .flat_map(|(_, lit)| lit.corner_exitance.into_iter().chain([lit.exitance]))
        .map(Rgb::max_channel)
        .fold(0.0, f64::max)
}

#[test]
fn no_light_leaks_through_a_wall_without_thickness() {
    let scene = two_rooms();
    // A uniform correction would put light into the dark room, too, and take it out again
    // only down to where the shooting stops.
    let config = ShootingConfig { correction: Correction::Never, ..until(1e-3) };
    for elements in [1, 60, 200, 777, 2000] {
        let mesh = cut(&scene, elements);
        assert_areas_are_kept(&mesh, &scene);
        let solved = solve_mesh(&scene, &mesh, config);
        assert_eq!(beyond_the_wall(&mesh, &solved), 0.0, "{elements} elements");
        assert_eq!(solved.ledger.wrong_side, Rgb::ZERO);
    }
    // It is the cuts that keep the light in.
    let mesh = uncut(&scene, 200);
    assert!(beyond_the_wall(&mesh, &solve_mesh(&scene, &mesh, config)) > 0.01);
}

#[test]
fn a_floor_lies_under_a_box_or_outside_but_never_both() {
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    floor(&mut model, 4.0, m);
    // A turned box without a bottom.
    let foot = [[1.0, 0.7], [2.9, 1.3], [2.4, 3.0], [0.6, 2.2]];
    for k in 0..4 {
        wall(&mut model, [foot[k], foot[(k + 1) % 4]], m);
    }
    let [a, b, c, d] = foot.map(|p| [p[0], p[1], 1.0]);
    model.quad([a, b, c, d], m);
    let scene = model.scene();
    let inside = |p: DVec3, slack: f64| {
        (0..4).all(|k| {
            let [a, b] = [foot[k], foot[(k + 1) % 4]].map(|p| DVec3::new(p[0], p[1], 0.0));
            (b - a).cross(p - a).z > -slack
        })
    };
    // Half the cross product of the diagonals (2.4 − 1, 3 − .7) and (.6 − 2.9, 2.2 − 1.3).
    let area = 0.5 * (1.4 * 0.9 + 2.3 * 2.3);
    for elements in [12, 100, 1000] {
        let mesh = cut(&scene, elements);
        assert_areas_are_kept(&mesh, &scene);
        let mut covered = 0.0;
        for e in mesh.elements().iter().filter(|e| mesh.root_of(e).triangle.0 < 2) {
            if inside(centroid(&mesh, e), 0.0) {
                covered += e.area;
                assert!(corners(&mesh, e).iter().all(|p| inside(*p, 1e-9)));
            }
        }
        assert!((covered - area).abs() < 1e-12, "{covered} {area}");
        assert_eq!(open_edges(&mesh, 4.0), 0);
    }
}

#[test]
fn a_scene_without_contacts_keeps_its_mesh_to_the_bit() {
    let mut cubes = Model::new();
    let m = cubes.surface(0.5, 0.0);
    cubes.cube([m; 6]);
    cubes.cube_at(1.5, [m; 6]);
    // A wall over a whole edge of both floors: bisection and points know it already.
    let mut meeting = Model::new();
    let m = meeting.surface(0.5, 0.0);
    floor(&mut meeting, 1.0, m);
    meeting.quad([[1., 0., 0.], [2., 0., 0.], [2., 1., 0.], [1., 1., 0.]], m);
    wall(&mut meeting, [[1., 0.], [1., 1.]], m);
    // Back to back, one above the other, and behind a floor that is lit from above.
    let mut near = Model::new();
    let m = near.surface(0.5, 0.0);
    floor(&mut near, 4.0, m);
    near.quad([[1., 1., 0.], [1., 2., 0.], [2., 2., 0.], [2., 1., 0.]], m);
    near.quad([[1., 1., 0.1], [2., 1., 0.1], [2., 2., 0.1], [1., 2., 0.1]], m);
    near.quad([[1., 1., -1.], [2., 1., -1.], [2., 1., 0.], [1., 1., 0.]], m);
    for scene in [cubes.scene(), meeting.scene(), near.scene()] {
        for elements in [1, 500] {
            let (a, b) = (cut(&scene, elements), uncut(&scene, elements));
            assert_eq!(a.vertices(), b.vertices());
            assert_eq!(a.elements(), b.elements());
            assert_eq!(a.points(), b.points());
        }
    }
}

#[test]
fn a_wall_across_two_coplanar_triangles_parts_both_at_one_vertex() {
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    floor(&mut model, 1.0, m);
    // It crosses the diagonal x = y near (.40, .40).
    wall(&mut model, [[0.2, 0.3], [0.9, 0.65]], m);
    let scene = model.scene();
    let mesh = cut(&scene, 1);
    let height = |p: DVec3| (p.y - 0.3) - 0.5 * (p.x - 0.2);
    let within = |p: DVec3| (0.2..=0.9).contains(&p.x);
    let floor = || mesh.elements().iter().filter(|e| mesh.root_of(e).triangle.0 < 2);
    for e in floor().filter(|e| corners(&mesh, e).into_iter().all(within)) {
        assert!(straddle(&mesh, e, height) < 1e-15, "{:?}", corners(&mesh, e));
    }
    let crossing = mesh
        .vertices()
        .iter()
        .filter(|p| p.z == 0.0 && p.distance(DVec3::new(0.4, 0.4, 0.0)) < 1e-12);
    assert_eq!(crossing.count(), 1);
    assert_eq!(open_edges(&mesh, 1.0), 0);
    // The wall itself stands on nothing that would part it: it stays two triangles.
    assert_eq!(mesh.roots().iter().filter(|r| r.triangle.0 >= 2).count(), 2);
    assert_areas_are_kept(&mesh, &scene);
    // Along the wall, the floor has points on each side of it.
    let fine = cut(&scene, 1000);
    let along = |p: DVec3| height(p).abs() < 0.02 && (0.3..0.8).contains(&p.x) && p.z == 0.0;
    let beside: Vec<DVec3> =
        fine.points().iter().map(|p| p.position).filter(|p| along(*p)).collect();
    assert!(beside.len() > 10 && beside.iter().all(|p| height(*p).abs() > 1e-6), "{beside:?}");
}

#[test]
fn a_wall_along_an_edge_between_coplanar_triangles_parts_their_points() {
    // On a part of the floor's diagonal: nothing is to be cut but the diagonal itself.
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    floor(&mut model, 1.0, m);
    wall(&mut model, [[0.3, 0.3], [0.7, 0.7]], m);
    let scene = model.scene();
    let mesh = cut(&scene, 200);
    assert_eq!(open_edges(&mesh, 1.0), 0);
    assert_eq!(mesh.roots().iter().filter(|r| r.triangle.0 < 2).count(), 6);
    let on_line =
        |p: DVec3, low: f64, high: f64| p.z == 0.0 && p.x == p.y && p.x > low && p.x < high;
    let count = |low, high| mesh.points().iter().filter(|p| on_line(p.position, low, high)).count();
    assert_eq!(count(0.29, 0.71), 0);
    assert!(count(0.01, 0.29) > 0 && count(0.71, 0.99) > 0, "elsewhere they are shared");
}

#[test]
fn coarse_meshes_are_the_beginnings_of_fine_ones() {
    let scene = two_rooms();
    let (coarse, fine) = (cut(&scene, 100), cut(&scene, 700));
    assert_eq!(coarse.roots(), fine.roots());
    assert_eq!(coarse.vertices(), &fine.vertices()[..coarse.vertices().len()]);
}

#[test]
fn triangles_that_go_through_each_other_part_each_other() {
    let mut model = Model::new();
    let m = model.sided(0.5, 0.0, Sides::Both);
    model.triangle([[-1., -1., 0.], [2., -1., 0.], [-1., 2., 0.]], m);
    model.triangle([[0.1, -0.5, -1.], [0.1, 0.5, -1.], [0.1, 0.1, 1.]], m);
    let scene = model.scene();
    let mesh = cut(&scene, 40);
    assert_areas_are_kept(&mesh, &scene);
    for e in mesh.elements() {
        let second = mesh.root_of(e).triangle.0 == 1;
        if second {
            assert!(straddle(&mesh, e, |p| p.z) < 1e-15);
        } else if corners(&mesh, e).iter().all(|p| (-0.2..=0.3).contains(&p.y)) {
            assert!(straddle(&mesh, e, |p| p.x - 0.1) < 1e-15);
        }
    }
    // Front and back are the same pieces, and those of the first triangle come first.
    let order: Vec<_> =
        mesh.roots().iter().map(|r| (r.triangle.0, r.face == scene::Face::Back)).collect();
    assert!(order.is_sorted() && order.len() > 8, "{order:?}");
    assert_eq!(order.iter().filter(|o| o.1).count() * 2, order.len());
}

#[test]
fn what_touches_by_rounding_cuts_and_what_is_apart_does_not() {
    let pieces = |height: f64| {
        let mut model = Model::new();
        let m = model.surface(0.5, 0.0);
        floor(&mut model, 1.0, m);
        let (a, b) = ([0.2, 0.4], [0.8, 0.4]);
        let at = |p: [f64; 2], z: f64| [p[0], p[1], z];
        model.quad([at(a, height), at(b, height), at(b, 1.0), at(a, 1.0)], m);
        cut(&model.scene(), 1).roots().len()
    };
    assert_eq!(pieces(1e-3), 4);
    assert!(pieces(1e-7) > 4 && pieces(-1e-7) > 4);
}

#[test]
fn a_foot_off_the_floor_by_rounding_leaves_the_floor_flat() {
    // A floor whose pieces bend towards the foot would lie before itself: it would be too light
    // by 2 % where the foot is above it, and by 7 % where it is below.
    let light = |foot: f64| {
        let mut model = Model::new();
        let wall = model.surface(0.5, 0.0);
        let lamp = model.surface(0.5, 1.0);
        let screen = model.sided(0.5, 0.0, Sides::Both);
        model.cube([wall, lamp, wall, wall, wall, wall]);
        let (a, b) = ([0.3, 0.4], [0.7, 0.6]);
        let at = |p: [f64; 2], z: f64| [p[0], p[1], z];
        model.quad([at(a, foot), at(b, foot), at(b, 0.3), at(a, 0.3)], screen);
        let scene = model.scene();
        let mesh = cut(&scene, 800);
        let floor = mesh.elements().iter().filter(|e| mesh.root_of(e).triangle.0 < 2);
        for place in floor.flat_map(|e| corners(&mesh, e)) {
            assert!(place.z.abs() < 1e-8, "{place}");
        }
        let solved = solve_mesh(&scene, &mesh, until(1e-4));
        let of_triangles = solved.solution.triangle_exitance(&scene);
        f64::midpoint(of_triangles[0][0], of_triangles[1][0])
    };
    let exact = light(0.0);
    for foot in [1e-8, 1e-6, -1e-6] {
        let off = light(foot) / exact - 1.0;
        println!("foot at {foot:e}: off by {off:.1e}");
        assert!(off.abs() < 3e-3, "{off}");
    }
}

#[test]
fn contacts_that_all_but_meet_leave_no_slivers() {
    // Ends within 1e-8 of a corner, of the diagonal, of each other and of another wall.
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    floor(&mut model, 1.0, m);
    wall(&mut model, [[1e-8, 0.0], [0.6, 0.3]], m);
    wall(&mut model, [[0.6, 0.3 + 1e-8], [0.5, 0.5 - 1e-8]], m);
    wall(&mut model, [[0.3, 0.15 + 1e-8], [0.2, 0.9]], m);
    wall(&mut model, [[0.7, 0.1], [0.7, 1e-8]], m);
    let scene = model.scene();
    let mesh = cut(&scene, 1);
    let shortest = mesh
        .elements()
        .iter()
        .map(|e| corners(&mesh, e))
        .flat_map(|p| [0, 1, 2].map(|k| p[k].distance(p[(k + 1) % 3])))
        .fold(1.0, f64::min);
    assert!(shortest > 0.05, "{shortest}");
    assert_eq!(open_edges(&mesh, 1.0), 0);
}

/// A thousand walls on a floor, by multiples of irrational numbers.
fn thicket(length: f64) -> Scene {
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    floor(&mut model, 1.0, m);
    for i in 0..1000 {
        let part = |k: f64| (f64::from(i) * k).fract();
        let (x, y) = (0.9 * part(2f64.sqrt()) + 0.05, 0.9 * part(3f64.sqrt()) + 0.05);
        let turn = std::f64::consts::TAU * part(5f64.sqrt());
        wall(&mut model, [[x, y], [x + length * turn.cos(), y + length * turn.sin()]], m);
    }
    model.scene()
}

#[test]
fn a_thousand_walls_keep_the_floor_whole() {
    let scene = thicket(0.04);
    let mesh = cut(&scene, 20_000);
    assert_areas_are_kept(&mesh, &scene);
    assert_eq!(open_edges(&mesh, 1.0), 0);
    // No piece of the floor lies on both sides of a wall. The middle of a wall is a place
    // where a crossing element would show.
    let walls: Vec<[DVec3; 2]> = (0..1000)
        .map(|i| scene.corners(scene::TriangleId(2 + 2 * i)))
        .map(|[a, b, _]| [a, b])
        .collect();
    let mut found = 0;
    for e in mesh.elements().iter().filter(|e| mesh.root_of(e).triangle.0 < 2) {
        let [a, b, c] = corners(&mesh, e);
        for &[p, q] in &walls {
            let middle = p.midpoint(q);
            let inside = |u: DVec3, v: DVec3| (v - u).cross(middle - u).z >= -1e-12;
            if inside(a, b) && inside(b, c) && inside(c, a) {
                found += 1;
                let normal = DVec3::Z.cross(q - p).normalize();
                assert!(straddle(&mesh, e, |x| (x - p).dot(normal)) < 1e-9);
            }
        }
    }
    assert!(found >= 1000, "{found}");
    // Longer walls cross each other a hundred thousand times: then there is an end of cuts.
    let scene = thicket(0.5);
    let mesh = cut(&scene, 4000);
    assert_areas_are_kept(&mesh, &scene);
    assert!((4000..=5 * 2002).contains(&mesh.roots().len()));
}

#[test]
fn odd_scenes_are_cut_or_left_alone_without_a_panic() {
    for scale in [1e-300, 1e-120, 1e-30, 1e30, 1e70] {
        let mut model = Model::new();
        let m = model.surface(0.5, 0.0);
        let at = |p: [f64; 3]| p.map(|x| x * scale);
        model.quad([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]].map(at), m);
        model.quad([[0.2, 0.3, 0.], [0.8, 0.4, 0.], [0.8, 0.4, 1.], [0.2, 0.3, 1.]].map(at), m);
        let scene = model.scene();
        let roots = cut(&scene, 1).roots().len();
        if (1e-70..1e71).contains(&scale) {
            assert!(roots > 4, "{scale}");
        }
    }
    // Needles, copies, and triangles around a common edge.
    let mut model = Model::new();
    let m = model.sided(0.5, 0.0, Sides::Both);
    for i in 0..40 {
        let (y, z) = (0.3 * f64::from(i)).sin_cos();
        model.triangle([[0., 0., 0.], [1., 0., 0.], [0.5, y, z]], m);
        model.triangle([[0., 1e-7 * y, 0.], [1., 0., 1e-9 * z], [0.5 + 0.1 * y, 1e-5 * z, y]], m);
        model.triangle([[-1., y, z], [-1., y, z + 1e-9], [2., -z, -y]], m);
    }
    let scene = model.scene();
    let mesh = cut(&scene, 5000);
    let mut less = 0;
    for (a, b) in areas(&mesh, &scene).into_iter().zip(areas(&uncut(&scene, 5000), &scene)) {
        assert!(a - b < 1e-5, "{a} {b}");
        less += usize::from(b - a > 1e-5);
    }
    // Some of the second kind are within what is near of one plane, and cover each other.
    assert!((1..=mesh.covered()).contains(&less) && less < 40, "{less} {}", mesh.covered());
}

#[test]
fn a_church_is_cut_in_the_time_of_its_bisection() {
    let here = std::path::PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let file = here.ancestors().map(|up| up.join("shared/scenes/church.tri")).find(|f| f.is_file());
    let Some(file) = file else {
        println!("skipped: no shared/scenes/church.tri beside the checkout");
        return;
    };
    let scene = triangles(&std::fs::read_to_string(file).unwrap());
    let start = std::time::Instant::now();
    let plain = uncut(&scene, 60_000);
    let middle = std::time::Instant::now();
    let mesh = cut(&scene, 60_000);
    println!("uncut {:?}, cut {:?}", middle - start, middle.elapsed());
    println!("{} roots, cut {}", plain.roots().len(), mesh.roots().len());
    let kept = areas(&plain, &scene).into_iter().zip(areas(&mesh, &scene));
    let whole: f64 = scene.ids().map(|id| scene.area(id)).sum();
    // Its coordinates have six decimals, so that what touches is apart by 1e-6 and the rims of
    // pieces bend by that.
    assert!(kept.map(|(a, b)| (a - b).abs()).sum::<f64>() < 1e-6 * whole);
    assert!(mesh.roots().len() > plain.roots().len());
}

/// The triangles of a .tri file, all of one surface.
fn triangles(text: &str) -> Scene {
    let mut model = Model::new();
    let m = model.surface(0.5, 0.0);
    for record in text.split("Triangle").skip(1) {
        let rows: Vec<Vec<f64>> = record
            .lines()
            .map(|l| l.split_whitespace().map(|w| w.parse().unwrap()).collect::<Vec<f64>>())
            .filter(|row| !row.is_empty())
            .collect();
        model.triangle([1, 2, 3].map(|k| [rows[k][0], rows[k][1], rows[k][2]]), m);
    }
    model.scene()
}
