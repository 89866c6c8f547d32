//! Bytes as places on triangles: what can be read is of finite numbers, what cannot has a message of one line.

#![no_main]

use libfuzzer_sys::fuzz_target;
use radiosity_fuzz::one_line;

fuzz_target!(|bytes: &[u8]| match output::csv::read_places(bytes) {
    Ok(values) => for value in values {
        let [u, v] = value.uv;
        assert!(u >= 0.0 && v >= 0.0 && u + v < 1.001);
        assert!(value.area.iter().all(|area| *area >= 0.0 && area.is_finite()));
    },
    Err(error) => one_line(&error.to_string()),
});
