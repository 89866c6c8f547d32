//! Rows that should sum to 1 and do not.

use form_factor::{Occluders, Polygon};
use glam::DVec3;
use radiosity_core::StopReason;
use radiosity_core::matrix::{
    ComputeConfig, Entry, Error, Matrix, MatrixConfig, MatrixShooting, Method, Surfaces, compute,
};
use radiosity_core::{Executor, Sequential};

use super::rooms::{cube_384, dense, furthest, grey, lit, rectangles, reference, solve, triangles};

/// The crudest estimator: the kernel between centroids. Its errors are stated as a half of
/// each value.
fn centroid_to_centroid(polygons: &[Polygon]) -> Matrix {
    let centre = |p: &Polygon| p.corners().iter().sum::<DVec3>() / p.corners().len() as f64;
    let value = |a: &Polygon, b: &Polygon| {
        let between = centre(b) - centre(a);
        let cosines = a.normal().dot(between).max(0.0) * b.normal().dot(-between).max(0.0);
        let square = between.length_squared();
        if cosines > 0.0 {
            cosines / (std::f64::consts::PI * square * square) * b.area()
        } else {
            0.0
        }
    };
    let row = |a: &Polygon| {
        let entry = |(column, b): (usize, &Polygon)| {
            let value = value(a, b);
            Entry { column: column as u32, value, error: 0.5 * value }
        };
        polygons.iter().enumerate().map(entry).collect()
    };
    let names = (0..polygons.len()).map(|i| i.to_string()).collect();
    let areas = polygons.iter().map(Polygon::area).collect();
    Matrix::from_rows(names, areas, polygons.iter().map(row).collect()).unwrap()
}

/// A reflectance of .99 makes an error of 1 % in the row sums one of 100 % in the light; rows
/// of 1.1 make light grow for ever. Closed, the same form factors give the light to 1 %.
#[test]
fn row_sum_amplification() {
    let polygons = triangles(DVec3::ONE, 4);
    assert_eq!(polygons.len(), 192);
    let exact = reference(polygons.clone());
    let rho = grey(vec![0.99; 192]);
    let shining = lit(192, |i| i < 32);
    let truth: Vec<f64> = solve(&exact, &rho, &shining, 1e-10, Method::Auto)
        .exitance()
        .iter()
        .map(|b| b[0])
        .collect();

    let mut crude = centroid_to_centroid(&polygons);
    let raw = crude.defects().unwrap();
    println!("raw rows sum to {:.3} to {:.3}", raw.lowest.sum, raw.highest.sum);
    assert!(raw.closure() > 0.1, "{raw:?}");
    let config = MatrixConfig { method: Method::Plain, ..MatrixConfig::until(1e-6) };
    let mut unrepaired = MatrixShooting::new(&crude, &rho, &shining, config).unwrap();
    assert_eq!(unrepaired.run(), StopReason::Diverged);

    let closed = crude.close().unwrap();
    println!("{closed:?}");
    assert_eq!(closed.before, raw.closure());
    assert!(closed.after <= 4e-15, "{closed:?}");
    assert!(crude.asymmetry() <= 1e-15, "reciprocity is kept");
    let repaired = solve(&crude, &rho, &shining, 1e-10, Method::Auto).exitance();
    let power = |light: &mut dyn Iterator<Item = f64>| -> f64 {
        light.zip(crude.areas()).map(|(b, a)| b * a).sum()
    };
    let wrong = power(&mut repaired.iter().zip(&truth).map(|(b, t)| (b[0] - t).abs()));
    let error = wrong / power(&mut truth.iter().copied());
    println!("E1 {error:.1e}, Einf {:.1e}", furthest(&repaired, &truth));
    assert!(error <= 1e-2, "{error}");
}

/// Good form factors are hardly touched.
#[test]
fn closing_changes_no_more_than_the_rows_were_wrong() {
    let mut cube = reference(rectangles(DVec3::ONE, 4));
    let closed = cube.close().unwrap();
    println!("{closed:?}");
    assert!(closed.relative_change <= 4.0 * closed.before + 1e-15, "{closed:?}");
    assert!(cube.close().unwrap().change <= 1e-15, "closed once is closed");
}

#[test]
fn an_open_scene_is_not_closed() {
    let mut polygons = rectangles(DVec3::ONE, 2);
    // Without the lid.
    polygons.truncate(20);
    let mut bin = reference(polygons);
    let before = bin.clone();
    let Err(Error::Open { sum, error, .. }) = bin.close() else { panic!("the lid is off") };
    assert!(sum < 0.9 && error < 1e-6);
    assert_eq!(bin, before, "and nothing was changed");
}

