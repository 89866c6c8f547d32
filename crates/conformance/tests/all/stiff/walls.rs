//! Walls that light must not pass: shared edges, T-vertices, thin and half screens, backs.

use accel::{
    BruteForce, BruteForceConfig, Bvh, BvhConfig, Occluder, Octree, OctreeConfig, Segment,
};
use form_factor::lambert;
use glam::DVec3;
use radiosity_core::{Correction, ShootingConfig, StopReason};
use scene::{MaterialId, Rgb, Scene, Sides, TriangleId};
use scene_import::{DiagnosticKind, Options, open_bytes};

use super::model::{Model, light};

/// All occluders over a scene.
fn occluders(scene: &Scene) -> [(&'static str, Box<dyn Occluder>); 3] {
    let triangles: Vec<_> = scene.ids().map(|id| scene.corners(id)).collect();
    [
        ("bvh", Box::new(Bvh::build(&triangles, &BvhConfig::DEFAULT))),
        ("octree", Box::new(Octree::build(&triangles, &OctreeConfig::DEFAULT))),
        ("brute force", Box::new(BruteForce::build(&triangles, &BruteForceConfig::default()))),
    ]
}

/// How many of the segments from each place to twice the distance of each target get through,
/// and how many there are.
fn escapes(scene: &Scene, places: &[DVec3], targets: &[DVec3]) -> usize {
    for (name, occluder) in occluders(scene) {
        let mut escaped = 0;
        for &from in places {
            for &target in targets {
                let to = target + (target - from);
                escaped += usize::from(!occluder.occluded(&Segment::new(from, to)));
            }
        }
        assert_eq!(escaped, 0, "{name}: {escaped} of {}", places.len() * targets.len());
    }
    places.len() * targets.len()
}

fn cube_scene() -> Scene {
    let mut model = Model::new();
    let wall = model.grey(0.5, 0.0);
    model.cube([wall; 6]);
    model.scene()
}

/// `n` points on each edge of each triangle, its ends among them.
fn edge_points(scene: &Scene, n: usize) -> Vec<DVec3> {
    let edges = scene.ids().flat_map(|id| {
        let [a, b, c] = scene.corners(id);
        [(a, b), (b, c), (c, a)]
    });
    edges.flat_map(|(a, b)| (0..n).map(move |i| a.lerp(b, i as f64 / (n - 1) as f64))).collect()
}

#[test]
fn grazing_shared_edges() {
    let scene = cube_scene();
    let targets = edge_points(&scene, 2800);
    let rays = escapes(&scene, &[DVec3::splat(0.5)], &targets);
    println!("{rays} rays from the centre at edges and corners, 0 escape");
    assert!(rays >= 100_000);
    // From faces to the middles of edges and to corners; the faces' own planes hold them in.
    let mut places = Vec::new();
    let spread = |i: usize, k: f64| (0.5 + i as f64 * k).fract();
    for i in 0..300 {
        let (u, v) = (spread(i, 0.754_877_666), spread(i, 0.569_840_291));
        for [p, normal] in [
            [DVec3::new(u, v, 0.0), DVec3::Z],
            [DVec3::new(1.0, u, v), DVec3::NEG_X],
            [DVec3::new(v, 1.0, u), DVec3::NEG_Y],
        ] {
            // As far off the face as the solver's own segments start.
            places.push(p + normal * 8e-6);
            // The face's own triangles are edge-on, and a point on an edge is nowhere.
            let seen = |t: &[DVec3; 3]| t.iter().any(|c| normal.dot(*c - p) > 0.0);
            let others = scene.ids().map(|id| scene.corners(id)).filter(seen);
            let row: f64 = others.map(|t| lambert(p, normal, t).form_factor).sum();
            assert!((row - 1.0).abs() <= 1e-12, "{p}: {row}");
        }
    }
    let rays = escapes(&scene, &places, &edge_points(&scene, 3));
    println!("{rays} rays from faces, 0 escape");
    // And in the solver's own estimate, rays and all: rows are 1.
    for elements in [12, 384, 1500] {
        let mut model = Model::new();
        let lamp = model.grey(0.5, 1.0);
        model.cube([lamp; 6]);
        let solved = light(&model.scene(), elements, ShootingConfig::until(1e-3));
        let worst = solved.rows.iter().map(|row| (row - 1.0).abs()).fold(0.0, f64::max);
        println!("{elements} elements: rows off by {worst:.1e}");
        assert!(worst <= 1e-9, "{worst:e}");
    }
}

/// A cube whose wall at x = 1 is cut at y = ½ while its neighbours are not.
fn cut_cube(model: &mut Model, wall: MaterialId, lamp: MaterialId) {
    let some = Some(wall);
    model.room([0.0; 3], [1.0; 3], [some, Some(lamp), some, some, some, None]);
    for (low, high) in [(0.0, 0.5), (0.5, 1.0)] {
        model.quad([[1., low, 0.], [1., low, 1.], [1., high, 1.], [1., high, 0.]], wall);
    }
}

#[test]
fn t_vertices() {
    let mut model = Model::new();
    let wall = model.grey(0.5, 0.0);
    let lamp = model.grey(0.5, 1.0);
    cut_cube(&mut model, wall, lamp);
    let inside = model.scene();
    let mut model = Model::new();
    let wall = model.grey(0.5, 0.0);
    let lamp = model.grey(0.5, 1.0);
    cut_cube(&mut model, wall, lamp);
    // Outside, a screen a little beyond the cut wall that faces it.
    model.quad([[1.25, -1., -1.], [1.25, -1., 2.], [1.25, 2., 2.], [1.25, 2., -1.]], wall);
    let scene = model.scene();
    for elements in [16, 500, 3000] {
        let solved = light(&scene, elements, ShootingConfig::until(1e-4));
        let outside = solved.solution.elements.iter().filter(|e| e.triangle.0 >= 14);
        assert!(outside.clone().count() >= 2);
        for element in outside {
            let [a, b, c] = element.corner_exitance;
            assert!([element.exitance, a, b, c].iter().all(|b| *b == Rgb::ZERO), "{element:?}");
        }
        // Rows inside: those of the closed cube alone, so that all points count.
        let rows = light(&inside, elements, ShootingConfig::until(1e-3)).rows;
        let worst = rows.iter().map(|row| (row - 1.0).abs()).fold(0.0, f64::max);
        println!("{elements} elements: H outside 0, rows inside off by {worst:.1e}");
        assert!(worst <= ShootingConfig::until(1e-3).tolerance, "{worst}");
    }
    // Segments through the T-vertices themselves, and along the seam.
    let seam: Vec<_> = (0..=1000).map(|i| DVec3::new(1.0, 0.5, f64::from(i) / 1000.0)).collect();
    println!(
        "{} segments at the seam",
        escapes(&scene, &[DVec3::splat(0.5), DVec3::splat(0.3)], &seam)
    );
}

/// Two rooms side by side with a lamp in the left one's ceiling, and between them a wall of
/// this thickness; `parted` says whether floor and ceiling are those of each room or of both.
fn two_rooms(thickness: f64, parted: bool) -> (Scene, f64) {
    let mut model = Model::new();
    let wall = model.grey(0.7, 0.0);
    let both = model.surface(Rgb::splat(0.7), Rgb::ZERO, Sides::Both);
    let lamp = model.grey(0.0, 10.0);
    let (left, right) = (1.0 - thickness / 2.0, 1.0 + thickness / 2.0);
    let some = Some(wall);
    if parted {
        model.room([0.0; 3], [left, 1.0, 1.0], [some, some, some, some, some, None]);
        model.room([right, 0.0, 0.0], [2.0, 1.0, 1.0], [some, some, some, some, None, some]);
    } else {
        model.room([0.0; 3], [2.0, 1.0, 1.0], [some; 6]);
    }
    let upright = |x: f64| [[x, 0., 0.], [x, 0., 1.], [x, 1., 1.], [x, 1., 0.]];
    if thickness == 0.0 {
        model.quad(upright(1.0), both);
    } else {
        model.quad(upright(left), wall);
        let [a, b, c, d] = upright(right);
        model.quad([a, d, c, b], wall);
    }
    model.level([0.2, 0.6], [0.3, 0.7], 0.9, false, lamp);
    (model.scene(), right)
}

/// The most light beyond the wall.
fn beyond(thickness: f64, parted: bool, elements: usize, correction: Correction) -> f64 {
    let (scene, right) = two_rooms(thickness, parted);
    let config = ShootingConfig { correction, ..ShootingConfig::until(1e-4) };
    let solved = light(&scene, elements, config);
    let solution = &solved.solution;
    let (mut most, mut count) = (0.0f64, 0);
    for element in &solution.elements {
        let corners = solution.corners(element);
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        // The sides of the wall lie where they look.
        let is_wall = corners.iter().all(|c| (c.x - 1.0).abs() <= 1e-3);
        let is_beyond = if is_wall { normal.x > 0.0 } else { corners.iter().all(|c| c.x >= right) };
        if is_beyond {
            count += 1;
            let [a, b, c] = element.corner_exitance;
            most = [element.exitance, a, b, c].iter().fold(most, |m, b| m.max(b[0].abs()));
        }
    }
    println!(
        "wall of {thickness:e}, floors parted: {parted}, {correction:?}, {elements} elements: \
         {count} beyond, B at most {most:.1e}"
    );
    assert!(count > 0);
    most
}

const THICKNESSES: [f64; 2] = [0.0, 1e-4];

#[test]
fn thin_wall_light_leak() {
    for thickness in THICKNESSES {
        for (parted, elements) in [(true, 0), (true, 300), (false, 0), (false, 300), (false, 1500)]
        {
            assert_eq!(beyond(thickness, parted, elements, Correction::Auto), 0.0);
        }
    }
}

/// No segment passes a wall, whatever its thickness, and no element lies on both of its sides:
/// the same without corrections.
#[test]
fn thin_walls_stop_every_segment() {
    for thickness in THICKNESSES {
        for (parted, elements) in [(true, 0), (true, 300), (false, 0), (false, 300), (false, 1500)]
        {
            assert_eq!(beyond(thickness, parted, elements, Correction::Never), 0.0);
        }
    }
}

/// Two rooms a metre apart, one of them lit, both of a reflectance that calls for corrections.
#[test]
fn another_room_stays_dark() {
    let mut model = Model::new();
    let wall = model.grey(0.9, 0.0);
    let lamp = model.grey(0.9, 1.0);
    model.room([0.0; 3], [1.0; 3], [wall, lamp, wall, wall, wall, wall].map(Some));
    model.room([2.0, 0.0, 0.0], [3.0, 1.0, 1.0], [Some(wall); 6]);
    let scene = model.scene();
    for elements in [0, 300] {
        let solved = light(&scene, elements, ShootingConfig::until(1e-4));
        let dark = solved.solution.elements.iter().filter(|e| e.triangle.0 >= 12);
        let most = dark.map(|e| e.exitance[0].abs()).fold(0.0, f64::max);
        println!("{elements} elements: B of the dark room up to {most:.1e}");
        assert_eq!(most, 0.0);
    }
}

#[test]
fn winding_mixed() {
    // The tenth triangle of a cube is flipped, in a file of a line per corner.
    let mut text = String::new();
    let scene = cube_scene();
    for id in scene.ids() {
        let mut corners = scene.corners(id);
        if id.0 == 9 {
            corners.swap(1, 2);
        }
        text += if id.0 == 2 {
            "Triangle\n128 128 128 255 255 255\n"
        } else {
            "Triangle\n128 128 128 0 0 0\n"
        };
        for [x, y, z] in corners.map(|p| p.to_array()) {
            text += &format!("{x} {y} {z}\n");
        }
    }
    let open = |sides| {
        open_bytes("cube.tri", text.as_bytes(), &Options { sides, ..Options::default() }).unwrap()
    };
    let imported = open(scene_import::SidesRule::Scene);
    println!("{}", imported.diagnostics[0]);
    assert_eq!(imported.diagnostics.len(), 1);
    let diagnostic = &imported.diagnostics[0];
    assert_eq!(diagnostic.kind, DiagnosticKind::ReversedWinding);
    assert_eq!(
        (diagnostic.triangle, diagnostic.place.as_str()),
        (Some(TriangleId(9)), "cube.tri:46")
    );
    let one_sided = light(&imported.scene, 600, ShootingConfig::until(1e-4));
    // A row lacks the form factor to the triangle that shows its back.
    let [a, b, c] = imported.scene.corners(TriangleId(9));
    let mut worst = 0.0f64;
    for (point, row) in one_sided.points.iter().zip(&one_sided.rows) {
        let (p, normal) = (point.position, point.normal);
        // From its own face it is seen edge-on; from itself, there is nothing but the outside.
        if (p - a).dot((b - a).cross(c - a)) < -1e-9 {
            worst = worst.max((row + lambert(p, normal, [a, c, b]).form_factor - 1.0).abs());
        }
    }
    println!("rows lack the form factor to triangle 9 but for {worst:.1e}");
    assert!(worst <= 1e-9, "{worst:e}");
    let ledger = one_sided.ledger;
    let wrong = ledger.share(ledger.wrong_side);
    // A twelfth of the walls, of what the lamp gives and of what goes round.
    println!(
        "one-sided: {wrong:.4} of the light meets a back, absorbed {:.4}",
        ledger.share(ledger.absorbed)
    );
    assert!(wrong > 0.05, "{wrong}");
    let two_sided =
        light(&open(scene_import::SidesRule::Both).scene, 600, ShootingConfig::until(1e-4));
    let ledger = two_sided.ledger;
    println!("two-sided: {:.4} of the light meets a back", ledger.share(ledger.wrong_side));
    assert_eq!(ledger.wrong_side, Rgb::ZERO);
    assert!(open(scene_import::SidesRule::Both).diagnostics.is_empty());
    assert_eq!(one_sided.reason, StopReason::Converged);
}

#[test]
fn exactly_half_blocked() {
    // Floor and ceiling with a black screen halfway, over half of them: by symmetry, half of
    // the light passes. Exact form factors from shared/cases/form_factors_and_solutions.json.
    for (a, gap, half) in [
        (1.0, 0.25, 0.316018215006930),
        (2.0, 3.0, 0.0301656926849768),
        (1.0, 0.01, 0.490208301462987),
    ] {
        for elements in [600, 4000] {
            let mut model = Model::new();
            let lamp = model.grey(0.0, 1.0);
            let screen = model.grey(0.0, 0.0);
            // What it shows is a thousandth of what it receives.
            let floor = model.grey(1e-3, 0.0);
            model.level([0.0, a], [0.0, 1.0], 0.0, true, floor);
            model.level([0.0, a], [0.0, 1.0], gap, false, lamp);
            for up in [true, false] {
                model.level([0.0, a / 2.0], [0.0, 1.0], gap / 2.0, up, screen);
            }
            let solved = light(&model.scene(), elements, ShootingConfig::until(1e-6));
            let irradiance = (solved.triangles[0][0] + solved.triangles[1][0]) / 2.0 / 1e-3;
            let error = irradiance / half - 1.0;
            println!("{a} x 1, gap {gap}, {elements} elements: {irradiance:.6}, {error:+.1e}");
            assert!(error.abs() <= 1e-2, "{error}");
        }
    }
}
