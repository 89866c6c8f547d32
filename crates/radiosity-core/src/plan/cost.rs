//! What each kind of work takes, in seconds on one thread: for choosing, not for promises.
//!
//! Read off `radiosity solve SCENE --elements N --no-statement --threads 1 --report R.json` for room,
//! blocks, hall and church on one machine (docs/plan.md); on others all differ by much the same
//! factor, and decisions hang on ratios.

use super::Structure;

/// One form factor: facing, distance, kernel.
pub(super) const FORM_FACTOR: f64 = 80e-9;

/// A receiver that is looked at and does not face the shooter.
pub(super) const LOOK: f64 = 8e-9;

/// A block of receivers looked at for planes alone, and for each thing that a way may pass.
pub(super) const BLOCK: f64 = 25e-9;
pub(super) const THING: f64 = 9e-9;

/// A wall looked at for a block: most are not between.
pub(super) const WALL: f64 = 15e-9;

/// A direction of the census.
pub(super) const DIRECTION: f64 = 0.4e-6;

/// An element in the commit of a shot.
pub(super) const COMMIT: f64 = 11e-9;

/// An element of a mesh, made.
pub(super) const ELEMENT: f64 = 1.4e-6;

/// A triangle put into a structure.
pub(super) const BUILD: f64 = 0.6e-6;

/// A step worth sharing out must take this long: threads meet five times in each.
pub(super) const STEP_WORTH_SHARING: f64 = 60e-6;

/// A pool of threads is started in about this time.
pub(super) const POOL: f64 = 0.2e-3;

/// One segment in a batch, through so many triangles. The octree takes three times as long at every
/// size measured (docs/performance/occlusion.md).
pub(super) fn segment(structure: Structure, triangles: usize) -> f64 {
    let bvh = 25e-9 + 10e-9 * (triangles.max(1) as f64).log2();
    match structure {
        Structure::None => 0.0,
        Structure::Bvh => bvh,
        Structure::Octree => 3.0 * bvh,
    }
}
