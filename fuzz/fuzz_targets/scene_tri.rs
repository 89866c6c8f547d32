//! Bytes as a .tri scene.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| radiosity_fuzz::scene("a.tri", bytes));