/// Two plates that see only each other cannot both give all they have, if one is larger; a
/// surface that sees nothing cannot be brought to 1.
#[test]
fn what_no_factors_can_close_is_refused() {
    let mut unequal = dense(vec![1.0, 2.0], &[vec![0.0, 1.0], vec![0.5, 0.0]], 0.5);
    assert!(matches!(unequal.close(), Err(Error::NotClosable { .. })));
    let rows = [vec![0.0, 1.0, 0.0], vec![1.0, 0.0, 0.0], vec![0.0; 3]];
    let mut blind = dense(vec![1.0; 3], &rows, 0.5);
    assert!(matches!(blind.close(), Err(Error::Open { .. })));
}

/// A group's form factors are the area-weighted sums of its triangles': the six faces of a
/// cube of 192 triangles are those of the cube of six squares.
#[test]
fn groups_are_sums_of_their_polygons() {
    let mut faces = Surfaces::new();
    let polygons = triangles(DVec3::ONE, 4);
    for (face, of_face) in polygons.chunks(32).enumerate() {
        faces.row(format!("face {face}"), of_face.to_vec());
    }
    faces.row("no such face", []);
    let config = ComputeConfig { tolerance: 1e-6, occluders: None };
    let computed = compute(&faces, &config, &Sequential);
    assert_eq!(computed.pairs, 192 * 191 / 2);
    assert_eq!(computed.lit, 15 * 32 * 32, "all but the pairs within a face");
    let squares = reference(rectangles(DVec3::ONE, 1));
    for i in 0..6 {
        for (j, error) in
            (0..6).map(|j| (j, (computed.matrix.value(i, j) - squares.value(i, j)).abs()))
        {
            assert!(error <= 1e-6, "{i} → {j}: off by {error:e}");
        }
    }
    assert_eq!(computed.matrix.names().last().unwrap(), "face 5");
}

/// A room with a box standing free in it, seen from outside: closed, and full of shadows.
/// With E = 1 − ρ everywhere, B is 1 everywhere, whatever the reflectances.
#[test]
fn a_room_with_a_box_in_it_is_closed() {
    let mut polygons = triangles(DVec3::ONE, 1);
    for inner in triangles(DVec3::new(0.25, 0.375, 0.5), 1) {
        let mut corners = [0, 1, 2].map(|k| inner.corners()[k] + DVec3::new(0.3, 0.4, 0.2));
        corners.reverse();
        polygons.push(Polygon::triangle(corners).unwrap());
    }
    let blocking: Vec<[DVec3; 3]> =
        polygons.iter().map(|p| [0, 1, 2].map(|k| p.corners()[k])).collect();
    let occluders = Occluders::build(&blocking);
    let config = ComputeConfig { tolerance: 1e-1, occluders: Some(&occluders) };
    let mut room = compute(&Surfaces::each(polygons), &config, &Sequential).matrix;
    let raw = room.defects().unwrap();
    println!("{raw:?}");
    for row in 0..room.len() {
        let defect = (room.row_sum(row) - 1.0).abs();
        assert!(defect <= room.row_error(row), "row {row}: {defect:e} {:e}", room.row_error(row));
    }
    let closed = room.close().unwrap();
    println!("{closed:?}");
    assert!(closed.change <= raw.row_error);
    let rho: Vec<f64> = (0..room.len()).map(|i| 0.04 * i as f64).collect();
    let emittance = grey(rho.iter().map(|rho| 1.0 - rho));
    let solved = solve(&room, &grey(rho), &emittance, 1e-13, Method::Auto);
    assert!(furthest(&solved.exitance(), &vec![1.0; room.len()]) <= 1e-12);
}

/// Runs the items backwards, two at a time.
struct Backwards;

impl Executor for Backwards {
    fn for_each<T: Send, F: Fn(&mut T) + Sync>(&self, items: &mut [T], f: F) {
        let (first, second) = items.split_at_mut(items.len() / 2);
        std::thread::scope(|scope| {
            scope.spawn(|| first.iter_mut().rev().for_each(&f));
            second.iter_mut().rev().for_each(&f);
        });
    }
}

#[test]
fn every_executor_gives_the_same_bits() {
    let surfaces = Surfaces::each(triangles(DVec3::new(1.0, 2.0, 3.0), 2));
    let config = ComputeConfig { tolerance: 1e-3, occluders: None };
    assert_eq!(compute(&surfaces, &config, &Sequential), compute(&surfaces, &config, &Backwards));
}

/// Rows of the computed cube miss 1 by no more than their errors say.
#[test]
fn stated_errors_cover_the_row_sums() {
    for tolerance in [1e-1, 1e-2, 1e-3, 1e-6] {
        let config = ComputeConfig { tolerance, occluders: None };
        let surfaces = Surfaces::each(triangles(DVec3::ONE, 4));
        let matrix = compute(&surfaces, &config, &Sequential).matrix;
        let defects = matrix.defects().unwrap();
        println!(
            "{tolerance:e}: rows off by {:.1e}, stated {:.1e}",
            defects.closure(),
            defects.row_error
        );
        for row in 0..matrix.len() {
            assert!((matrix.row_sum(row) - 1.0).abs() <= matrix.row_error(row) + 1e-12);
        }
    }
    assert!(cube_384().defects().unwrap().closure() <= 1e-15);
}
