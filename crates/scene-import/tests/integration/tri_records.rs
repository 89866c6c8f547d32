//! Scenes as .tri records, and back.

use glam::DVec3;
use scene::{Camera, Material, Rgb, Scene, SceneBuilder, Sides, TriangleId};
use scene_import::{DiagnosticKind, Options, SidesRule, open_bytes, tri_records};
use tri_io::{TriRecord, Writer};

fn text(records: &[TriRecord]) -> Vec<u8> {
    let mut writer = Writer::new(Vec::new());
    records.iter().for_each(|record| writer.write(record).expect("finite corners"));
    writer.finish().expect("memory takes every byte")
}

/// One triangle of each material, all over the same corners.
fn scene_of(materials: &[Material]) -> Scene {
    let mut builder = SceneBuilder::new();
    let group = builder.group("room");
    let corners = [[0.1, -1e-300, 2.0], [1e17, 1.0 / 3.0, 0.0], [0.0, 7.0, -5e-324]];
    let corners = corners.map(|p| builder.vertex(DVec3::from(p)));
    for material in materials {
        let id = builder.material(material.clone()).expect("the test's material is sound");
        builder.triangle(corners, id, group).expect("its ids are the builder's");
    }
    builder.finish()
}

fn material(name: &str, reflectance: [f64; 3], emittance: [f64; 3]) -> Material {
    let (reflectance, emittance) = (Rgb(reflectance), Rgb(emittance));
    Material { name: name.into(), reflectance, emittance, sides: Sides::Front }
}

fn bits(corners: [DVec3; 3]) -> [[u64; 3]; 3] {
    corners.map(|p| p.to_array().map(f64::to_bits))
}

#[test]
fn reflectance_comes_back_within_half_a_step_and_geometry_to_the_bit() {
    // Every thousandth up to the most that the file can hold, in different channels.
    for options in [Options::default(), Options { tri_reflect: 0.8, ..Options::default() }] {
        let most = options.tri_reflect;
        let materials: Vec<_> = (0..=1000)
            .map(|i| most * f64::from(i) / 1000.0)
            .map(|rho| material("m", [rho, most - rho, 0.5 * rho], [0.0; 3]))
            .collect();
        let scene = scene_of(&materials);
        let (records, diagnostics) = tri_records(&scene, &options);
        assert_eq!(diagnostics, []);
        let back = open_bytes("room.tri", &text(&records), &options).unwrap().scene;
        assert_eq!(back.triangles().len(), materials.len());
        // Half of a 255th, and the roundings of numbers below 1.
        let half_step = most / 510.0 + 1e-15;
        for id in scene.ids() {
            assert_eq!(bits(back.corners(id)), bits(scene.corners(id)));
            let [was, is] = [&scene, &back].map(|scene| scene.material_of(id));
            let change = (was.reflectance - is.reflectance).map(f64::abs).max_channel();
            assert!(change <= half_step, "{:?} {:?}", was.reflectance, is.reflectance);
            assert_eq!(is.emittance, Rgb::ZERO);
        }
    }
}

#[test]
fn what_came_from_tri_goes_back_unchanged() {
    let file = b"Triangle\n51 102 255 0 0 0\n0 0 0\n1 0 0\n0 1 0\n\
                 Triangle\n0 254 1 255 10 254\n0 0 1.5\n1 0 1\n-0.25 1 1e-7\n\
                 Triangle\n9 9 9 1 255 255\n0 0 1\n0 0 1\n0 0 1\n";
    for light in [1.0, 0.37, 3.0] {
        let options = Options { tri_light: light, ..Options::default() };
        let scene = open_bytes("a.tri", file, &options).unwrap().scene;
        let (records, diagnostics) = tri_records(&scene, &options);
        assert_eq!(diagnostics, []);
        assert_eq!(text(&records), file);
    }
}

