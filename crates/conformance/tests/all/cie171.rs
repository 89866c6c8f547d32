//! Rooms whose light has a published formula, each place within its own tolerance.

use conformance::cie171::comparisons;

#[test]
fn every_place_is_lit_as_its_formula_says() {
    let rows = comparisons().unwrap();
    for row in &rows {
        let error = row.error();
        println!(
            "{}, {}: expected {:.5}, got {:.5}, off by {error:.1e} of {:.1e}",
            row.case, row.place, row.expected, row.got, row.tolerance
        );
    }
    for row in &rows {
        assert!(row.expected > 0.0 && row.error() <= row.tolerance, "{row:?}");
        assert!(row.tolerance < 0.25, "a tolerance that says nothing: {row:?}");
    }
    let cases: std::collections::BTreeSet<_> = rows.iter().map(|row| row.case).collect();
    assert_eq!(cases.len(), 6);
}
