//! Bytes as glTF as JSON: buffers and images in data URIs.

#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| radiosity_fuzz::scene("a.gltf", bytes));
