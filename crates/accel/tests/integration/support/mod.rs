//! What the tests share.

pub(crate) mod all;
pub(crate) mod reference;
pub(crate) mod rng;
pub(crate) mod scenes;
pub(crate) mod segments;
pub(crate) mod shared;

/// Three corners in scene units.
pub(crate) type Triangle = [glam::DVec3; 3];
