//! What is known of many segments at once, so that none of them has to be asked for.
//!
//! Four facts about the triangles alone: which can block nothing ([`never_block`]), which make up
//! large convex [`Walls`], what stands in separate [`Objects`], and which [`Spaces`] are sealed off
//! from each other. [`Proven`] answers with them in front of any [`crate::Occluder`].

mod hull;
mod object;
mod proven;
mod shaft;
mod space;
mod wall;
mod weld;

pub use hull::never_block;
pub use object::Objects;
pub use proven::{Outlook, Proofs, Proven, Sight};
pub use space::{Spaces, solid_angle};
pub use wall::Walls;

use glam::DVec3;

/// A triangle lies in a plane if its corners are no farther from it than this share of the extent:
/// far above the rounding of f64 corners, far below what f32 can tell.
const IN_PLANE: f64 = 1e-9;

/// A plane: places with `normal` · place = `offset`; the normal has length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// Unit normal.
    pub normal: DVec3,
    /// Its distance from the origin along the normal, in scene units.
    pub offset: f64,
}

impl Plane {
    /// The plane of a triangle, its normal to the side from which corners run counter-clockwise;
    /// `None` without area.
    #[must_use]
    pub fn of([a, b, c]: [DVec3; 3]) -> Option<Self> {
        let size = (b - a).abs().max((c - a).abs()).max_element();
        // Scaled to unit size first: areas of tiny or huge triangles leave the range of f64.
        let normal = ((b - a) / size).cross((c - a) / size).try_normalize()?;
        Some(Self::through(a, normal))
    }

    /// The plane through a place with this unit normal.
    #[must_use]
    pub fn through(place: DVec3, normal: DVec3) -> Self {
        Self { normal, offset: normal.dot(place) }
    }

    /// How far a place lies in front of the plane.
    #[must_use]
    pub fn height(&self, place: DVec3) -> f64 {
        self.normal.dot(place) - self.offset
    }

    /// The least and the greatest height in a box.
    #[must_use]
    pub fn heights(&self, low: DVec3, high: DVec3) -> [f64; 2] {
        let (a, b) = (self.normal * low, self.normal * high);
        [a.min(b).element_sum() - self.offset, a.max(b).element_sum() - self.offset]
    }
}

/// The diagonal of the bounds of all triangles that are finite.
fn extent(triangles: &[[DVec3; 3]]) -> f64 {
    let finite = |t: &&[DVec3; 3]| t.iter().all(|p| p.is_finite());
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    for place in triangles.iter().filter(finite).flatten() {
        (low, high) = (low.min(*place), high.max(*place));
    }
    if low.x > high.x { 0.0 } else { (high - low).length() }
}