#[test]
fn only_emitters_have_a_back_of_255_and_all_are_equally_strong() {
    let scene = scene_of(&[
        material("wall", [0.5; 3], [0.0; 3]),
        material("lamp", [0.0; 3], [25_500.0, 12_720.0, 0.0]),
        material("candle", [0.0; 3], [10.0, 5.0, 1.0]),
        material("sun", [0.0; 3], [5e4, 1e5, 2e4]),
    ]);
    let (records, diagnostics) = tri_records(&scene, &Options::default());
    let backs: Vec<_> = records.iter().map(|record| record.back).collect();
    // 12720 is 127.2 steps; 5/10, 1/10, 1/2 and 1/5 of 255 are 127.5, 25.5, 127.5 and 51.
    assert_eq!(backs, [[0; 3], [255, 127, 0], [255, 128, 26], [128, 255, 51]]);
    let warnings: Vec<_> = diagnostics.iter().map(ToString::to_string).collect();
    assert_eq!(
        warnings,
        [
            "material candle: emittance [10.0, 5.0, 1.0] becomes [25500.0, 12800.0, 2600.0], \
             the one strength of .tri emitters",
            "material sun: emittance [50000.0, 100000.0, 20000.0] becomes \
             [12800.0, 25500.0, 5100.0], the one strength of .tri emitters",
        ]
    );
    // The stated emittance is the one that the import makes of it.
    let back = open_bytes("a.tri", &text(&records), &Options::default()).unwrap().scene;
    for (triangle, diagnostic) in [(2, &diagnostics[0]), (3, &diagnostics[1])] {
        let emittance = back.material_of(TriangleId(triangle)).emittance;
        let DiagnosticKind::EmittanceChanged { to, .. } = diagnostic.kind else { panic!() };
        assert_eq!(to, emittance);
    }
    // A light of 10/25500 is the candle's.
    let options = Options { tri_light: 10.0 / 25_500.0, ..Options::default() };
    let (_, diagnostics) = tri_records(&scene, &options);
    let places: Vec<_> = diagnostics.iter().map(|d| d.place.as_str()).collect();
    assert_eq!(places, ["material lamp", "material sun"]);
}

#[test]
fn reflectance_beyond_the_files_range_is_clamped_and_told_once() {
    let white = material("white", [0.9, 0.5, 0.1], [0.0; 3]);
    let mut builder = SceneBuilder::new();
    let group = builder.group("room");
    let id = builder.material(white).unwrap();
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| builder.vertex(p));
    for _ in 0..3 {
        builder.triangle(corners, id, group).unwrap();
    }
    let (records, diagnostics) = tri_records(&builder.finish(), &Options::default());
    assert!(records.iter().all(|record| record.front == [255, 255, 51]));
    let told: Vec<_> = diagnostics.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        ["material white: reflectance [0.9, 0.5, 0.1] becomes [0.5, 0.5, 0.1], \
          beyond which .tri cannot go"]
    );
}

#[test]
fn sides_names_and_cameras_that_are_lost_are_told() {
    let mut builder = SceneBuilder::new();
    let [_, group] = ["hall", "room"].map(|name| builder.group(name));
    let mut leaf = material("leaf", [0.2; 3], [0.0; 3]);
    leaf.sides = Sides::Both;
    let id = builder.material(leaf).unwrap();
    let corners = [DVec3::ZERO, DVec3::X, DVec3::Y].map(|p| builder.vertex(p));
    builder.triangle(corners, id, group).unwrap();
    builder.camera(Camera {
        name: "eye".into(),
        position: DVec3::Z,
        target: DVec3::ZERO,
        up: DVec3::Y,
        vertical_fov: 1.0,
    });
    let scene = builder.finish();
    let told = |sides| {
        let options = Options { sides, ..Options::default() };
        let (_, diagnostics) = tri_records(&scene, &options);
        diagnostics.iter().map(ToString::to_string).collect::<Vec<_>>()
    };
    let lost = [
        "groups: left out: the names of 2 groups: .tri has no place for them",
        "cameras: left out: 1 cameras: .tri has no place for them",
    ];
    // Whoever reads the file with both sides gets them back.
    assert_eq!(told(SidesRule::Both), lost);
    let side = "material leaf: two-sided becomes one-sided: .tri has no sides";
    assert_eq!(told(SidesRule::Scene), [lost[0], lost[1], side]);
}

#[test]
fn an_empty_scene_has_no_records() {
    assert_eq!(tri_records(&Scene::default(), &Options::default()), (vec![], vec![]));
}
