//! Solutions known to many digits: exact form factors, exact linear algebra.

use form_factor::Polygon;
use glam::DVec3;
use radiosity_core::matrix::Method;
use serde_json::Value;

use super::rooms::{dense, furthest, grey, lit, rectangles, reference, solve};
use super::shared::{number, numbers, solution};

/// The exact form factors of a box with one element a face come from three numbers of the
/// file; the solutions were found in 40 digits.
fn box_faces(id: &str) -> Option<f64> {
    let case = solution(id)?;
    let (rho, emittance) = (grey(numbers(&case["rho"])), grey(numbers(&case["E"])));
    let size = DVec3::from_slice(&numbers(&case["dims"]));
    let mut faces = reference(rectangles(size, 1));
    let first_row = numbers(&case["F_first_row_x0"]);
    for (column, exact) in first_row.iter().enumerate() {
        let error = (faces.value(0, column) - exact).abs();
        assert!(error <= 1e-10 * exact, "{id}: F 0 → {column} is off by {error:e}");
    }
    faces.close().unwrap();
    let expected = numbers(&case["B"]);
    let solved = solve(&faces, &rho, &emittance, 1e-13, Method::Auto);
    let far = furthest(&solved.exitance(), &expected);
    println!("{id}: off by {far:.1e} after {:.1} sweeps", solved.sweeps());
    Some(far)
}

#[test]
fn boxes_with_one_element_a_face() {
    for id in [
        "cube_one_emitter_rho0.5",
        "cube_one_emitter_rho0.9",
        "cube_black_emitter_white_walls",
        "cube_mixed",
        "cube_emission_1e30_and_1e-30",
        "box_10x1x0.1_rho0.9",
    ] {
        let Some(far) = box_faces(id) else { return };
        assert!(far <= 1e-11, "{id}: {far:e}");
    }
}

#[test]
fn deep_box() {
    let Some(case) = solution("box_1x1x1000_rho0.99") else { return };
    assert!(box_faces("box_1x1x1000_rho0.99").unwrap() <= 1e-10);
    let mut faces = reference(rectangles(DVec3::new(1.0, 1.0, 1000.0), 1));
    faces.close().unwrap();
    let emittance = grey(numbers(&case["E"]));
    let solved = solve(&faces, &grey([0.99; 6]), &emittance, 1e-14, Method::Auto);
    // Far down the shaft less than a fortieth of the light is left.
    let opposite = solved.exitance()[5][0];
    assert!((opposite / 0.02449069223396 - 1.0).abs() <= 1e-10, "{opposite}");
}

/// Corners and form factors of a closed mesh, and its solutions, from 36 digits.
fn mesh(id: &str) {
    let Some(case) = solution(id) else { return };
    let corner = |index: &Value| {
        DVec3::from_slice(&numbers(&case["vertices"][index.as_u64().unwrap() as usize]))
    };
    let triangles = case["triangles"].as_array().unwrap().iter();
    // The file's triangles face outwards or inwards, whichever sees the others.
    let polygons = |flip: bool| -> Vec<Polygon> {
        let triangle = |t: &Value| {
            let mut corners = [0, 1, 2].map(|k| corner(&t[k]));
            if flip {
                corners.reverse();
            }
            Polygon::triangle(corners).unwrap()
        };
        triangles.clone().map(triangle).collect()
    };
    let mut ours = reference(polygons(false));
    if ours.values().is_empty() {
        ours = reference(polygons(true));
    }
    let rows: Vec<Vec<f64>> = case["F"].as_array().unwrap().iter().map(numbers).collect();
    for (i, row) in rows.iter().enumerate() {
        for (j, exact) in row.iter().enumerate() {
            let error = (ours.value(i, j) - exact).abs();
            assert!(error <= 1e-9, "{id}: F {i} → {j} is {}, off by {error:e}", ours.value(i, j));
        }
    }
    let exact = dense(ours.areas().to_vec(), &rows, 1e-17);
    for run in case["solutions"].as_array().unwrap() {
        let (rho, emittance) = (grey(numbers(&run["rho"])), grey(numbers(&run["E"])));
        let expected = numbers(&run["B"]);
        let far = |matrix| {
            furthest(&solve(matrix, &rho, &emittance, 1e-13, Method::Auto).exitance(), &expected)
        };
        let (theirs, own) = (far(&exact), far(&ours));
        println!("{id}: off by {theirs:.1e} with exact form factors, {own:.1e} with ours");
        assert!(theirs <= 1e-12 && own <= 1e-8, "{id}: {theirs:e} {own:e}");
    }
}

#[test]
fn tetrahedron() {
    mesh("tri_tetra_irregular");
}

#[test]
fn cube_of_twelve_triangles() {
    mesh("tri_cube_12_triangles");
}

/// Two plates, in front of each other and in an open scene but for F = 1: what one does not
/// send to the other leaves.
#[test]
fn two_plates() {
    for id in [
        "plates_rho0.5_0.5_F1.0",
        "plates_rho0.9_0.8_F1.0",
        "plates_rho0.999_0.999_F1.0",
        "plates_rho0.9_0.9_F0.199825",
        "plates_rho0.9_0.5_F0.998006",
    ] {
        let Some(case) = solution(id) else { return };
        let f = number(&case["F12"]);
        let plates = dense(vec![3.0, 3.0], &[vec![0.0, f], vec![f, 0.0]], 0.0);
        let (rho, emittance) = (grey(numbers(&case["rho"])), grey(numbers(&case["E"])));
        for method in [Method::Plain, Method::Deflated] {
            let solved = solve(&plates, &rho, &emittance, 1e-14, method);
            let far = furthest(&solved.exitance(), &numbers(&case["B"]));
            assert!(far <= 1e-12, "{id}: {far:e}");
            let leaving: f64 = solved.exitance().iter().map(|b| b[0] * 3.0 * (1.0 - f)).sum();
            let ledger = solved.ledger();
            assert!((ledger.escaped[0] - leaving).abs() <= 1e-12 * ledger.emitted[0], "{id}");
        }
    }
}

/// The mean exitance over the faces z0 (which shines), x0 and z1 of a cube of n × n squares
/// a face, to the 13 digits of the file.
#[test]
fn cube_galerkin_nxn() {
    let Some(case) = solution("cube_galerkin_nxn") else { return };
    for n in [1, 2, 4, 8] {
        let cube = reference(rectangles(DVec3::ONE, n));
        let face = |i: usize| i / (n * n);
        let of_n = case["face_averages"].as_array().unwrap().iter().filter(|a| a["n"] == n);
        for averages in of_n {
            let rho = number(&averages["rho"]);
            let shining = lit(cube.len(), |i| face(i) == 4);
            let solved = solve(&cube, &grey(vec![rho; cube.len()]), &shining, 1e-12, Method::Auto);
            for (wanted, at) in [("emitter", 4), ("side", 0), ("opposite", 5)] {
                let exitance = solved.exitance();
                let of_face = exitance.iter().enumerate().filter(|(i, _)| face(*i) == at);
                let mean = of_face.map(|(_, b)| b[0]).sum::<f64>() / (n * n) as f64;
                let far = mean / number(&averages[wanted]) - 1.0;
                println!("n {n}, ρ {rho}, {wanted}: off by {far:.1e}");
                assert!(far.abs() <= 1e-8, "n {n}, ρ {rho}, {wanted}: {mean}, off by {far:e}");
            }
        }
    }
}
