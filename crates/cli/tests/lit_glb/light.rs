//! The light in the vertices is the light of the solution.

use std::path::Path;

use crate::file::Glb;
use crate::model;

/// Area-weighted mean of `_RADIOSITY` over the front faces of a node's mesh, and their area, both in
/// the mesh's own coordinates.
fn mean(lit: &Glb, node: &str) -> [f64; 3] {
    let primitive = &lit.primitives(node)[0];
    let (places, light) =
        (lit.attribute(primitive, "POSITION"), lit.attribute(primitive, "_RADIOSITY"));
    let (mut sum, mut total) = ([0.0; 3], 0.0);
    for face in lit.faces(primitive) {
        let [a, b, c] = face.map(|i| glam::DVec3::from_slice(&places[i]));
        let area = 0.5 * (b - a).cross(c - a).length();
        total += area;
        for channel in 0..3 {
            sum[channel] += area * face.iter().map(|&i| light[i][channel]).sum::<f64>() / 3.0;
        }
    }
    sum.map(|channel| channel / total)
}

/// The rows of a CSV of exitance: triangle, area, r, g, b.
fn rows(path: &Path) -> Vec<[f64; 5]> {
    let text = std::fs::read_to_string(path).unwrap();
    let row = |line: &str| -> [f64; 5] {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        cells.try_into().unwrap()
    };
    text.lines().skip(1).map(row).collect()
}

#[test]
fn exitance_and_colours_are_those_of_the_solution() {
    let folder = tempfile::tempdir().unwrap();
    let scene = model::write(folder.path());
    let [glb, csv] = model::solve(&scene, folder.path(), &["--elements", "2000"]);
    let (lit, rows) = (Glb::read(&glb), rows(&csv));
    // Two triangles each, in the order of the nodes.
    for (number, node) in ["floor", "lamp", "near", "mirror"].into_iter().enumerate() {
        let [a, b] = [&rows[2 * number], &rows[2 * number + 1]];
        let found = mean(&lit, node);
        for channel in 0..3 {
            let expected = (a[1] * a[2 + channel] + b[1] * b[2 + channel]) / (a[1] + b[1]);
            // Corners are interpolated and means are not: they meet as elements get small.
            let off = (found[channel] - expected).abs();
            assert!(off < 0.03 * expected, "{node}: {} {expected}", found[channel]);
        }
    }
    let scale = lit.json["asset"]["extras"]["radiosity"]["exposureScale"].as_f64().unwrap();
    let shown = |exitance: f64| {
        // The curve of output::tone, written again.
        let light = exitance * scale;
        if light <= 0.8 { light } else { 1.0 - 0.2 / (1.0 + (light - 0.8) / 0.2) }
    };
    for node in ["near", "lamp", "sheet"] {
        let primitive = &lit.primitives(node)[0];
        let light = lit.attribute(primitive, "_RADIOSITY");
        for (colour, light) in lit.attribute(primitive, "COLOR_0").iter().zip(light) {
            for channel in 0..3 {
                assert!((colour[channel] - shown(light[channel])).abs() < 1.0 / 65535.0);
            }
        }
    }
    // The texture multiplies what stands in the vertices: half of its texels are 120, half 230.
    let linear = |byte: f64| ((byte / 255.0 + 0.055) / 1.055_f64).powf(2.4);
    let texture = 0.5 * (linear(120.0) + linear(230.0));
    let floor = &lit.primitives("floor")[0];
    let light = lit.attribute(floor, "_RADIOSITY");
    for (colour, light) in lit.attribute(floor, "COLOR_0").iter().zip(light) {
        let expected = shown(light[0]) / texture;
        assert!(
            expected > 1.0 || (colour[0] - expected).abs() <= 2e-3 * expected + 1.0 / 65535.0,
            "{colour:?} {expected}"
        );
    }
}

#[test]
fn the_back_of_a_sheet_has_light_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    let scene = model::write(folder.path());
    let [glb, _] = model::solve(&scene, folder.path(), &["--elements", "2000"]);
    let lit = Glb::read(&glb);
    let [front, back] = lit.primitives("sheet") else { panic!("expected two sides") };
    assert_eq!(back["extras"]["radiosity"]["face"], "back");
    let normal = |side| {
        let places = lit.attribute(side, "POSITION");
        let [a, b, c] = lit.faces(side)[0].map(|i| glam::DVec3::from_slice(&places[i]));
        (b - a).cross(c - a).normalize()
    };
    assert!(normal(front).dot(normal(back)) < -0.999);
    let most = |side| {
        let light = lit.attribute(side, "_RADIOSITY");
        light.iter().map(|light| light[0]).fold(0.0, f64::max)
    };
    // The front was turned to -x, away from the lamp.
    assert!(most(front) < 0.5 * most(back), "{} {}", most(front), most(back));
}

#[test]
fn the_lit_file_is_read_as_the_scene_that_it_was() {
    let folder = tempfile::tempdir().unwrap();
    let scene = model::write(folder.path());
    let [first, csv] = model::solve(&scene, folder.path(), &["--elements", "2000"]);
    let power = |rows: Vec<[f64; 5]>| rows.iter().map(|row| row[1] * row[3]).sum::<f64>();
    let before = power(rows(&csv));
    let again = folder.path().join("again");
    std::fs::create_dir(&again).unwrap();
    let [second, csv] = model::solve(&first, &again, &["--elements", "2000"]);
    // Another mesh of the same surfaces.
    let after = power(rows(&csv));
    assert!((before - after).abs() < 0.01 * before, "{before} {after}");
    let [first, second] = [first, second].map(|path| Glb::read(&path));
    for list in ["materials", "textures", "cameras", "animations", "skins", "extensionsUsed"] {
        assert_eq!(first.json[list], second.json[list], "{list}");
    }
    assert_eq!(first.primitives("sheet").len(), second.primitives("sheet").len());
}

#[test]
fn a_file_of_our_own_making_is_lit_again() {
    let folder = tempfile::tempdir().unwrap();
    let triangle = "Triangle\n200 100 50 255 255 255\n0 0 0\n1 0 0\n0 1 0\n";
    let scene = folder.path().join("lamp.tri");
    std::fs::write(&scene, triangle).unwrap();
    let [plain, _] = model::solve(&scene, folder.path(), &["--elements", "20", "--sides", "both"]);
    let again = folder.path().join("again");
    std::fs::create_dir(&again).unwrap();
    let [lit, csv] = model::solve(&plain, &again, &["--elements", "20"]);
    let lit = Glb::read(&lit);
    let primitives = lit.json["meshes"][0]["primitives"].as_array().unwrap();
    let faces: Vec<_> = primitives.iter().map(|p| &p["extras"]["radiosity"]["face"]).collect();
    assert_eq!(faces, [&serde_json::Value::Null, &serde_json::json!("back")]);
    assert!(primitives.iter().all(|p| p["extras"]["radiosity"]["lit"] == true));
    // Emittance of a .tri lamp: 100 times the back, 25,500.
    assert!(rows(&csv).iter().all(|row| (row[2] / 25_500.0 - 1.0).abs() < 1e-6));
}
