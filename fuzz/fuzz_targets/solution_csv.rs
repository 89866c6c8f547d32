//! Bytes as rows of a solution: what can be read is of finite numbers, what cannot has a message of one line.

#![no_main]

use libfuzzer_sys::fuzz_target;
use radiosity_fuzz::one_line;

fuzz_target!(|bytes: &[u8]| match output::csv::read(bytes) {
    Ok(values) => for value in values {
        assert!(value.area >= 0.0 && value.area.is_finite());
        assert!(value.exitance.0.iter().all(|c| c.is_finite()));
        assert!(value.se.iter().flat_map(|se| se.0).all(|c| c >= 0.0 && c.is_finite()));
    },
    Err(error) => one_line(&error.to_string()),
});
