//! Laws that hold for any scene, on scenes that no one thought of.
