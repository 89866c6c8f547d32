//! What `radiosity verify` checks: every exact case passes, and a wrong number would not.

use conformance::verify::{Outcome, checks};

#[test]
fn every_exact_case_passes() {
    for check in checks() {
        let outcome = check.run();
        assert!(outcome.passed(), "{}: {outcome:?}", check.name);
    }
}

#[test]
fn what_is_no_number_does_not_pass() {
    let outcome = |error| Outcome { exact: 1.0, ours: 1.0, error, bound: 1e-3 };
    assert!(outcome(1e-3).passed());
    assert!(!outcome(f64::NAN).passed() && !outcome(2e-3).passed());
}
