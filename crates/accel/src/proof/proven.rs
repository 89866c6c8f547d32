//! Proofs in front of an occluder: what all segments between two surfaces have in common.

use glam::DVec3;

use super::shaft::Shaft;
use super::wall::Wall;
use super::{Objects, Plane, Spaces, Walls};
use crate::{Occluder, Segment, Target};

/// What is known of all segments between two surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sight {
    /// Nothing blocks any of them.
    Open,
    /// Each of them is blocked.
    Blocked,
    /// Each has to be asked for.
    Unknown,
}

/// Facts about the triangles of an occluder.
#[derive(Clone, Debug, Default)]
pub struct Proofs {
    /// Large convex occluders.
    pub walls: Walls,
    /// All that may block, in separate things; `None` if that is not known, and no way is open.
    pub objects: Option<Objects>,
    /// Spaces sealed off from each other.
    pub spaces: Spaces,
    /// How far from their surfaces segments begin and end at most, in scene units.
    pub lift: f64,
}

/// An occluder with proofs about its triangles: segments are answered as before, and many at once
/// where a proof holds.
#[derive(Clone, Copy)]
pub struct Proven<'a> {
    occluder: &'a dyn Occluder,
    proofs: &'a Proofs,
}

impl<'a> Proven<'a> {
    /// Puts proofs in front of an occluder over the same triangles.
    pub fn new(occluder: &'a dyn Occluder, proofs: &'a Proofs) -> Self {
        Self { occluder, proofs }
    }
}

impl Occluder for Proven<'_> {
    fn occluded(&self, segment: &Segment) -> bool {
        self.occluder.occluded(segment)
    }

    fn occluded_batch(&self, from: DVec3, ignore: u32, targets: &[Target], blocked: &mut [bool]) {
        self.occluder.occluded_batch(from, ignore, targets, blocked);
    }

    fn look_from(&self, surface: [DVec3; 3]) -> Option<Outlook<'_>> {
        Outlook::new(self.proofs, surface)
    }

    fn space(&self, place: DVec3) -> Option<u64> {
        self.proofs.spaces.space(place)
    }
}

/// What can be told of segments from one triangle, seen from its front.
#[derive(Debug)]
pub struct Outlook<'a> {
    surface: [DVec3; 3],
    plane: Plane,
    bounds: [DVec3; 2],
    lift: f64,
    /// Walls that have the surface on one side: in front or not.
    walls: Vec<(&'a Wall, bool)>,
    /// Bounds and corners of what rises above the surface; `None` if not known.
    above: Option<Vec<(&'a super::object::Object, [DVec3; 2])>>,
}

/// Lengths that segments are kept from what a proof says nothing of, in lifts: the lift itself, and
/// as much for the rounding of an occluder that works in f32, which is less than a tenth of it.
const SLACK: f64 = 2.0;

/// What rises less than this above a surface, in lifts, is passed by segments that start a lift above
/// it.
const FLAT: f64 = 0.5;

impl<'a> Outlook<'a> {
    fn new(proofs: &'a Proofs, surface: [DVec3; 3]) -> Option<Self> {
        let plane = Plane::of(surface)?;
        let slack = SLACK * proofs.lift;
        let sided = |wall: &'a Wall| {
            let heights = surface.map(|p| wall.plane.height(p));
            let front = heights.iter().all(|h| *h > slack);
            (front || heights.iter().all(|h| *h < -slack)).then_some((wall, front))
        };
        let walls: Vec<_> = proofs.walls.0.iter().filter_map(sided).collect();
        let rises = |o: &&super::object::Object| {
            o.places.iter().any(|p| plane.height(*p) > FLAT * proofs.lift)
        };
        let grown = |o: &'a super::object::Object| {
            (o, [o.low - DVec3::splat(slack), o.high + DVec3::splat(slack)])
        };
        let above = proofs.objects.as_ref().map(|o| o.0.iter().filter(rises).map(grown).collect());
        if walls.is_empty() && above.is_none() {
            return None;
        }
        let [a, b, c] = surface;
        let bounds = [a.min(b).min(c), a.max(b).max(c)];
        Some(Self { surface, plane, bounds, lift: proofs.lift, walls, above })
    }

    /// What is known of all segments between the surface and places in the box from `low` to `high`;
    /// `plane` is the one that all of these lie in, if they do, its normal to their lit side. Only
    /// those places count that lie in front of the surface, and in front of whose plane a part of the
    /// surface lies.
    #[must_use]
    pub fn sight(&self, low: DVec3, high: DVec3, plane: Option<&Plane>) -> Sight {
        if self.walls.iter().any(|(wall, front)| self.hides(wall, *front, low, high)) {
            return Sight::Blocked;
        }
        match &self.above {
            Some(above) if self.is_open(above, low, high, plane) => Sight::Open,
            _ => Sight::Unknown,
        }
    }

    fn hides(&self, wall: &Wall, front: bool, low: DVec3, high: DVec3) -> bool {
        let slack = SLACK * self.lift;
        let [least, most] = wall.plane.heights(low, high);
        let apart = if front { most < -slack } else { least > slack };
        apart && {
            let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
                let pick = |bit, a: f64, b: f64| if i & bit == 0 { a } else { b };
                DVec3::new(pick(1, low.x, high.x), pick(2, low.y, high.y), pick(4, low.z, high.z))
            });
            wall.cuts(&self.surface, &corners, slack)
        }
    }

    fn is_open(
        &self,
        above: &[(&super::object::Object, [DVec3; 2])],
        low: DVec3,
        high: DVec3,
        plane: Option<&Plane>,
    ) -> bool {
        if above.is_empty() && self.plane.heights(low, high)[0] > SLACK * self.lift {
            return true;
        }
        // Ends that lie as low as the surface may be lifted below it, to where flat things are.
        if self.plane.heights(low, high)[0] <= SLACK * self.lift {
            return false;
        }
        // Things that do not rise above the far surface are passed, too, if all of this one does.
        let far =
            plane.filter(|plane| self.surface.iter().all(|p| plane.height(*p) > SLACK * self.lift));
        let flat = |o: &super::object::Object| {
            far.is_some_and(|plane| o.places.iter().all(|p| plane.height(*p) <= FLAT * self.lift))
        };
        let shaft = Shaft::between(self.bounds, [low, high]);
        above.iter().all(|(object, [low, high])| shaft.misses(*low, *high) || flat(object))
    }
}
