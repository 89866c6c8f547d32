#![doc = include_str!("../README.md")]

mod contender;
mod embree;
mod measure;
mod obvhs;
mod refine;
mod rng;
mod scenes;
mod synthetic;
mod table;
pub mod techniques;
mod workload;

pub use contender::{Asking, CONTENDERS, Contender, Structure, Structures};
pub use embree::{
    Embree, EmbreeConfig, EmbreeError, EmbreeLibrary, EmbreeScene, EmbreeWidth, LIBRARY_NAMES,
    LIBRARY_VARIABLE,
};
pub use measure::{Kind, Limits, Row, measure};
pub use obvhs::{Obvhs, ObvhsPreset, ObvhsShape};
pub use refine::refine;
pub use scenes::{SCENES, SceneError, workload};
pub use synthetic::{soup, terrain};
pub use table::{csv, markdown};
pub use workload::{Batch, LIFT, Workload};

/// Three corners; the front is the side from which they run anticlockwise.
pub type Triangle = [glam::DVec3; 3];

/// The part of a segment on which something blocks, by the parameter that is 1 at its far end:
/// all but the two ends themselves, as accel has it. Embree and obvhs count theirs as inside.
const INSIDE: (f32, f32) = (f32::MIN_POSITIVE, 1.0_f32.next_down());

/// The least and greatest corner of all vertices; `None` without any.
fn bounds(triangles: &[Triangle]) -> Option<(glam::DVec3, glam::DVec3)> {
    let mut vertices = triangles.iter().flatten();
    let first = *vertices.next()?;
    Some(vertices.fold((first, first), |(lo, hi), v| (lo.min(*v), hi.max(*v))))
}
