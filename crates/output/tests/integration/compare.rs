//! Error measures against sums done by hand.

use output::csv::{Row, read};
use output::{Comparison, ErrorKind, compare};

fn rows(text: &str) -> Vec<Row> {
    let header = "triangle,area,B_r,B_g,B_b,se_r,se_g,se_b,emits,ambiguous";
    read(format!("{header}\n{text}").as_bytes()).unwrap()
}

/// Three rows that count, and two that must not.
fn pair() -> (Vec<Row>, Vec<Row>) {
    let ours = "0,2,3,1,0,0,0,0,0,0\n1,1,6,2,0,0,0,0,0,0\n2,4,1,3,0,0,0,0,0,0\n\
                3,9,900,0,0,0,0,0,0,0\n4,9,800,0,0,0,0,0,0,1";
    let reference = "0,2,4,1,0,.1,.2,0,0,0\n1,1,8,1,0,.4,.2,0,0,0\n2,4,1,1,0,.1,.1,0,0,0\n\
                     3,9,100,0,0,0,0,0,1,0\n4,9,100,0,0,0,0,0,0,0";
    (rows(ours), rows(reference))
}

#[test]
fn measures_match_sums_by_hand() {
    let (ours, reference) = pair();
    let error = compare(&ours, &reference).unwrap();
    // Red: |ΔB| = 1, 2, 0 on areas 2, 1, 4; ΣAB* = 8 + 8 + 4 = 20, ΣAB*² = 32 + 64 + 4 = 100.
    // Green: |ΔB| = 0, 1, 2; ΣAB* = ΣAB*² = 7. Blue: no light on either side.
    let expected = Comparison {
        e1: [4.0 / 20.0, 9.0 / 7.0, 0.0],
        e2: [(6.0 / 100.0_f64).sqrt(), (17.0 / 7.0_f64).sqrt(), 0.0],
        einf: [2.0 / (20.0 / 7.0), 2.0, 0.0],
        rows_used: 3,
        // Red: 0.2 + 0.4 + 0.4 = 1 of 20; green: 0.4 + 0.2 + 0.4 = 1 of 7.
        reference_se: Some([1.0 / 20.0, 1.0 / 7.0, 0.0]),
    };
    let close = |a: [f64; 3], b: [f64; 3]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-15);
    assert!(close(error.e1, expected.e1) && close(error.e2, expected.e2), "{error:?}");
    assert!(close(error.einf, expected.einf), "{error:?}");
    assert!(close(error.reference_se.unwrap(), expected.reference_se.unwrap()), "{error:?}");
    assert_eq!(error.rows_used, 3);
    assert_eq!(error.worst_e1(), error.e1[1]);
    assert_eq!(error.worst_e2(), error.e2[1]);
    assert_eq!(error.worst_einf(), 2.0);
}

#[test]
fn the_reference_is_the_second_side() {
    let (ours, reference) = pair();
    let error = compare(&reference, &ours).unwrap();
    // ΣA·B of what was ours: 6 + 6 + 4.
    assert_eq!(error.e1[0], 4.0 / 16.0);
}

#[test]
fn light_in_a_channel_the_reference_leaves_dark_is_infinitely_wrong() {
    let (mut ours, reference) = pair();
    ours[0].exitance.0[2] = 1e-9;
    let error = compare(&ours, &reference).unwrap();
    assert_eq!(
        (error.e1[2], error.e2[2], error.einf[2]),
        (f64::INFINITY, f64::INFINITY, f64::INFINITY)
    );
    assert_eq!(error.worst_e1(), f64::INFINITY);
}

#[test]
fn what_cannot_be_compared_is_refused_by_row() {
    let (ours, reference) = pair();
    let message =
        |ours: &[Row], reference: &[Row]| compare(ours, reference).unwrap_err().to_string();
    assert_eq!(message(&ours[..4], &reference), "4 rows against 5 in the reference");
    let mut other = ours.clone();
    other[1].area = 1.0 + 1.2e-4;
    assert_eq!(message(&other, &reference), "row 1: area 1.00012 against 1 in the reference");
    other[1].area = 1.0 + 0.9e-4;
    assert!(compare(&other, &reference).is_ok());
    other[2].triangle = 9;
    assert_eq!(message(&other, &reference), "row 2: triangle 9 against 2 in the reference");
    let mut other = ours.clone();
    other[4].exitance.0[0] = f64::NAN;
    assert_eq!(*compare(&other, &reference).unwrap_err().kind(), ErrorKind::RowValue { row: 4 });
    assert_eq!(*compare(&ours[3..], &reference[3..]).unwrap_err().kind(), ErrorKind::NoRows);
    assert_eq!(*compare(&[], &[]).unwrap_err().kind(), ErrorKind::NoRows);
}

#[test]
fn a_standard_error_must_cover_every_row() {
    let (ours, mut reference) = pair();
    reference[2].se = None;
    assert_eq!(compare(&ours, &reference).unwrap().reference_se, None);
}
